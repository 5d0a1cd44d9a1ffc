//! Symmetries that belong together: the finite groups of those that fix a point, and rows, rings
//! and grids of those that do not.
//!
//! Here are isometries only. Whether one holds on a shape a callback says, which also returns it
//! refined: everything new that products and powers suggest is offered to it, and nothing is
//! believed that it refuses.

mod closure;
pub mod exact;
mod fixed;
pub mod grid;
pub mod name;
pub mod point_group;
pub mod row;
mod step;

pub use fixed::fixed_together;
pub use grid::{Grid, Pattern, patterns};
pub use name::Name;
pub use point_group::{PointGroup, point_group};
pub use row::{Row, row};

use crate::transform::{Isometry, TransformSpace};

/// Says whether an isometry holds on the shape: refined where it does, `None` where it does not.
pub type Verify<'a> = dyn FnMut(&Isometry) -> Option<Isometry> + 'a;

/// How far two isometries may be apart and count as one.
#[derive(Debug, Clone, Copy)]
pub struct Within<'a> {
    /// Where the distance is measured: the rms displacement over the part that is symmetric.
    pub space: &'a TransformSpace,
    /// The greatest distance, in the space's unit: at least three times the error of a verified
    /// isometry, because products add up two and are compared with a third, and less than half of
    /// the distance of two that are to be told apart.
    pub tolerance: f64,
}

impl Within<'_> {
    /// Whether `a` and `b` count as one.
    fn same(&self, a: &Isometry, b: &Isometry) -> bool {
        self.space.distance(a, b) <= self.tolerance
    }

    /// The nearest of `among` that counts as one with `t`; the earlier of two equally near.
    fn find(&self, t: &Isometry, among: &[Isometry]) -> Option<usize> {
        let distances = among.iter().map(|a| self.space.distance(a, t));
        distances
            .enumerate()
            .filter(|(_, d)| *d <= self.tolerance)
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(i, _)| i)
    }

    /// The answer to `t`, where it is about `t`: a refinement that left for another isometry, more
    /// than twice the tolerance away, refuses this one.
    fn ask(&self, t: &Isometry, verify: &mut Verify<'_>) -> Option<Isometry> {
        let near = |r: &Isometry| {
            r.is_improper() == t.is_improper() && self.space.distance(r, t) <= 2.0 * self.tolerance
        };
        verify(t).filter(near)
    }
}

#[cfg(test)]
mod tests;
