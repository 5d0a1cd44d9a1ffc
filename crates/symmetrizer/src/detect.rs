//! Detection: samples, pairs, clusters and patches in a row (section 2).

use crate::cluster::{Cluster, ClusterParams, Votes};
use crate::context::Context;
use crate::error::Result;
use crate::pair::{Pair, PairParams, mirror_pairs};
use crate::patch::grow::Ground;
use crate::patch::{PatchParams, Refusal, Symmetry, grow_patch};
use crate::sample::{SampleParams, Samples, sample};
use crate::shape::{ClosestPoint, Surface};
use crate::transform::space::Phi;
use crate::transform::{Isometry, TransformSpace};

/// Parameters of detection, a section for each stage.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DetectParams {
    /// Samples.
    pub sample: SampleParams,
    /// Pairs.
    pub pair: PairParams,
    /// Clusters.
    pub cluster: ClusterParams,
    /// Patches.
    pub patch: PatchParams,
}

/// What detection found on a surface.
pub struct Detection {
    /// The samples.
    pub samples: Samples,
    /// The votes' pairs.
    pub pairs: Vec<Pair>,
    /// Transformation space of the surface.
    pub space: TransformSpace,
    /// The votes, those explained by a symmetry with weight 0.
    pub votes: Votes,
    /// Verified symmetries, the highest first.
    pub symmetries: Vec<Symmetry>,
    /// Modes that were looked at and refused.
    pub refused: Vec<Refusal>,
}

/// Modes grown at the most; later ones are far lower than any symmetry seen on the models.
const MODES: usize = 12;

/// Finds the mirror symmetries of `surface`, partial ones too.
///
/// # Errors
/// [`crate::Error::Params`], [`crate::Error::Cancelled`].
pub fn detect(
    surface: &Surface,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    let samples = ctx.stage("sample", |ctx| sample(surface, &params.sample, ctx))?;
    let pairs = ctx.stage("pair", |ctx| mirror_pairs(&samples, &params.pair, ctx))?;
    let space = TransformSpace::new(samples.list.iter().map(|s| (s.position, 1.0)));
    let mut votes = Votes::new(&pairs, &space);
    let clusters = ctx.stage("cluster", |_| Ok(votes.clusters(&params.cluster)))?;
    let (symmetries, refused) = ctx.stage("patch", |ctx| {
        let closest = ClosestPoint::new(surface);
        let ground = Ground {
            surface,
            closest: &closest,
            samples: &samples,
        };
        verify(&ground, &pairs, clusters, &mut votes, &space, params, ctx)
    })?;
    Ok(Detection {
        samples,
        pairs,
        space,
        votes,
        symmetries,
        refused,
    })
}

/// Grows the modes one after the other, highest first, counting only votes that no symmetry found
/// so far explains.
fn verify(
    ground: &Ground<'_>,
    pairs: &[Pair],
    mut clusters: Vec<Cluster>,
    votes: &mut Votes,
    space: &TransformSpace,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<(Vec<Symmetry>, Vec<Refusal>)> {
    let mut found: Vec<Symmetry> = Vec::new();
    let mut refused = Vec::new();
    let h = params.cluster.bandwidth;
    let mut tried: Vec<Phi> = Vec::new();
    for k in 0..MODES {
        ctx.progress(k as f64 / MODES as f64)?;
        let untried = |c: &&Cluster| tried.iter().all(|t| (t - c.mode).norm() > 0.5 * h);
        let Some(cluster) = clusters.iter().find(untried) else {
            break;
        };
        let highest = found
            .iter()
            .map(|s: &Symmetry| s.height)
            .fold(0.0, f64::max);
        if cluster.votes.len() < MIN_VOTES || cluster.height < params.patch.min_height * highest {
            break;
        }
        tried.push(cluster.mode);
        match grow_patch(ground, pairs, cluster, &params.patch) {
            Err(refusal) => refused.push(refusal),
            Ok(symmetry) => {
                let mirror = Isometry::mirror(&symmetry.plane);
                let known = found
                    .iter()
                    .any(|s| space.distance(&Isometry::mirror(&s.plane), &mirror) < 0.5 * h);
                let well = 0.5 * params.patch.tolerance;
                explain(votes, pairs, &symmetry, ground.samples.list.len(), well);
                // From all starts again: a mode that stood in the shadow of this one shows now.
                clusters = votes.clusters(&params.cluster);
                if !known {
                    found.push(Symmetry {
                        id: found.len() as u32,
                        ..symmetry
                    });
                }
            }
        }
    }
    Ok((found, refused))
}

/// Votes a mode must have left to be looked at.
const MIN_VOTES: usize = 8;

/// A vote is explained when both of its ends lie well within the symmetry's patch: what they look
/// like is accounted for, whatever mirror they vote for. Ends that the mirror only just reaches,
/// as on a round head turned a little on its body, keep their say.
fn explain(votes: &mut Votes, pairs: &[Pair], symmetry: &Symmetry, count: usize, well: f64) {
    let mut member = vec![false; count];
    for pair in symmetry.pairs.iter().filter(|p| p.residual < well) {
        member[pair.sample as usize] = true;
    }
    votes.explain_away(|i| member[pairs[i].p as usize] && member[pairs[i].q as usize]);
}
