//! Bent shapes: the bend is undone, the straight shape made symmetric, and what is to stay of the bend put
//! back.

use crate::context::Context;
use crate::error::Result;
use crate::field::grow::Land;
use crate::field::trust::{Trust, Verdict};
use crate::field::{Mirrors, Reach};
use crate::job::{Detected, plane};
use crate::optimize::schedule::{Settings, prepared};
use crate::optimize::{Optimized, Step, complete, mend};
use crate::report::{BendReport, KeptReport};
use crate::sample::Samples;
use crate::shape::ClosestPoint;
use crate::straighten::{Bend, StraightenParams, Straightened, When, bend_again, straighten};

/// Distance along the surface that a field looks at, fraction of L.
pub(super) const REACH: f64 = 0.12;

/// Share of the samples that a part is to hold which is straightened though the whole is uncertain.
const MOST: f64 = 0.35;

/// A bend that was found, for pictures of it.
pub struct Bent {
    /// The bend.
    pub bend: Bend,
    /// The samples that it is a bend of.
    pub samples: Samples,
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

impl Looked {
    /// Says that the bend was left as it is.
    pub fn stays(&mut self) {
        if let Some(report) = &mut self.report {
            (report.removed, report.kept) = (0.0, None);
        }
        if let Some(bent) = &mut self.bent {
            bent.straight = None;
        }
    }
}

/// What the land of a state stands on.
struct Ground<'a> {
    state: &'a Detected,
    reach: Reach,
    closest: ClosestPoint,
}

impl<'a> Ground<'a> {
    fn of(state: &'a Detected) -> Result<Self> {
        let samples = &state.detection.samples;
        Ok(Self {
            reach: match &state.wall {
                Some(wall) => Reach::inside(wall, samples, REACH)?,
                None => Reach::new(samples, REACH),
            },
            closest: ClosestPoint::new(&state.working.surface),
            state,
        })
    }

    /// What fields of the state grow over.
    fn land<'b>(&'b self, settings: Settings<'b>) -> Land<'b> {
        let (surface, samples) = (&self.state.working.surface, &self.state.detection.samples);
        Land::new(surface, &self.closest, samples, &self.reach)
            .with_stiffness(settings.stiffness)
            .with_wall(settings.wall)
    }
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
    unbend_unless(&|_| false, before, asymmetry, params, settings, ctx)
}

/// [`unbend`], which leaves a bend that is `denied` by what is trusted of it.
pub(super) fn unbend_unless(
    denied: &dyn Fn(&Trust) -> bool,
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
    let plane = before.wall.is_some();
    let mut mirrors = Mirrors::from(&before.detection);
    if plane {
        // An outline is paired all around, whatever mirrors it has.
        mirrors.doubtful.clear();
    }
    if params.when == When::Never || mirrors.sure.is_empty() && !plane {
        return Ok(nothing);
    }
    let ground = Ground::of(before)?;
    let land = ground.land(settings);
    let found = ctx.stage("bend", |ctx| {
        Bend::find_unless(denied, &land, &mirrors, ctx)
    })?;
    let Some(bend) = found else {
        return Ok(nothing);
    };
    let mut report = BendReport::new(&bend);
    let enough = bend.degrees >= params.min_bend || !plane::mirrored(before);
    let wanted = wanted(report.verdict, params.when);
    let undone = if enough && wanted && !denied(&bend.trust) {
        undone(before, asymmetry, &land, &bend, params.share, settings, ctx)?
    } else {
        None
    };
    let (straight, done) = undone.map_or((None, None), |undone| {
        report.removed = params.share * bend.degrees;
        report.kept = undone.kept;
        (Some(undone.straight), Some(undone.done))
    });
    Ok(Looked {
        report: Some(report),
        bent: Some(Bent {
            bend,
            samples: before.detection.samples.clone(),
            straight,
        }),
        done,
    })
}

/// The bend that was `looked` at undone in the part that it is sure of, where that is most of the shape and the whole
/// cannot be had by other means.
pub(super) fn unbend_part(
    before: &Detected,
    asymmetry: f64,
    looked: &mut Looked,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<Optimized>> {
    let (Some(report), Some(bent)) = (&mut looked.report, &mut looked.bent) else {
        return Ok(None);
    };
    let uncertain = report.verdict == Verdict::Uncertain && bent.bend.degrees >= params.min_bend;
    if params.when == When::Never || !uncertain || bent.straight.is_some() {
        return Ok(None);
    }
    let ground = Ground::of(before)?;
    let land = ground.land(settings);
    let region = bent.bend.trust.region(&land);
    if region.iter().sum::<f64>() < MOST * region.len() as f64 {
        return Ok(None);
    }
    let undone = undone(
        before,
        asymmetry,
        &land,
        &bent.bend,
        params.share,
        settings,
        ctx,
    )?;
    Ok(undone.map(|undone| {
        report.removed = params.share * bent.bend.degrees;
        report.kept = undone.kept;
        bent.straight = Some(undone.straight);
        undone.done
    }))
}

/// The bend of the state `before` that was `looked` at and undone, undone once more with other `settings`.
pub(super) fn undone_again(
    before: &Detected,
    asymmetry: f64,
    looked: &mut Looked,
    params: &StraightenParams,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<Optimized>> {
    let Some(bent) = &mut looked.bent else {
        return Ok(None);
    };
    let ground = Ground::of(before)?;
    let land = ground.land(settings);
    let share = params.share;
    let undone = undone(before, asymmetry, &land, &bent.bend, share, settings, ctx)?;
    Ok(undone.map(|undone| {
        bent.straight = Some(undone.straight);
        undone.done
    }))
}

/// A bend undone.
struct Undone {
    straight: Straightened,
    done: Optimized,
    /// What stayed of the bend, where not all was to go.
    kept: Option<KeptReport>,
}

/// `share` of `bend` undone and the rest made symmetric; `None` where that takes a larger deformation than is
/// allowed.
fn undone(
    before: &Detected,
    asymmetry: f64,
    land: &Land<'_>,
    bend: &Bend,
    share: f64,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Option<Undone>> {
    let surface = land.surface;
    let mut straight = ctx.stage("straighten", |_| straighten(land, bend))?;
    if land.wall.is_none() {
        // Fingers that are pressed together would only be drawn on.
        let tangled = surface.with_positions(straight.positions);
        straight.positions = mend(surface, tangled)?.surface.positions;
    }
    let body = ctx.stage("prepare", |_| prepared(surface, settings))?;
    // It grows with the square of the angle.
    let energy = share.powi(2) * body.energy_at(&straight.positions);
    let most = settings.optimize.max_deformation.unwrap_or(f64::INFINITY);
    if energy > most {
        ctx.warn(format!(
            "the bend is not undone: that takes a deformation energy of {energy:.3}, more than the {most} that \
             are allowed"
        ));
        return Ok(None);
    }
    let now = surface.with_positions(straight.positions.clone());
    // What is not sure of the whole is done to the part that it is sure of.
    let part = bend.trust.verdict() == Verdict::Uncertain && land.wall.is_none();
    let trusted = part.then(|| bend.region(land));
    let region = both(trusted, settings.region);
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
    let mut kept = None;
    if let Some(plane) = done.plane.filter(|_| share < 1.0) {
        let symmetric = now.with_positions(std::mem::take(&mut done.positions));
        let rest = 1.0 - share;
        let posed = ctx.stage("bend again", |_| {
            bend_again(land, bend, &straight, (&symmetric, &plane), rest)
        })?;
        let percent = 100.0 / before.diagonal;
        let degrees = rest * bend.degrees;
        kept = Some(KeptReport {
            degrees,
            across: posed.across * percent,
            line: posed.line * percent,
        });
        done.positions = posed.positions;
        done.steps.push(Step::Bend { bend: degrees });
    }
    done.energy = body.energy_at(&done.positions);
    Ok(Some(Undone {
        straight,
        done,
        kept,
    }))
}

/// How far each vertex may be changed where two say it.
fn both(one: Option<Vec<f64>>, other: Option<&[f64]>) -> Option<Vec<f64>> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.iter().zip(other).map(|(a, b)| a * b).collect()),
        (one, other) => one.or_else(|| other.map(<[f64]>::to_vec)),
    }
}

fn wanted(verdict: Verdict, when: When) -> bool {
    match verdict {
        Verdict::Accept => when != When::Never,
        Verdict::Uncertain => when == When::Uncertain,
        Verdict::Refuse => false,
    }
}
