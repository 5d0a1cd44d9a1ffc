//! Straightening: a bent shape whose local mirrors vary along it is turned, place by place, until they are
//! one.

mod rotations;

use rayon::prelude::*;

use crate::deform::Tie;
use crate::deform::poisson::integrate_tied;
use crate::error::{Error, Result};
use crate::field::{Reach, SymmetryField};
use crate::geom::{Matrix3, Point, PointIndex, nearest_orthogonal};
use crate::sample::Samples;
use crate::shape::Surface;

/// A straightened surface; its mirror is the plane x = 0.
pub struct Straightened {
    /// Vertex positions; turned as a whole by an arbitrary rotation.
    pub positions: Vec<Point>,
}

/// Weight of a pair beside a vertex's edges.
const PAIR: f64 = 0.3;
/// Samples whose rotations are blended at a vertex.
const BLENDED: usize = 8;

/// `surface` with the bend of `field` undone.
///
/// # Errors
/// [`Error::Numerical`].
pub fn straighten(
    surface: &Surface,
    samples: &Samples,
    reach: &Reach,
    field: &SymmetryField,
) -> Result<Straightened> {
    let turns = rotations::rotations(reach, field).map_err(|_| Error::Numerical {
        stage: "straighten",
        step: 0,
        what: "the rotation field could not be solved for".into(),
    })?;
    let at_vertices = blended(surface, samples, &turns);
    let pairs = samples.list.iter().zip(&field.partners);
    let ties: Vec<Tie> = pairs
        .filter_map(|(s, partner)| {
            let q = partner.as_ref()?;
            Some(Tie {
                p: s.at,
                q: q.at,
                weight: PAIR,
            })
        })
        .collect();
    Ok(Straightened {
        positions: integrate_tied(surface, &at_vertices, &ties)?,
    })
}

/// The samples' rotations at each vertex, blended among the nearest that face its way.
fn blended(surface: &Surface, samples: &Samples, turns: &[Matrix3]) -> Vec<Matrix3> {
    let places: Vec<[f64; 3]> = samples
        .list
        .iter()
        .map(|s| s.position.coords.into())
        .collect();
    let index = PointIndex::new(&places);
    (0..surface.positions.len())
        .into_par_iter()
        .map(|v| {
            let (x, n) = (&surface.positions[v], &surface.vertex_normals[v]);
            let near = index.nearest_n(&x.coords.into(), 2 * BLENDED);
            let mut facing: Vec<(u32, f64)> = near
                .iter()
                .copied()
                .filter(|(s, _)| samples.list[*s as usize].normal.dot(n) > 0.0)
                .collect();
            if facing.is_empty() {
                facing = near;
            }
            facing.truncate(BLENDED);
            let rim = facing.last().map_or(1.0, |l| l.1) * 1.000_001 + 1e-12;
            let sum: Matrix3 = facing
                .iter()
                .map(|&(s, d)| turns[s as usize] * (1.0 - d / rim).powi(2))
                .sum();
            nearest_orthogonal(&sum, false)
        })
        .collect()
}
