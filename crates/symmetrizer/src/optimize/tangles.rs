//! Where a deformation has tangled a surface.

use std::collections::HashSet;

use crate::shape::Surface;
use crate::shape::crossings::{Crossings, faces_of};
use crate::shape::inverted::inverted_faces;

/// Finds tangles in one deformed state of a surface after another.
pub struct Tangles {
    crossings: Crossings,
    /// Vertices of faces that crossed each other at rest, the lower first.
    crossed: HashSet<[u32; 2]>,
    /// Vertices of each face and next to it.
    around: Vec<Vec<u32>>,
}

impl Tangles {
    /// In states of `rest`, whose vertices have these `neighbors`.
    pub fn of(rest: &Surface, neighbors: &[Vec<u32>]) -> Self {
        let crossings = Crossings::new(rest);
        let old = crossings.among(rest, |_| true);
        let corners = |[f, g]: [u32; 2]| {
            let [f, g] = [f, g].map(|face| rest.triangles[face as usize]);
            f.into_iter().flat_map(move |u| g.map(|v| sorted(u, v)))
        };
        let around = |corners: &[u32; 3]| {
            let near = corners.iter().flat_map(|&v| &neighbors[v as usize]);
            let mut around: Vec<u32> = near.copied().collect();
            around.sort_unstable();
            around.dedup();
            around
        };
        let crossed: HashSet<_> = old.into_iter().flat_map(corners).collect();
        // Asked for only where something crossed at rest.
        let around = match crossed.is_empty() {
            true => Vec::new(),
            false => rest.triangles.iter().map(around).collect(),
        };
        Self {
            crossings,
            crossed,
            around,
        }
    }

    /// The faces of `now`, sorted, that cross others or are turned over and were not at `rest`.
    ///
    /// Sheets that ran through each other at rest go on doing so, along a line that slides: what crosses next to
    /// where the same two sheets crossed is nothing new.
    pub fn faces(&mut self, rest: &Surface, now: &Surface) -> Vec<u32> {
        let crossings = &mut self.crossings;
        let crossing = || {
            crossings.follow(now);
            crossings.among(now, |_| true)
        };
        let (mut pairs, inverted) = rayon::join(crossing, || inverted_faces(rest, now));
        pairs.retain(|pair| !self.known(*pair));
        let mut faces = faces_of(&pairs);
        faces.extend(inverted);
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    /// Whether the surface crossed itself at rest where it does in these two faces, or next to them.
    fn known(&self, [f, g]: [u32; 2]) -> bool {
        if self.crossed.is_empty() {
            return false;
        }
        let [f, g] = [f, g].map(|face| &self.around[face as usize]);
        let mut all = f.iter().flat_map(|&u| g.iter().map(move |&v| sorted(u, v)));
        all.any(|pair| self.crossed.contains(&pair))
    }
}

fn sorted(u: u32, v: u32) -> [u32; 2] {
    [u.min(v), u.max(v)]
}
