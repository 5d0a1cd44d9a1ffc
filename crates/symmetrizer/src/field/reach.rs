//! What lies around each sample along the surface.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use crate::deform::bridges::bridges;
use crate::geom::Point;
use crate::sample::Samples;

/// For each sample the samples within a distance along the surface, itself first.
pub struct Reach {
    /// For each sample the samples next to it, those that tie loose parts to the rest among them.
    pub neighbors: Vec<Vec<u32>>,
    /// Sample and distance along the graph of neighbours, fraction of L, nearest first.
    pub around: Vec<Vec<(u32, f64)>>,
}

impl Reach {
    /// The samples within `radius` (fraction of L) of each.
    pub fn new(samples: &Samples, radius: f64) -> Self {
        let mut neighbors = samples.neighbors.clone();
        let places: Vec<Point> = samples.list.iter().map(|s| s.position).collect();
        let links = (0..).zip(&samples.neighbors);
        let links = links.flat_map(|(i, near)| near.iter().map(move |&j| [i, j]));
        for [i, j] in bridges(&places, links) {
            neighbors[i as usize].push(j);
            neighbors[j as usize].push(i);
        }
        let count = samples.list.len() as u32;
        let around = (0..count).into_par_iter();
        let around = around
            .map(|s| within(&places, &neighbors, s, radius))
            .collect();
        Self { neighbors, around }
    }

    /// Those of sample `s` within `radius`, which is no more than that of all.
    pub fn of(&self, s: u32, radius: f64) -> impl Iterator<Item = (u32, f64)> + '_ {
        let all = self.around[s as usize].iter().copied();
        all.take_while(move |(_, d)| *d <= radius)
    }
}

/// Dijkstra over the graph of neighbours.
fn within(places: &[Point], neighbors: &[Vec<u32>], from: u32, radius: f64) -> Vec<(u32, f64)> {
    let mut best: std::collections::BTreeMap<u32, f64> = [(from, 0.0)].into();
    // Lengths are not negative, so their bits are in order.
    let mut queue = BinaryHeap::from([Reverse((0.0_f64.to_bits(), from))]);
    let mut reached = Vec::new();
    while let Some(Reverse((bits, s))) = queue.pop() {
        let d = f64::from_bits(bits);
        if best.get(&s).is_some_and(|b| *b < d) {
            continue;
        }
        reached.push((s, d));
        for &n in &neighbors[s as usize] {
            let away = d + (places[n as usize] - places[s as usize]).norm();
            if away <= radius && best.get(&n).is_none_or(|b| away < *b) {
                best.insert(n, away);
                queue.push(Reverse((away.to_bits(), n)));
            }
        }
    }
    reached
}
