//! Distances over a surface, along its edges.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use symmetrizer::shape::Surface;

/// The length of the shortest way along edges from `source` to each vertex; infinite where there is none.
pub fn distances(surface: &Surface, source: u32) -> Vec<f64> {
    let neighbors = neighbors(surface);
    let mut distance = vec![f64::INFINITY; surface.positions.len()];
    distance[source as usize] = 0.0;
    // Distances are not negative, so their bits are ordered as they are.
    let mut next = BinaryHeap::from([Reverse((0_u64, source))]);
    while let Some(Reverse((bits, v))) = next.pop() {
        let here = f64::from_bits(bits);
        if here > distance[v as usize] {
            continue;
        }
        let from = surface.positions[v as usize];
        for &w in &neighbors[v as usize] {
            let there = here + (surface.positions[w as usize] - from).norm();
            if there < distance[w as usize] {
                distance[w as usize] = there;
                next.push(Reverse((there.to_bits(), w)));
            }
        }
    }
    distance
}

fn neighbors(surface: &Surface) -> Vec<Vec<u32>> {
    let mut neighbors = vec![Vec::new(); surface.positions.len()];
    let mut edges = surface.sides();
    edges.dedup();
    for [u, v] in edges {
        neighbors[u as usize].push(v);
        neighbors[v as usize].push(u);
    }
    neighbors
}
