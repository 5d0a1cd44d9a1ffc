//! Region growing: how far over the surface a cluster's isometry holds (section 2).

use crate::cluster::Cluster;
use crate::geom::Point;
use crate::pair::Pair;
use crate::patch::ground::Ground;
use crate::patch::judge::{Grown, judge};
use crate::patch::params::PatchParams;
use crate::patch::reach::Reach;
use crate::patch::settle::{NOWHERE, Settled, settled};
use crate::patch::symmetry::{Refusal, Symmetry};
use crate::sample::Samples;
use crate::sample::samples::Describer;
use crate::transform::{Class, Correspondence, Isometry, TransformSpace, optimal_mirror};

fn sorted(mut samples: Vec<u32>) -> Vec<u32> {
    samples.sort_unstable();
    samples.dedup();
    samples
}

/// An isometry that may be a symmetry, and the samples where it is thought to hold.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The isometry, to be refined.
    pub t: Isometry,
    /// Its class.
    pub class: Class,
    /// Height of the cluster it came from.
    pub height: f64,
    /// Samples to grow from, increasing.
    pub seeds: Vec<u32>,
    /// The samples it may grow over; all where there is none.
    pub within: Option<Vec<bool>>,
    /// Whether it is known that there is something: a mirror then draws in nothing further away, a motion
    /// needs less evidence of its own.
    pub near: bool,
}

impl Candidate {
    /// What the votes of `cluster` among `pairs` speak for.
    pub fn of_cluster(
        samples: &Samples,
        pairs: &[Pair],
        cluster: &Cluster,
        class: Class,
        space: &TransformSpace,
    ) -> Self {
        let votes = cluster.votes.iter().map(|&i| &pairs[i as usize]);
        // Either end of a mirror's vote lies in the patch; else the first does, the second in the image.
        let both = class == Class::Mirror;
        let seeds = votes.flat_map(|v| std::iter::once(v.p).chain(both.then_some(v.q)));
        Self {
            t: start(samples, pairs, cluster, class, space),
            class,
            height: cluster.height,
            seeds: sorted(seeds.collect()),
            within: None,
            near: false,
        }
    }

    /// The same on `ground` of which it is known that it comes again: its patch is a part of it, and needs
    /// less evidence.
    pub fn known(self, ground: &[bool]) -> Self {
        Self {
            within: Some(ground.to_vec()),
            near: true,
            ..self
        }
    }

    /// That it is no symmetry, with its isometry as it is then.
    pub fn refuse(&self, t: Isometry, reason: String, samples: &Samples) -> Box<Refusal> {
        let first = self.seeds.first();
        Box::new(Refusal {
            class: self.class,
            q_from_p: t,
            height: self.height,
            reason,
            near: first.map_or(Point::origin(), |&s| samples.list[s as usize].position),
        })
    }
}

/// Grows the patch of a candidate: from its seeds over neighbouring samples, as long as their images
/// lie on the surface; the isometry is refitted as the patch grows, in the end to the part of the patch
/// for which it holds best.
///
/// # Errors
/// [`Refusal`] where no symmetry worth the name comes out, with the reason.
pub fn grow_patch(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    candidate: &Candidate,
    params: &PatchParams,
) -> Result<Symmetry, Box<Refusal>> {
    let rest = settled(ground, candidate, params);
    grow_settled(ground, describer, candidate, rest, params)
}

/// [`grow_patch`] for a candidate that has come to `rest`.
///
/// # Errors
/// As [`grow_patch`].
pub fn grow_settled(
    ground: &Ground<'_>,
    describer: &Describer<'_>,
    candidate: &Candidate,
    rest: Result<Settled, String>,
    params: &PatchParams,
) -> Result<Symmetry, Box<Refusal>> {
    let class = candidate.class;
    let refuse = |t: Isometry, reason: String| candidate.refuse(t, reason, ground.samples);
    let tolerance = params.tolerance_of(class);
    let Settled { t, spread } = rest.map_err(|reason| refuse(candidate.t, reason))?;
    // A patch ends where the isometry no longer holds as it does where it holds best.
    let reached = (params.end_of(class) * spread).clamp(0.25 * tolerance, tolerance);
    let grown = Reach::new(ground, candidate, params.min_cos).grow(&t, reached, u32::MAX);
    if grown.is_empty() {
        return Err(refuse(t, NOWHERE.into()));
    }
    let grown = Grown {
        t,
        class,
        height: candidate.height,
        pairs: grown,
        reached,
        near: candidate.near,
    };
    judge(ground, describer, grown, params).map_err(|reason| refuse(t, reason))
}

/// The isometry that a cluster's votes agree on: appendix A for mirrors, else the mean of the cloud.
fn start(
    samples: &Samples,
    pairs: &[Pair],
    cluster: &Cluster,
    class: Class,
    space: &TransformSpace,
) -> Isometry {
    let mean = || space.nearest(&cluster.mode, class.is_improper());
    if class != Class::Mirror {
        return mean();
    }
    let votes: Vec<Correspondence> = cluster
        .votes
        .iter()
        .map(|&i| &pairs[i as usize])
        .map(|v| Correspondence {
            p: samples.list[v.p as usize].position,
            q: samples.list[v.q as usize].position,
            weight: v.weight,
        })
        .collect();
    optimal_mirror(&votes, samples.ambient).map_or_else(mean, |fit| Isometry::mirror(&fit.plane))
}
