//! Where a bend cannot be had from some samples of a surface it may be from others: where a field grows wrong hangs on where
//! they happen to lie.

use crate::context::Context;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::job::bent::Bent;
use crate::job::state::{State, detected, unbent};
use crate::optimize::Optimized;
use crate::optimize::schedule::Settings;
use crate::report::BendReport;
use crate::straighten::{StraightenParams, When};

/// Other samples of a surface at the most.
pub(super) const OTHERS: u64 = 3;

/// A bend of the shape `before`, with that mean asymmetry (fraction of L), which could not be had where it was `looked` for,
/// all of it or a part undone as other samples of the same surface show it.
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
        if let Some((done, looked)) = unbent(&state, params, settings, ctx)? {
            (*report, *bent) = (looked.report, looked.bent);
            return Ok(Some(done));
        }
    }
    Ok(None)
}
