//! Bends that show once another is undone: where the body of an animal is straight and symmetric, its head stands against it as
//! one piece.

use crate::context::Context;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::job::bent::undone_again;
use crate::job::guard::{mended, tangled};
use crate::job::otherwise::OTHERS;
use crate::job::spared::spared;
use crate::job::state::{State, detected, unbent};
use crate::optimize::Optimized;
use crate::optimize::schedule::{Settings, prepared};
use crate::straighten::StraightenParams;

/// Further bends at the most.
const MOST: usize = 8;
/// What is undone further leaves this share of the mean asymmetry at the most,
const GAIN: f64 = 0.93;
/// and each of several that come to that together this one: none of them does harm, but while the half of a shape is bent the
/// mean says little about the other.
const STEP: f64 = 1.0;
/// Much is left above this share of the mean asymmetry of the shape.
const MUCH: f64 = 0.15;
/// A further bend is undone from this share of the least degrees on that the first must have: what is left of a shape by then is small.
const LEAST: f64 = 0.5;

/// What came of further bends.
pub(super) struct Further {
    pub done: Optimized,
    /// Whether it is the whole that is symmetric.
    pub whole: bool,
    /// The mean asymmetry that is left, fraction of L.
    pub mean: f64,
}

/// What was `done` to a part of the shape `before`, all of whose bend was to go, and then to what is bent of the result. The energy is that beside `before`, whose mean
/// asymmetry is given (fraction of L).
///
/// # Errors
/// Those of detection, measuring and the deformation.
pub(super) fn further(
    (before, asymmetry): (&Detected, f64),
    mut done: Optimized,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Further> {
    let mut whole = false;
    let mut state = State::of(before, &done, settings, ctx)?;
    let mut least = state.mean;
    let smaller = StraightenParams {
        min_bend: LEAST * params.min_bend,
        ..params.clone()
    };
    let body = ctx.stage("prepare", |_| prepared(&before.working.surface, settings))?;
    let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
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
    Ok(Further {
        done,
        whole,
        mean: least,
    })
}

/// One further bend of a `state` of the shape `before` undone, what came of it, and whether the whole bend is sure.
fn tried(
    before: &Detected,
    state: &State,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, State, bool)>> {
    let Some((next, mut looked)) = unbent(state, params, settings, ctx)? else {
        return Ok(None);
    };
    let mut next = mended(before, next, ctx)?;
    if tangled(before, &next) {
        let mask = spared(&state.found, &next.positions);
        let within = Settings {
            region: Some(&mask),
            ..settings
        };
        let (found, mean) = (&state.found, state.mean);
        match undone_again(found, mean, &mut looked, params, within, ctx)? {
            Some(again) => next = mended(before, again, ctx)?,
            None => return Ok(None),
        }
        if tangled(before, &next) {
            return Ok(None);
        }
    }
    let after = State::of(before, &next, settings, ctx)?;
    let verdict = looked.report.map(|report| report.verdict);
    Ok(Some((next, after, verdict == Some(Verdict::Accept))))
}
