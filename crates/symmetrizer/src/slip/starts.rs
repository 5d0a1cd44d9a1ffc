//! Twists to start from: those of neighbourhoods, and of two neighbourhoods together.

use std::collections::VecDeque;

use rayon::prelude::*;

use crate::slip::fit::weight;
use crate::slip::ground::Ground;
use crate::slip::twist::{Moments, Twist};

/// Neighbourhoods, spread over the samples; ours.
const SEEDS: usize = 32;
/// Share of all samples that a neighbourhood has, and the fewest samples that make one; ours.
const SHARE: f64 = 0.02;
const FEWEST: usize = 16;
/// Samples on which a start is rated; ours.
const RATED: usize = 300;
/// Angle, radians, that counts half when a start is rated; ours: neighbourhoods say this much.
const ANGLE: f64 = 0.06;
/// Starts kept; ours.
const KEPT: usize = 12;
/// Twists are alike whose velocities correlate more than this; ours.
const ALIKE: f64 = 0.98;

/// The twists along which most of the samples `alive` slide, as neighbourhoods see it, best first.
pub fn starts(ground: &Ground, alive: &[u32], patches: &[Vec<u32>]) -> Vec<Twist> {
    let sums: Vec<Moments> = patches.iter().map(|p| ground.moments(p)).collect();
    let whole = ground.moments(alive);
    let mut twists: Vec<Twist> = whole.twists().into_iter().flatten().take(3).collect();
    for sum in &sums {
        twists.extend(sum.twists().into_iter().flatten().take(3));
    }
    let couples: Vec<(usize, usize)> = (0..sums.len())
        .flat_map(|i| (0..i).map(move |j| (i, j)))
        .collect();
    let of_couple = |&(i, j): &(usize, usize)| Some((sums[i] + sums[j]).twists()?[0]);
    twists.par_extend(couples.par_iter().filter_map(of_couple));
    let stride = alive.len().div_ceil(RATED).max(1);
    let scale = ANGLE.hypot(ground.tolerance);
    let mut rated: Vec<(f64, Twist)> = twists
        .into_par_iter()
        .map(|twist| {
            let on = alive.iter().step_by(stride);
            let rating = on.map(|&i| weight(ground.angle(&twist, i), scale)).sum();
            (rating, twist)
        })
        .collect();
    rated.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<Twist> = Vec::new();
    for (_, twist) in rated {
        if kept
            .iter()
            .all(|k| whole.correlation(k, &twist).abs() < ALIKE)
        {
            kept.push(twist);
        }
        if kept.len() == KEPT {
            break;
        }
    }
    kept
}

/// Neighbourhoods of samples as far from each other as they can be, within those `alive`.
pub fn neighborhoods(ground: &Ground, alive: &[bool]) -> Vec<Vec<u32>> {
    let size = FEWEST.max((SHARE * alive.len() as f64) as usize);
    let mut away: Vec<f64> = alive
        .iter()
        .map(|&a| if a { f64::INFINITY } else { -1.0 })
        .collect();
    let mut found = Vec::new();
    for _ in 0..SEEDS {
        let Some(seed) =
            (0..away.len()).max_by(|&a, &b| away[a].total_cmp(&away[b]).then(b.cmp(&a)))
        else {
            break;
        };
        if away[seed] <= 0.0 {
            break;
        }
        let x = ground.positions[seed];
        for (a, y) in away.iter_mut().zip(&ground.positions) {
            *a = a.min((y - x).norm_squared());
        }
        let patch = nearest(&ground.facing, alive, seed as u32, size);
        if patch.len() >= FEWEST {
            found.push(patch);
        }
    }
    found
}

/// The first `size` samples reached from `seed`, increasing.
fn nearest(graph: &[Vec<u32>], alive: &[bool], seed: u32, size: usize) -> Vec<u32> {
    let mut seen = vec![false; alive.len()];
    let mut queue = VecDeque::from([seed]);
    let mut patch = Vec::new();
    seen[seed as usize] = true;
    while let Some(i) = queue.pop_front() {
        patch.push(i);
        if patch.len() == size {
            break;
        }
        for &j in &graph[i as usize] {
            if alive[j as usize] && !seen[j as usize] {
                seen[j as usize] = true;
                queue.push_back(j);
            }
        }
    }
    patch.sort_unstable();
    patch
}
