//! What a run must not do: leave a shape tangled, or less symmetric than it was.

use crate::context::Context;
use crate::detect::DetectParams;
use crate::error::Result;
use crate::job::{Detected, Symmetrized};
use crate::optimize::{Optimized, Outcome, Step, mend};
use crate::shape::Mesh;

/// Share of the area on which a tangled result had to be given back the form of the input, above which its mirror
/// is no mirror of the whole. Of shapes with one it is 0 to 1.3 %, of the dragon under the mirror of its front 28 %.
const SPOILED: f64 = 0.05;

/// Mean asymmetry, % of D, that may come and go with the triangulation.
const SLIGHTLY: f64 = 0.01;

/// Share of the faces that may stay tangled.
const TANGLED: f64 = 0.001;

/// What was `done`, where it is tangled with the form of the input.
pub(super) fn mended(
    before: &Detected,
    mut done: Optimized,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    if before.wall.is_some() || done.steps.is_empty() {
        return Ok(done);
    }
    let rest = &before.working.surface;
    let after = rest.with_positions(std::mem::take(&mut done.positions));
    let mended = ctx.stage("mend", |_| mend(rest, after))?;
    if mended.share > 0.0 || mended.left > 0 {
        done.steps.push(Step::Mend {
            share: mended.share,
            left: mended.left,
        });
    }
    done.positions = mended.surface.positions;
    Ok(done)
}

/// Whether so much of what was `done` to `before` had to be mended, or could not be, that the whole is not to be had.
pub(super) fn spoiled(before: &Detected, done: &Optimized) -> bool {
    let mended = |step: &Step| matches!(step, Step::Mend { share, .. } if *share > SPOILED);
    tangled(before, done) || done.steps.iter().any(mended)
}

/// Whether more of what was `done` to `before` is tangled than may be, though it was mended.
pub(super) fn tangled(before: &Detected, done: &Optimized) -> bool {
    let most = (TANGLED * before.working.surface.triangles.len() as f64) as usize;
    let left = |step: &Step| matches!(step, Step::Mend { left, .. } if *left > most);
    done.steps.iter().any(left)
}

/// Whether the result of a `job` on a mesh is less symmetric than the input. What keeps its pose is not measured by
/// one mirror, and a drawing has a rule of its own.
fn worse(job: &Symmetrized) -> bool {
    let Some(result) = &job.report.result else {
        return false;
    };
    let posed = job
        .report
        .steps
        .iter()
        .any(|s| matches!(s, Step::Bend { .. }));
    // Nor are groups, rows and copies, which need not have any.
    let measured = job.before.wall.is_none() && !posed && result.exact.is_empty();
    measured && result.asymmetry.mean > job.report.input.shape.mean_asymmetry()
}

/// Leaves a `mesh` that would come out less symmetric as it was; says so where it is more than comes and goes with
/// the triangulation, or where it is only a `part` that has a symmetry.
pub(super) fn give_up_on_worse(
    job: &mut Symmetrized,
    mesh: &Mesh,
    part: bool,
    detect: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<()> {
    let Some(result) = job.report.result.as_ref().filter(|_| worse(job)) else {
        return Ok(());
    };
    let (was, mean) = (
        job.report.input.shape.mean_asymmetry(),
        result.asymmetry.mean,
    );
    if part || mean > 1.05 * was + SLIGHTLY {
        ctx.warn(format!(
            "the shape is left as it is: with what is symmetric of it made so, as a whole it would be less so ({mean:.3} \
             % of D from symmetric, was {was:.3})"
        ));
    }
    if let Some(bend) = &mut job.report.bend {
        bend.removed = 0.0;
    }
    let before = &job.before;
    let surface = &before.working.surface;
    let unmoved = Optimized::unmoved(surface, &before.detection, Outcome::Converged);
    job.conclude(unmoved, mesh, detect, ctx)
}

/// Says that the rest was left, where a `part` was made symmetric and is still.
pub(super) fn say_part(job: &Symmetrized, part: bool, ctx: &mut Context<'_>) {
    if part && !job.report.steps.is_empty() {
        ctx.warn("only a part is made symmetric: the rest has no counterpart that fits");
    }
}
