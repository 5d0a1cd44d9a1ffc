//! A square of a page with a piece of the plane in it.

use crate::geom::{Point, Vector};
use crate::job::Detected;
use crate::job::pictures::color;
use crate::job::pictures::flat::SIDE;
use crate::optimize::orbit::Goal;
use crate::optimize::outcome::mirrors;
use crate::picture::canvas::{GREY, INK, Text};
use crate::picture::{Canvas, checks};
use crate::shape::SurfacePoint;
use crate::shape::wall::Wall;
use crate::straighten::Bend;
use crate::transform::{Isometry, Plane};

/// Room for a caption, and around a shape, pixels.
const CAPTION: f64 = 24.0;
const MARGIN: f64 = 14.0;
/// Lines drawn at the most.
const LINES: usize = 3;
/// Of all pairs one in so many is drawn.
const PAIRS: usize = 5;
/// Inside of shapes, light grey.
const INSIDE: [u8; 3] = [228, 231, 236];
/// The mirror image that is laid over a shape.
const IMAGE: [u8; 3] = [220, 60, 60];
/// Edges of meshes.
const PALE_BLUE: [u8; 3] = [90, 120, 170];

/// What is seen of the plane: its middle, working coordinates, and pixels for each L.
#[derive(Clone, Copy)]
pub struct Frame {
    middle: Point,
    scale: f64,
}

impl Frame {
    pub fn around(wall: &Wall) -> Self {
        let x = &wall.surface.positions;
        let low = x.iter().fold(x[0], |m, x| m.inf(x));
        let high = x.iter().fold(x[0], |m, x| m.sup(x));
        let room = f64::from(SIDE) - 2.0 * MARGIN - CAPTION;
        let size = (high.x - low.x).max(high.y - low.y);
        Self {
            middle: nalgebra::center(&low, &high),
            scale: room / size.max(f64::MIN_POSITIVE),
        }
    }

    /// The same middle, nothing larger than in the other.
    pub fn as_large_as(self, other: &Self) -> Self {
        Self {
            scale: self.scale.min(other.scale),
            ..self
        }
    }
}

/// A square of the page with a piece of the plane in it.
pub struct Panel<'a> {
    page: &'a mut Canvas,
    corner: [f64; 2],
    frame: Frame,
}

impl<'a> Panel<'a> {
    pub fn new(page: &'a mut Canvas, corner: [u32; 2], frame: Frame, caption: &str) -> Self {
        let corner = corner.map(f64::from);
        let mut panel = Self {
            page,
            corner,
            frame,
        };
        panel.caption(caption);
        panel
    }

    fn caption(&mut self, caption: &str) {
        let [x, y] = self.corner;
        let text = Text::new(caption, x + MARGIN, y + 16.0, 14.0).colored(GREY);
        self.page.text(text.within(f64::from(SIDE) - 2.0 * MARGIN));
    }

    fn at(&self, x: &Point) -> [f64; 2] {
        let way = (x - self.frame.middle) * self.frame.scale;
        let half = f64::from(SIDE) / 2.0;
        [
            self.corner[0] + half + way.x,
            self.corner[1] + half + CAPTION / 2.0 - way.y,
        ]
    }

    fn holds(&self, x: &[f64; 2]) -> bool {
        (0..2).all(|i| (0.0..=f64::from(SIDE)).contains(&(x[i] - self.corner[i])))
    }

    fn rings(&self, wall: &Wall, place: impl Fn(Point) -> Point) -> Vec<Vec<[f64; 2]>> {
        let ring = |edges: &std::ops::Range<usize>| {
            let mut points: Vec<[f64; 2]> = edges
                .clone()
                .map(|e| self.at(&place(wall.start(e))))
                .collect();
            points.extend(points.first().copied());
            points
        };
        wall.rings.iter().map(ring).collect()
    }

    pub fn outline(&mut self, wall: &Wall) {
        let rings = self.rings(wall, |x| x);
        self.page.area(rings.clone(), INSIDE);
        for ring in rings {
            self.page.path(ring, 1.2, INK);
        }
    }

    /// The mirror image, over the shape.
    pub fn image(&mut self, wall: &Wall, plane: &Plane) {
        let mirror = Isometry::mirror(plane);
        for ring in self.rings(wall, |x| mirror.apply(&x)) {
            // What would lie in other panels is left out.
            let pieces = ring.split(|x| !self.holds(x)).filter(|p| p.len() > 1);
            let pieces: Vec<Vec<[f64; 2]>> = pieces.map(<[_]>::to_vec).collect();
            for piece in pieces {
                self.page.path(piece, 1.0, IMAGE);
            }
        }
    }

    /// A line across the shape.
    pub fn line(&mut self, plane: &Plane, color: [u8; 3], width: f64) {
        let (n, middle) = (plane.normal, self.frame.middle);
        let foot = middle - plane.signed_distance(&middle) * n;
        let half = (f64::from(SIDE) / 2.0 - MARGIN) / self.frame.scale;
        let way = Vector::new(-n.y, n.x, 0.0) * half;
        let ends = [foot - way, foot + way].map(|x| self.at(&x));
        self.page.line(ends[0], ends[1], width, color);
    }

    /// The shape with what its symmetries hold for, and its image under `plane`.
    pub fn state(&mut self, found: &Detected, wall: &Wall, plane: Option<Plane>) {
        self.outline(wall);
        if let Some(plane) = plane {
            self.image(wall, &plane);
        }
        let lines: Vec<_> = mirrors(&found.detection).take(LINES).collect();
        for s in lines.into_iter().rev() {
            for pair in &s.pairs {
                let x = found.detection.samples.list[pair.sample as usize].position;
                self.page.circle(self.at(&x), 1.5, 1.5, color(s.id));
            }
            self.line(&s.plane(), color(s.id), 1.5);
        }
    }

    /// The shape with the places of a `goal` in a colour each, and the first carried onto the others.
    pub fn copies(&mut self, found: &Detected, wall: &Wall, goal: &Goal) {
        self.outline(wall);
        let list = &found.detection.samples.list;
        let place = |i: &u32| wall.surface.point(&list[*i as usize].at);
        for (k, places) in (0..).zip(&goal.places) {
            for i in places {
                self.page.circle(self.at(&place(i)), 1.5, 1.5, color(k));
            }
        }
        for link in goal.links(0).first().into_iter().flatten() {
            for i in &goal.places[link.from] {
                let image = self.at(&link.t.apply(&place(i)));
                if self.holds(&image) {
                    self.page.circle(image, 0.5, 0.8, IMAGE);
                }
            }
        }
    }

    /// The pairs of a field in matching colours, and the middles between them.
    pub fn field(&mut self, found: &Detected, wall: &Wall, bend: &Bend) {
        self.caption("pairs and spine");
        self.outline(wall);
        let list = &found.detection.samples.list;
        let along = Along::of(wall);
        for (k, (s, partner)) in list.iter().zip(&bend.settled.partners).enumerate() {
            let Some(q) = partner else { continue };
            let color = checks::hue(along.share(wall, &s.at, &q.at));
            let ends = [self.at(&s.position), self.at(&q.position)];
            if k % PAIRS == 0 {
                self.page.line(ends[0], ends[1], 0.7, color);
            }
            let middle = [0, 1].map(|i| (ends[0][i] + ends[1][i]) / 2.0);
            self.page.circle(middle, 0.8, 1.2, color);
        }
    }

    pub fn mesh(&mut self, triangles: &[[u32; 3]], positions: &[Point]) {
        self.caption("the mesh inside");
        for corners in triangles {
            let [a, b, c] = corners.map(|v| self.at(&positions[v as usize]));
            self.page.path(vec![a, b, c, a], 0.4, PALE_BLUE);
        }
    }
}

/// How far along an outline places are.
struct Along {
    starts: Vec<f64>,
    total: f64,
}

impl Along {
    fn of(wall: &Wall) -> Self {
        let mut starts = Vec::new();
        let mut total = 0.0;
        for ring in 0..wall.rings.len() {
            starts.push(total);
            total += wall.length(ring);
        }
        Self { starts, total }
    }

    /// 0 to 1, the same for two partners.
    fn share(&self, wall: &Wall, p: &SurfacePoint, q: &SurfacePoint) -> f64 {
        let share = |at: &SurfacePoint| {
            let (ring, along) = wall.along(at);
            (self.starts[ring] + along) / self.total
        };
        share(p).min(share(q))
    }
}
