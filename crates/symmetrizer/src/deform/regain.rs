//! A part of a deformed surface regains the form that it has at rest, where the rest of the surface took it.

use crate::deform::elastic::Motion;
use crate::deform::failure;
use crate::deform::harmonic::rotations_inside;
use crate::deform::laplacian::edge_weights;
use crate::deform::poisson::system::EdgeSystem;
use crate::error::Result;
use crate::geom::{Matrix3, Point};
use crate::shape::Surface;

/// Positions of `now`, a deformed state of `rest` to which its vertices have come by these `motions`, with the form at
/// rest where a vertex is in the `core`: edges there are those of `rest`, turned as the surface around has turned
/// (harmonic rotations). What is `freed` besides makes room: it keeps the form that it has now, and moves (Poisson's
/// equation for both, as in Yu et al. 2004). All else stays, as do loose parts that are freed as a whole: nothing holds
/// them.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn regain(
    (rest, now): (&Surface, &Surface),
    motions: &[Motion],
    core: &[bool],
    freed: &[bool],
) -> Result<Vec<Point>> {
    let mut positions = now.positions.clone();
    let patch = Patch::new(rest, freed);
    if !patch.held.contains(&false) {
        return Ok(positions);
    }
    let vertices = patch.vertices.iter().zip(&patch.held);
    let known: Vec<Option<Matrix3>> = vertices
        .map(|(&v, held)| {
            let kept = *held || !core[v as usize];
            kept.then(|| motions[v as usize].rotation)
        })
        .collect();
    let (rotations, system) = rayon::join(
        || rotations_inside(&patch.rest, &known),
        || EdgeSystem::new(&patch.rest, &edge_weights(&patch.rest, None)),
    );
    let (rotations, mut system) = (rotations?, system.map_err(|e| failure(e, 0))?);
    system.set_fixed(patch.held.clone());
    let from: Vec<Point> = patch
        .vertices
        .iter()
        .map(|&v| positions[v as usize])
        .collect();
    let at_rest = &patch.rest.positions;
    let wanted = |_, i: usize, j: usize| {
        if known[i].is_some() && known[j].is_some() {
            return from[i] - from[j];
        }
        0.5 * ((rotations[i] + rotations[j]) * (at_rest[i] - at_rest[j]))
    };
    let ways = system
        .ways_for(&patch.rest, wanted, &[], 1.0, &from)
        .map_err(|e| failure(e, 0))?;
    for (&v, way) in patch.vertices.iter().zip(&ways) {
        positions[v as usize] += way;
    }
    Ok(positions)
}

/// The faces around what is freed.
struct Patch {
    rest: Surface,
    /// The surface's vertex for each of the patch.
    vertices: Vec<u32>,
    /// Whether each stays.
    held: Vec<bool>,
}

impl Patch {
    fn new(rest: &Surface, freed: &[bool]) -> Self {
        let touched = |t: &&[u32; 3]| t.iter().any(|&v| freed[v as usize]);
        let faces: Vec<[u32; 3]> = rest.triangles.iter().filter(touched).copied().collect();
        let mut vertices: Vec<u32> = faces.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut number = vec![0; rest.positions.len()];
        for (k, &v) in (0..).zip(&vertices) {
            number[v as usize] = k;
        }
        let triangles = faces.iter().map(|t| t.map(|v| number[v as usize]));
        let places = vertices.iter().map(|&v| rest.positions[v as usize]);
        let rest = Surface::new(places.collect(), triangles.collect());
        let mut held: Vec<bool> = vertices.iter().map(|&v| !freed[v as usize]).collect();
        hold_loose(&rest, &mut held);
        Self {
            rest,
            vertices,
            held,
        }
    }
}

/// Holds the pieces of which nothing is held.
fn hold_loose(patch: &Surface, held: &mut [bool]) {
    let mut root: Vec<u32> = (0..held.len() as u32).collect();
    for [u, v] in patch.edges() {
        let [a, b] = [u, v].map(|v| find(&mut root, v));
        root[a.max(b) as usize] = a.min(b);
    }
    let roots: Vec<u32> = (0..held.len() as u32).map(|v| find(&mut root, v)).collect();
    let mut holds = vec![false; held.len()];
    for (&root, held) in roots.iter().zip(&*held) {
        holds[root as usize] |= held;
    }
    for (&root, held) in roots.iter().zip(held) {
        *held |= !holds[root as usize];
    }
}

/// The root of a piece, the ways there made shorter.
fn find(root: &mut [u32], mut v: u32) -> u32 {
    while root[v as usize] != v {
        root[v as usize] = root[root[v as usize] as usize];
        v = root[v as usize];
    }
    v
}
