//! From the modes of a cloud to its symmetries.

use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::cluster::{Cluster, Votes};
use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::mirrors::mirrors;
use crate::detect::surroundings::{SHUFFLES, Surroundings, as_good, is_same};
use crate::error::Result;
use crate::pair::{Pair, shuffled_motions};
use crate::patch::{Candidate, Refusal, Symmetry, grow_patch};
use crate::transform::space::Phi;
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
    let h = params.cluster.bandwidth;
    let chance = Chance::new(surroundings, cloud, &mut ctx.rng("chance"));
    let highest = |all: &[Symmetry]| all.iter().map(|k| k.height).fold(0.0, f64::max);
    let mut found = Found::default();
    let worth = clusters.iter().filter(|c| c.votes.len() >= MIN_VOTES);
    let modes: Vec<&Cluster> = worth.take(again.map_or(MOTIONS, |a| a.modes)).collect();
    let grown: Vec<_> = modes
        .par_iter()
        .map(|c| {
            let candidate = Candidate::of_cluster(ground.samples, &cloud.pairs, c, class, space);
            let Some(round) = again else {
                let hopeless = chance.hopeless(c, highest(known));
                return match hopeless {
                    Some(reason) => Err(candidate.refuse(candidate.t, reason, ground.samples)),
                    None => grow_patch(ground, describer, &candidate, &params.patch),
                };
            };
            grow_patch(
                ground,
                describer,
                &candidate.known(round.ground),
                &params.patch,
            )
        })
        .collect();
    ctx.progress(1.0)?;
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
    let near = 0.5 * h;
    let mut accepted = known.to_vec();
    for s in good {
        if accepted.iter().any(|k| is_same(k, &s, space, near)) {
            continue;
        }
        if again.is_none() && s.height < FAINT * highest(&accepted) {
            found.refused.push(*s.refuse(faint(), ground.samples));
            continue;
        }
        let by_chance = chance.share(&space.embed(&s.q_from_p), s.height);
        if by_chance > params.patch.max_chance {
            found
                .refused
                .push(*s.refuse(accidental(by_chance), ground.samples));
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

/// A mode whose votes come by chance to more than this many times what a symmetry's may is not grown: as its motion
/// settles it moves by a fraction of the kernel's radius.
const HOPELESS: f64 = 2.0;

/// What the votes of a cloud come to when their second places are shuffled.
struct Chance {
    shuffled: Vec<Votes>,
    /// The kernel's radius, fraction of L.
    h: f64,
    /// The largest share of a mode's height that may come by chance.
    most: f64,
}

impl Chance {
    fn new(surroundings: &Surroundings<'_>, cloud: &Cloud, rng: &mut Pcg64) -> Self {
        let Surroundings {
            ground,
            space,
            params,
            ..
        } = surroundings;
        let shuffle = |_| shuffled_motions(&cloud.pairs, cloud.class, ground.samples, rng);
        let shuffled: Vec<Vec<Pair>> = (0..SHUFFLES).map(shuffle).collect();
        let freedom = cloud.class.freedom(ground.samples.ambient);
        let votes = shuffled
            .par_iter()
            .map(|pairs| Votes::new(pairs, space, freedom));
        Self {
            shuffled: votes.collect(),
            h: params.cluster.bandwidth,
            most: params.patch.max_chance,
        }
    }

    /// The share of the `height` of a mode that comes by chance.
    fn share(&self, mode: &Phi, height: f64) -> f64 {
        let density: f64 = self.shuffled.iter().map(|v| v.density(mode, self.h)).sum();
        density / SHUFFLES as f64 / height
    }

    /// Why a mode need not be grown, where the highest symmetry known has that height.
    fn hopeless(&self, mode: &Cluster, highest: f64) -> Option<String> {
        if mode.height < FAINT * highest {
            return Some(faint());
        }
        let share = self.share(&mode.mode, mode.height);
        (share > HOPELESS * self.most).then(|| accidental(share))
    }
}

fn faint() -> String {
    "hardly any votes speak for it".to_owned()
}

fn accidental(by_chance: f64) -> String {
    format!("as many votes come by chance ({by_chance:.2} of its height)")
}
