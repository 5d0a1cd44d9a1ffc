//! Faces that pass through other faces of the same surface.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector as GlamVector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use rayon::prelude::*;

use crate::shape::surface::Surface;
use crate::shape::triangles_cross::cross;

/// The faces, sorted, that cross another face with which they share no vertex.
///
/// Crossing is meant strictly: the two triangles share a piece of line that runs through the
/// inside of both and they do not lie in one plane. Touching, whether at a point, along an edge or
/// face on face, does not count, to 1e-9 of the triangles' size.
pub fn crossing_faces(surface: &Surface) -> Vec<u32> {
    let boxes: Vec<Aabb> = (0..surface.triangles.len() as u32)
        .map(|f| bounds(surface, f))
        .collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let mut crossing: Vec<u32> = (0..boxes.len() as u32)
        .into_par_iter()
        .flat_map_iter(|f| crossed_by(surface, &tree, &boxes[f as usize], f))
        .flatten_iter()
        .collect();
    crossing.sort_unstable();
    crossing.dedup();
    crossing
}

/// The faces of `after` that are not in `before`; both sorted, the answer too.
pub fn new_crossings(before: &[u32], after: &[u32]) -> Vec<u32> {
    let is_new = |f: &&u32| before.binary_search(f).is_err();
    after.iter().filter(is_new).copied().collect()
}

/// The pairs of `f` with the later faces that it crosses.
fn crossed_by(surface: &Surface, tree: &Bvh, bounds: &Aabb, f: u32) -> Vec<[u32; 2]> {
    let mine = surface.triangles[f as usize];
    let corners = surface.corners(f);
    tree.intersect_aabb(bounds)
        .filter(|&g| g > f)
        .filter(|&g| {
            !surface.triangles[g as usize]
                .iter()
                .any(|v| mine.contains(v))
        })
        .filter(|&g| cross(&corners, &surface.corners(g)))
        .map(|g| [f, g])
        .collect()
}

fn bounds(surface: &Surface, face: u32) -> Aabb {
    let [a, b, c] = surface.corners(face);
    let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
    Aabb::new(
        GlamVector::new(low.x, low.y, low.z),
        GlamVector::new(high.x, high.y, high.z),
    )
}
