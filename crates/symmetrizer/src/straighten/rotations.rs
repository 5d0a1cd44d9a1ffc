//! The rotation field that turns every local mirror into one.
//!
//! R_i: the rotation of sample i; rho its row as a column. Of a pair (p, q) with the local map A the target
//! R_q A = S R_p, S = diag(-1, 1, 1), is linear and falls apart by rows: rho_q = s A rho_p with s = -1 for the
//! first row, +1 for the others. The rows that miss it least are the smallest eigenvectors of
//! sum over edges of w |rho_i - rho_j|^2 + W sum over pairs of c |rho_q - s A rho_p|^2 against a mass.

use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::deform::solver::{Entries, Factorized, SolveError};
use crate::error::Error;
use crate::field::grow::Land;
use crate::field::{Partner, SymmetryField};
use crate::geom::{Ambient, Matrix3, Vector, nearest_orthogonal};
use crate::straighten::angles;

/// W, beside [`Evenness`] for all edges of a sample.
pub(super) const PAIRS: f64 = 3.0;
/// Edges of a sample: evenness over some three samples' distance. The poses of limbs, which both sides have in common,
/// follow from nothing else; a local isometry is only as good as its few pairs.
const EDGES: f64 = 32.0;
/// The same where pairs are only to settle from there: over seven samples' distance. At the end it would take detail.
const EDGES_AT_FIRST: f64 = 128.0;
/// The same in the plane, where the joints of limbs are to turn.
const EDGES_IN_PLANE: f64 = 8.0;
/// Mass of a sample without a partner: it follows.
const FOLLOWS: f64 = 0.02;
/// Residual at which a pair's say falls to 1/e, fraction of L, and the least it has.
const RESIDUAL: f64 = 0.01;
const LEAST: f64 = 0.15;
/// Vectors and rounds of the subspace iteration.
const VECTORS: usize = 5;
const ROUNDS: usize = 30;
/// Squared sine of the angle by which the sought vectors turn in a round, below which they are found.
const TURNED: f64 = 1e-14;
/// Shift of the eigenproblem, against a singular matrix.
const SHIFT: f64 = 1e-6;

/// How even a rotation field is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Evenness {
    /// For pairs that are yet to settle.
    AtFirst,
    /// For pairs that have.
    AtLast,
}

/// The rotation of each sample; in the plane turns are counted with `others` where the field has no pairs.
///
/// # Errors
/// [`Error::Numerical`].
pub fn solved(
    land: &Land<'_>,
    (field, others): (&SymmetryField, &SymmetryField),
    evenness: Evenness,
) -> Result<Vec<Matrix3>, Error> {
    rotations(land, (field, others), evenness).map_err(|_| Error::Numerical {
        stage: "straighten",
        step: 0,
        what: "the rotation field could not be solved for".into(),
    })
}

fn rotations(
    land: &Land<'_>,
    (field, others): (&SymmetryField, &SymmetryField),
    evenness: Evenness,
) -> Result<Vec<Matrix3>, SolveError> {
    if land.samples.ambient == Ambient::Plane {
        return angles::solved(land, field, others);
    }
    let rows = |s, wanted| rows(land, field, evenness, s, wanted);
    let (first, others) = rayon::join(|| rows(-1.0, 1), || rows(1.0, 2));
    let (first, others) = (first?, others?);
    let matrix = |i: usize| {
        let rows = [first[0][i], others[0][i], others[1][i]];
        Matrix3::from_rows(&rows.map(|row| row.transpose()))
    };
    let mut all: Vec<Matrix3> = (0..land.reach.neighbors.len()).map(matrix).collect();
    let mut hands: Vec<f64> = all.iter().map(Matrix3::determinant).collect();
    if crate::geom::median(&mut hands).unwrap_or(1.0) < 0.0 {
        for m in &mut all {
            m.row_mut(0).neg_mut();
        }
    }
    Ok(all.iter().map(|m| nearest_orthogonal(m, false)).collect())
}

/// What a pair has to say, 0 to 1: less the further the surface lies from its image.
pub(super) fn say(partner: &Partner) -> f64 {
    (-(partner.residual / RESIDUAL).powi(2)).exp().max(LEAST)
}

/// The factor of the weights between neighbours for which they have so much `evenness` for each sample in the mean.
pub(super) fn edge_scale(land: &Land<'_>, evenness: Evenness) -> f64 {
    let reach = land.reach;
    let all: f64 = reach.edges.iter().map(|(_, w)| 2.0 * w).sum();
    let edges = match (land.samples.ambient, evenness) {
        (Ambient::Plane, _) => EDGES_IN_PLANE,
        (Ambient::Space, Evenness::AtFirst) => EDGES_AT_FIRST,
        (Ambient::Space, Evenness::AtLast) => EDGES,
    };
    edges * reach.neighbors.len() as f64 / all.max(f64::MIN_POSITIVE)
}

/// The `wanted` smallest eigenvectors for the rows of sign `s`, a vector for each sample.
fn rows(
    land: &Land<'_>,
    field: &SymmetryField,
    evenness: Evenness,
    s: f64,
    wanted: usize,
) -> Result<Vec<Vec<Vector>>, SolveError> {
    let n = land.reach.neighbors.len();
    let mut entries = Entries::default();
    add_edges(&mut entries, land, evenness);
    let mut mass = vec![FOLLOWS; n];
    for (p, (partner, map)) in field.partners.iter().zip(&field.maps).enumerate() {
        if let (Some(partner), Some(map)) = (partner, map) {
            mass[p] = 1.0;
            let c = PAIRS * say(partner);
            add_pair(
                &mut entries,
                p,
                partner.sample as usize,
                &(s * map.linear),
                c,
            );
        }
    }
    let mass: Vec<f64> = mass.iter().flat_map(|m| [*m; 3]).collect();
    for (i, m) in mass.iter().enumerate() {
        entries.add(i, i, SHIFT * m);
    }
    let vectors = smallest(entries.factorized(3 * n)?, &mass, wanted)?;
    let split = |x: &Vec<f64>| x.chunks_exact(3).map(Vector::from_column_slice).collect();
    Ok(vectors.iter().map(split).collect())
}

/// w |rho_i - rho_j|^2 over the edges between neighbours, so much `evenness` for each sample in the mean, more where the
/// surface is stiff.
fn add_edges(entries: &mut Entries, land: &Land<'_>, evenness: Evenness) {
    let scale = edge_scale(land, evenness);
    for &([i, j], w) in &land.reach.edges {
        let w = scale * w * land.firmness([i, j]);
        let (i, j) = (i as usize, j as usize);
        for a in 0..3 {
            entries.add_square(&[(3 * j + a, 1.0), (3 * i + a, -1.0)], w);
        }
    }
}

/// c |rho_q - a rho_p|^2.
fn add_pair(entries: &mut Entries, p: usize, q: usize, a: &Matrix3, c: f64) {
    for r in 0..3 {
        let across = (0..3).map(|k| (3 * p + k, -a[(r, k)]));
        let terms: Vec<(usize, f64)> = std::iter::once((3 * q + r, 1.0)).chain(across).collect();
        entries.add_square(&terms, c);
    }
}

/// Inverse subspace iteration: the `wanted` smallest eigenvectors of a matrix against a diagonal mass.
fn smallest(matrix: Factorized, mass: &[f64], wanted: usize) -> Result<Vec<Vec<f64>>, SolveError> {
    // Any start that is not orthogonal to what is sought.
    let start = |k: usize| -> Vec<f64> {
        let any = |i: usize| ((1 + k) as f64 * (i % 3 + 1) as f64 + 0.001 * i as f64).sin();
        (0..mass.len()).map(any).collect()
    };
    let mut block: Vec<Vec<f64>> = (0..VECTORS).map(start).collect();
    orthonormalize(&mut block, mass);
    for _ in 0..ROUNDS {
        let before = block.clone();
        block.par_iter_mut().try_for_each(|x| {
            x.iter_mut().zip(mass).for_each(|(x, m)| *x *= m);
            matrix.solve(x)
        })?;
        block = ritz(&before, &block, mass);
        orthonormalize(&mut block, mass);
        let turned = |x: &Vec<f64>| {
            let shares = before[..wanted].iter().map(|y| dot(x, y, mass).powi(2));
            1.0 - shares.sum::<f64>()
        };
        if block[..wanted].iter().all(|x| turned(x) < TURNED) {
            break;
        }
    }
    block.truncate(wanted);
    Ok(block)
}

fn dot(a: &[f64], b: &[f64], mass: &[f64]) -> f64 {
    a.iter().zip(b).zip(mass).map(|((a, b), m)| a * b * m).sum()
}

/// Rayleigh and Ritz: the combinations of what the vectors `before` became, those that grew most first. By
/// itself each vector would come no faster than the gap to the next one lets it.
fn ritz(before: &[Vec<f64>], after: &[Vec<f64>], mass: &[f64]) -> Vec<Vec<f64>> {
    let product = |i: usize, j: usize| dot(&before[i], &after[j], mass);
    let small = DMatrix::from_fn(before.len(), before.len(), |i, j| {
        (product(i, j) + product(j, i)) / 2.0
    });
    let eigen = small.symmetric_eigen();
    let mut order: Vec<usize> = (0..before.len()).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let combined = |k: &usize| {
        let mut x = vec![0.0; mass.len()];
        for (y, c) in after.iter().zip(eigen.eigenvectors.column(*k).iter()) {
            x.iter_mut().zip(y).for_each(|(x, y)| *x += c * y);
        }
        x
    };
    order.iter().map(combined).collect()
}

/// Gram and Schmidt against the mass, the largest first: inverse iteration has grown the smallest
/// eigenvector most.
fn orthonormalize(block: &mut [Vec<f64>], mass: &[f64]) {
    for k in 0..block.len() {
        let (done, rest) = block.split_at_mut(k);
        let x = &mut rest[0];
        for y in done.iter() {
            let along = dot(x, y, mass);
            x.iter_mut().zip(y).for_each(|(x, y)| *x -= along * y);
        }
        let norm = dot(x, x, mass).sqrt().max(f64::MIN_POSITIVE);
        x.iter_mut().for_each(|x| *x /= norm);
    }
}
