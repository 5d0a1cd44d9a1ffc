//! Prescribed rotations: positions whose differences are the rest shape's, turned as asked.

pub mod system;
mod tied;

use crate::deform::bridges::bridges;
use crate::deform::laplacian::edge_weights;
use crate::deform::{Pull, Tie, carry, check_pulls, check_stiffness, failure};
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;
use system::EdgeSystem;
use tied::Tied;

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

/// [`integrate`] with `ties` instead of pulls: x_p = S x_q at each, S = diag(-1, 1, 1), softly, both ends free
/// to move and anywhere on the surface. A `weight` of 1 counts as much as the edges of a vertex.
///
/// # Errors
/// [`Error::Params`] for a wrong count, [`Error::Numerical`] for what is not finite.
pub fn integrate_tied(
    rest: &Surface,
    rotations: &[Matrix3],
    stiffness: Option<&[f64]>,
    ties: &[Tie],
) -> Result<Vec<Point>> {
    relax_tied(rest, rotations, stiffness, ties, 0)
}

/// [`integrate_tied`], then `rounds` in which each vertex is turned as its surroundings were and the positions are
/// found again (local and global, Sorkine and Alexa 2007): what is prescribed is where it begins, and the ties hold
/// against the stretch of edges alone.
///
/// # Errors
/// Those of [`integrate_tied`].
pub fn relax_tied(
    rest: &Surface,
    rotations: &[Matrix3],
    stiffness: Option<&[f64]>,
    ties: &[Tie],
    rounds: usize,
) -> Result<Vec<Point>> {
    if rotations.len() != rest.positions.len() {
        return Err(Error::params("rotations", "needs one for each vertex"));
    }
    if let Some(s) = stiffness {
        check_stiffness(s, rest)?;
    }
    let weights = edge_weights(rest, stiffness);
    let bridges = bridges(&rest.positions, weights.keys().map(|&(u, v)| [u, v]));
    let mut edges: Vec<([u32; 2], f64)> = weights.iter().map(|(&(u, v), &k)| ([u, v], k)).collect();
    let degree = 2.0 * weights.values().sum::<f64>() / rest.positions.len().max(1) as f64;
    edges.extend(bridges.iter().map(|&pair| (pair, TIE)));
    let scaled = |t: &Tie| Tie {
        weight: t.weight * degree,
        ..*t
    };
    let ties: Vec<Tie> = ties.iter().map(scaled).collect();
    let relaxed = || {
        let tied = Tied::new(rest, &edges, &ties)?;
        let mut moved = tied.turned(rotations)?;
        for _ in 0..rounds {
            let now = rest.with_positions(moved);
            let motions = carry::motions(rest, &now);
            let turns: Vec<Matrix3> = motions.iter().map(|m| m.rotation).collect();
            moved = tied.turned(&turns)?;
        }
        Ok(moved)
    };
    relaxed().map_err(|e| failure(e, 0))
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
