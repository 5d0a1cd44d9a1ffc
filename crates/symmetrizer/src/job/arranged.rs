//! Shapes whose symmetries are more than one mirror: groups, rows, copies, slides, and parts with symmetries of
//! their own.

use crate::context::Context;
use crate::detect::{Detection, detect};
use crate::error::{Error, Result};
use crate::field::trust::Verdict;
use crate::geom::median;
use crate::job::{Bent, Detected, bent};
use crate::optimize::orbit::{Goal, orbits};
use crate::optimize::outcome::{mirrors, next_id};
use crate::optimize::plan::goals;
use crate::optimize::schedule::Settings;
use crate::optimize::{Optimized, Outcome, optimize};
use crate::report::BendReport;
use crate::shape::working::Working;
use crate::straighten::StraightenParams;
use crate::transform::Kind;

/// What is to be done with the symmetries of a shape.
pub(super) enum Plan {
    /// Each symmetry is made exact where it holds.
    Orbits(Vec<Goal>),
    /// One mirror, straight or bent, may be made to hold for all of it.
    Mirror {
        /// Everything else, which comes first.
        details: Vec<Goal>,
        /// All of it, should there be no such mirror.
        all: Vec<Goal>,
    },
}

/// A mirror that is to be that of the whole shape holds for this share of the surface: of less it would make one
/// part in the image of an unlike other.
const MAIN: f64 = 0.75;
/// Details that it holds for less of, copies of an element that stand any way, say, contradict it.
const DETAIL: f64 = 0.5;
/// It holds where residuals are no larger than this many times the median, or than this, fraction of L.
const TYPICAL: f64 = 6.0;
const SMALL: f64 = 0.003;

/// What to do for the symmetries in `found` of a shape of space.
pub(super) fn plan(found: &Detected, settings: Settings<'_>) -> Plan {
    let goals = goals(&found.detection, settings.optimize);
    let is_mirror = |goal: &Goal| {
        let mut mirrors = mirrors(&found.detection);
        mirrors.any(|s| goal.symmetries == [s.id])
    };
    let whole = goals.iter().any(|g| g.is_of_the_whole() && !is_mirror(g));
    let chosen = settings.optimize.only.is_some() || settings.optimize.max_symmetries.is_some();
    let mirrors = settings.detect.wanted.has(Kind::Mirror);
    if whole || chosen || !mirrors {
        return Plan::Orbits(goals);
    }
    let details = goals.iter().filter(|g| !is_mirror(g)).cloned();
    Plan::Mirror {
        details: details.collect(),
        all: goals,
    }
}

/// Whether one mirror holds for about the whole of a shape, its `details` among it.
fn has_main_mirror(detection: &Detection, details: &[Goal]) -> bool {
    mirrors(detection).any(|s| {
        let mut residuals: Vec<f64> = s.pairs.iter().map(|p| p.residual).collect();
        let near = (TYPICAL * median(&mut residuals).unwrap_or(0.0)).max(SMALL);
        let mut held = vec![false; detection.samples.list.len()];
        for pair in s.pairs.iter().filter(|p| p.residual <= near) {
            held[pair.sample as usize] = true;
        }
        let share = |samples: &mut dyn Iterator<Item = bool>| {
            let (held, all) = samples.fold((0.0, 0.0), |(h, n), s| (h + f64::from(s), n + 1.0));
            held / f64::max(all, 1.0)
        };
        let of_detail = |goal: &Goal| {
            let samples = goal.places.iter().flatten();
            share(&mut samples.map(|&i| held[i as usize]))
        };
        share(&mut held.iter().copied()) >= MAIN && details.iter().all(|g| of_detail(g) >= DETAIL)
    })
}

/// What came of a shape.
pub(super) struct Arranged {
    /// The work.
    pub done: Optimized,
    /// What was found of a bend, where one was looked for.
    pub bend: Option<BendReport>,
    /// What that is about.
    pub bent: Option<Bent>,
    /// The state whose mirrors were merged, where they were.
    pub merged: Option<Box<Detected>>,
}

/// Makes the symmetries of `found` exact; its asymmetry is that `mean` (fraction of L), or it is `exact`. The mirrors of weaker
/// evidence that this takes up are added to it.
pub(super) fn symmetrized(
    found: &mut Detected,
    (mean, exact): (f64, bool),
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Arranged> {
    check_only(found, settings)?;
    let (details, all) = match plan(found, settings) {
        Plan::Orbits(goals) => return Ok(Arranged::plain(met(found, &goals, settings, ctx)?)),
        Plan::Mirror { details, all } => (details, all),
    };
    let detailed = met(found, &details, settings, ctx)?;
    let unmoved = detailed.positions == found.working.surface.positions;
    if exact && unmoved && mirrors(&found.detection).next().is_some() {
        return Ok(Arranged::plain(Optimized {
            outcome: Outcome::Converged,
            ..detailed
        }));
    }
    let near = ctx.stage("detect", |ctx| nearly(found, settings, ctx))?;
    if mirrors(&near).next().is_none() {
        return Ok(Arranged::plain(detailed));
    }
    let state = state(found, near, &detailed);
    let looked = bent::unbend(&state, mean, params, settings, ctx)?;
    let trusted = looked
        .report
        .as_ref()
        .is_some_and(|bend| bend.verdict == Verdict::Accept);
    let whole = trusted || all.is_empty() || has_main_mirror(&state.detection, &details);
    let (mut done, merged) = match looked.done {
        Some(done) => (done, false),
        None if whole => (optimize(&state.working.surface, &state.detection, settings, ctx)?, true),
        None => {
            return Ok(Arranged {
                done: met(found, &all, settings, ctx)?,
                bend: looked.report,
                bent: looked.bent,
                merged: None,
            });
        }
    };
    done.steps.splice(0..0, detailed.steps);
    done.next_id = done.next_id.max(detailed.next_id);
    Ok(Arranged {
        done,
        bend: looked.report,
        bent: looked.bent,
        merged: merged.then(|| Box::new(state)),
    })
}

impl Arranged {
    /// Without a bend.
    pub fn plain(done: Optimized) -> Self {
        Self {
            done,
            bend: None,
            bent: None,
            merged: None,
        }
    }
}

/// The mirrors of the shape with patches as far as the tolerance: what nearly is symmetric is to become so. Those that
/// `found` has are known by their ids, the others are added to it.
fn nearly(found: &mut Detected, settings: Settings<'_>, ctx: &mut Context<'_>) -> Result<Detection> {
    let mut near = detect(&found.working.surface, settings.detect, ctx)?;
    let mut next = next_id(&found.detection);
    let known = &mut found.detection;
    let mut taken = Vec::new();
    for s in &mut near.symmetries {
        let like = mirrors(known).filter(|k| !taken.contains(&k.id));
        let like = like
            .map(|k| (known.space.distance(&k.q_from_p, &s.q_from_p), k.id))
            .filter(|(distance, _)| *distance < SAME)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        s.id = like.map_or(next, |(_, id)| id);
        taken.push(s.id);
        if like.is_none() {
            next += 1;
            known.symmetries.push(s.clone());
        }
    }
    Ok(near)
}

/// Mirrors that are one, distance in the shape's transformation space, fraction of L.
const SAME: f64 = 0.03;

/// The shape with its details made exact, and the mirrors `near` there.
fn state(found: &Detected, mut near: Detection, detailed: &Optimized) -> Detected {
    let working = &found.working;
    let surface = working.surface.with_positions(detailed.positions.clone());
    for s in &mut near.samples.list {
        s.position = surface.point(&s.at);
        s.normal = surface.normal(&s.at);
    }
    Detected {
        working: Working {
            surface,
            ..working.clone()
        },
        wall: None,
        diagonal: found.diagonal,
        detection: near,
    }
}

/// Makes `goals` exact where they hold.
fn met(
    found: &Detected,
    goals: &[Goal],
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    let surface = &found.working.surface;
    if goals.is_empty() {
        return Ok(Optimized::unmoved(surface, &found.detection, Outcome::NoSymmetry));
    }
    ctx.stage("orbits", |ctx| orbits(surface, &found.detection, goals, settings, ctx))
}

/// That the symmetries that were asked for by their ids are among those `found`.
///
/// # Errors
/// [`Error::Params`] with the first that is not.
fn check_only(found: &Detected, settings: Settings<'_>) -> Result<()> {
    let known: Vec<u32> = found.symmetries().iter().map(|s| s.id).collect();
    let asked = settings.optimize.only.iter().flatten();
    match asked.copied().find(|id| !known.contains(id)) {
        Some(id) => {
            let what = format!("there is no symmetry {id}; found were {known:?}");
            Err(Error::params("optimize.only", what))
        }
        None => Ok(()),
    }
}
