//! What a drawing's outline takes along: all of the plane.

use crate::deform::{Igarashi, carry};
use crate::error::Result;
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::wall::Wall;
use crate::shape::working::Normalization;
use crate::shape::{ClosestPoint, Surface};

/// Vertices whose neighbours turn by less, radians, take along what is around them as they turn; those whose
/// neighbours turn by more leave it to the triangles. On the way round a corner that closes, an edge would bulge.
const CALM: [f64; 2] = [0.15, 0.45];

/// Where all of the plane goes with an outline: with the triangles inside; around it, with the nearest place on it.
pub struct Follow {
    normalization: Normalization,
    rest: Surface,
    closest: ClosestPoint,
    /// Where the vertices of the inside go, how their surroundings turn, and how far they take these along, 0 to 1.
    places: Vec<Point>,
    rotations: Vec<Matrix3>,
    calm: Vec<f64>,
}

impl Follow {
    /// With `wall`, whose vertices go to `positions`.
    ///
    /// # Errors
    /// [`crate::Error::Numerical`].
    pub fn new(wall: &Wall, positions: &[Point]) -> Result<Self> {
        let body = Igarashi::new(wall.clone())?;
        let places = body.filled(positions)?;
        let rest = body.sheet().surface.clone();
        let moved = rest.with_positions(places.clone());
        let motions = carry::motions(&rest, &moved);
        let rotations: Vec<Matrix3> = motions.iter().map(|m| m.rotation).collect();
        Ok(Self {
            normalization: wall.normalization,
            closest: ClosestPoint::new(&rest),
            calm: calm(&rest, &rotations),
            rotations,
            places,
            rest,
        })
    }

    /// Where a place of the drawing goes: each corner of the triangle there, or nearest to it, takes it along as it
    /// turns itself.
    pub fn place(&self, x: &Point) -> Point {
        let x = self.normalization.to_working(x);
        let Some(hit) = self.closest.nearest(&x, f64::INFINITY) else {
            return x;
        };
        let corners = self.rest.triangles[hit.at.face as usize];
        let at = |places: &[Point]| {
            let terms = corners.iter().zip(hit.at.bary);
            terms
                .map(|(&v, b)| b * places[v as usize].coords)
                .sum::<Vector>()
        };
        // As the triangle has it, with what lies beside it carried along.
        let plain = at(&self.places);
        let foot = Point::from(at(&self.rest.positions));
        let carried = corners.iter().zip(hit.at.bary).map(|(&v, b)| {
            let v = v as usize;
            let (rest, turn) = (self.rest.positions[v], self.rotations[v]);
            let along = plain - self.places[v].coords + turn * (x - foot);
            let taken = turn * (x - rest);
            let calm = self.calm[v];
            b * (self.places[v].coords + calm * taken + (1.0 - calm) * along)
        });
        let moved = Point::from(carried.sum::<Vector>());
        let moved = self.normalization.to_document(&moved);
        Point::new(moved.x, moved.y, 0.0)
    }
}

/// How calm it is around each vertex: 1 where its neighbours turn as it does, 0 where they do not.
fn calm(rest: &Surface, rotations: &[Matrix3]) -> Vec<f64> {
    let mut most = vec![0.0_f64; rotations.len()];
    let angle = |m: &Matrix3| m[(1, 0)].atan2(m[(0, 0)]);
    for [u, v] in rest.edges() {
        let (u, v) = (u as usize, v as usize);
        let apart = angle(&(rotations[u].transpose() * rotations[v])).abs();
        most[u] = most[u].max(apart);
        most[v] = most[v].max(apart);
    }
    let [low, high] = CALM;
    let share = |a: f64| 1.0 - ((a - low) / (high - low)).clamp(0.0, 1.0);
    most.into_iter().map(share).collect()
}
