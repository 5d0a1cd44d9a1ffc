//! Prescribed rotations: positions whose differences are the rest shape's, turned as asked.

pub mod system;

use crate::deform::bridges::bridges;
use crate::deform::laplacian::edge_weights;
use crate::deform::{Pull, check_pulls, check_stiffness, failure};
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;
use system::EdgeSystem;

/// Vertex positions that minimise sum over edges of k_ij |(x_i - x_j) - (R_i + R_j) (p_i - p_j) / 2|^2 plus the
/// `pulls`: the Poisson equation of a rotation field (Yu et al. 2004). One linear solve, exact where
/// the field is that of a rigid motion.
///
/// `rotations` has one for each vertex of `rest`; `stiffness`, where given, one value for each face: the
/// stiff ones keep their shape where the field cannot be met. Without pulls the area's centroid stays
/// where it is.
///
/// # Errors
/// [`Error::Params`] for wrong counts, [`Error::Numerical`] for what is not finite.
pub fn integrate(
    rest: &Surface,
    rotations: &[Matrix3],
    stiffness: Option<&[f64]>,
    pulls: &[Pull],
) -> Result<Vec<Point>> {
    if rotations.len() != rest.positions.len() {
        return Err(Error::params("rotations", "needs one for each vertex"));
    }
    if let Some(s) = stiffness {
        check_stiffness(s, rest)?;
    }
    check_pulls(pulls, 0)?;
    let mut weights = edge_weights(rest, stiffness);
    for [i, j] in bridges(
        &rest.positions,
        edge_weights(rest, None).keys().map(|&(u, v)| [u, v]),
    ) {
        weights.insert((i.min(j), i.max(j)), TIE);
    }
    let mut system = EdgeSystem::new(rest, &weights).map_err(|e| failure(e, 0))?;
    let mut moved = rest.positions.clone();
    // The second solve takes out what the first one's ridge held back.
    for _ in 0..2 {
        let ways = system
            .ways(rest, rotations, pulls, 1.0, &moved)
            .map_err(|e| failure(e, 0))?;
        moved.iter_mut().zip(&ways).for_each(|(x, way)| *x += way);
    }
    if pulls.iter().all(|p| p.weight == 0.0) {
        let drift = centroid(rest, &rest.positions) - centroid(rest, &moved);
        moved.iter_mut().for_each(|x| *x += drift);
    }
    Ok(moved)
}

/// Weight of the edge that ties a separate component to its nearest neighbour.
const TIE: f64 = 0.1;

fn centroid(rest: &Surface, positions: &[Point]) -> Vector {
    let weighted = positions
        .iter()
        .zip(&rest.vertex_areas)
        .map(|(x, a)| x.coords * *a);
    weighted.sum::<Vector>() / rest.area()
}
