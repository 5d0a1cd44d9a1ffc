//! Detection: samples, pairs, clusters and patches in a row, a cloud of votes for each class
//! (section 2).

mod again;
mod apart;
mod arrange;
mod complete;
pub mod groups;
mod mirrors;
mod pass;
mod search;
mod surroundings;
mod turns;
pub mod wanted;

pub use groups::Group;
pub use wanted::{Want, Wanted};

use surroundings::Surroundings;

use crate::cluster::{ClusterParams, Votes};
use crate::context::Context;
use crate::error::Result;
use crate::pair::{Pair, PairParams, likes, mirror_pairs, rigid_pairs};
use crate::patch::{Candidate, Ground, PatchParams, Refusal, Settled, Symmetry, settled};
use crate::sample::outline::sample_outline;
use crate::sample::samples::Describer;
use crate::sample::{SampleParams, Samples, probes, sample};
use crate::shape::fairing::faired;
use crate::shape::wall::Wall;
use crate::shape::{ClosestPoint, Surface};
use crate::slip::{Continuous, SlipParams, continuous};
use crate::transform::{Class, Isometry, Kind, TransformSpace};

/// Parameters of detection, a section for each stage.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DetectParams {
    /// What is looked for.
    pub wanted: Wanted,
    /// Samples.
    pub sample: SampleParams,
    /// Pairs.
    pub pair: PairParams,
    /// Clusters.
    pub cluster: ClusterParams,
    /// Patches.
    pub patch: PatchParams,
    /// Continuous symmetries; not looked for without.
    pub slip: Option<SlipParams>,
}

impl Default for DetectParams {
    fn default() -> Self {
        Self {
            wanted: Wanted::default(),
            sample: SampleParams::default(),
            pair: PairParams::default(),
            cluster: ClusterParams::default(),
            patch: PatchParams::default(),
            slip: Some(SlipParams::default()),
        }
    }
}

impl DetectParams {
    /// The same for what is made exact: mirrors alone, if they are wanted, with patches as far as the tolerance, because what
    /// nearly is symmetric is to become so.
    pub fn mirrors_only(self) -> Self {
        let mut wanted = Wanted::mirrors();
        wanted.kinds.retain(|want| self.wanted.kinds.contains(want));
        Self {
            wanted,
            slip: None,
            patch: PatchParams {
                end: f64::MAX,
                ..self.patch
            },
            ..self
        }
    }
}

/// The votes of one class.
pub struct Cloud {
    /// The class.
    pub class: Class,
    /// The votes' pairs.
    pub pairs: Vec<Pair>,
    /// The votes, those explained by a symmetry with weight 0.
    pub votes: Votes,
    /// How its modes came to rest, as far as they were grown one after the other.
    pub rested: Vec<Rested>,
}

/// A mode that has come to rest on the surface, or not.
#[derive(Debug, Clone)]
pub struct Rested {
    /// Where it started from.
    start: Isometry,
    seeds: Vec<u32>,
    /// Where it came to rest, or why it did not.
    rest: std::result::Result<Settled, String>,
}

impl Cloud {
    /// Of `pairs`, none of them explained.
    fn new(class: Class, pairs: Vec<Pair>, space: &TransformSpace) -> Self {
        Self {
            class,
            votes: Votes::new(&pairs, space),
            pairs,
            rested: Vec::new(),
        }
    }

    /// The same with nothing explained.
    fn anew(&self, space: &TransformSpace) -> Self {
        Self {
            rested: self.rested.clone(),
            ..Self::new(self.class, self.pairs.clone(), space)
        }
    }

    /// Where a `candidate` among its modes comes to rest on `ground`: that is worked out once.
    fn rest(
        &mut self,
        ground: &Ground<'_>,
        candidate: &Candidate,
        params: &PatchParams,
    ) -> std::result::Result<Settled, String> {
        let mut known = self.rested.iter();
        if let Some(known) = known.find(|k| k.start == candidate.t && k.seeds == candidate.seeds) {
            return known.rest.clone();
        }
        let rest = settled(ground, candidate, params);
        self.rested.push(Rested {
            start: candidate.t,
            seeds: candidate.seeds.clone(),
            rest: rest.clone(),
        });
        rest
    }
}

/// What detection found on a surface.
pub struct Detection {
    /// The samples.
    pub samples: Samples,
    /// Transformation space of the surface.
    pub space: TransformSpace,
    /// The votes, a cloud for each class that was looked for.
    pub clouds: Vec<Cloud>,
    /// Verified symmetries, class by class, the highest first.
    pub symmetries: Vec<Symmetry>,
    /// Modes that were looked at and refused.
    pub refused: Vec<Refusal>,
    /// Which symmetries belong together, those of most of the surface first.
    pub groups: Vec<Group>,
    /// Parts that slide along themselves, the largest first.
    pub continuous: Vec<Continuous>,
}

/// On a surface that was noisy curvature is fitted over radii this much wider.
const WIDENING: f64 = 2.0;

/// Finds the symmetries of `surface`, partial ones too.
///
/// # Errors
/// [`crate::Error::Params`], [`crate::Error::Cancelled`].
pub fn detect(
    surface: &Surface,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    // Noise as high as the triangles are long hides curvature: the shape under it is looked at.
    let fair = faired(surface);
    let surface = fair.as_ref().unwrap_or(surface);
    let describer = Describer::new(surface, if fair.is_some() { WIDENING } else { 1.0 });
    let samples = ctx.stage("sample", |ctx| sample(&describer, &params.sample, ctx))?;
    find(&describer, samples, params, Given::default(), ctx)
}

/// Finds the symmetries of `surface` once more, with `params` that differ in what is wanted and in where patches end: its samples are those
/// that were `found` on it before, and so are the votes of mirrors, where there are any, and where they came to rest.
///
/// # Errors
/// As [`detect`].
pub fn detect_anew(
    surface: &Surface,
    found: &Detection,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    let fair = faired(surface);
    let surface = fair.as_ref().unwrap_or(surface);
    let describer = Describer::new(surface, if fair.is_some() { WIDENING } else { 1.0 });
    let samples = found.samples.clone();
    let given = Given {
        known: &found.clouds,
        ..Given::default()
    };
    find(&describer, samples, params, given, ctx)
}

/// Finds the mirror lines of an outline, partial ones too, as mirrors at right angles to its plane, and the turns of
/// the whole, or of rings that have them by themselves.
///
/// # Errors
/// As [`detect`].
pub fn detect_in_plane(
    wall: &Wall,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    let rotations = params.wanted.has(Kind::Rotation);
    let params = DetectParams {
        wanted: Wanted::mirrors(),
        slip: None,
        ..params.clone()
    };
    let describer = Describer::of_outline(wall);
    let samples = ctx.stage("sample", |ctx| {
        sample_outline(&describer, wall, &params.sample, ctx)
    })?;
    let given = Given {
        turned: rotations.then_some(wall),
        ..Given::default()
    };
    find(&describer, samples, &params, given, ctx)
}

/// What is known before the search.
#[derive(Default)]
struct Given<'a> {
    /// The wall that the surface is, where turns of the whole or of rings are looked for.
    turned: Option<&'a Wall>,
    /// Clouds of votes of the same samples; that of mirrors is used again.
    known: &'a [Cloud],
}

/// What there is to be found among `samples` of the surface of `describer`.
fn find(
    describer: &Describer<'_>,
    samples: Samples,
    params: &DetectParams,
    Given { turned, known }: Given<'_>,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    let surface = describer.surface;
    let space = TransformSpace::new(samples.list.iter().map(|s| (s.position, 1.0)));
    let closest = ClosestPoint::new(surface);
    let ground = Ground {
        surface,
        closest: &closest,
        samples: &samples,
    };
    let continuous = match &params.slip {
        Some(slip) => ctx.stage("slip", |_| Ok(continuous(&samples, slip)))?,
        None => Vec::new(),
    };
    let classes = params.wanted.classes();
    let probes = ctx.stage("probe", |ctx| {
        let rigid = classes.iter().any(|&c| c != Class::Mirror);
        let count = if rigid { params.sample.count } else { 0 };
        Ok(probes(describer, &samples, count, &mut ctx.rng("probe")))
    })?;
    let likes = ctx.stage("pair", |_| Ok(likes(&probes, &params.pair)))?;
    let surroundings = Surroundings {
        ground: &ground,
        space: &space,
        describer,
        continuous: &continuous,
        params,
    };
    let mut clouds = Vec::new();
    let mut symmetries: Vec<Symmetry> = Vec::new();
    let mut refused = Vec::new();
    let mut drifting = Vec::new();
    for class in classes {
        let known = known.iter().find(|c| c.class == Class::Mirror);
        let mut cloud = ctx.stage("pair", |ctx| {
            let pairs = match (class, known) {
                (Class::Mirror, Some(known)) => return Ok(known.anew(&space)),
                (Class::Mirror, None) => mirror_pairs(&samples, None, &params.pair, ctx)?,
                _ => rigid_pairs(&probes, &likes, class, &space, &params.pair, ctx)?,
            };
            Ok(Cloud::new(class, pairs, &space))
        })?;
        let clusters = ctx.stage("cluster", |_| Ok(cloud.votes.clusters(&params.cluster)))?;
        let found = ctx.stage("patch", |ctx| {
            search::search(&surroundings, clusters, &mut cloud, &symmetries, ctx)
        })?;
        symmetries.extend(found.symmetries);
        refused.extend(found.refused);
        drifting.extend(found.drifting);
        clouds.push(cloud);
    }
    if clouds.iter().any(|c| c.class != Class::Mirror) {
        ctx.stage("again", |ctx| {
            again::again(&surroundings, (&probes, &likes), &mut symmetries, ctx)
        })?;
        ctx.stage("complete", |ctx| {
            complete::complete(&surroundings, &mut symmetries, &drifting, ctx)
        })?;
    }
    let turns = turned.map_or_else(Vec::new, |wall| turns::turns(&ground, wall));
    let (lines, turns): (Vec<_>, Vec<_>) = turns.into_iter().map(|t| (t.line, t.symmetry)).unzip();
    let first = symmetries.len();
    symmetries.extend(turns);
    for (id, s) in (0..).zip(&mut symmetries) {
        s.id = id;
    }
    let continuous = continuous
        .iter()
        .filter(|c| c.is_telling(&samples))
        .cloned()
        .collect();
    let turns = symmetries[first..].iter().zip(&lines);
    let groups = match lines.is_empty() {
        true => arrange::arrange(&surroundings, &symmetries),
        false => turns
            .map(|(turn, line)| turns::group(turn, line.as_ref(), &symmetries))
            .collect(),
    };
    Ok(Detection {
        samples,
        space,
        clouds,
        symmetries,
        refused,
        groups,
        continuous,
    })
}
