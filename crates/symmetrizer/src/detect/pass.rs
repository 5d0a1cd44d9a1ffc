//! One pass over the modes of mirrors: the highest is grown, takes its votes with it, and the rest is
//! clustered anew.

use crate::cluster::{Cluster, ClusterParams};
use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::search::{Found, MIN_VOTES};
use crate::detect::surroundings::{Surroundings, as_good, is_same};
use crate::error::Result;
use crate::patch::ground::touch;
use crate::patch::{Candidate, Symmetry, grow_settled};
use crate::transform::space::Phi;
use crate::transform::{Class, Isometry};

/// Mirror modes grown at the most; later ones are far lower than any symmetry seen on the models.
const MIRRORS: usize = 12;

/// Which votes a symmetry takes with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Explain {
    /// Those between places of its patch, whatever mirror they vote for.
    Ground,
    /// Those for about itself.
    Mode,
}

/// A way to go through the modes.
pub struct Pass {
    /// Which votes a symmetry takes with it.
    pub explain: Explain,
    /// The kernel that modes are looked for in.
    pub kernel: ClusterParams,
    /// Height in this kernel of the highest symmetry found before.
    pub highest: f64,
}

impl Pass {
    /// Grows the modes of `cloud` one after the other, counting only votes that no symmetry found so
    /// far explains.
    pub fn take(
        mut self,
        surroundings: &Surroundings<'_>,
        mut clusters: Vec<Cluster>,
        cloud: &mut Cloud,
        found: &mut Found,
        ctx: &mut Context<'_>,
    ) -> Result<()> {
        let Surroundings {
            ground,
            space,
            describer,
            params,
            ..
        } = surroundings;
        let h = self.kernel.bandwidth;
        let near = 0.5 * params.cluster.bandwidth;
        let mut tried: Vec<Phi> = Vec::new();
        for k in 0..MIRRORS {
            ctx.progress(k as f64 / MIRRORS as f64)?;
            let untried = |c: &&Cluster| tried.iter().all(|t| (t - c.mode).norm() > near);
            let Some(cluster) = clusters.iter().find(untried) else {
                break;
            };
            let least = params.patch.min_height * self.highest;
            if cluster.votes.len() < MIN_VOTES || cluster.height < least {
                break;
            }
            tried.push(cluster.mode);
            let candidate =
                Candidate::of_cluster(ground.samples, &cloud.pairs, cluster, Class::Mirror, space);
            let rest = cloud.rest(ground, &candidate, &params.patch);
            let grown = grow_settled(ground, describer, &candidate, rest, &params.patch)
                .and_then(|s| surroundings.more_than_sliding(s))
                .and_then(|s| as_good(s, &found.symmetries, ground))
                .map(|s| surroundings.weigh_against_any(s))
                .map(|s| surroundings.weigh_against_chance(s, cluster, cloud, h, ctx));
            match grown {
                Err(refusal) => found.refused.push(*refusal),
                Ok(symmetry) if symmetry.doubt > params.patch.max_doubt => {
                    found.put_aside(symmetry, ground)
                }
                Ok(symmetry) => {
                    let t = &symmetry.q_from_p;
                    let again = |s: &Symmetry| is_same(s, &symmetry, space, near);
                    let again = found.symmetries.iter().any(again);
                    match self.explain {
                        Explain::Ground => explain_ground(cloud, surroundings, t),
                        Explain::Mode => explain_near(cloud, surroundings, t),
                    }
                    self.highest = self.highest.max(symmetry.height);
                    // From all starts again: a mode that stood in the shadow of this one shows now.
                    clusters = cloud.clusters(&self.kernel);
                    if !again {
                        found.symmetries.push(symmetry);
                    }
                }
            }
        }
        Ok(())
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
pub fn explain_near(cloud: &mut Cloud, surroundings: &Surroundings<'_>, t: &Isometry) {
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
