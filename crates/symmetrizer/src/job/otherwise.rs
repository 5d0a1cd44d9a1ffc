//! Where a bend cannot be had from some samples of a surface it may be from others: where a field grows wrong hangs on where
//! they happen to lie.

use crate::context::Context;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::bent::Looked;
use crate::job::either::Either;
use crate::job::state::{State, detected, unbent};
use crate::optimize::Optimized;
use crate::straighten::When;

/// Other samples of a surface at the most.
pub(super) const OTHERS: u64 = 3;

/// A bend of a `shape` which could not be had where it was `looked` for, all of it or a part undone as other samples of the
/// same surface show it; and what those show.
///
/// # Errors
/// Those of detection and the deformation.
pub(super) fn unbend_otherwise(
    shape: &Either<'_>,
    looked: &Looked,
    ctx: &mut Context<'_>,
) -> Result<Option<(Optimized, Looked)>> {
    let report = looked.report.as_ref();
    let in_doubt = report.is_some_and(|r| r.verdict != Verdict::Accept);
    if !in_doubt || shape.params.when == When::Never {
        return Ok(None);
    }
    let (before, settings) = (shape.before, shape.settings);
    for turn in 1..=OTHERS {
        let surface = before.working.surface.clone();
        let found = ctx.drawn_anew(turn, |ctx| detected(before, surface, settings, ctx))?;
        let state = State {
            found,
            mean: shape.asymmetry,
        };
        let unbent = unbent(&state, shape.params, settings, ctx)?;
        if unbent.is_some() {
            return Ok(unbent);
        }
    }
    Ok(None)
}
