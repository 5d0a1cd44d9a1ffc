//! How far over the surface an isometry reaches from where it was found.

use rayon::prelude::*;

use crate::patch::ground::{Ground, touch_one};
use crate::patch::grow::Candidate;
use crate::patch::symmetry::PatchPair;
use crate::transform::Isometry;

/// Grows what an isometry holds for again and again while it is refined: contacts of before say where to look first.
pub struct Reach<'a> {
    ground: &'a Ground<'a>,
    candidate: &'a Candidate,
    /// Smallest cosine between carried and found normal.
    min_cos: f64,
    /// For each sample the face that its image touched last.
    last: Vec<Option<u32>>,
}

impl<'a> Reach<'a> {
    /// From the seeds of `candidate`.
    pub fn new(ground: &'a Ground<'a>, candidate: &'a Candidate, min_cos: f64) -> Self {
        Self {
            ground,
            candidate,
            min_cos,
            last: vec![None; ground.samples.list.len()],
        }
    }

    /// The samples that can be reached from a seed over at most `rings` neighbours whose images under `t` touch the
    /// surface within `tolerance`, fraction of L, by sample.
    pub fn grow(&mut self, t: &Isometry, tolerance: f64, rings: u32) -> Vec<PatchPair> {
        let samples = self.ground.samples;
        let mut seen = match &self.candidate.within {
            Some(within) => within.iter().map(|inside| !inside).collect(),
            None => vec![false; samples.list.len()],
        };
        let mut front: Vec<u32> = self.candidate.seeds.clone();
        for &s in &front {
            seen[s as usize] = true;
        }
        let mut grown = Vec::new();
        let mut ring = 0;
        while !front.is_empty() && ring <= rings {
            ring += 1;
            let touched: Vec<PatchPair> = front
                .par_iter()
                .with_min_len(64)
                .filter_map(|&s| {
                    let guess = self.last[s as usize];
                    touch_one(self.ground, t, s, tolerance, self.min_cos, guess)
                })
                .collect();
            front.clear();
            for pair in &touched {
                for &next in &samples.neighbors[pair.sample as usize] {
                    if !seen[next as usize] {
                        seen[next as usize] = true;
                        front.push(next);
                    }
                }
            }
            grown.extend(touched);
        }
        grown.sort_by_key(|p| p.sample);
        for pair in &grown {
            self.last[pair.sample as usize] = Some(pair.partner.face);
        }
        grown
    }
}
