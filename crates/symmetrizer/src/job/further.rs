//! Bends that show once another is undone: where the body of an animal is straight and symmetric, its head stands against it as
//! one piece.

use crate::context::Context;
use crate::detect::detect;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::job::bent::{Bent, Looked, unbend, unbend_part};
use crate::job::guard::mended;
use crate::optimize::Optimized;
use crate::optimize::schedule::{Settings, prepared};
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
/// A further bend is undone from this share of the least degrees on that the first must have: what is left of a shape by then is small.
const LEAST: f64 = 0.5;

/// What was `done` to a part of the shape `before`, and then to what is bent of the result; and whether that is the whole. The energy is that
/// beside `before`.
///
/// # Errors
/// Those of detection, measuring and the deformation.
pub(super) fn further(
    before: &Detected,
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
    for _ in 0..MOST {
        let Some((next, looked)) = once_more(&state, &smaller, settings, ctx)? else {
            break;
        };
        let mut next = mended(before, next, ctx)?;
        next.energy = body.energy_at(&next.positions);
        let after = State::of(before, &next, settings, ctx)?;
        if after.mean > STEP * state.mean || next.energy > most {
            break;
        }
        steps.append(&mut next.steps);
        if after.mean <= GAIN * least {
            let verdict = looked.report.map(|report| report.verdict);
            whole = verdict == Some(Verdict::Accept);
            least = after.mean;
            done = Optimized {
                steps: steps.clone(),
                ..next
            };
        }
        state = after;
    }
    Ok((done, whole))
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
    let in_doubt = report.as_ref().is_some_and(|r| r.verdict != Verdict::Accept);
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
