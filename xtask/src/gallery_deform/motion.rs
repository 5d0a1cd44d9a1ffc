//! The rigid motion of a handle.

use symmetrizer::geom::{Point, Vector, exp_rotation};

/// A turn about a pivot that is shifted meanwhile.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// The pivot before.
    pub pivot: Point,
    /// Axis times angle in radians.
    pub turn: Vector,
    /// The way of the pivot.
    pub shift: Vector,
}

impl Motion {
    /// Where `x` is after the share `t` of the motion.
    pub fn after(&self, t: f64, x: &Point) -> Point {
        self.pivot + self.shift * t + exp_rotation(&(self.turn * t)) * (x - self.pivot)
    }
}
