//! Bends that show once another is undone: where the body of an animal is straight and symmetric, its head stands against it as
//! one piece.

use crate::context::Context;
use crate::detect::detect;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::geom::{Point, PointIndex};
use crate::job::Detected;
use crate::job::bent::{Bent, Looked, unbend, unbend_part};
use crate::job::guard::{mended, tangled};
use crate::optimize::Optimized;
use crate::optimize::schedule::{Settings, prepared};
use crate::optimize::tangles::Tangles;
use crate::report::BendReport;
use crate::shape::{Surface, Working};
use crate::straighten::{StraightenParams, When};
use crate::transform::Plane;

/// Further bends at the most.
const MOST: usize = 5;
/// What is undone further leaves this share of the mean asymmetry at the most,
const GAIN: f64 = 0.93;
/// and each of several that come to that together this one: while the half of a shape is bent the mean says little about the other.
const STEP: f64 = 1.0;
/// Much is left above this share of the mean asymmetry of the shape.
const MUCH: f64 = 0.25;
/// A further bend is undone from this share of the least degrees on that the first must have: what is left of a shape by then is small.
const LEAST: f64 = 0.5;

/// What was `done` to a part of the shape `before`, and then to what is bent of the result; and whether that is the whole. The energy is that
/// beside `before`, whose mean asymmetry is given (fraction of L).
///
/// # Errors
/// Those of detection, measuring and the deformation.
pub(super) fn further(
    (before, asymmetry): (&Detected, f64),
    mut done: Optimized,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<(Optimized, bool)> {
    let mut whole = false;
    // What stays of the bend stands where it was found.
    if params.share < 1.0 {
        return Ok((done, whole));
    }
    let smaller = StraightenParams {
        min_bend: LEAST * params.min_bend,
        ..params.clone()
    };
    let body = ctx.stage("prepare", |_| prepared(&before.working.surface, settings))?;
    let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
    let mut state = State::of(before, &done, settings, ctx)?;
    let mut least = state.mean;
    let mut steps = done.steps.clone();
    let much = MUCH * state.mean.max(asymmetry);
    let mut turn = 0;
    for _ in 0..MOST {
        let tried = tried(before, &state, &smaller, settings, ctx)?;
        let gained = tried.filter(|(next, after, _)| {
            let energy = body.energy_at(&next.positions);
            after.mean <= STEP * state.mean && energy <= most
        });
        let Some((mut next, after, sure)) = gained else {
            // Where much is left other samples may show more of it.
            turn += 1;
            if turn > OTHERS || state.mean <= much {
                break;
            }
            let surface = state.found.working.surface.clone();
            state.found = ctx.drawn_anew(turn, |ctx| detected(before, surface, settings, ctx))?;
            continue;
        };
        steps.append(&mut next.steps);
        if after.mean <= GAIN * least {
            whole = sure;
            least = after.mean;
            done = Optimized {
                energy: body.energy_at(&next.positions),
                steps: steps.clone(),
                ..next
            };
        }
        state = after;
    }
    Ok((done, whole))
}

/// One further bend of a `state` of the shape `before` undone, what came of it, and whether the whole bend is sure.
fn tried(
    before: &Detected,
    state: &State,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, State, bool)>> {
    let Some((next, looked)) = once_more(state, params, settings, ctx)? else {
        return Ok(None);
    };
    let mut next = (mended(before, next, ctx)?, looked);
    if tangled(before, &next.0) {
        let mask = spared(&state.found, &next.0.positions);
        let within = Settings {
            region: Some(&mask),
            ..settings
        };
        let Some((again, looked)) = once_more(state, params, within, ctx)? else {
            return Ok(None);
        };
        next = (mended(before, again, ctx)?, looked);
        if tangled(before, &next.0) {
            return Ok(None);
        }
    }
    let (next, looked) = next;
    let after = State::of(before, &next, settings, ctx)?;
    let verdict = looked.report.map(|report| report.verdict);
    Ok(Some((next, after, verdict == Some(Verdict::Accept))))
}

/// Around what tangles a shape is spared to this distance, and wholly changed from twice that on; fraction of L.
const SPARED: f64 = 0.04;

/// For each vertex of a `state` how far it may be changed, 0 to 1, so that what tangles in `positions` is spared.
fn spared(state: &Detected, positions: &[Point]) -> Vec<f64> {
    let rest = &state.working.surface;
    let now = rest.with_positions(positions.to_vec());
    let faces = Tangles::of(rest, &rest.next_to_vertices()).faces(rest, &now);
    let corners = faces.iter().flat_map(|&f| rest.corners(f));
    let places: Vec<[f64; 3]> = corners.map(|x| x.coords.into()).collect();
    let index = PointIndex::new(&places);
    let share = |x: &Point| {
        let nearest = index.nearest(&x.coords.into());
        let distance = nearest.map_or(f64::INFINITY, |(_, square)| square.sqrt());
        (distance / SPARED - 1.0).clamp(0.0, 1.0)
    };
    rest.positions.iter().map(share).collect()
}

/// Other samples of a surface at the most.
const OTHERS: u64 = 2;

/// A bend of the shape `before`, with that mean asymmetry (fraction of L), which could not be had where it was `looked` for,
/// all of it or a part undone as other samples of the same surface show it: where a field grows wrong that hangs on where
/// samples happen to lie.
///
/// # Errors
/// Those of detection and the deformation.
pub(super) fn unbend_otherwise(
    (before, asymmetry): (&Detected, f64),
    looked: (&mut Option<BendReport>, &mut Option<Bent>),
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<Optimized>> {
    let (report, bent) = looked;
    let in_doubt = report
        .as_ref()
        .is_some_and(|r| r.verdict != Verdict::Accept);
    if !in_doubt || params.when == When::Never || before.wall.is_some() {
        return Ok(None);
    }
    for turn in 1..=OTHERS {
        let surface = before.working.surface.clone();
        let found = ctx.drawn_anew(turn, |ctx| detected(before, surface, settings, ctx))?;
        let state = State {
            found,
            mean: asymmetry,
        };
        if let Some((done, looked)) = once_more(&state, params, settings, ctx)? {
            (*report, *bent) = (looked.report, looked.bent);
            return Ok(Some(done));
        }
    }
    Ok(None)
}

/// A shape as it is by now.
struct State {
    found: Detected,
    /// Its mean asymmetry, fraction of L.
    mean: f64,
}

impl State {
    fn of(
        before: &Detected,
        done: &Optimized,
        settings: Settings<'_>,
        ctx: &mut Context<'_>,
    ) -> Result<Self> {
        let rest = &before.working.surface;
        let now = rest.with_positions(done.positions.clone());
        let found = detected(before, now, settings, ctx)?;
        let known: Vec<Plane> = done.plane.into_iter().collect();
        let measured = ctx.stage("measure", |ctx| found.asymmetry(&known, ctx))?;
        Ok(Self {
            mean: measured.mean / 100.0 * found.diagonal,
            found,
        })
    }
}

/// The mirrors of a state of the shape `before`.
fn detected(
    before: &Detected,
    surface: Surface,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    let detection = ctx.stage("detect", |ctx| detect(&surface, settings.detect, ctx))?;
    let working = Working {
        surface,
        ..before.working.clone()
    };
    Ok(Detected {
        detection,
        working,
        wall: None,
        diagonal: before.diagonal,
    })
}

/// The bend of a state undone, all of it or a part, with what was found of it.
fn once_more(
    state: &State,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, Looked)>> {
    let mut looked = unbend(&state.found, state.mean, params, settings, ctx)?;
    let done = match looked.done.take() {
        Some(done) => Some(done),
        None => unbend_part(
            &state.found,
            state.mean,
            (&mut looked.report, &mut looked.bent),
            params,
            settings,
            ctx,
        )?,
    };
    Ok(done.map(|done| (done, looked)))
}
