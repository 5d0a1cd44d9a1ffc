//! Mirror planes in a picture: translucent sheets with an outline, and the line where they cut the
//! shape.

use crate::geom::{Point, Vector};
use crate::picture::camera::{Camera, View, unit};
use crate::picture::light::to_linear;
use crate::picture::stance::Stance;
use crate::transform::isometry::Plane;

/// How much of what is behind a sheet it hides.
const SHEET: f64 = 0.26;
/// How much of what is behind an outline it hides.
const OUTLINE: f64 = 0.9;
/// How much the line where a sheet cuts the shape hides of it.
const CUT: f64 = 0.75;
/// How far a sheet reaches beyond the shape, as a share of half the shape's extent.
const MARGIN: f64 = 0.06;

/// Something translucent in front of a sample: depth, linear colour, opacity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layer {
    pub depth: f64,
    pub color: [f64; 3],
    pub opacity: f64,
}

/// A rectangle in space, drawn as a translucent sheet with an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tile {
    /// Its corners in order, model units.
    pub corners: [Point; 4],
    /// sRGB.
    pub color: [u8; 3],
}

/// A rectangle projected into a picture: of a mirror plane around the shape, or a tile.
pub(super) struct Sheet {
    color: [f64; 3],
    /// The corners in order, sample coordinates and depth.
    corners: [Vector; 4],
    /// Half the width of the outline, samples.
    half_line: f64,
}

/// The corners, in order, of the rectangle of `plane` beside the vertices; `None` where the plane
/// has no place or direction, or there are no vertices.
pub(super) fn corners(plane: &Plane, positions: &[Point]) -> Option<[Point; 4]> {
    let normal = unit(plane.normal)?;
    let stance = Stance::about(Some(plane), positions);
    let view = View::new(normal, stance.up);
    let origin = Point::from(normal * (plane.offset / plane.normal.norm()));
    let (center, half) = view.bounds(positions.iter(), &origin)?;
    // The longer side sets the margin, so that it is even all around.
    let grow = MARGIN * half.x.max(half.y);
    let signs = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    Some(signs.map(|[sx, sy]| {
        let x = center.x + sx * (half.x + grow);
        let y = center.y + sy * (half.y + grow);
        origin + view.right() * x + view.up * y
    }))
}

impl Sheet {
    /// The part of `plane` beside the vertices, or `None` where it has no place or direction.
    pub fn new(
        plane: &Plane,
        color: [u8; 3],
        positions: &[Point],
        camera: &Camera,
        half_line: f64,
    ) -> Option<Self> {
        let corners = corners(plane, positions)?;
        Self::over(&Tile { corners, color }, camera, half_line)
    }

    /// The `tile`, or `None` where it has no place.
    pub fn over(tile: &Tile, camera: &Camera, half_line: f64) -> Option<Self> {
        let corners = tile.corners.map(|c| camera.project(&c));
        let finite = corners.iter().all(|c| c.iter().all(|x| x.is_finite()));
        finite.then_some(Self {
            color: tile.color.map(|c| to_linear(f64::from(c) / 255.0)),
            corners,
            half_line,
        })
    }

    /// What of this sheet covers the picture position, if anything: the outline, else the sheet.
    pub fn layer(&self, x: f64, y: f64) -> Option<Layer> {
        let outline = (0..4)
            .filter_map(|i| self.side(i, x, y))
            .min_by(f64::total_cmp);
        let (depth, opacity) = match outline {
            Some(depth) => (depth, OUTLINE),
            None => (self.inside(x, y)?, SHEET),
        };
        Some(Layer {
            depth,
            color: self.color,
            opacity,
        })
    }

    /// The line on the shape's surface at a sample position with depth, where the sheet cuts it.
    pub fn cut(&self, at: &Vector) -> Option<Layer> {
        let [o, u, _, v] = self.corners;
        let (u, v, way) = (u - o, v - o, at - o);
        let normal = unit(u.cross(&v))?;
        let near = normal.dot(&way).abs() <= self.half_line;
        let beside = |side: &Vector| (0.0..=side.norm_squared()).contains(&side.dot(&way));
        (near && beside(&u) && beside(&v)).then_some(Layer {
            depth: at.z,
            color: self.color,
            opacity: CUT,
        })
    }

    /// The depth of side `i`, where its stroke covers the position.
    fn side(&self, i: usize, x: f64, y: f64) -> Option<f64> {
        let (a, b) = (self.corners[i], self.corners[(i + 1) % 4]);
        let along = (b - a).xy();
        let from_a = Vector::new(x, y, 0.0).xy() - a.xy();
        let length2 = along.norm_squared();
        let t = if length2 > 1e-9 {
            (from_a.dot(&along) / length2).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let near = (from_a - along * t).norm() <= self.half_line;
        // Seen end-on, the near end counts.
        let depth = if length2 > 1e-9 {
            a.z + (b.z - a.z) * t
        } else {
            a.z.min(b.z)
        };
        near.then_some(depth)
    }

    /// The depth of the sheet, where it covers the position. A sheet seen edge-on covers nothing.
    fn inside(&self, x: f64, y: f64) -> Option<f64> {
        let [o, u, _, v] = self.corners;
        let (u, v) = (u - o, v - o);
        let det = u.x * v.y - u.y * v.x;
        let (px, py) = (x - o.x, y - o.y);
        let s = (px * v.y - py * v.x) / det;
        let t = (u.x * py - u.y * px) / det;
        let within = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
        (within && det.abs() > 1.0).then(|| o.z + s * u.z + t * v.z)
    }
}
