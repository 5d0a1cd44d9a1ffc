//! Prescribed rotations with pairs of points that are tied to each other, both ends free.

use rayon::prelude::*;

use crate::deform::Tie;
use crate::deform::solver::{Entries, Factorized, SolveError};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;

/// Share of the mean diagonal that is added to it: what nothing holds stays where it is.
const RIDGE: f64 = 1e-8;
/// What a tie does to each axis: x changes sides.
const SIGNS: [f64; 3] = [-1.0, 1.0, 1.0];

/// A surface whose edges are to be turned as asked and whose pairs are tied, see [`super::integrate_tied`]. Axes fall
/// apart; those of the same sign share a matrix.
pub struct Tied<'a> {
    rest: &'a Surface,
    edges: &'a [([u32; 2], f64)],
    /// For each sign, -1 first.
    systems: [System; 2],
}

/// What is to be solved for the axes of one sign.
struct System {
    ridge: f64,
    matrix: Factorized,
}

impl System {
    fn new(
        rest: &Surface,
        edges: &[([u32; 2], f64)],
        ties: &[Tie],
        sign: f64,
    ) -> Result<Self, SolveError> {
        let mut entries = Entries::default();
        for &([i, j], k) in edges {
            entries.add_square(&[(i as usize, 1.0), (j as usize, -1.0)], k);
        }
        for tie in ties {
            entries.add_square(&terms(rest, tie, sign), tie.weight);
        }
        let n = rest.positions.len();
        let ridge = RIDGE * entries.mean_diagonal(n);
        (0..n).for_each(|v| entries.add(v, v, ridge));
        Ok(Self {
            ridge,
            matrix: entries.factorized(n)?,
        })
    }
}

impl<'a> Tied<'a> {
    /// Of `rest` with these weighted edges.
    pub fn new(
        rest: &'a Surface,
        edges: &'a [([u32; 2], f64)],
        ties: &[Tie],
    ) -> Result<Self, SolveError> {
        let of = |sign| System::new(rest, edges, ties, sign);
        let (first, others) = rayon::join(|| of(-1.0), || of(1.0));
        Ok(Self {
            rest,
            edges,
            systems: [first?, others?],
        })
    }

    /// Positions that minimise the edges' misfit to the rotations plus that of the ties.
    pub fn turned(&self, rotations: &[Matrix3]) -> Result<Vec<Point>, SolveError> {
        let wanted = wanted(self.rest, self.edges, rotations);
        let solved = |axis: usize| {
            let system = &self.systems[usize::from(SIGNS[axis] > 0.0)];
            let mut x: Vec<f64> = self.rest.positions.iter().map(|p| p[axis]).collect();
            // A second solve takes out what the first one's ridge held back.
            for _ in 0..2 {
                let held = wanted.iter().zip(&x);
                x = held.map(|(w, x)| w[axis] + system.ridge * x).collect();
                system.matrix.solve(&mut x)?;
            }
            Ok(x)
        };
        let axes = (0..3).into_par_iter().map(solved);
        let [x, y, z] = &axes.collect::<Result<Vec<_>, SolveError>>()?[..] else {
            unreachable!("there are three axes")
        };
        let places = x.iter().zip(y).zip(z);
        Ok(places.map(|((x, y), z)| Point::new(*x, *y, *z)).collect())
    }
}

/// The right-hand side of the edges.
fn wanted(rest: &Surface, edges: &[([u32; 2], f64)], rotations: &[Matrix3]) -> Vec<Vector> {
    let mut wanted = vec![Vector::zeros(); rest.positions.len()];
    for &([i, j], k) in edges {
        let (i, j) = (i as usize, j as usize);
        let mean = (rotations[i] + rotations[j]) / 2.0;
        let way = k * (mean * (rest.positions[i] - rest.positions[j]));
        wanted[i] += way;
        wanted[j] -= way;
    }
    wanted
}

/// x_p - sign x_q as terms over the corners of both ends.
fn terms(rest: &Surface, tie: &Tie, sign: f64) -> Vec<(usize, f64)> {
    let end = |at: &crate::shape::SurfacePoint, factor: f64| {
        let corners = rest.triangles[at.face as usize];
        std::array::from_fn::<_, 3, _>(|k| (corners[k] as usize, factor * at.bary[k]))
    };
    [end(&tie.p, 1.0), end(&tie.q, -sign)].concat()
}
