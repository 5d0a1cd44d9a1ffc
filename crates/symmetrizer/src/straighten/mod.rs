//! Straightening: a bent shape whose local mirrors vary along it is turned, place by place, until they are
//! one.

mod blend;
mod equations;
mod rotations;
mod settle;
mod slopes;

use crate::deform::Tie;
use crate::deform::poisson::integrate_tied;
use crate::error::Result;
use crate::field::{Reach, SymmetryField};
use crate::geom::Point;
use crate::sample::Samples;
use crate::shape::Surface;
use crate::straighten::blend::Blend;

pub use settle::settle;

/// A straightened surface; its mirror is the plane x = 0.
pub struct Straightened {
    /// Vertex positions; turned as a whole by an arbitrary rotation.
    pub positions: Vec<Point>,
}

/// Weight of a pair beside a vertex's edges.
const PAIR: f64 = 0.3;

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
    let turns = rotations::solved(reach, field)?;
    let at_vertices = Blend::new(surface, samples).rotations(&turns);
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
