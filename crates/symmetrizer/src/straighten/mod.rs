//! Straightening: a bent shape whose local mirrors vary along it is turned, place by place, until they are
//! one.

mod bend;
pub mod blend;
mod equations;
pub mod params;
mod pose;
mod rotations;
mod settle;
mod slopes;

use crate::deform::Tie;
use crate::deform::poisson::integrate_tied;
use crate::error::Result;
use crate::field::SymmetryField;
use crate::field::grow::Land;
use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use crate::shape::Surface;
use crate::transform::Plane;
use blend::Blend;

pub use bend::Bend;
pub use params::{StraightenParams, When};
pub use pose::{Posed, bend_again};
pub use settle::settle;

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
    integrate_tied(land.surface, &at_vertices, land.stiffness, &ties)
}

/// Positions whose mirror is x = 0, moved over `surface`.
fn placed(surface: &Surface, positions: Vec<Point>) -> Straightened {
    let area: f64 = surface.vertex_areas.iter().sum();
    let center = |x: &[Point]| {
        let weighted = x.iter().zip(&surface.vertex_areas);
        weighted.map(|(x, w)| x.coords * *w).sum::<Vector>() / area
    };
    let (from, to) = (center(&positions), center(&surface.positions));
    let weighted = positions
        .iter()
        .zip(&surface.positions)
        .zip(&surface.vertex_areas);
    let moment: Matrix3 = weighted
        .map(|((x, y), w)| *w * (y.coords - to) * (x.coords - from).transpose())
        .sum();
    let frame = nearest_orthogonal(&moment, false);
    let move_over = |x: &Vector| Point::from(frame * (x - from) + to);
    Straightened {
        plane: Plane::through(&move_over(&Vector::zeros()), frame * Vector::x()),
        positions: positions.iter().map(|x| move_over(&x.coords)).collect(),
        frame,
    }
}
