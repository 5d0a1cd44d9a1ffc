//! The rotation field in the plane, where a rotation is an angle.
//!
//! A pair (p, q) with the local map A, a reflection about a line at the angle alpha, is opposite across x = 0 where
//! theta_p + theta_q = pi - 2 alpha. Once these sums are known as numbers and not only as directions, the evenest
//! angles that meet them are the solution of one linear system, however far a shape bends. Rows of matrices
//! (`rotations`) would do no more than half a turn: from there on it costs less to change their sign on the way.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::{PI, TAU};

use crate::deform::solver::{Entries, SolveError};
use crate::field::SymmetryField;
use crate::field::grow::Land;
use crate::geom::Matrix3;
use crate::straighten::rotations::{Evenness, PAIRS, edge_scale, say};

/// Rounds of the solve, and the angle, radians, by which a pair misses its sum where it begins to count less.
const ROUNDS: usize = 8;
const FAR: f64 = 0.3;
/// What is added to the diagonal: parts without pairs stay as they are.
const RIDGE: f64 = 1e-6;

/// The rotation of each sample. Where the field has no pairs, as in the middle of a tail that is not trusted there, whole turns
/// are counted over those of `others`.
///
/// # Errors
/// [`SolveError`].
pub fn solved(
    land: &Land<'_>,
    field: &SymmetryField,
    others: &SymmetryField,
) -> Result<Vec<Matrix3>, SolveError> {
    let mut pairs = pairs(&field.or(others));
    unwind(land, &mut pairs, field.partners.len());
    pairs.retain(|pair| field.partners[pair.of[0]].is_some());
    let mut angles = vec![0.0; field.partners.len()];
    for round in 0..ROUNDS {
        if round > 0 {
            // What is a whole turn off was unwound on the wrong way.
            for pair in &mut pairs {
                pair.sum += TAU * (pair.missed(&angles) / TAU).round();
            }
        }
        let weight = |pair: &Pair| match round {
            0 => pair.say,
            _ => pair.say * (1.0 + (pair.missed(&angles) / FAR).powi(2)).powi(-2),
        };
        let weights: Vec<f64> = pairs.iter().map(weight).collect();
        angles = even(land, &pairs, &weights, angles.len())?;
    }
    let turn = |angle: &f64| {
        let (sin, cos) = angle.sin_cos();
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
    };
    Ok(angles.iter().map(turn).collect())
}

/// Two samples whose angles have a known sum.
struct Pair {
    of: [usize; 2],
    sum: f64,
    say: f64,
}

impl Pair {
    /// By how much the angles' sum is larger.
    fn missed(&self, angles: &[f64]) -> f64 {
        angles[self.of[0]] + angles[self.of[1]] - self.sum
    }
}

/// The pairs of a field; their sums to within whole turns.
fn pairs(field: &SymmetryField) -> Vec<Pair> {
    let all = field.partners.iter().zip(&field.maps).enumerate();
    let pair = |(p, (q, map)): (usize, (&Option<_>, &Option<crate::transform::Isometry>))| {
        let (q, map): (&crate::field::Partner, _) = (q.as_ref()?, map.as_ref()?);
        let twice = map.linear[(1, 0)].atan2(map.linear[(0, 0)]);
        Some(Pair {
            of: [p, q.sample as usize],
            sum: PI - twice,
            say: PAIRS * say(q),
        })
    };
    all.filter_map(pair).collect()
}

/// Makes the sums of neighbours as near to each other as whole turns can, over the tree of neighbours that differ least
/// (Prim); parts that are not neighbours begin anew.
fn unwind(land: &Land<'_>, pairs: &mut [Pair], count: usize) {
    let mut of_sample = vec![None; count];
    for (k, pair) in pairs.iter().enumerate() {
        of_sample[pair.of[0]] = Some(k);
    }
    let mut done = vec![false; pairs.len()];
    for first in 0..pairs.len() {
        let mut queue = BinaryHeap::from([Reverse((0, first, first))]);
        while let Some(Reverse((_, k, from))) = queue.pop() {
            if std::mem::replace(&mut done[k], true) {
                continue;
            }
            pairs[k].sum += TAU * ((pairs[from].sum - pairs[k].sum) / TAU).round();
            let [p, q] = pairs[k].of;
            let near = land.reach.neighbors[p].iter().map(|&j| j as usize);
            let near = near.chain([q]).filter_map(|j| of_sample[j]);
            for next in near.filter(|&next| !done[next]) {
                let apart = (pairs[next].sum - pairs[k].sum) / TAU;
                // Not negative, so that their bits are in order.
                let apart = (apart - apart.round()).abs();
                queue.push(Reverse((apart.to_bits(), next, k)));
            }
        }
    }
}

/// The angles of `count` samples that differ least between neighbours and meet the pairs' sums by their weights.
fn even(
    land: &Land<'_>,
    pairs: &[Pair],
    weights: &[f64],
    count: usize,
) -> Result<Vec<f64>, SolveError> {
    let mut entries = Entries::default();
    let scale = edge_scale(land, Evenness::AtLast);
    for &([i, j], w) in &land.reach.edges {
        let w = scale * w * land.firmness([i, j]);
        entries.add_square(&[(j as usize, 1.0), (i as usize, -1.0)], w);
    }
    let mut x = vec![0.0; count];
    for (pair, &w) in pairs.iter().zip(weights) {
        let [p, q] = pair.of;
        // On the line itself partners are one sample.
        let terms: &[(usize, f64)] = if p == q {
            &[(p, 2.0)]
        } else {
            &[(p, 1.0), (q, 1.0)]
        };
        entries.add_square(terms, w);
        for &(i, t) in terms {
            x[i] += t * w * pair.sum;
        }
    }
    (0..count).for_each(|i| entries.add(i, i, RIDGE));
    entries.factorized(count)?.solve(&mut x)?;
    Ok(x)
}
