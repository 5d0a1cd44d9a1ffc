//! Outlines as surfaces: a wall along each ring.
//!
//! A shape of the plane is to the stages what a shape of space is: the wall over its outline is a surface
//! whose normals lie in the plane, whose closest points are those of the outline, and whose samples lie on it.

use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::shape::surface::{Surface, SurfacePoint};
use crate::shape::working::Normalization;

/// Half the height of a wall, fraction of L: of no weight beside any length of a shape.
const HALF: f64 = 5e-4;
/// Longest edge, fraction of L, and the number of edges above which they may be longer.
const PIECE: f64 = 0.004;
const MOST: f64 = 100_000.0;
/// Places to either side that a mean is taken over.
const MEANS: i32 = 3;

/// The wall over closed rings.
#[derive(Debug, Clone)]
pub struct Wall {
    /// The wall, in working coordinates: for each edge of a ring, cut into short ones, two triangles.
    pub surface: Surface,
    /// The rings as ranges of edges: edge e has the triangles 2 e and 2 e + 1.
    pub rings: Vec<std::ops::Range<usize>>,
    /// Lengths from the start of the ring to the start of each edge, fraction of L.
    starts: Vec<f64>,
    /// The length of each edge, fraction of L.
    lengths: Vec<f64>,
    /// From and to the coordinates of the rings.
    pub normalization: Normalization,
}

impl Wall {
    /// Over `rings` at z = 0: the shape to their left, the last point of each joined to its first.
    ///
    /// # Errors
    /// [`Error::Input`] where they have no length.
    pub fn new(rings: &[Vec<Point>]) -> Result<Self> {
        let (normalization, total) = normalize(rings)?;
        let piece = PIECE.max(total / MOST);
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let (mut starts, mut lengths, mut ranges) = (Vec::new(), Vec::new(), Vec::new());
        for ring in rings.iter().filter(|ring| ring.len() > 2) {
            let first = starts.len();
            let base = positions.len() as u32;
            let ring: Vec<Point> = ring.iter().map(|x| normalization.to_working(x)).collect();
            let ring = divided(&ring, piece);
            let count = ring.len();
            let mut along = 0.0;
            for (k, x) in ring.iter().enumerate() {
                let y = &ring[(k + 1) % count];
                positions.extend([-HALF, HALF].map(|z| Point::new(x.x, x.y, z)));
                let [a, b] = [k, (k + 1) % count].map(|k| base + 2 * k as u32);
                triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
                starts.push(along);
                lengths.push((y - x).norm());
                along += (y - x).norm();
            }
            ranges.push(first..starts.len());
        }
        Ok(Self {
            surface: Surface::new(positions, triangles.into()),
            rings: ranges,
            starts,
            lengths,
            normalization,
        })
    }

    /// The same wall with its vertices at other positions, in the same working coordinates.
    pub fn moved(&self, positions: Vec<Point>) -> Self {
        let surface = self.surface.with_positions(positions);
        let mut moved = Self {
            surface,
            ..self.clone()
        };
        for ring in &self.rings {
            let mut along = 0.0;
            for edge in ring.clone() {
                let length = (moved.start(moved.next(edge)) - moved.start(edge)).norm();
                moved.starts[edge] = along;
                moved.lengths[edge] = length;
                along += length;
            }
        }
        moved
    }

    /// The length of a ring, fraction of L.
    pub fn length(&self, ring: usize) -> f64 {
        let last = self.rings[ring].end - 1;
        self.starts[last] + self.lengths[last]
    }

    /// The point of the outline at the length `along` from the start of a ring, around which it runs again and
    /// again.
    pub fn at(&self, ring: usize, along: f64) -> SurfacePoint {
        let range = self.rings[ring].clone();
        let along = along.rem_euclid(self.length(ring));
        let starts = &self.starts[range.clone()];
        let k = starts.partition_point(|s| *s <= along).max(1) - 1;
        let edge = range.start + k;
        let t = ((along - starts[k]) / self.lengths[edge].max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        // The middle line leaves the triangle a, b, b' for a, b', a' half way.
        if t >= 0.5 {
            let bary = [1.0 - t, t - 0.5, 0.5];
            SurfacePoint {
                face: 2 * edge as u32,
                bary,
            }
        } else {
            let bary = [0.5, t, 0.5 - t];
            SurfacePoint {
                face: 2 * edge as u32 + 1,
                bary,
            }
        }
    }

    /// On which ring a point of the wall lies, and at which length from its start, fraction of L.
    pub fn along(&self, at: &SurfacePoint) -> (usize, f64) {
        let (edge, t) = Self::on_edge(at);
        (self.ring(edge), self.starts[edge] + t * self.lengths[edge])
    }

    /// On which edge a point of the wall lies, and at which share of it.
    pub fn on_edge(at: &SurfacePoint) -> (usize, f64) {
        let [_, b, c] = at.bary;
        let t = if at.face.is_multiple_of(2) { b + c } else { b };
        (at.face as usize / 2, t)
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.starts.len()
    }

    /// The edge that follows an edge on its ring.
    pub fn next(&self, edge: usize) -> usize {
        let ring = &self.rings[self.ring(edge)];
        if edge + 1 == ring.end {
            ring.start
        } else {
            edge + 1
        }
    }

    /// Where an edge starts.
    pub fn start(&self, edge: usize) -> Point {
        let x = &self.surface.positions[2 * edge];
        Point::new(x.x, x.y, 0.0)
    }

    fn ring(&self, edge: usize) -> usize {
        self.rings.partition_point(|r| r.end <= edge)
    }

    /// The place of the outline at the length `along` from the start of a ring.
    pub fn place(&self, ring: usize, along: f64) -> Point {
        self.surface.point(&self.at(ring, along))
    }

    /// The mean place over the length `half` to either side of that.
    pub fn mean_place(&self, ring: usize, along: f64, half: f64) -> Point {
        let steps = (-MEANS..=MEANS).map(|k| f64::from(k) / f64::from(MEANS));
        let places = steps.map(|step| self.place(ring, along + step * half).coords);
        Point::from(places.sum::<Vector>() / f64::from(2 * MEANS + 1))
    }
}

/// The centroid of the rings' length and L = 4 x its rms radius; the length itself, fraction of L.
fn normalize(rings: &[Vec<Point>]) -> Result<(Normalization, f64)> {
    let edges = || {
        rings.iter().filter(|r| r.len() > 2).flat_map(|ring| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next)
        })
    };
    let total: f64 = edges().map(|(a, b)| (b - a).norm()).sum();
    if !(total.is_finite() && total > 0.0) {
        return Err(Error::input(
            "the outline has no length",
            "it needs at least one closed ring of three points that are not at one place",
        ));
    }
    let center = edges()
        .map(|(a, b)| nalgebra::center(a, b).coords * (b - a).norm())
        .sum::<Vector>()
        / total;
    // Along a straight edge the mean of x^2 is that of its ends and its middle by Simpson's rule.
    let square = |x: &Point| (x.coords - center).norm_squared();
    let moment: f64 = edges()
        .map(|(a, b)| {
            let middle = nalgebra::center(a, b);
            (square(a) + 4.0 * square(&middle) + square(b)) / 6.0 * (b - a).norm()
        })
        .sum();
    let scale = 4.0 * (moment / total).sqrt();
    let normalization = Normalization {
        center: center.into(),
        scale,
    };
    Ok((normalization, total / scale))
}

/// A ring with its edges cut into pieces of at most this length: normals at its points, which are means of two
/// edges, then say nothing of the middle of an edge.
fn divided(ring: &[Point], piece: f64) -> Vec<Point> {
    let next = ring.iter().cycle().skip(1);
    let cut = |(a, b): (&Point, &Point)| {
        let count = ((b - a).norm() / piece).ceil().max(1.0);
        let (a, way) = (*a, b - a);
        (0..count as u32).map(move |k| a + way * (f64::from(k) / count))
    };
    ring.iter().zip(next).flat_map(cut).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_has_its_corners_and_normals_outwards() {
        let corners = [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]];
        let ring = corners.map(|[x, y]| Point::new(x, y, 0.0)).to_vec();
        let wall = Wall::new(&[ring]).expect("a wall");
        let scale = wall.normalization.scale;
        // The mean square distance of a square's sides of length 2 from its centre is 1 + 1/3.
        assert!((scale - 4.0 * (4.0_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert!((wall.length(0) - 8.0 / scale).abs() < 1e-12);
        for (along, place, normal) in [
            (0.5, [-0.5, -1.0], [0.0, -1.0]),
            (1.7, [0.7, -1.0], [0.0, -1.0]),
            (3.0, [1.0, 0.0], [1.0, 0.0]),
            (8.0 + 5.0, [0.0, 1.0], [0.0, 1.0]),
        ] {
            let at = wall.at(0, along / scale);
            let x = wall.surface.point(&at);
            assert!((x.x * scale - place[0]).abs() < 1e-9, "{x}");
            assert!((x.y * scale - place[1]).abs() < 1e-9, "{x}");
            assert!(x.z.abs() < 1e-12);
            let n = wall.surface.face_normals[at.face as usize];
            assert!(
                (n.x - normal[0]).abs() + (n.y - normal[1]).abs() < 1e-9,
                "{n}"
            );
            let (ring, back) = wall.along(&at);
            assert!(ring == 0 && (back - along.rem_euclid(8.0) / scale).abs() < 1e-9);
        }
    }

    #[test]
    fn points_at_one_place_are_no_outline() {
        let ring = vec![Point::new(2.0, 1.0, 0.0); 5];
        assert!(Wall::new(&[ring]).is_err());
        assert!(Wall::new(&[]).is_err());
    }
}
