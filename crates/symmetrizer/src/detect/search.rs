//! From the modes of a cloud to its symmetries.

use rayon::prelude::*;

use crate::cluster::{Cluster, Votes};
use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::mirrors::mirrors;
use crate::detect::surroundings::{SHUFFLES, Surroundings, as_good, is_same};
use crate::error::Result;
use crate::pair::shuffled_motions;
use crate::patch::{Candidate, Refusal, Symmetry, grow_patch};
use crate::transform::{Class, Isometry};

/// What came of a cloud's modes.
#[derive(Default)]
pub struct Found {
    /// Verified, the highest first.
    pub symmetries: Vec<Symmetry>,
    /// Looked at and refused.
    pub refused: Vec<Refusal>,
    /// Refused motions and their heights: some are mirrors that a bend has shifted.
    pub drifting: Vec<(Isometry, f64)>,
    /// Doubtful mirrors, which others may support.
    pub doubtful: Vec<Symmetry>,
}

/// Modes of motions grown at the most.
const MOTIONS: usize = 400;
/// Least height of a motion, as a share of the highest symmetry's; ours: copies of an element have .009 of
/// what the whole plate under them has.
const FAINT: f64 = 0.005;
/// Votes a mode must have left to be looked at.
pub const MIN_VOTES: usize = 6;

/// The symmetries among the modes of `cloud`; `known` are those of other clouds.
pub fn search(
    surroundings: &Surroundings<'_>,
    clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    known: &[Symmetry],
    ctx: &mut Context<'_>,
) -> Result<Found> {
    match cloud.class {
        Class::Mirror => mirrors(surroundings, clusters, cloud, ctx),
        _ => motions(surroundings, &clusters, cloud, known, None, ctx),
    }
}

/// A second round of looking.
pub struct Again<'a> {
    /// Modes grown at the most.
    pub modes: usize,
    /// The samples of parts that are known to come again.
    pub ground: &'a [bool],
}

/// Grows all modes of motions, each for itself, and keeps the best of those that are one symmetry.
pub fn motions(
    surroundings: &Surroundings<'_>,
    clusters: &[Cluster],
    cloud: &Cloud,
    known: &[Symmetry],
    again: Option<&Again<'_>>,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    let Surroundings {
        ground,
        space,
        describer,
        params,
        ..
    } = surroundings;
    let class = cloud.class;
    let worth = clusters.iter().filter(|c| c.votes.len() >= MIN_VOTES);
    let modes: Vec<&Cluster> = worth.take(again.map_or(MOTIONS, |a| a.modes)).collect();
    let grown: Vec<_> = modes
        .par_iter()
        .map(|c| {
            let candidate = Candidate::of_cluster(ground.samples, &cloud.pairs, c, class, space);
            let candidate = match again {
                Some(round) => candidate.known(round.ground),
                None => candidate,
            };
            grow_patch(ground, describer, &candidate, &params.patch)
        })
        .collect();
    ctx.progress(1.0)?;
    let mut rng = ctx.rng("chance");
    let mut found = Found::default();
    let mut good: Vec<Symmetry> = Vec::new();
    for outcome in grown {
        match outcome.and_then(|s| surroundings.more_than_sliding(s)) {
            Ok(symmetry) => good.push(symmetry),
            Err(refusal) => {
                found.drifting.push((refusal.q_from_p, refusal.height));
                found.refused.push(*refusal);
            }
        }
    }
    let quality = |s: &Symmetry| s.area_fraction * (1.0 - s.rms / params.patch.copy_tolerance);
    good.sort_by(|a, b| quality(b).total_cmp(&quality(a)));
    let h = params.cluster.bandwidth;
    let near = 0.5 * h;
    let chance: Vec<Votes> = (0..SHUFFLES)
        .map(|_| {
            let pairs = shuffled_motions(&cloud.pairs, class, ground.samples, &mut rng);
            Votes::new(&pairs, space)
        })
        .collect();
    let mut accepted = known.to_vec();
    for s in good {
        if accepted.iter().any(|k| is_same(k, &s, space, near)) {
            continue;
        }
        let highest = accepted.iter().map(|k| k.height).fold(0.0, f64::max);
        if again.is_none() && s.height < FAINT * highest {
            let reason = "hardly any votes speak for it".to_owned();
            found.refused.push(*s.refuse(reason, ground.samples));
            continue;
        }
        let mode = space.embed(&s.q_from_p);
        let by_chance: f64 = chance.iter().map(|v| v.density(&mode, h)).sum();
        let by_chance = by_chance / SHUFFLES as f64 / s.height;
        if by_chance > params.patch.max_chance {
            let reason = format!("as many votes come by chance ({by_chance:.2} of its height)");
            found.refused.push(*s.refuse(reason, ground.samples));
            continue;
        }
        match as_good(s, &accepted, ground) {
            Ok(s) => accepted.push(s),
            Err(refusal) => found.refused.push(*refusal),
        }
    }
    found.symmetries = accepted.split_off(known.len());
    Ok(found)
}
