//! The mirrors among the modes of their cloud.

use crate::cluster::{Cluster, ClusterParams};
use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::apart::apart;
use crate::detect::search::{Found, MIN_VOTES};
use crate::detect::surroundings::{Surroundings, as_good, is_same};
use crate::error::Result;
use crate::patch::ground::touch;
use crate::patch::{Candidate, Ground, Refusal, Symmetry, grow_patch};
use crate::transform::space::Phi;
use crate::transform::{Class, Isometry};

/// Mirror modes grown at the most; later ones are far lower than any symmetry seen on the models.
const MIRRORS: usize = 12;
/// Kernel radius of the second pass, in units of that of the first: parts of a bend, whose mirrors are near
/// each other, are one mode in the wider.
const FINER: f64 = 0.7;
/// A doubtful mirror may be one of several that support each other up to this doubt; ours.
const MAX_SUPPORTED: f64 = 1.1;
/// Mirrors that support each other hold for at least this share of the surface; ours.
const MIN_SUPPORTED: f64 = 0.5;

/// Mirrors in two passes: first those of different ground, each taking the votes of its patch with it;
/// then those that share their ground with one found already and hold there as well as it does.
pub fn mirrors(
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
    if found.symmetries.is_empty() && found.doubtful.is_empty() {
        return Ok(found);
    }
    let explained = std::mem::replace(&mut cloud.votes, all);
    for k in 0..found.symmetries.len() {
        let t = found.symmetries[k].q_from_p;
        explain_near(cloud, surroundings, &t);
    }
    let bandwidth = FINER * surroundings.params.cluster.bandwidth;
    let clusters = cloud.votes.clusters(&ClusterParams { bandwidth });
    pass(
        surroundings,
        clusters,
        cloud,
        &mut found,
        Explain::Mode,
        ctx,
    )?;
    cloud.votes = explained;
    consistent(surroundings, &mut found);
    apart(surroundings, &mut found.symmetries);
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
        let candidate =
            Candidate::of_cluster(ground.samples, &cloud.pairs, cluster, Class::Mirror, space);
        let grown = grow_patch(ground, describer, &candidate, &params.patch)
            .and_then(|s| surroundings.more_than_sliding(s))
            .map(|s| surroundings.weigh_against_chance(s, cluster, cloud, ctx))
            .and_then(|s| as_good(s, &found.symmetries, ground));
        match grown {
            Err(refusal) => found.refused.push(*refusal),
            Ok(symmetry) if symmetry.doubt > params.patch.max_doubt => {
                found.put_aside(symmetry, ground)
            }
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

impl Found {
    /// Keeps a doubtful mirror for [`consistent`].
    fn put_aside(&mut self, symmetry: Symmetry, ground: &Ground<'_>) {
        let doubt = symmetry.doubt;
        let reason = format!(
            "doubtful ({doubt:.2}): partners look no more alike than many other places (confusion \
             {:.2}), its image passes by the surface, or as many votes come by chance",
            symmetry.confusion
        );
        if doubt <= MAX_SUPPORTED && symmetry.area_fraction >= MIN_SUPPORTED {
            self.doubtful.push(symmetry.clone());
        }
        self.refused.push(*symmetry.refuse(reason, ground.samples));
    }
}

/// Accepts doubtful mirrors that support each other: three of which one is the mirror image of the
/// second in the third, as the planes of a three-fold or higher axis are. Two planes at right angles
/// are no support: any roundish shape has some.
fn consistent(surroundings: &Surroundings<'_>, found: &mut Found) {
    let Surroundings {
        ground,
        space,
        params,
        ..
    } = surroundings;
    let near = 0.5 * params.cluster.bandwidth;
    let all: Vec<Symmetry> = found
        .symmetries
        .iter()
        .chain(&found.doubtful)
        .cloned()
        .collect();
    let third = |a: &Isometry, b: &Isometry| {
        let image = a.after(&b.after(a));
        let apart = space.distance(&image, a) > near && space.distance(&image, b) > near;
        apart
            && all
                .iter()
                .any(|c| space.distance(&image, &c.q_from_p) < near)
    };
    for s in std::mem::take(&mut found.doubtful) {
        let supported = all.iter().any(|b| third(&s.q_from_p, &b.q_from_p));
        let again = found.symmetries.iter().any(|k| is_same(k, &s, space, near));
        if supported
            && !again
            && let Ok(s) = as_good(s, &found.symmetries, ground)
        {
            found
                .refused
                .retain(|r: &Refusal| space.distance(&r.q_from_p, &s.q_from_p) > 1e-9);
            found.symmetries.push(s);
        }
    }
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
