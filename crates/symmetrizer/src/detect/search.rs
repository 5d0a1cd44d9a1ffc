//! From the modes of one cloud to its symmetries: the highest first, each verified on the surface, the
//! votes that it explains taken out before the next is looked at.

use rayon::prelude::*;

use crate::cluster::{Cluster, Votes};
use crate::context::Context;
use crate::detect::{Cloud, DetectParams};
use crate::error::Result;
use crate::pair::{Pair, shuffled_mirrors, shuffled_motions};
use crate::patch::grow::{Ground, touch};
use crate::patch::{Refusal, Symmetry, grow_patch};
use crate::sample::samples::Describer;
use crate::slip::Continuous;
use crate::transform::space::Phi;
use crate::transform::{Class, Isometry, TransformSpace};

/// What came of a cloud's modes.
#[derive(Default)]
pub struct Found {
    /// Verified, the highest first.
    pub symmetries: Vec<Symmetry>,
    /// Looked at and refused.
    pub refused: Vec<Refusal>,
}

/// Mirror modes grown at the most; later ones are far lower than any symmetry seen on the models.
const MIRRORS: usize = 12;
/// Modes of motions grown at the most.
const MOTIONS: usize = 300;
/// Votes a mode must have left to be looked at.
const MIN_VOTES: usize = 8;

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
        _ => motions(surroundings, &clusters, cloud, known, ctx),
    }
}

/// Grows all modes of motions, each for itself, and keeps the best of those that are one symmetry.
fn motions(
    surroundings: &Surroundings<'_>,
    clusters: &[Cluster],
    cloud: &Cloud,
    known: &[Symmetry],
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
    let modes: Vec<&Cluster> = worth.take(MOTIONS).collect();
    let grown: Vec<_> = modes
        .par_iter()
        .map(|c| {
            grow_patch(
                ground,
                describer,
                &cloud.pairs,
                c,
                class,
                space,
                &params.patch,
            )
        })
        .collect();
    ctx.progress(1.0)?;
    let mut rng = ctx.rng("chance");
    let mut found = Found::default();
    let mut good: Vec<Symmetry> = Vec::new();
    for outcome in grown {
        match outcome.and_then(|s| surroundings.more_than_sliding(s)) {
            Ok(symmetry) => good.push(symmetry),
            Err(refusal) => found.refused.push(refusal),
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
        let mode = space.embed(&s.q_from_p);
        let by_chance: f64 = chance.iter().map(|v| v.density(&mode, h)).sum();
        let by_chance = by_chance / SHUFFLES as f64 / s.height;
        if by_chance > params.patch.max_chance {
            let reason = format!("as many votes come by chance ({by_chance:.2} of its height)");
            found.refused.push(s.refuse(reason, ground.samples));
            continue;
        }
        match as_good(s, &accepted, ground) {
            Ok(s) => accepted.push(s),
            Err(refusal) => found.refused.push(refusal),
        }
    }
    found.symmetries = accepted.split_off(known.len());
    Ok(found)
}

/// Mirrors in two passes: first those of different ground, each taking the votes of its patch with it;
/// then those that share their ground with one found already and hold there as well as it does.
fn mirrors(
    surroundings: &Surroundings<'_>,
    clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    let mut found = Found::default();
    let all = cloud.votes.clone();
    pass(
        surroundings,
        clusters,
        cloud,
        &mut found,
        Explain::Ground,
        ctx,
    )?;
    if found.symmetries.is_empty() {
        return Ok(found);
    }
    let explained = std::mem::replace(&mut cloud.votes, all);
    for k in 0..found.symmetries.len() {
        let t = found.symmetries[k].q_from_p;
        explain_near(cloud, surroundings, &t);
    }
    let clusters = cloud.votes.clusters(&surroundings.params.cluster);
    pass(
        surroundings,
        clusters,
        cloud,
        &mut found,
        Explain::Mode,
        ctx,
    )?;
    cloud.votes = explained;
    Ok(found)
}

/// Which votes a symmetry takes with it.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Explain {
    /// Those between places of its patch, whatever mirror they vote for.
    Ground,
    /// Those for about itself.
    Mode,
}

/// Grows the modes of `cloud` one after the other, counting only votes that no symmetry found so far
/// explains.
fn pass(
    surroundings: &Surroundings<'_>,
    mut clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    found: &mut Found,
    explain: Explain,
    ctx: &mut Context<'_>,
) -> Result<()> {
    let Surroundings {
        ground,
        space,
        describer,
        params,
        ..
    } = surroundings;
    let h = params.cluster.bandwidth;
    let mut tried: Vec<Phi> = Vec::new();
    for k in 0..MIRRORS {
        ctx.progress(k as f64 / MIRRORS as f64)?;
        let untried = |c: &&Cluster| tried.iter().all(|t| (t - c.mode).norm() > 0.5 * h);
        let Some(cluster) = clusters.iter().find(untried) else {
            break;
        };
        let highest = found
            .symmetries
            .iter()
            .map(|s| s.height)
            .fold(0.0, f64::max);
        if cluster.votes.len() < MIN_VOTES || cluster.height < params.patch.min_height * highest {
            break;
        }
        tried.push(cluster.mode);
        let grown = grow_patch(
            ground,
            describer,
            &cloud.pairs,
            cluster,
            Class::Mirror,
            space,
            &params.patch,
        )
        .and_then(|s| surroundings.more_than_sliding(s))
        .and_then(|s| surroundings.weigh_against_chance(s, cluster, cloud, ctx))
        .and_then(|s| as_good(s, &found.symmetries, ground));
        match grown {
            Err(refusal) => found.refused.push(refusal),
            Ok(symmetry) => {
                let again = found
                    .symmetries
                    .iter()
                    .any(|s| is_same(s, &symmetry, space, 0.5 * h));
                match explain {
                    Explain::Ground => explain_ground(cloud, surroundings, &symmetry.q_from_p),
                    Explain::Mode => explain_near(cloud, surroundings, &symmetry.q_from_p),
                }
                // From all starts again: a mode that stood in the shadow of this one shows now.
                clusters = cloud.votes.clusters(&params.cluster);
                if !again {
                    found.symmetries.push(symmetry);
                }
            }
        }
    }
    Ok(())
}

/// What symmetries are looked for on.
pub struct Surroundings<'a> {
    /// The surface and its samples.
    pub ground: &'a Ground<'a>,
    /// Transformation space of the surface.
    pub space: &'a TransformSpace,
    /// Makes samples of other places.
    pub describer: &'a Describer<'a>,
    /// Parts that slide along themselves.
    pub continuous: &'a [Continuous],
    /// The parameters.
    pub params: &'a DetectParams,
}

/// A part has an isometry by sliding when it comes to this of itself, rms fraction of L.
const IMPLIED: f64 = 0.03;

/// An isometry that sliding parts imply must hold for this share of what lies elsewhere, as a mug's
/// mirror does for its handle,
const MIN_ELSEWHERE: f64 = 0.5;
/// and this must be so much of the whole surface.
const MIN_LEFT: f64 = 0.03;

/// Shuffles of the votes that chance is estimated from.
const SHUFFLES: usize = 4;

impl Surroundings<'_> {
    /// Refuses a symmetry of which too little is left when parts that have it by sliding along
    /// themselves are not counted: a vase has all planes through its axis, which is one symmetry.
    pub fn more_than_sliding(&self, s: Symmetry) -> std::result::Result<Symmetry, Refusal> {
        let samples = self.ground.samples;
        let mut elsewhere = vec![true; samples.list.len()];
        let implied = self
            .continuous
            .iter()
            .filter(|c| c.implies(&s.q_from_p, samples, IMPLIED));
        for part in implied {
            part.samples
                .iter()
                .for_each(|&i| elsewhere[i as usize] = false);
        }
        let rest = elsewhere.iter().filter(|e| **e).count();
        if rest == elsewhere.len() {
            return Ok(s);
        }
        let own = s.ground(samples.list.len());
        let left = own
            .iter()
            .zip(&elsewhere)
            .filter(|(o, e)| **o && **e)
            .count();
        let holds = left as f64 >= MIN_ELSEWHERE * rest as f64
            && left as f64 >= MIN_LEFT * elsewhere.len() as f64;
        if holds {
            Ok(s)
        } else {
            Err(s.refuse("implied by a continuous symmetry".to_owned(), samples))
        }
    }

    /// Refuses a mirror whose cluster is hardly higher than chance, adding this to its doubt: the
    /// height that the same votes have there when their second places are shuffled.
    fn weigh_against_chance(
        &self,
        symmetry: Symmetry,
        cluster: &Cluster,
        cloud: &Cloud,
        ctx: &Context<'_>,
    ) -> std::result::Result<Symmetry, Refusal> {
        let mut rng = ctx.rng("chance");
        let weighed: Vec<Pair> = cloud
            .pairs
            .iter()
            .zip(cloud.votes.weights())
            .filter(|(_, w)| **w > 0.0)
            .map(|(v, _)| *v)
            .collect();
        let h = self.params.cluster.bandwidth;
        let chance: f64 = (0..SHUFFLES)
            .map(|_| {
                let other =
                    shuffled_mirrors(&weighed, self.ground.samples, &self.params.pair, &mut rng);
                let share = weighed.len() as f64 / other.len().max(1) as f64;
                share * Votes::new(&other, self.space).density(&cluster.mode, h)
            })
            .sum::<f64>()
            / SHUFFLES as f64;
        let chance = chance / cluster.height;
        let doubt = symmetry.doubt + chance;
        if doubt <= self.params.patch.max_doubt {
            return Ok(Symmetry { doubt, ..symmetry });
        }
        let reason = format!(
            "doubtful ({doubt:.2}): partners look no more alike than many other places (confusion \
             {:.2}), its image passes by the surface, or as many votes come by chance ({chance:.2})",
            symmetry.confusion
        );
        Err(symmetry.refuse(reason, self.ground.samples))
    }
}

/// Refuses what holds clearly worse than a symmetry found already does on the same ground: where an
/// exact symmetry is known, approximate ones are its echo.
pub fn as_good(
    s: Symmetry,
    found: &[Symmetry],
    ground: &Ground<'_>,
) -> std::result::Result<Symmetry, Refusal> {
    let count = ground.samples.list.len();
    let own = s.ground(count);
    let size = own.iter().filter(|m| **m).count();
    let echo = found.iter().find(|k| {
        let other = k.ground(count);
        let shared = own.iter().zip(&other).filter(|(a, b)| **a && **b).count();
        2 * shared > size && s.rms > WORSE * k.rms + SLACK
    });
    match echo {
        None => Ok(s),
        Some(k) => {
            let reason = format!(
                "holds worse than another on the same ground (rms {:.2} % of L, the other {:.2} %)",
                100.0 * s.rms,
                100.0 * k.rms
            );
            Err(s.refuse(reason, ground.samples))
        }
    }
}

/// Clearly worse is an rms residual this many times another's,
const WORSE: f64 = 1.7;
/// and by this much, fraction of L.
const SLACK: f64 = 5e-4;

/// Whether two symmetries are one: T and its inverse are.
pub fn is_same(a: &Symmetry, b: &Symmetry, space: &TransformSpace, near: f64) -> bool {
    let (s, t) = (&a.q_from_p, &b.q_from_p);
    space.distance(s, t) < near || space.distance(s, &t.inverse()) < near
}

/// A vote is explained when the symmetry holds well at both of its ends: what they look like is accounted
/// for, whatever mirror they vote for. Ends that the mirror only just reaches, as on a round head
/// turned a little on its body, keep their say.
fn explain_ground(cloud: &mut Cloud, surroundings: &Surroundings<'_>, t: &Isometry) {
    let patch = &surroundings.params.patch;
    let touched = touch(surroundings.ground, t, 0.5 * patch.tolerance, patch.min_cos);
    let pairs = &cloud.pairs;
    cloud.votes.explain_away(|i| {
        let (p, q) = (pairs[i].p as usize, pairs[i].q as usize);
        touched[p].is_some() && touched[q].is_some()
    });
}

/// Takes out the votes for about `t`.
fn explain_near(cloud: &mut Cloud, surroundings: &Surroundings<'_>, t: &Isometry) {
    let h = surroundings.params.cluster.bandwidth;
    let mode = surroundings.space.embed(t);
    let near: Vec<bool> = cloud
        .votes
        .points()
        .iter()
        .map(|x| (x - mode).norm() < h)
        .collect();
    cloud.votes.explain_away(|i| near[i]);
}
