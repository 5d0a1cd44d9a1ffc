//! Rotations of parts that a bend keeps apart, merged: what is one group of the whole shape once it is straight is made so.

use crate::context::Context;
use crate::detect::DetectParams;
use crate::error::Result;
use crate::geom::{Point, PointIndex};
use crate::job::Detected;
use crate::job::state::detected;
use crate::optimize::orbit::{Goal, jointed, merge, orbits};
use crate::optimize::outcome::next_id;
use crate::optimize::plan::goals;
use crate::optimize::schedule::{Settings, moving, prepared};
use crate::optimize::{Optimized, Step};
use crate::patch::carry_ids;
use crate::patch::ground::Ground;
use crate::shape::{ClosestPoint, Surface};

/// A merge is kept where the group then holds for this share of what both held for.
const KEPT: f64 = 0.85;
/// Goals that have less than this share of the smaller one in common lie apart.
const APART: f64 = 0.1;
/// Merges at the most.
const MOST: usize = 4;

/// What came of merging rotations.
pub(super) struct Merged {
    /// The shape as it is now; none where it is as it was.
    pub now: Option<Now>,
    /// What was done, and undone.
    pub steps: Vec<Step>,
    /// The first id that no symmetry had.
    pub next_id: u32,
}

/// A shape some of whose rotations were merged.
pub(super) struct Now {
    /// It and its symmetries, which have the ids of those of before where they are the same.
    pub found: Detected,
    /// What is to be made exact of it, what was merged last first.
    pub goals: Vec<Goal>,
}

/// Merges rotations among the `goals` for what was `found`, as long as that makes one of two; looks for all symmetries as `params` say
/// after each.
///
/// # Errors
/// Those of detection and the deformation.
pub(super) fn merged(
    found: &Detected,
    goals: &[Goal],
    params: &DetectParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Merged> {
    let mut merged = Merged::nothing(found);
    for _ in 0..MOST {
        let now = merged.now.as_ref();
        let (now, wanted) = now.map_or((found, goals), |now| (&now.found, now.goals.as_slice()));
        let Some((step, next)) = once(now, wanted, &mut merged.next_id, params, settings, ctx)?
        else {
            break;
        };
        merged.steps.push(step);
        let Some(next) = next else {
            break;
        };
        merged.now = Some(next);
    }
    Ok(merged)
}

impl Merged {
    /// Nothing is merged of what was `found`.
    pub fn nothing(found: &Detected) -> Self {
        Self {
            now: None,
            steps: Vec::new(),
            next_id: next_id(&found.detection),
        }
    }
}

impl Now {
    /// Whether what was merged is exact in what was `done`.
    pub fn is_met(&self, done: &Optimized) -> bool {
        let met = |goal: &Goal| goal.symmetries == self.goals[0].symmetries;
        done.goals.iter().any(met)
    }
}

/// Says of a merge that it was undone.
pub(super) fn undo(step: &mut Step) {
    if let Step::Merge { kept, .. } = step {
        *kept = false;
    }
}

/// One merge, and what there is then if it is kept; `None` where nothing is to be merged. New ids go on from `next`.
fn once(
    found: &Detected,
    wanted: &[Goal],
    next: &mut u32,
    params: &DetectParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Step, Option<Now>)>> {
    let surface = &found.working.surface;
    let samples = &found.detection.samples;
    let Some(([a, b], parts)) = jointed(wanted, samples, settings.optimize) else {
        return Ok(None);
    };
    let mut body = ctx.stage("prepare", |_| prepared(surface, settings))?;
    let mut moving = moving(surface, &found.detection, settings, body.as_mut());
    let joint = ctx.stage("merge", |ctx| {
        merge(&mut moving, &parts, settings.optimize, ctx)
    })?;
    if joint.steps == 0 {
        return Ok(None);
    }
    let now = surface.with_positions(body.positions());
    let state = later(found, now, next, params, settings, ctx)?;
    let common = on(&state, |ground| parts.goal(&joint.axis, None, ground));
    let covered = common.area_fraction;
    let kept = !joint.limited && covered >= KEPT * (a.area_fraction + b.area_fraction);
    let first = |goal: &Goal| goal.symmetries.first().copied().unwrap_or_default();
    let step = Step::Merge {
        symmetries: [a, b].map(first),
        steps: joint.steps,
        distance: joint.distance,
        coverage: [a.area_fraction.max(b.area_fraction), covered],
        energy: joint.energy,
        kept,
    };
    let mut goals = beside(common, goals(&state.detection, settings.optimize));
    goals.truncate(settings.optimize.max_symmetries.unwrap_or(usize::MAX));
    let now = Now {
        found: state,
        goals,
    };
    Ok(Some((step, kept.then_some(now))))
}

/// What was `done` to a bent shape that was `found`, two of whose `details` are one group of rotations now that it is straight: that group
/// made exact, with the mirror that the shape has by then. As it was where there is none.
///
/// # Errors
/// Those of detection and the deformation.
pub(super) fn with_rotations(
    found: &Detected,
    done: Optimized,
    details: &[Goal],
    params: &DetectParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    let (rest, samples) = (&found.working.surface, &found.detection.samples);
    let Some(([a, b], parts)) = jointed(details, samples, settings.optimize) else {
        return Ok(done);
    };
    let mut next = done.next_id;
    let now = rest.with_positions(done.positions.clone());
    let places = parts
        .at()
        .map(|at| at.iter().map(|x| now.point(x)).collect());
    let axis = parts.joint(&places).common();
    let state = later(found, now, &mut next, params, settings, ctx)?;
    let group = on(&state, |ground| {
        parts.goal(&axis, done.plane.as_ref(), ground)
    });
    if group.area_fraction < KEPT * (a.area_fraction + b.area_fraction) {
        return Ok(done);
    }
    let mut more = ctx.stage("orbits", |ctx| {
        let surface = &state.working.surface;
        orbits(surface, &state.detection, &[group], settings, ctx)
    })?;
    more.energy = prepared(rest, settings)?.energy_at(&more.positions);
    let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
    if more.goals.is_empty() || more.energy > most {
        return Ok(done);
    }
    placed(&mut more.goals, &state, found);
    more.steps.splice(0..0, done.steps);
    Ok(Optimized {
        plane: done.plane,
        next_id: next,
        ..more
    })
}

/// The shape `found` with another `surface`, and all its symmetries: those of before have the ids that they had, the others such from `next`
/// on.
fn later(
    found: &Detected,
    surface: Surface,
    next: &mut u32,
    params: &DetectParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    let whole = Settings {
        detect: params,
        ..settings
    };
    let mut state = detected(found, surface, whole, ctx)?;
    *next = renamed(found, &mut state, *next);
    Ok(state)
}

/// What `work` makes of the ground of a state.
fn on(state: &Detected, work: impl FnOnce(&Ground<'_>) -> Goal) -> Goal {
    let surface = &state.working.surface;
    work(&Ground {
        surface,
        closest: &ClosestPoint::new(surface),
        samples: &state.detection.samples,
    })
}

/// `goals` for a later state of a shape, `now`, with their places among the samples of the shape that was `found`.
pub(super) fn placed(goals: &mut [Goal], now: &Detected, found: &Detected) {
    let rest = &found.working.surface;
    let samples = &now.detection.samples.list;
    let places: Vec<[f64; 3]> = samples
        .iter()
        .map(|s| rest.point(&s.at).coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let nearest = |x: &Point| index.nearest(&x.coords.into()).map(|(j, _)| j);
    let own = found.detection.samples.list.iter();
    let own: Vec<Option<u32>> = own.map(|s| nearest(&s.position)).collect();
    for place in goals.iter_mut().flat_map(|goal| &mut goal.places) {
        let held = |j: &Option<u32>| j.is_some_and(|j| place.binary_search(&j).is_ok());
        let own = (0..).zip(&own).filter(|(_, j)| held(j));
        *place = own.map(|(i, _)| i).collect();
    }
}

/// The `common` goal and those of the `others` that lie elsewhere.
fn beside(common: Goal, others: Vec<Goal>) -> Vec<Goal> {
    let elsewhere = others
        .into_iter()
        .filter(|goal| goal.shared(&common) < APART);
    let elsewhere: Vec<Goal> = elsewhere.collect();
    std::iter::once(common).chain(elsewhere).collect()
}

/// Gives the symmetries of a later `state` of the shape that was `found`, and its groups, the ids that they had, and ids from `next` on
/// to the others; returns the next free one.
fn renamed(found: &Detected, state: &mut Detected, next: u32) -> u32 {
    let new = &mut state.detection;
    let old: Vec<u32> = new.symmetries.iter().map(|s| s.id).collect();
    let known = &found.detection;
    let next = carry_ids(
        &found.working.surface,
        (&known.samples, &known.symmetries),
        (&new.samples, &mut new.symmetries),
        next,
    );
    let named = new.symmetries.iter().map(|s| s.id);
    let names: std::collections::BTreeMap<u32, u32> = old.into_iter().zip(named).collect();
    for id in new.groups.iter_mut().flat_map(|g| &mut g.symmetries) {
        *id = names[id];
    }
    next
}
