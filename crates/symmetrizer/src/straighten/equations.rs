//! Normal equations over the twists of many rigid motions.

use nalgebra::{Matrix3x6, Matrix6};

use crate::deform::solver::{Cholesky, SolveError, Twist};
use crate::geom::{Vector, skew};

/// What is added to the diagonal for a turn, L^2, and for a way: what nothing holds stays.
const RIDGE: [f64; 2] = [1e-9, 1e-6];

/// What of a twist there is in space, and what of it does not lead out of the plane: the turn about z and two ways.
const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];
const FLAT: [usize; 3] = [2, 3, 4];

/// Sums of squares that are linear in the twists.
pub struct Equations {
    /// Lower blocks: for each column its rows, in the order in which they came.
    blocks: Vec<Vec<(u32, Matrix6<f64>)>>,
    right: Vec<Twist>,
    /// Whether the motions stay in the plane.
    flat: bool,
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

/// Points of two motions that are to be at the same places.
#[derive(Debug, Clone, Default)]
pub struct Spring {
    /// Of the first, of the second, and between the second (rows) and the first.
    blocks: [Matrix6<f64>; 3],
    right: [Twist; 2],
}

impl Spring {
    /// Adds `weight` times the square of `miss` plus what the point at `arms[0]` from the first centre moves less
    /// what that at `arms[1]` from the second does.
    pub fn add(&mut self, arms: [Vector; 2], miss: Vector, weight: f64) {
        let [a, b] = arms.map(|arm| {
            let mut j = Matrix3x6::zeros();
            j.fixed_view_mut::<3, 3>(0, 0).copy_from(&-skew(&arm));
            j.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
            j
        });
        self.blocks[0] += weight * a.tr_mul(&a);
        self.blocks[1] += weight * b.tr_mul(&b);
        self.blocks[2] -= weight * b.tr_mul(&a);
        self.right[0] -= weight * a.tr_mul(&miss);
        self.right[1] += weight * b.tr_mul(&miss);
    }
}

impl Equations {
    /// Of `count` motions, which stay in the plane where they are `flat`.
    pub fn new(count: usize, flat: bool) -> Self {
        Self {
            flat,
            blocks: vec![Vec::new(); count],
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

    /// Adds a spring between the motions i < j.
    pub fn add_spring(&mut self, [i, j]: [u32; 2], spring: &Spring) {
        for (at, block) in [(i, i), (j, j), (i, j)].into_iter().zip(&spring.blocks) {
            *self.block(at) += block;
        }
        self.right[i as usize] += spring.right[0];
        self.right[j as usize] += spring.right[1];
    }

    /// The block of this column and row. Columns have some ten.
    fn block(&mut self, (column, row): (u32, u32)) -> &mut Matrix6<f64> {
        let column = &mut self.blocks[column as usize];
        let at = column.iter().position(|b| b.0 == row);
        let at = at.unwrap_or_else(|| {
            column.push((row, Matrix6::zeros()));
            column.len() - 1
        });
        &mut column[at].1
    }

    fn add_terms(&mut self, terms: &[(u32, Twist)], miss: f64, weight: f64) {
        for (i, row) in terms {
            self.right[*i as usize] -= weight * miss * row;
            for (j, other) in terms.iter().filter(|(j, _)| j <= i) {
                *self.block((*j, *i)) += weight * row * other.transpose();
            }
        }
    }

    /// The twists that make the sum least.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn solve(mut self) -> Result<Vec<Twist>, SolveError> {
        for (j, column) in (0..).zip(&mut self.blocks) {
            if !column.iter().any(|b| b.0 == j) {
                column.push((j, Matrix6::zeros()));
            }
            // The diagonal is the first: all others lie below it.
            column.sort_unstable_by_key(|b| b.0);
        }
        let moves: &[usize] = if self.flat { &FLAT } else { &ALL };
        let (starts, rows, values) = self.columns(moves);
        let mut cholesky = Cholesky::of_blocks(&self.pattern(), moves.len(), (starts, rows))?;
        cholesky.factorize(&values)?;
        let right = self.right.iter();
        let mut x: Vec<f64> = right.flat_map(|t| moves.iter().map(|&c| t[c])).collect();
        cholesky.solve(&values, &mut x)?;
        let twist = |x: &[f64]| {
            let mut twist = Twist::zeros();
            moves.iter().zip(x).for_each(|(&c, x)| twist[c] = *x);
            twist
        };
        Ok(x.chunks_exact(moves.len()).map(twist).collect())
    }

    /// The rows of each column's blocks.
    fn pattern(&self) -> Vec<Vec<usize>> {
        let rows = |column: &Vec<(u32, _)>| column.iter().map(|b| b.0 as usize).collect();
        self.blocks.iter().map(rows).collect()
    }

    /// The lower triangle in compressed columns, of each twist only what `moves`: starts, rows, values.
    fn columns(&self, moves: &[usize]) -> (Vec<usize>, Vec<usize>, Vec<f64>) {
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        let size = moves.len();
        for (j, column) in self.blocks.iter().enumerate() {
            let own = &column[0].1;
            for (k, &c) in moves.iter().enumerate() {
                for (l, &r) in moves.iter().enumerate().skip(k) {
                    let ridge = if r == c { RIDGE[c / 3] } else { 0.0 };
                    rows.push(size * j + l);
                    values.push(own[(r, c)] + ridge);
                }
                for (i, block) in &column[1..] {
                    let i = *i as usize;
                    rows.extend(size * i..size * (i + 1));
                    values.extend(moves.iter().map(|&r| block[(r, c)]));
                }
                starts.push(rows.len());
            }
        }
        (starts, rows, values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_points_meet_half_way() {
        // Two motions, each with a point above its centre, 1 apart along x.
        let arms = [Vector::y(), Vector::y()];
        let mut rows = Equations::new(2, false);
        for axis in 0..3 {
            let e = Vector::ith(axis, 1.0);
            rows.add(
                [(0, along(&e, &arms[0])), (1, -along(&e, &arms[1]))],
                e.x,
                1.0,
            );
        }
        let mut spring = Spring::default();
        spring.add(arms, Vector::x(), 1.0);
        let mut equations = Equations::new(2, false);
        equations.add_spring([0, 1], &spring);
        let same = rows.solve().expect("positive definite");
        let found = equations.solve().expect("positive definite");
        let reached = |k: usize| {
            let (omega, v) = (found[k].fixed_rows::<3>(0), found[k].fixed_rows::<3>(3));
            v + omega.cross(&Vector::y())
        };
        let gap = Vector::x() + reached(0) - reached(1);
        assert!(gap.norm() < 1e-5, "{gap}");
        assert!((reached(0) + reached(1)).norm() < 1e-9);
        for (a, b) in same.iter().zip(&found) {
            assert!((a - b).norm() < 1e-9, "{a} {b}");
        }
    }

    #[test]
    fn nothing_leads_out_of_the_plane() {
        let mut equations = Equations::new(2, true);
        let mut spring = Spring::default();
        spring.add([Vector::y(), Vector::x()], Vector::new(1.0, 2.0, 3.0), 1.0);
        equations.add_spring([0, 1], &spring);
        let found = equations.solve().expect("positive definite");
        for twist in &found {
            assert_eq!([twist[0], twist[1], twist[5]], [0.0; 3]);
        }
        let reached = |k: usize, arm: &Vector| {
            let (omega, v) = (found[k].fixed_rows::<3>(0), found[k].fixed_rows::<3>(3));
            v + omega.cross(arm)
        };
        let gap = reached(0, &Vector::y()) - reached(1, &Vector::x());
        assert!((gap + Vector::new(1.0, 2.0, 0.0)).norm() < 1e-5, "{gap}");
    }

    #[test]
    fn one_motion_may_be_asked_twice() {
        let mut equations = Equations::new(1, false);
        let row = along(&Vector::x(), &Vector::zeros());
        equations.add([(0, row), (0, row)], 1.0, 1.0);
        let found = equations.solve().expect("positive definite");
        assert!((found[0][3] + 0.5).abs() < 1e-5, "{}", found[0]);
    }
}
