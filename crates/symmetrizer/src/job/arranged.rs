//! Shapes whose symmetries are more than one mirror: groups, rows, copies, slides, and parts with symmetries of
//! their own.

use crate::context::Context;
use crate::detect::{Detection, detect_anew};
use crate::error::{Error, Result};
use crate::field::trust::{Trust, Verdict};
use crate::geom::median;
use crate::job::either::{Either, Made};
use crate::job::guard::mended;
use crate::job::merged::{Merged, merged, placed, undo, with_rotations};
use crate::job::{Bent, Detected, bent};
use crate::optimize::orbit::{Goal, orbits};
use crate::optimize::outcome::{mirrors, next_id};
use crate::optimize::plan::goals;
use crate::optimize::schedule::{Settings, prepared};
use crate::optimize::{Optimized, Outcome};
use crate::params::Params;
use crate::patch::Symmetry;
use crate::report::BendReport;
use crate::straighten::When;
use crate::transform::Kind;

/// What is to be done with the symmetries of a shape.
pub(super) enum Plan {
    /// Each symmetry is made exact where it holds.
    Orbits(Vec<Goal>),
    /// One mirror, straight or bent, may be made to hold for all of it.
    Mirror {
        /// Everything else, which may speak against it.
        details: Vec<Goal>,
        /// All of it, should there be no such mirror.
        all: Vec<Goal>,
    },
}

/// A mirror that is to be that of the whole holds for this share of each detail at the least; copies of an element that
/// stand any way, say, contradict it.
const DETAIL: f64 = 0.5;
/// Details on less than this share of the surface, in fewer places than these, come by chance on bland ground, and say nothing.
const TELLING: f64 = 0.1;
const SEVERAL: usize = 4;
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

/// Whether the mirror that holds for most of a shape, as far as the tolerance, does not hold for its `details`.
fn is_contradicted(detection: &Detection, details: &[Goal]) -> bool {
    let larger = |a: &&Symmetry, b: &&Symmetry| a.area_fraction.total_cmp(&b.area_fraction);
    let Some(main) = mirrors(detection).max_by(larger) else {
        return false;
    };
    let mut residuals: Vec<f64> = main.pairs.iter().map(|p| p.residual).collect();
    let near = (TYPICAL * median(&mut residuals).unwrap_or(0.0)).max(SMALL);
    let mut held = vec![false; detection.samples.list.len()];
    for pair in main.pairs.iter().filter(|p| p.residual <= near) {
        held[pair.sample as usize] = true;
    }
    is_outside(details, &held)
}

/// Whether most of any of the `details` that may say so lies where nothing is `held`.
fn is_outside(details: &[Goal], held: &[bool]) -> bool {
    details.iter().any(|goal| {
        let samples = || goal.places.iter().flatten();
        let inside = samples().filter(|&&i| held[i as usize]).count();
        let all = samples().count() as f64;
        let telling = all >= TELLING * held.len() as f64 || goal.places.len() >= SEVERAL;
        telling && (inside as f64) < DETAIL * all
    })
}

/// What came of a shape.
pub(super) struct Arranged {
    /// The work, what it tangled mended.
    pub done: Optimized,
    /// What was found of a bend, where one was looked for.
    pub bend: Option<BendReport>,
    /// What that is about.
    pub bent: Option<Bent>,
    /// Whether it is no more than a part of the shape that is symmetric.
    pub part: bool,
}

/// Makes the symmetries of `found` exact; its asymmetry is that `mean` (fraction of L), or it is `exact`. The mirrors of weaker
/// evidence that this takes up are added to it.
pub(super) fn symmetrized(
    found: &mut Detected,
    (mean, exact): (f64, bool),
    params: &Params,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Arranged> {
    check_only(found, settings)?;
    let meet = |found: &Detected, goals: &[Goal], ctx: &mut Context<'_>| {
        Ok(Arranged::plain(met(found, goals, params, settings, ctx)?))
    };
    let (details, all) = match plan(found, settings) {
        Plan::Orbits(goals) => return meet(found, &goals, ctx),
        Plan::Mirror { details, all } => (details, all),
    };
    if exact && mirrors(&found.detection).next().is_some() {
        let surface = &found.working.surface;
        let unmoved = Optimized::unmoved(surface, &found.detection, Outcome::Converged);
        return Ok(Arranged::plain(unmoved));
    }
    let near = ctx.stage("detect", |ctx| {
        let surface = &found.working.surface;
        detect_anew(surface, &found.detection, settings.detect, ctx)
    })?;
    if mirrors(&near).next().is_none() {
        return meet(found, &all, ctx);
    }
    let contradicted = is_contradicted(&near, &details);
    let near = known(found, near);
    let state = state(found, near);
    // A mirror that drifts over a plate passes by the elements on it as a straight one does.
    let denies = |trust: &Trust| contradicted && is_outside(&details, &trust.trusted);
    let straighten = &params.straighten;
    let mut looked = bent::unbend_unless(&denies, &state, mean, straighten, settings, ctx)?;
    let verdict = looked.report.as_ref().map(|bend| bend.verdict);
    let denied = looked
        .bent
        .as_ref()
        .is_some_and(|bent| denies(&bent.bend.trust));
    let made = match looked.done.take() {
        Some(done) => {
            let done = match straighten.share >= 1.0 {
                true => with_rotations(found, done, &details, &params.detect(), settings, ctx)?,
                false => done,
            };
            Made {
                done: mended(found, done, ctx)?,
                part: false,
            }
        }
        None if denied || contradicted && verdict != Some(Verdict::Accept) => {
            return meet(found, &all, ctx);
        }
        None => {
            let shape = Either {
                before: &state,
                asymmetry: mean,
                params: straighten,
                settings,
            };
            shape.made(&mut looked, ctx)?
        }
    };
    Ok(Arranged {
        done: made.done,
        bend: looked.report,
        bent: looked.bent,
        part: made.part,
    })
}

impl Arranged {
    /// Without a bend.
    pub fn plain(done: Optimized) -> Self {
        Self {
            done,
            bend: None,
            bent: None,
            part: false,
        }
    }
}

/// The mirrors `near`, those that `found` has under its ids; the others are added to it.
fn known(found: &mut Detected, mut near: Detection) -> Detection {
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
    near
}

/// Mirrors that are one, distance in the shape's transformation space, fraction of L.
const SAME: f64 = 0.03;

/// The shape with the mirrors `near`.
fn state(found: &Detected, near: Detection) -> Detected {
    Detected {
        working: found.working.clone(),
        wall: None,
        diagonal: found.diagonal,
        detection: near,
    }
}

/// Makes `goals` exact where they hold, those merged first that a bend keeps apart, if it is to go.
fn met(
    found: &Detected,
    goals: &[Goal],
    params: &Params,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    let surface = &found.working.surface;
    if goals.is_empty() {
        return Ok(Optimized::unmoved(
            surface,
            &found.detection,
            Outcome::NoSymmetry,
        ));
    }
    let merged = match params.straighten.when != When::Never && params.straighten.share >= 1.0 {
        true => merged(found, goals, &params.detect(), settings, ctx)?,
        false => Merged::nothing(found),
    };
    let drawn = |found: &Detected, goals: &[Goal], ctx: &mut Context<'_>| {
        ctx.stage("orbits", |ctx| {
            orbits(
                &found.working.surface,
                &found.detection,
                goals,
                settings,
                ctx,
            )
        })
    };
    let mut steps = merged.steps;
    if let Some(now) = &merged.now {
        let mut done = drawn(&now.found, &now.goals, ctx)?;
        done.energy = prepared(surface, settings)?.energy_at(&done.positions);
        let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
        if done.energy <= most && now.is_met(&done) {
            placed(&mut done.goals, &now.found, found);
            done.steps.splice(0..0, steps);
            done.next_id = merged.next_id;
            return mended(found, done, ctx);
        }
        steps.iter_mut().for_each(undo);
    }
    let mut done = drawn(found, goals, ctx)?;
    done.steps.splice(0..0, steps);
    done.next_id = merged.next_id;
    mended(found, done, ctx)
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
