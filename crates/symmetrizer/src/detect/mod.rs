//! Detection: samples, pairs, clusters and patches in a row, a cloud of votes for each class
//! (section 2).

mod again;
mod apart;
mod arrange;
mod cloud;
mod complete;
pub mod groups;
mod in_plane;
mod mirrors;
mod pass;
mod roundness;
mod search;
mod surroundings;
mod turns;
pub mod wanted;
mod whole;

pub use cloud::Cloud;
pub use groups::Group;
pub use wanted::{Want, Wanted};

use surroundings::Surroundings;

use crate::cluster::ClusterParams;
use crate::context::Context;
use crate::error::Result;
use crate::geom::Ambient;
use crate::pair::{Likes, PairParams, mirror_pairs};
use crate::patch::{Ground, PatchParams, Refusal, Symmetry};
use crate::sample::outline::sample_outline;
use crate::sample::samples::Describer;
use crate::sample::{Probe, SampleParams, Samples, probes, probes_of_outline, sample};
use crate::shape::fairing::faired;
use crate::shape::wall::Wall;
use crate::shape::{ClosestPoint, Surface};
use crate::slip::{Continuous, SlipParams, continuous};
use crate::transform::{Class, TransformSpace};

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
            ..self.whole_mirrors()
        }
    }

    /// The same with the patches of mirrors as far as the tolerance.
    pub fn whole_mirrors(mut self) -> Self {
        self.patch.end = f64::MAX;
        self
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
    /// Mirrors that were refused for nothing but doubt, not much of it: where a shape is bent more than one of them may be true.
    pub doubtful: Vec<Symmetry>,
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
    let fair = faired(surface);
    let describer = describer(surface, fair.as_ref());
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
    let describer = describer(surface, fair.as_ref());
    let samples = found.samples.clone();
    let given = Given {
        known: &found.clouds,
        ..Given::default()
    };
    find(&describer, samples, params, given, ctx)
}

/// What describes the samples of `surface`: noise as high as the triangles are long hides curvature, so that the `fair` shape
/// under it is looked at.
fn describer<'a>(surface: &'a Surface, fair: Option<&'a Surface>) -> Describer<'a> {
    let widening = if fair.is_some() { WIDENING } else { 1.0 };
    Describer::new(fair.unwrap_or(surface), widening)
}

/// Finds the symmetries of an outline, partial ones too: mirror lines, as mirrors at right angles to its plane, turns, shifts and
/// glides of the plane, and the turns of the whole, or of rings that have them by themselves, of any order.
///
/// # Errors
/// As [`detect`].
pub fn detect_in_plane(
    wall: &Wall,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detection> {
    let params = DetectParams {
        wanted: params.wanted.in_plane(),
        patch: params.patch.in_plane(),
        slip: None,
        ..params.clone()
    };
    let describer = Describer::of_outline(wall);
    let samples = ctx.stage("sample", |ctx| {
        sample_outline(&describer, wall, &params.sample, ctx)
    })?;
    let given = Given {
        wall: Some(wall),
        ..Given::default()
    };
    find(&describer, samples, &params, given, ctx)
}

/// What is known before the search.
#[derive(Default)]
struct Given<'a> {
    /// The wall that the surface is, in the plane.
    wall: Option<&'a Wall>,
    /// Clouds of votes of the same samples; that of mirrors is used again.
    known: &'a [Cloud],
}

/// What there is to be found among `samples` of the surface of `describer`.
fn find(
    describer: &Describer<'_>,
    samples: Samples,
    params: &DetectParams,
    given: Given<'_>,
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
    let surroundings = Surroundings {
        ground: &ground,
        space: &space,
        describer,
        continuous: &continuous,
        any_mirror: roundness::any_mirror(&ground),
        params,
    };
    let mut looked = looked(&surroundings, given.known, ctx)?;
    let groups = match given.wall {
        Some(wall) => in_plane::arrange(&surroundings, wall, &mut looked.symmetries),
        None => {
            numbered(&mut looked.symmetries);
            arrange::arrange(&surroundings, &looked.symmetries)
        }
    };
    let continuous = told(continuous.clone(), looked.round, &samples);
    Ok(Detection {
        clouds: looked.clouds,
        symmetries: looked.symmetries,
        doubtful: looked.doubtful,
        refused: looked.refused,
        groups,
        continuous,
        samples,
        space,
    })
}

/// The parts that slide along themselves which are worth telling: where the whole is `round`, that and what lies elsewhere.
fn told(
    mut parts: Vec<Continuous>,
    round: Option<Continuous>,
    samples: &Samples,
) -> Vec<Continuous> {
    if let Some(round) = round {
        let within = |i: &u32| round.samples.binary_search(i).is_ok();
        parts.retain(|c| !c.samples.iter().any(within));
        parts.insert(0, round);
    }
    parts.retain(|c| c.is_telling(samples));
    parts
}

/// Names symmetries by their number.
fn numbered(symmetries: &mut [Symmetry]) {
    for (id, s) in (0..).zip(symmetries) {
        s.id = id;
    }
}

/// What the search through all clouds of votes came to.
#[derive(Default)]
struct Looked {
    clouds: Vec<Cloud>,
    symmetries: Vec<Symmetry>,
    doubtful: Vec<Symmetry>,
    refused: Vec<Refusal>,
    /// The whole as a surface of revolution.
    round: Option<Continuous>,
}

/// Pairs, clusters and patches of each class that is wanted, and what follows from them; the votes of mirrors are those of a cloud that is
/// `known`.
fn looked(
    surroundings: &Surroundings<'_>,
    known: &[Cloud],
    ctx: &mut Context<'_>,
) -> Result<Looked> {
    let Surroundings {
        ground,
        space,
        params,
        ..
    } = surroundings;
    let samples = ground.samples;
    let classes = params.wanted.classes();
    let probes = ctx.stage("probe", |ctx| Ok(probed(surroundings, &classes, ctx)))?;
    let likes = ctx.stage("pair", |_| {
        Ok(Likes::new(&probes, samples.ambient, &params.pair))
    })?;
    let mut looked = Looked::default();
    let mut drifting = Vec::new();
    for &class in &classes {
        let known = known.iter().find(|c| c.class == Class::Mirror);
        let mut cloud = ctx.stage("pair", |ctx| {
            let pairs = match (class, known) {
                (Class::Mirror, Some(known)) => return Ok(known.anew()),
                (Class::Mirror, None) => mirror_pairs(samples, None, &params.pair, ctx)?,
                _ => likes.pairs(class, space, &params.pair, ctx)?,
            };
            Ok(Cloud::new(class, pairs, (space, samples.ambient)))
        })?;
        let clusters = ctx.stage("cluster", |_| Ok(cloud.clusters(&params.cluster)))?;
        let found = ctx.stage("patch", |ctx| {
            search::search(surroundings, clusters, &mut cloud, &looked.symmetries, ctx)
        })?;
        looked.symmetries.extend(found.symmetries);
        looked.doubtful.extend(found.doubtful);
        looked.refused.extend(found.refused);
        drifting.extend(found.drifting);
        looked.clouds.push(cloud);
    }
    if classes.iter().any(|&c| c != Class::Mirror) {
        ctx.stage("again", |ctx| {
            again::again(surroundings, &likes, &mut looked.symmetries, ctx)
        })?;
        ctx.stage("complete", |ctx| {
            complete::complete(surroundings, &mut looked.symmetries, &drifting, ctx)
        })?;
    }
    if samples.ambient == Ambient::Space {
        if params.wanted.continuous() && params.slip.is_some() {
            looked.round = ctx.stage("round", |_| {
                let Looked {
                    clouds,
                    symmetries,
                    refused,
                    ..
                } = &mut looked;
                Ok(whole::revolution(surroundings, clouds, symmetries, refused))
            })?;
        }
        ctx.stage("whole", |ctx| {
            whole::whole(surroundings, &looked.clouds, &mut looked.symmetries, ctx)
        })?;
    }
    Ok(looked)
}

/// The probes by which motions among the `classes` are looked for.
fn probed(surroundings: &Surroundings<'_>, classes: &[Class], ctx: &Context<'_>) -> Vec<Probe> {
    let samples = surroundings.ground.samples;
    match samples.ambient {
        _ if classes.iter().all(|&c| c == Class::Mirror) => Vec::new(),
        Ambient::Plane => probes_of_outline(samples),
        Ambient::Space => {
            let count = surroundings.params.sample.count;
            probes(
                surroundings.describer,
                samples,
                count,
                &mut ctx.rng("probe"),
            )
        }
    }
}
