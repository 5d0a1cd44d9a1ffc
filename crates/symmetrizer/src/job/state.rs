//! A shape on its way: its surface and mirrors as they are by now, and its bend undone from there.

use crate::context::Context;
use crate::error::Result;
use crate::job::Detected;
use crate::job::bent::{Looked, unbend, unbend_part};
use crate::optimize::Optimized;
use crate::optimize::schedule::Settings;
use crate::shape::{Surface, Working};
use crate::straighten::StraightenParams;
use crate::transform::Plane;

/// A shape as it is by now.
pub(super) struct State {
    /// It and its mirrors.
    pub found: Detected,
    /// Its mean asymmetry, fraction of L.
    pub mean: f64,
}

impl State {
    /// What was `done` to the shape `before`, measured.
    pub fn of(
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

/// The shape `before` with another `surface`, and the mirrors of that.
pub(super) fn detected(
    before: &Detected,
    surface: Surface,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    let working = Working {
        surface,
        ..before.working.clone()
    };
    let diagonal = before.diagonal * working.normalization.scale;
    ctx.stage("detect", |ctx| {
        Detected::find((working, None), diagonal, settings.detect, ctx)
    })
}

/// The bend of a state undone, all of it or a part, with what was found of it.
pub(super) fn unbent(
    state: &State,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, Looked)>> {
    let mut looked = unbend(&state.found, state.mean, params, settings, ctx)?;
    let done = match looked.done.take() {
        Some(done) => Some(done),
        None => {
            let (found, mean) = (&state.found, state.mean);
            unbend_part(found, mean, &mut looked, params, settings, ctx)?
        }
    };
    Ok(done.map(|done| (done, looked)))
}
