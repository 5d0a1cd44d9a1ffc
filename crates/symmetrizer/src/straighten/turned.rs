//! Positions for given rotations: of a surface, or of what a wall encloses.

use crate::deform::Tie;
use crate::deform::harmonic::rotations_inside;
use crate::deform::poisson::{integrate, integrate_tied, relax_tied};
use crate::error::Result;
use crate::field::grow::Land;
use crate::geom::{Matrix3, Point};
use crate::shape::Surface;
use crate::shape::sheet::Sheet;

/// Rounds in which what a wall encloses is made as rigid as its pairs allow.
const RELAXED: usize = 10;

/// Vertex positions of `rest`, which is the surface of `land` or a later state of it, its vertices turned by
/// `rotations` and `ties` opposite each other across x = 0. Over a wall all that it encloses is turned: from
/// the outline inwards the rotations go on evenly, and with ties it is then as rigid as they allow: the rotations of
/// a field are as even as they can be, so that at a hip the trunk would bend and the leg turn with it.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn turned(
    land: &Land<'_>,
    rest: &Surface,
    rotations: &[Matrix3],
    ties: &[Tie],
) -> Result<Vec<Point>> {
    let Some(wall) = land.wall else {
        return match ties {
            [] => integrate(rest, rotations, land.stiffness, &[]),
            ties => integrate_tied(rest, rotations, land.stiffness, ties),
        };
    };
    let wall = wall.moved(rest.positions.clone());
    let sheet = Sheet::new(&wall)?;
    let mut known = vec![None; sheet.surface.positions.len()];
    for (pair, &v) in rotations.chunks_exact(2).zip(&sheet.corners) {
        known[v as usize] = Some(pair[0]);
    }
    let inside = rotations_inside(&sheet.surface, &known)?;
    let tie = |t: &Tie| Tie {
        p: sheet.at(&t.p),
        q: sheet.at(&t.q),
        ..*t
    };
    let ties: Vec<Tie> = ties.iter().map(tie).collect();
    let moved = match ties.as_slice() {
        [] => integrate(&sheet.surface, &inside, None, &[])?,
        ties => relax_tied(&sheet.surface, &inside, None, ties, RELAXED)?,
    };
    Ok(sheet.wall(&wall, &moved))
}
