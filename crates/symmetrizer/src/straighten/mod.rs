//! Straightening: a bent shape whose local mirrors vary along it is turned, place by place, until they are
//! one.

mod angles;
mod bend;
pub mod blend;
mod equations;
pub mod params;
mod pose;
mod rotations;
mod settle;
mod slopes;
mod turned;

use crate::deform::Tie;
use crate::deform::elastic::Motion;
use crate::error::Result;
use crate::field::SymmetryField;
use crate::field::grow::Land;
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;
use crate::transform::Plane;
use blend::Blend;
use turned::turned;

pub use bend::Bend;
pub use params::{StraightenParams, When};
pub use pose::{Posed, bend_again};
pub use settle::Settler;

/// A straightened surface.
#[derive(Debug, Clone)]
pub struct Straightened {
    /// Vertex positions, as near to those of the input as a rigid motion takes them.
    pub positions: Vec<Point>,
    /// Its mirror.
    pub plane: Plane,
    /// The rotation from the frame of the rotation field, in which the mirror is x = 0.
    pub frame: Matrix3,
}

/// Weight of a pair beside a vertex's edges.
const PAIR: f64 = 0.3;

/// The surface with `bend` undone.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn straighten(land: &Land<'_>, bend: &Bend) -> Result<Straightened> {
    let positions = solve(land, &bend.field, &bend.turns)?;
    Ok(placed(land.surface, positions))
}

/// Vertex positions of the surface with the samples turned by `turns` and the pairs of `field` opposite each
/// other across x = 0.
fn solve(land: &Land<'_>, field: &SymmetryField, turns: &[Matrix3]) -> Result<Vec<Point>> {
    let at_vertices = Blend::new(land.surface, land.samples).rotations(turns);
    let pairs = land.samples.list.iter().zip(&field.partners);
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
    turned(land, land.surface, &at_vertices, &ties)
}

/// Positions whose mirror is x = 0, moved over `surface`.
fn placed(surface: &Surface, positions: Vec<Point>) -> Straightened {
    let over = Motion::between(&positions, &surface.positions, &surface.vertex_areas);
    let normal = over.rotation * Vector::x();
    Straightened {
        plane: Plane::through(&over.apply(&Point::origin()), normal),
        positions: positions.iter().map(|x| over.apply(x)).collect(),
        frame: over.rotation,
    }
}
