//! The sides of triangles, gathered by edge.

use rayon::prelude::*;

use super::sets::Sets;

/// A side of a triangle: its ends in increasing order, and the corner it begins at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Side {
    low: u32,
    high: u32,
    /// The corner from which it runs to the next: three times the triangle, and 0, 1 or 2.
    pub corner: u32,
}

impl Side {
    /// The triangle that it belongs to.
    pub fn triangle(self) -> u32 {
        self.corner / 3
    }

    /// The corner at which it ends, numbered as [`Side::corner`].
    pub fn next_corner(self) -> u32 {
        let first = self.corner - self.corner % 3;
        first + (self.corner + 1) % 3
    }

    /// Whether it runs from its lower end to its higher one.
    pub fn runs_up(self, triangles: &[[u32; 3]]) -> bool {
        vertex(triangles, self.corner) == self.low
    }

    /// Its corners at the lower and at the higher end.
    pub fn corners(self, triangles: &[[u32; 3]]) -> [u32; 2] {
        let ends = [self.corner, self.next_corner()];
        if self.runs_up(triangles) {
            ends
        } else {
            [ends[1], ends[0]]
        }
    }
}

/// The vertex at a corner, numbered as [`Side::corner`].
pub(super) fn vertex(triangles: &[[u32; 3]], corner: u32) -> u32 {
    triangles[corner as usize / 3][corner as usize % 3]
}

/// The sides of all triangles, those of one edge side by side in the order of their corners.
pub(super) fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides: Vec<Side> = (0..3 * triangles.len() as u32)
        .map(|corner| {
            let mut side = Side {
                low: 0,
                high: 0,
                corner,
            };
            let [u, v] = [corner, side.next_corner()].map(|c| vertex(triangles, c));
            (side.low, side.high) = (u.min(v), u.max(v));
            side
        })
        .collect();
    // No two are equal, so that the order does not depend on the threads.
    sides.par_sort_unstable();
    sides
}

/// The sides of each edge.
pub(super) fn edges(sides: &[Side]) -> impl Iterator<Item = &[Side]> {
    sides.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
}

/// Edges with one triangle, and with more than two.
pub(super) fn odd_edges(sides: &[Side]) -> (usize, usize) {
    let mut counts = (0, 0);
    for edge in edges(sides) {
        match edge.len() {
            1 => counts.0 += 1,
            2 => {}
            _ => counts.1 += 1,
        }
    }
    counts
}

/// The part of the surface that each triangle belongs to: that of all triangles with which it hangs
/// together by shared vertices, named by the lowest of them. Vertices are below `count`.
pub(super) fn components(triangles: &[[u32; 3]], count: usize) -> Vec<u32> {
    let mut sets = Sets::new(count);
    for &[a, b, c] in triangles {
        sets.join(a, b);
        sets.join(b, c);
    }
    let mut first = vec![u32::MAX; count];
    let mut of = Vec::with_capacity(triangles.len());
    for (t, corners) in triangles.iter().enumerate() {
        let first = &mut first[sets.root(corners[0]) as usize];
        *first = (*first).min(t as u32);
        of.push(*first);
    }
    of
}
