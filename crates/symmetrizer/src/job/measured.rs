//! Measuring alone: how symmetric a shape is, and what became of the one it was made from.

use crate::apply::measure::{Asymmetry, Distortion, asymmetry, distortion};
use crate::context::Context;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::Mesh;
use crate::shape::wall::Wall;
use crate::shape::working::Working;

/// A shape and its figures.
pub struct Measured {
    /// The shape to work on.
    pub working: Working,
    /// The wall that it is, in the plane.
    pub wall: Option<Wall>,
    /// The bounding-box diagonal D, fraction of L.
    pub diagonal: f64,
    /// How far from symmetric; planes in working coordinates.
    pub asymmetry: Asymmetry,
    /// How it differs from its original, where one was given.
    pub distortion: Option<Distortion>,
}

/// Measures `mesh`, and against its `original` of the same vertices and faces if there is one.
///
/// # Errors
/// [`Error::Input`] for a mesh that cannot be worked on or an original of other vertices or faces,
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn measure_in(mesh: &Mesh, original: Option<&Mesh>, ctx: &mut Context<'_>) -> Result<Measured> {
    let working = Working::new(mesh)?;
    let diagonal = mesh.diagonal() / working.normalization.scale;
    let asymmetry = ctx.stage("measure", |ctx| {
        asymmetry(&working.surface, diagonal, &[], ctx)
    })?;
    let distortion = original
        .map(|original| ctx.stage("compare", |_| compare(original, mesh)))
        .transpose()?;
    Ok(Measured {
        wall: None,
        working,
        diagonal,
        asymmetry,
        distortion,
    })
}

fn compare(original: &Mesh, mesh: &Mesh) -> Result<Distortion> {
    if original.positions.len() != mesh.positions.len() || original.polygons != mesh.polygons {
        return Err(Error::input(
            "the two shapes do not have the same vertices and faces in the same order",
            "compare a result with the file it was made from, in a format that keeps order",
        ));
    }
    let before = Working::new(original)?;
    let after = before.surface.with_positions(moved(&before, mesh));
    let diagonal = original.diagonal() / before.normalization.scale;
    Ok(distortion(&before.surface, &after, diagonal))
}

/// Where the working vertices of `before` are in `mesh`: as the first document vertex of each.
fn moved(before: &Working, mesh: &Mesh) -> Vec<Point> {
    let mut positions = before.surface.positions.clone();
    // Backwards, so that the first one stays.
    for (p, vertex) in mesh.positions.iter().zip(&before.vertex_of_document).rev() {
        if let Some(v) = vertex {
            positions[*v as usize] = before.normalization.to_working(p);
        }
    }
    positions
}
