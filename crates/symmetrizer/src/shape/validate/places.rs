//! Vertices in equal places.

use rayon::prelude::*;

use crate::geom::Point;
use crate::shape::mesh::is_finite;

/// For each vertex the first of the used ones with equal coordinates: itself where there is none
/// before it, where it is not used, or where it has no place.
pub(super) fn first_in_place(positions: &[Point], used: &[bool]) -> Vec<u32> {
    let mut first: Vec<u32> = (0..positions.len() as u32).collect();
    let mut order: Vec<u32> = first
        .iter()
        .copied()
        .filter(|&v| used[v as usize] && is_finite(&positions[v as usize]))
        .collect();
    // Adding 0.0 makes -0.0 and 0.0 one place.
    let key = |v: u32| positions[v as usize].coords.map(|c| c + 0.0);
    let compare = |a: &u32, b: &u32| {
        let (p, q) = (key(*a), key(*b));
        (p.x.total_cmp(&q.x))
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
    };
    order.par_sort_unstable_by(|a, b| compare(a, b).then(a.cmp(b)));
    for place in order.chunk_by(|a, b| compare(a, b).is_eq()) {
        for &v in place {
            first[v as usize] = place[0];
        }
    }
    first
}
