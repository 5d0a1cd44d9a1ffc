//! Bent shapes: the bend is undone, the straight shape made symmetric, and what is to stay of the bend put
//! back.

use crate::context::Context;
use crate::error::Result;
use crate::field::Reach;
use crate::field::grow::Land;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::optimize::schedule::{Settings, prepared};
use crate::optimize::{Optimized, Step, complete};
use crate::report::{BendReport, KeptReport};
use crate::shape::ClosestPoint;
use crate::straighten::{Bend, StraightenParams, Straightened, When, bend_again, straighten};

/// Distance along the surface that a field looks at, fraction of L.
pub(super) const REACH: f64 = 0.12;

/// A bend that was found, for pictures of it.
pub struct Bent {
    /// The bend.
    pub bend: Bend,
    /// The shape without it, not yet symmetric; none where the bend was left.
    pub straight: Option<Straightened>,
}

/// What came of looking for a bend.
pub(super) struct Looked {
    /// The figures, whatever came of it.
    pub report: Option<BendReport>,
    /// What they are about.
    pub bent: Option<Bent>,
    /// The work, where the bend was undone.
    pub done: Option<Optimized>,
}

/// Looks for a bend in the state `before`, whose mean asymmetry is `asymmetry` (fraction of L), and undoes it
/// where the parameters say so.
pub(super) fn unbend(
    before: &Detected,
    asymmetry: f64,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Looked> {
    let nothing = Looked {
        report: None,
        bent: None,
        done: None,
    };
    if params.when == When::Never || before.symmetries().is_empty() {
        return Ok(nothing);
    }
    let surface = &before.working.surface;
    let samples = &before.detection.samples;
    let reach = Reach::new(samples, REACH);
    let closest = ClosestPoint::new(surface);
    let land = Land::new(surface, &closest, samples, &reach).with_stiffness(settings.stiffness);
    let mirrors: Vec<_> = before.symmetries().iter().map(|s| s.q_from_p).collect();
    let found = ctx.stage("bend", |ctx| Bend::find(&land, &mirrors, ctx))?;
    let Some(bend) = found else {
        return Ok(nothing);
    };
    let mut report = BendReport::new(&bend);
    if bend.degrees < params.min_bend || !wanted(report.verdict, params.when) {
        return Ok(Looked {
            report: Some(report),
            bent: Some(Bent {
                bend,
                straight: None,
            }),
            done: None,
        });
    }
    let straight = ctx.stage("straighten", |_| straighten(&land, &bend))?;
    let body = ctx.stage("prepare", |_| prepared(surface, settings))?;
    let energy = body.energy_at(&straight.positions);
    if settings
        .optimize
        .max_deformation
        .is_some_and(|most| energy > most)
    {
        ctx.warn(format!(
            "the bend is not undone: that takes a deformation of {energy:.3}, more than is allowed"
        ));
        return Ok(Looked {
            report: Some(report),
            done: None,
        });
    }
    let now = surface.with_positions(straight.positions.clone());
    // What is not sure of the whole is done to the part that it is sure of.
    let region = (report.verdict == Verdict::Uncertain).then(|| bend.region(&land));
    let within = Settings {
        region: region.as_deref(),
        ..settings
    };
    let plane = straight.plane;
    let mut done = complete(&now, plane, asymmetry, &before.detection, within, ctx)?;
    done.steps.insert(
        0,
        Step::Straighten {
            bend: bend.degrees,
            trusted: bend.trust.share,
        },
    );
    report.removed = params.share * bend.degrees;
    if let Some(plane) = done.plane.filter(|_| params.share < 1.0) {
        let symmetric = now.with_positions(done.positions);
        let posed = ctx.stage("bend again", |_| {
            let kept = 1.0 - params.share;
            bend_again(&land, &bend, &straight, (&symmetric, &plane), kept)
        })?;
        let percent = 100.0 / before.diagonal;
        report.kept = Some(KeptReport {
            degrees: bend.degrees - report.removed,
            across: posed.across * percent,
            line: posed.line * percent,
        });
        done.positions = posed.positions;
        done.steps.push(Step::Bend {
            bend: bend.degrees - report.removed,
        });
    }
    done.energy = body.energy_at(&done.positions);
    Ok(Looked {
        report: Some(report),
        bent: Some(Bent {
            bend,
            straight: Some(straight),
        }),
        done: Some(done),
    })
}

fn wanted(verdict: Verdict, when: When) -> bool {
    match verdict {
        Verdict::Accept => when != When::Never,
        Verdict::Uncertain => when == When::Uncertain,
        Verdict::Refuse => false,
    }
}
