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
    faces_of(&Crossings::new(surface).among(surface, |_| true))
}

/// The faces of `after` that are not in `before`; both sorted, the answer too.
pub fn new_crossings(before: &[u32], after: &[u32]) -> Vec<u32> {
    let is_new = |f: &&u32| before.binary_search(f).is_err();
    after.iter().filter(is_new).copied().collect()
}

/// The faces, sorted, that are in one of the pairs.
pub fn faces_of(pairs: &[[u32; 2]]) -> Vec<u32> {
    let mut faces: Vec<u32> = pairs.iter().flatten().copied().collect();
    faces.sort_unstable();
    faces.dedup();
    faces
}

/// Finds crossings in one state after another of the same triangles.
#[derive(Clone)]
pub struct Crossings {
    tree: Bvh,
}

impl Crossings {
    /// For states near that of `surface`.
    pub fn new(surface: &Surface) -> Self {
        Self {
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes(surface)),
        }
    }

    /// Goes over to another state.
    pub fn follow(&mut self, surface: &Surface) {
        for (f, bounds) in (0..).zip(boxes(surface)) {
            self.tree.insert_or_update_partially(bounds, f, 0.0);
        }
        self.tree.refit_without_opt();
    }

    /// The pairs of faces that cross, one of them at least `asked` for, in order.
    pub fn among(&self, surface: &Surface, asked: impl Fn(u32) -> bool + Sync) -> Vec<[u32; 2]> {
        (0..surface.triangles.len() as u32)
            .into_par_iter()
            .filter(|&f| asked(f))
            .flat_map_iter(|f| {
                // Of two that are asked for, the first one tells.
                let other = |&g: &u32| g > f || (g < f && !asked(g));
                self.crossed_by(surface, f, other)
            })
            .collect()
    }

    /// The pairs of `f` with those faces of `others` that it crosses.
    fn crossed_by(
        &self,
        surface: &Surface,
        f: u32,
        others: impl Fn(&u32) -> bool,
    ) -> Vec<[u32; 2]> {
        let mine = surface.triangles[f as usize];
        let corners = surface.corners(f);
        self.tree
            .intersect_aabb(&bounds(surface, f))
            .filter(others)
            .filter(|&g| {
                !surface.triangles[g as usize]
                    .iter()
                    .any(|v| mine.contains(v))
            })
            .filter(|&g| cross(&corners, &surface.corners(g)))
            .map(|g| [f, g])
            .collect()
    }
}

fn boxes(surface: &Surface) -> Vec<Aabb> {
    (0..surface.triangles.len() as u32)
        .into_par_iter()
        .map(|f| bounds(surface, f))
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
