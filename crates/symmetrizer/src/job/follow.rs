//! What a drawing's outline takes along: all of the plane.

use crate::deform::{Igarashi, carry};
use crate::error::Result;
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::wall::Wall;
use crate::shape::working::Normalization;
use crate::shape::{ClosestPoint, Surface};

/// Edges bulge where vertices turn by less than their neighbours do, radians, and not where by more: on the way round a
/// corner that closes they would come to lie across each other.
const CALM: [f64; 2] = [0.15, 0.45];

/// Where all of the plane goes with an outline: with the triangles inside; around it, with the nearest place on it.
pub struct Follow {
    normalization: Normalization,
    rest: Surface,
    closest: ClosestPoint,
    /// Where the vertices of the inside go, how their surroundings turn, and how far edges bulge there, 0 to 1.
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

    /// Where a place of the drawing goes: with the triangle there, or nearest to it, whose edges bulge as its corners
    /// turn.
    pub fn place(&self, x: &Point) -> Point {
        let x = self.normalization.to_working(x);
        let Some(hit) = self.closest.nearest(&x, f64::INFINITY) else {
            return x;
        };
        let corners = self.rest.triangles[hit.at.face as usize].map(|v| v as usize);
        let terms = || corners.iter().zip(hit.at.bary);
        let plain: Vector = terms().map(|(&v, b)| b * self.places[v].coords).sum();
        let turned = |way: &dyn Fn(usize) -> Vector| -> Vector {
            let along = terms().map(|(&v, b)| b * (self.rotations[v] * way(v)));
            along.sum()
        };
        let bulge = turned(&|v| hit.point - self.rest.positions[v]);
        let beside = turned(&|_| x - hit.point);
        let calm = corners
            .map(|v| self.calm[v])
            .into_iter()
            .fold(1.0, f64::min);
        let moved = Point::from(plain + calm * bulge + beside);
        let moved = self.normalization.to_document(&moved);
        Point::new(moved.x, moved.y, 0.0)
    }
}

/// How calm it is around each vertex: 1 where its neighbours turn as it does, 0 where they do not.
fn calm(rest: &Surface, rotations: &[Matrix3]) -> Vec<f64> {
    let mut most = vec![0.0_f64; rotations.len()];
    // Where the inside is turned over, by half a turn about an axis of the plane.
    let angle = |m: &Matrix3| ((m.trace() - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
    for [u, v] in rest.edges() {
        let (u, v) = (u as usize, v as usize);
        let apart = angle(&(rotations[u].transpose() * rotations[v]));
        most[u] = most[u].max(apart);
        most[v] = most[v].max(apart);
    }
    let [low, high] = CALM;
    let share = |a: f64| 1.0 - ((a - low) / (high - low)).clamp(0.0, 1.0);
    most.into_iter().map(share).collect()
}
