//! From the modes of one cloud to its symmetries: the highest first, each verified on the surface, the
//! votes that it explains taken out before the next is looked at.

use rayon::prelude::*;

use crate::cluster::Cluster;
use crate::context::Context;
use crate::detect::{Cloud, DetectParams};
use crate::error::Result;
use crate::patch::grow::Ground;
use crate::patch::likeness::confusion;
use crate::patch::{Refusal, Symmetry, grow_patch};
use crate::sample::samples::Describer;
use crate::transform::space::Phi;
use crate::transform::{Class, TransformSpace};

/// What came of a cloud's modes.
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
    ground: &Ground<'_>,
    space: &TransformSpace,
    describer: &Describer<'_>,
    clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    known: &[Symmetry],
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    match cloud.class {
        Class::Mirror => mirrors(ground, space, clusters, cloud, known, params, ctx),
        _ => motions(
            ground, space, describer, &clusters, cloud, known, params, ctx,
        ),
    }
}

/// Grows all modes of motions, each for itself, and keeps the best of those that are one symmetry.
fn motions(
    ground: &Ground<'_>,
    space: &TransformSpace,
    describer: &Describer<'_>,
    clusters: &[Cluster],
    cloud: &Cloud,
    known: &[Symmetry],
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    let class = cloud.class;
    let worth = clusters.iter().filter(|c| c.votes.len() >= MIN_VOTES);
    let modes: Vec<&Cluster> = worth.take(MOTIONS).collect();
    let grown: Vec<_> = modes
        .par_iter()
        .map(|c| grow_patch(ground, &cloud.pairs, c, class, space, &params.patch))
        .collect();
    ctx.progress(1.0)?;
    let mut refused = Vec::new();
    let mut good: Vec<Symmetry> = Vec::new();
    for outcome in grown {
        match outcome {
            Ok(symmetry) => good.push(symmetry),
            Err(refusal) => refused.push(refusal),
        }
    }
    let quality = |s: &Symmetry| s.area_fraction * (1.0 - s.rms / params.patch.copy_tolerance);
    good.sort_by(|a, b| quality(b).total_cmp(&quality(a)));
    let near = 0.5 * params.cluster.bandwidth;
    let mut symmetries: Vec<Symmetry> = Vec::new();
    for s in good {
        let mut all = symmetries.iter().chain(known);
        if all.any(|k| is_same(k, &s, space, near)) {
            continue;
        }
        let confusion = confusion(ground, describer, &s);
        if confusion > params.patch.max_confusion {
            let near = ground.samples.list[s.pairs[0].sample as usize].position;
            refused.push(Refusal {
                class,
                q_from_p: s.q_from_p,
                height: s.height,
                reason: format!(
                    "partners look no more alike than many other places (confusion {confusion:.2})"
                ),
                near,
            });
            continue;
        }
        symmetries.push(Symmetry { confusion, ..s });
    }
    Ok(Found {
        symmetries,
        refused,
    })
}

/// Grows the modes of `cloud` one after the other, counting only votes that no symmetry found so far
/// explains; `known` are the symmetries of other clouds.
fn mirrors(
    ground: &Ground<'_>,
    space: &TransformSpace,
    mut clusters: Vec<Cluster>,
    cloud: &mut Cloud,
    known: &[Symmetry],
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Found> {
    let mut found: Vec<Symmetry> = Vec::new();
    let mut refused = Vec::new();
    let h = params.cluster.bandwidth;
    let mut tried: Vec<Phi> = Vec::new();
    for k in 0..MIRRORS {
        ctx.progress(k as f64 / MIRRORS as f64)?;
        let untried = |c: &&Cluster| tried.iter().all(|t| (t - c.mode).norm() > 0.5 * h);
        let Some(cluster) = clusters.iter().find(untried) else {
            break;
        };
        let highest = found.iter().map(|s| s.height).fold(0.0, f64::max);
        if cluster.votes.len() < MIN_VOTES || cluster.height < params.patch.min_height * highest {
            break;
        }
        tried.push(cluster.mode);
        let class = cloud.class;
        match grow_patch(ground, &cloud.pairs, cluster, class, space, &params.patch) {
            Err(refusal) => refused.push(refusal),
            Ok(symmetry) => {
                let mut all = found.iter().chain(known);
                let again = all.any(|s| is_same(s, &symmetry, space, 0.5 * h));
                let well = 0.5 * params.patch.tolerance;
                explain(cloud, &symmetry, ground.samples.list.len(), well);
                // From all starts again: a mode that stood in the shadow of this one shows now.
                clusters = cloud.votes.clusters(&params.cluster);
                if !again {
                    found.push(symmetry);
                }
            }
        }
    }
    Ok(Found {
        symmetries: found,
        refused,
    })
}

/// Whether two symmetries are one: T and its inverse are.
fn is_same(a: &Symmetry, b: &Symmetry, space: &TransformSpace, near: f64) -> bool {
    let (s, t) = (&a.q_from_p, &b.q_from_p);
    space.distance(s, t) < near || space.distance(s, &t.inverse()) < near
}

/// A vote is explained when both of its ends lie well within the symmetry's patch: what they look
/// like is accounted for, whatever mirror they vote for. Ends that the mirror only just reaches,
/// as on a round head turned a little on its body, keep their say.
fn explain(cloud: &mut Cloud, symmetry: &Symmetry, count: usize, well: f64) {
    let mut patch = vec![false; count];
    for pair in symmetry.pairs.iter().filter(|p| p.residual < well) {
        patch[pair.sample as usize] = true;
    }
    let pairs = &cloud.pairs;
    cloud
        .votes
        .explain_away(|i| patch[pairs[i].p as usize] && patch[pairs[i].q as usize]);
}
