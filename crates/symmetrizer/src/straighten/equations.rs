//! Normal equations over the twists of many rigid motions.

use std::collections::BTreeMap;

use nalgebra::Matrix6;

use crate::deform::solver::{Entries, SolveError, Twist};
use crate::geom::Vector;

/// What is added to the diagonal for a turn, L^2, and for a way: what nothing holds stays.
const RIDGE: [f64; 2] = [1e-9, 1e-6];

/// Sums of squares that are linear in the twists.
pub struct Equations {
    /// Lower blocks: row, column.
    blocks: BTreeMap<(u32, u32), Matrix6<f64>>,
    right: Vec<Twist>,
}

/// How far the point at `arm` from a motion's centre goes along `direction`, as a row over its twist:
/// direction . (v + omega x arm).
pub fn along(direction: &Vector, arm: &Vector) -> Twist {
    let turn = arm.cross(direction);
    Twist::new(
        turn.x,
        turn.y,
        turn.z,
        direction.x,
        direction.y,
        direction.z,
    )
}

impl Equations {
    /// Of `count` motions.
    pub fn new(count: usize) -> Self {
        Self {
            blocks: BTreeMap::new(),
            right: vec![Twist::zeros(); count],
        }
    }

    /// Adds `weight` times the square of `miss` plus the rows' products with the twists of two motions,
    /// which may be the same.
    pub fn add(&mut self, [a, b]: [(u32, Twist); 2], miss: f64, weight: f64) {
        if a.0 == b.0 {
            self.add_terms(&[(a.0, a.1 + b.1)], miss, weight);
        } else {
            self.add_terms(&[a, b], miss, weight);
        }
    }

    fn add_terms(&mut self, terms: &[(u32, Twist)], miss: f64, weight: f64) {
        for (i, row) in terms {
            self.right[*i as usize] -= weight * miss * row;
            for (j, other) in terms.iter().filter(|(j, _)| j <= i) {
                let block = self.blocks.entry((*i, *j)).or_insert_with(Matrix6::zeros);
                *block += weight * row * other.transpose();
            }
        }
    }

    /// The twists that make the sum least.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn solve(self) -> Result<Vec<Twist>, SolveError> {
        let mut entries = Entries::default();
        for ((i, j), block) in &self.blocks {
            let (i, j) = (6 * *i as usize, 6 * *j as usize);
            for r in 0..6 {
                let last = if i == j { r } else { 5 };
                (0..=last).for_each(|c| entries.add(i + r, j + c, block[(r, c)]));
            }
        }
        let n = 6 * self.right.len();
        (0..n).for_each(|i| entries.add(i, i, RIDGE[i % 6 / 3]));
        let mut x: Vec<f64> = self.right.iter().flat_map(|t| t.data.0[0]).collect();
        entries.factorized(n)?.solve(&mut x)?;
        Ok(x.chunks_exact(6).map(Twist::from_column_slice).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_points_meet_half_way() {
        // Two motions, each with a point at its centre, 1 apart along x.
        let mut equations = Equations::new(2);
        for axis in 0..3 {
            let e = Vector::ith(axis, 1.0);
            let rows = [(0, along(&e, &Vector::y())), (1, -along(&e, &Vector::y()))];
            equations.add(rows, e.x, 1.0);
        }
        let found = equations.solve().expect("positive definite");
        let reached = |k: usize| {
            let (omega, v) = (found[k].fixed_rows::<3>(0), found[k].fixed_rows::<3>(3));
            v + omega.cross(&Vector::y())
        };
        let gap = Vector::x() + reached(0) - reached(1);
        assert!(gap.norm() < 1e-5, "{gap}");
        assert!((reached(0) + reached(1)).norm() < 1e-9);
    }

    #[test]
    fn one_motion_may_be_asked_twice() {
        let mut equations = Equations::new(1);
        let row = along(&Vector::x(), &Vector::zeros());
        equations.add([(0, row), (0, row)], 1.0, 1.0);
        let found = equations.solve().expect("positive definite");
        assert!((found[0][3] + 0.5).abs() < 1e-5, "{}", found[0]);
    }
}
