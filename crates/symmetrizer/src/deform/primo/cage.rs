//! The control mesh: a few thousand prisms that carry a fine surface.

use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::Surface;

/// A decimated copy of `surface` with about `faces` triangles, its vertices among the surface's
/// own; the surface itself where it has no more than that.
///
/// # Errors
/// [`Error::Numerical`] where decimation leaves nothing.
pub fn control_mesh(surface: &Surface, faces: usize) -> Result<Surface> {
    if surface.triangles.len() <= faces + faces / 2 {
        return Ok(surface.clone());
    }
    let positions: Vec<[f32; 3]> = surface
        .positions
        .iter()
        .map(|p| [p.x as f32, p.y as f32, p.z as f32])
        .collect();
    let indices: Vec<u32> = surface.triangles.iter().flatten().copied().collect();
    let kept = meshopt::simplify_decoder(
        &indices,
        &positions,
        3 * faces,
        f32::MAX,
        meshopt::SimplifyOptions::None,
        None,
    );
    let mut map = vec![u32::MAX; surface.positions.len()];
    let mut used: Vec<Point> = Vec::new();
    let mut triangles = Vec::with_capacity(kept.len() / 3);
    for corner in kept.chunks_exact(3) {
        let t: [u32; 3] = std::array::from_fn(|k| {
            let v = corner[k] as usize;
            if map[v] == u32::MAX {
                map[v] = used.len() as u32;
                used.push(surface.positions[v]);
            }
            map[v]
        });
        triangles.push(t);
    }
    if triangles.is_empty() {
        return Err(Error::Numerical {
            stage: "control mesh",
            step: 0,
            what: "decimation left no faces".into(),
        });
    }
    Ok(Surface::new(used, triangles.into()))
}
