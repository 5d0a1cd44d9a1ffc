//! What lies around each sample along the surface.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use crate::deform::bridges::bridges;
use crate::deform::laplacian::edge_weights;
use crate::error::Result;
use crate::geom::Point;
use crate::sample::Samples;
use crate::shape::sheet::between;
use crate::shape::wall::Wall;

/// Weight of all edges in the plane together, for each sample: that of the edges of a surface.
const EDGES: f64 = 8.0;

/// For each sample the samples within a distance along the surface, itself first.
pub struct Reach {
    /// For each sample the samples next to it, those that tie loose parts to the rest among them.
    pub neighbors: Vec<Vec<u32>>,
    /// What holds neighbours together: two samples, the first one's number the smaller, and how much it counts,
    /// on a surface 1.
    pub edges: Vec<([u32; 2], f64)>,
    /// Sample and distance along the graph of neighbours, fraction of L, nearest first.
    pub around: Vec<Vec<(u32, f64)>>,
}

impl Reach {
    /// The samples within `radius` (fraction of L) of each.
    pub fn new(samples: &Samples, radius: f64) -> Self {
        let mut neighbors = samples.neighbors.clone();
        let ties = ties(samples, &neighbors);
        join(&mut neighbors, &ties);
        let edges = edges(&neighbors).map(|edge| (edge, 1.0)).collect();
        Self::over(samples, neighbors, edges, radius)
    }

    /// The same in the plane: samples next to each other across the inside of the `wall` that they are on are
    /// neighbours, too, and edges count as those of a flat triangulation (their cotangents).
    ///
    /// # Errors
    /// [`crate::Error::Input`] where the inside could not be triangulated.
    pub fn inside(wall: &Wall, samples: &Samples, radius: f64) -> Result<Self> {
        let mut rings = vec![Vec::new(); wall.rings.len()];
        for s in &samples.list {
            rings[wall.along(&s.at).0].push(s.position);
        }
        let flat = between(&rings)?;
        let mut weights = edge_weights(&flat, None);
        let mut neighbors = samples.neighbors.clone();
        let links: Vec<[u32; 2]> = weights.keys().map(|&(i, j)| [i, j]).collect();
        join(&mut neighbors, &links);
        for [i, j] in ties(samples, &neighbors) {
            join(&mut neighbors, &[[i, j]]);
            weights.insert((i.min(j), i.max(j)), 1.0);
        }
        let scale = EDGES * samples.list.len() as f64 / weights.values().sum::<f64>();
        let edges = weights.iter().map(|(&(i, j), w)| ([i, j], scale * w));
        let edges = edges.collect();
        Ok(Self::over(samples, neighbors, edges, radius))
    }

    fn over(
        samples: &Samples,
        neighbors: Vec<Vec<u32>>,
        edges: Vec<([u32; 2], f64)>,
        radius: f64,
    ) -> Self {
        let places: Vec<Point> = samples.list.iter().map(|s| s.position).collect();
        let around = (0..samples.list.len() as u32).into_par_iter();
        let around = around
            .map(|s| within(&places, &neighbors, s, radius))
            .collect();
        Self {
            neighbors,
            edges,
            around,
        }
    }

    /// Those of sample `s` within `radius`, which is no more than that of all.
    pub fn of(&self, s: u32, radius: f64) -> impl Iterator<Item = (u32, f64)> + '_ {
        let all = self.around[s as usize].iter().copied();
        all.take_while(move |(_, d)| *d <= radius)
    }
}

/// The edges between neighbours.
fn edges(neighbors: &[Vec<u32>]) -> impl Iterator<Item = [u32; 2]> + '_ {
    let all = (0..).zip(neighbors);
    let all = all.flat_map(|(i, near): (u32, &Vec<u32>)| near.iter().map(move |&j| [i, j]));
    all.filter(|[i, j]| i < j)
}

/// Pairs of samples that tie loose parts to the rest.
fn ties(samples: &Samples, neighbors: &[Vec<u32>]) -> Vec<[u32; 2]> {
    let places: Vec<Point> = samples.list.iter().map(|s| s.position).collect();
    bridges(&places, edges(neighbors))
}

/// Makes the two of each pair neighbours where they are not.
fn join(neighbors: &mut [Vec<u32>], pairs: &[[u32; 2]]) {
    for &[i, j] in pairs {
        if !neighbors[i as usize].contains(&j) {
            neighbors[i as usize].push(j);
            neighbors[j as usize].push(i);
        }
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
