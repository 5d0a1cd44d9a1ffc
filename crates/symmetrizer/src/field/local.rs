//! The local isometry of each sample, fitted to the pairs around it.

use rayon::prelude::*;

use crate::field::{Partner, Reach};
use crate::sample::Samples;
use crate::transform::optimal::optimal_improper;
use crate::transform::{Ambient, Correspondence, Isometry, optimal_mirror};

/// What is fitted around a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Local {
    /// A mirror: the parts have not moved against each other.
    Mirror,
    /// Any isometry that turns inside out: a raised arm and its lowered partner.
    Improper,
}

/// Weights fall to 1/e at this share of the radius.
const WIDTH: f64 = 0.6;
/// Fewer pairs fit nothing.
const LEAST: usize = 4;
/// Pairs that miss the first fit by more than this many times the median count less in the second.
const ROBUST: f64 = 2.0;

/// Fits `local` isometries within `radius` (fraction of L) of each sample that has a partner.
pub fn fit(
    samples: &Samples,
    reach: &Reach,
    partners: &[Option<Partner>],
    local: Local,
    radius: f64,
) -> Vec<Option<Isometry>> {
    // The pairs whose partner is next to each sample: swapped, they tell of its mirror too.
    let mut back: Vec<Vec<u32>> = vec![Vec::new(); samples.list.len()];
    for (s, partner) in (0..).zip(partners) {
        if let Some(q) = partner {
            back[q.sample as usize].push(s);
        }
    }
    (0..samples.list.len() as u32)
        .into_par_iter()
        .map(|s| {
            partners[s as usize].as_ref()?;
            let mut pairs = Vec::new();
            for (j, d) in reach.of(s, radius) {
                let weight = (-(d / (WIDTH * radius)).powi(2)).exp();
                if let Some(q) = &partners[j as usize] {
                    let p = samples.list[j as usize].position;
                    pairs.push(Correspondence {
                        p,
                        q: q.position,
                        weight,
                    });
                }
                for &k in &back[j as usize] {
                    if let Some(q) = &partners[k as usize] {
                        let p = samples.list[k as usize].position;
                        pairs.push(Correspondence {
                            p: q.position,
                            q: p,
                            weight,
                        });
                    }
                }
            }
            robust(&mut pairs, local, samples.ambient)
        })
        .collect()
}

fn robust(pairs: &mut [Correspondence], local: Local, ambient: Ambient) -> Option<Isometry> {
    if pairs.len() < LEAST {
        return None;
    }
    let first = once(pairs, local, ambient)?;
    let missed: Vec<f64> = pairs
        .iter()
        .map(|c| (first.apply(&c.p) - c.q).norm())
        .collect();
    let middle = crate::geom::median(&mut missed.clone()).unwrap_or_default();
    for (c, r) in pairs.iter_mut().zip(&missed) {
        c.weight /= 1.0 + (r / (ROBUST * middle + 1e-6)).powi(4);
    }
    once(pairs, local, ambient)
}

fn once(pairs: &[Correspondence], local: Local, ambient: Ambient) -> Option<Isometry> {
    match local {
        Local::Mirror => optimal_mirror(pairs, ambient).map(|f| Isometry::mirror(&f.plane)),
        Local::Improper => optimal_improper(pairs, None, ambient).map(|f| f.isometry),
    }
}
