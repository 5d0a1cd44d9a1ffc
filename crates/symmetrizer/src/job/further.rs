//! Bends that show once another is undone: where the body of an animal is straight and symmetric, its head stands against it as
//! one piece.

use crate::context::Context;
use crate::detect::detect;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::job::bent::{unbend, unbend_part};
use crate::job::guard::mended;
use crate::optimize::Optimized;
use crate::optimize::schedule::{Settings, prepared};
use crate::report::BendReport;
use crate::shape::Working;
use crate::straighten::StraightenParams;
use crate::transform::Plane;

/// Further bends at the most.
const MOST: usize = 3;
/// What is undone further leaves this share of the mean asymmetry at the most.
const GAIN: f64 = 0.93;
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
    let body = ctx.stage("prepare", |_| prepared(&before.working.surface, settings))?;
    let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
    let mut state = State::of(before, &done, settings, ctx)?;
    for _ in 0..MOST {
        let Some((next, report)) = once_more(&state, params, settings, ctx)? else {
            break;
        };
        let mut next = mended(before, next, ctx)?;
        next.energy = body.energy_at(&next.positions);
        let after = State::of(before, &next, settings, ctx)?;
        if after.mean > GAIN * state.mean || next.energy > most {
            break;
        }
        whole = report.verdict == Verdict::Accept;
        done.steps.append(&mut next.steps);
        done = Optimized {
            steps: done.steps,
            ..next
        };
        state = after;
    }
    Ok((done, whole))
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
        let working = Working {
            surface: before
                .working
                .surface
                .with_positions(done.positions.clone()),
            ..before.working.clone()
        };
        let detection = ctx.stage("detect", |ctx| {
            detect(&working.surface, settings.detect, ctx)
        })?;
        let found = Detected {
            detection,
            working,
            wall: None,
            diagonal: before.diagonal,
        };
        let known: Vec<Plane> = done.plane.into_iter().collect();
        let measured = ctx.stage("measure", |ctx| found.asymmetry(&known, ctx))?;
        Ok(Self {
            mean: measured.mean / 100.0 * found.diagonal,
            found,
        })
    }
}

/// The bend of a state undone, all of it or a part, with what was found of it.
fn once_more(
    state: &State,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, BendReport)>> {
    let params = &StraightenParams {
        min_bend: LEAST * params.min_bend,
        ..params.clone()
    };
    let looked = unbend(&state.found, state.mean, params, settings, ctx)?;
    let (mut report, mut bent) = (looked.report, looked.bent);
    let done = match looked.done {
        Some(done) => Some(done),
        None => unbend_part(
            &state.found,
            state.mean,
            (&mut report, &mut bent),
            params,
            settings,
            ctx,
        )?,
    };
    Ok(done.zip(report))
}
