//! The search: the best part, then the best of the rest, until nothing large enough slides.

use rayon::prelude::*;

use crate::geom::Vector;
use crate::sample::Samples;
use crate::slip::classify::{Kind, classify};
use crate::slip::fit::settle;
use crate::slip::ground::Ground;
use crate::slip::orbit::{ARC, WINDING, round, sectors};
use crate::slip::params::SlipParams;
use crate::slip::part::Part;
use crate::slip::starts::{neighborhoods, starts};
use crate::slip::twist::Twist;
use crate::slip::{Continuous, Slip};

/// What each freedom beyond the first adds to the area when explanations compete; ours: a long tube with
/// lids is a cylinder, a tin is a surface of revolution.
const FREEDOM: f64 = 0.15;
/// Parts looked for at most: one of a tenth of the surface leaves room for ten.
const ROUNDS: usize = 10;

/// A part with what it is.
struct Found {
    kind: Kind,
    part: Part,
    rms: f64,
}

impl Found {
    fn score(&self) -> f64 {
        let freedoms = match self.kind.slip {
            Slip::Revolution | Slip::Extrusion | Slip::Helix => 1.0,
            Slip::Cylinder => 2.0,
            Slip::Sphere | Slip::Plane => 3.0,
        };
        self.part.samples.len() as f64 * (1.0 + FREEDOM * (freedoms - 1.0))
    }

    fn continuous(self, count: usize) -> Continuous {
        Continuous {
            slip: self.kind.slip,
            axis: self.kind.axis,
            point: self.kind.point,
            pitch: self.kind.pitch,
            area_fraction: self.part.samples.len() as f64 / count as f64,
            samples: self.part.samples,
            rms: self.rms,
        }
    }
}

/// The parts of the surface that slide along themselves, the largest first; no sample is in two.
pub fn continuous(samples: &Samples, params: &SlipParams) -> Vec<Continuous> {
    let views = Ground::views(samples, params);
    let seen = views.iter().map(|ground| parts(ground, params.min_area));
    let covered = |parts: &[Continuous]| parts.iter().map(|c| c.samples.len()).sum::<usize>();
    seen.reduce(|a, b| if covered(&b) > covered(&a) { b } else { a })
        .unwrap_or_default()
}

/// The parts of at least the share `min_area`, as one way of seeing the samples shows them.
fn parts(ground: &Ground, min_area: f64) -> Vec<Continuous> {
    let count = ground.positions.len();
    let fewest = (min_area * count as f64).ceil().max(1.0) as usize;
    let mut alive = vec![true; count];
    let mut all = Vec::new();
    for _ in 0..ROUNDS {
        if alive.iter().filter(|a| **a).count() < fewest {
            break;
        }
        let Some(found) = best(ground, &alive, fewest) else {
            break;
        };
        for &i in &found.part.samples {
            alive[i as usize] = false;
        }
        all.push(found.continuous(count));
    }
    all.sort_by_key(|c| std::cmp::Reverse(c.samples.len()));
    all
}

/// The part of at least `fewest` samples with the best score.
fn best(ground: &Ground, alive: &[bool], fewest: usize) -> Option<Found> {
    let list: Vec<u32> = (0..alive.len() as u32)
        .filter(|&i| alive[i as usize])
        .collect();
    let patches = neighborhoods(ground, alive);
    let sliding = starts(ground, &list, &patches)
        .into_par_iter()
        .filter_map(|start| {
            let twist = settle(ground, &list, start)?;
            let gate = ground.gate();
            let part = Part::new(ground, alive, |i| ground.angle(&twist, i) < gate);
            found(ground, part, &twist, fewest)
        });
    let planes = patches.par_iter().filter_map(|patch| {
        let part = plane(ground, alive, patch)?;
        let twist = ground.moments(&part.sliding).twists()?[0];
        found(ground, part, &twist, fewest)
    });
    let all: Vec<Found> = sliding.chain(planes).collect();
    all.into_iter()
        .reduce(|a, b| if b.score() > a.score() { b } else { a })
}

/// The part as what it is; `None` where it is too small, or merely passes by the twist: angles that fill
/// the gate have an rms above the tolerance.
fn found(ground: &Ground, part: Part, twist: &Twist, fewest: usize) -> Option<Found> {
    if part.sliding.len() < fewest {
        return None;
    }
    let kind = classify(ground, &part.sliding, twist)?;
    let part = match kind.slip {
        Slip::Plane => part.largest_piece(&ground.facing),
        Slip::Extrusion => part.largest_piece(&ground.around),
        Slip::Revolution => round(ground, &part, &kind)?,
        Slip::Helix if sectors(ground, &part, &kind) < WINDING => return None,
        Slip::Cylinder | Slip::Sphere | Slip::Helix => part,
    };
    let bends = matches!(kind.slip, Slip::Revolution | Slip::Cylinder);
    let arc = !bends || sectors(ground, &part, &kind) >= ARC;
    if part.samples.len() < fewest || !arc {
        return None;
    }
    let rms = kind.rms(ground, &part.sliding, twist);
    (rms <= ground.tolerance).then_some(Found { kind, part, rms })
}

/// The flat part around a neighbourhood.
fn plane(ground: &Ground, alive: &[bool], patch: &[u32]) -> Option<Part> {
    let gate = ground.gate().cos();
    let mut members = patch.to_vec();
    let mut part = None;
    for _ in 0..2 {
        let sum: Vector = members.iter().map(|&i| ground.normals[i as usize]).sum();
        let normal = sum.try_normalize(1e-9)?;
        let flat = Part::new(ground, alive, |i| {
            ground.normals[i as usize].dot(&normal) > gate
        });
        let piece = flat.largest_piece(&ground.facing);
        members.clone_from(&piece.sliding);
        part = Some(piece);
    }
    part
}
