//! What is known on a boundary, spread evenly over the inside.

use rayon::prelude::*;

use crate::deform::failure;
use crate::deform::laplacian::edge_weights;
use crate::deform::solver::{Entries, SolveError};
use crate::error::Result;
use crate::geom::{Matrix3, nearest_orthogonal};
use crate::shape::Surface;

/// The rotations at all vertices of `surface`, `known` at some: elsewhere those nearest to the harmonic functions
/// between their entries.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn rotations_inside(surface: &Surface, known: &[Option<Matrix3>]) -> Result<Vec<Matrix3>> {
    let spread = spread(surface, known).map_err(|e| failure(e, 0))?;
    Ok(spread
        .iter()
        .map(|m| nearest_orthogonal(m, false))
        .collect())
}

fn spread(
    surface: &Surface,
    known: &[Option<Matrix3>],
) -> std::result::Result<Vec<Matrix3>, SolveError> {
    let mut number = vec![0; known.len()];
    let mut count = 0;
    for (n, _) in number.iter_mut().zip(known).filter(|(_, k)| k.is_none()) {
        *n = count;
        count += 1;
    }
    if count == 0 {
        return Ok(known.iter().flatten().copied().collect());
    }
    let mut entries = Entries::default();
    let mut right = vec![Matrix3::zeros(); count];
    for (&(i, j), &w) in &edge_weights(surface, None) {
        let (i, j) = (i as usize, j as usize);
        match (known[i], known[j]) {
            (None, None) => entries.add_square(&[(number[i], 1.0), (number[j], -1.0)], w),
            (None, Some(m)) => {
                entries.add(number[i], number[i], w);
                right[number[i]] += w * m;
            }
            (Some(m), None) => {
                entries.add(number[j], number[j], w);
                right[number[j]] += w * m;
            }
            (Some(_), Some(_)) => {}
        }
    }
    let matrix = entries.factorized(count)?;
    let solved = |k: usize| {
        let mut x: Vec<f64> = right.iter().map(|m| m[k]).collect();
        if x.iter().any(|x| *x != 0.0) {
            matrix.solve(&mut x)?;
        }
        Ok(x)
    };
    let entries: Vec<Vec<f64>> = (0..9)
        .into_par_iter()
        .map(solved)
        .collect::<std::result::Result<_, _>>()?;
    let found = |n: usize| Matrix3::from_fn(|r, c| entries[r + 3 * c][n]);
    let all = known.iter().zip(&number);
    Ok(all.map(|(k, &n)| k.unwrap_or_else(|| found(n))).collect())
}
