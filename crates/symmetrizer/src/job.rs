//! The whole paper: detection, contraction, merging and the figures before and after, in a row.

mod arranged;
mod bent;
mod detected;
mod either;
mod firm;
mod follow;
mod further;
mod guard;
pub mod kinds;
mod measured;
mod merged;
mod otherwise;
pub mod pictures;
pub mod plane;
mod spared;
mod state;

use crate::apply::measure::{AsymmetryReport, Distortion, distortion, distortion_of_outline};
use crate::context::Context;
use crate::deform::{Igarashi, Stiffness};
use crate::detect::DetectParams;
use crate::error::Result;
use crate::job::arranged::Arranged;
use crate::optimize::orbit::{Goal, orbits};
use crate::optimize::outcome::mirrors;
use crate::optimize::schedule::Settings;
use crate::optimize::{Optimized, Outcome, optimize};
use crate::params::Params;
use crate::patch::{Symmetry, carry_ids};
use crate::report::faces::FaceSamples;
use crate::report::groups::exact;
use crate::report::{Head, InputReport, Report, ResultReport, StiffnessReport, symmetry};
use crate::shape::wall::Wall;
use crate::shape::working::{Mended, Working};
use crate::shape::{Document, Mesh};
use crate::transform::Plane;

pub use bent::Bent;
pub use detected::Detected;
pub use measured::{Measured, measure_in};
pub use plane::{
    Drawn, detect_drawing, measure_drawing, symmetrize_drawing, symmetrize_drawing_with,
    unbend_drawing,
};

/// A shape made symmetric, and how.
pub struct Symmetrized {
    /// The result: the input's vertices, moved, with its order and faces. Where no symmetry was
    /// found, the input itself.
    pub shape: Mesh,
    /// How the run ended.
    pub outcome: Outcome,
    /// The input and its symmetries.
    pub before: Detected,
    /// The result and its symmetries, in the working coordinates of the input; none where no
    /// symmetry was found.
    pub after: Option<Detected>,
    /// The bend that was found in the input, whatever was made of it.
    pub bend: Option<Bent>,
    /// What was made exact by orbits, its motions as they are exact, working coordinates of the input.
    pub goals: Vec<Goal>,
    /// The planes by which `report` measures asymmetry before and after, working coordinates.
    pub planes: [Plane; 2],
    /// Everything in figures.
    pub report: Report,
}

/// Finds the symmetries of `mesh`, or of the cloud of its vertices where it has no faces.
///
/// # Errors
/// [`crate::Error::Input`] for a mesh that cannot be worked on, [`crate::Error::Params`],
/// [`crate::Error::Cancelled`].
pub fn detect_in(mesh: &Mesh, params: &Params, ctx: &mut Context<'_>) -> Result<Detected> {
    params.check()?;
    let working = match mesh.polygons.is_empty() {
        true => ctx.stage("discs", |_| Working::of_cloud(mesh, None))?,
        false => Working::new(mesh)?,
    };
    find_in(working, mesh, &params.detect(), ctx)
}

/// Finds the symmetries of the mesh of `document`, as [`detect_in`] does; of a cloud with the normals
/// that the document has.
///
/// # Errors
/// As for [`detect_in`].
pub fn detect_document(
    document: &Document,
    params: &Params,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    let mesh = &document.mesh;
    let normals = document.vertex_normals();
    if !mesh.polygons.is_empty() || normals.is_none() {
        return detect_in(mesh, params, ctx);
    }
    params.check()?;
    let working = ctx.stage("discs", |_| Working::of_cloud(mesh, normals.as_deref()))?;
    find_in(working, mesh, &params.detect(), ctx)
}

fn find_in(
    working: Working,
    mesh: &Mesh,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    warn_of(&working.mended, ctx);
    ctx.stage("detect", |ctx| {
        Detected::sought(working, mesh.diagonal(), params, ctx)
    })
}

/// Makes `mesh` symmetric (section 4.2): finds its symmetries, contracts and merges their clusters,
/// and measures both states.
///
/// The same mesh, parameters and seed give the same result to the last bit, with any number of
/// threads. That no symmetry was found or the energy limit was reached is an [`Outcome`].
///
/// # Errors
/// Those of [`detect_in`]; [`crate::Error::Numerical`].
pub fn symmetrize(mesh: &Mesh, params: &Params, ctx: &mut Context<'_>) -> Result<Symmetrized> {
    symmetrize_with(mesh, &Stiffness::default(), params, ctx)
}

/// [`symmetrize`] with a `stiffness` that is not the same everywhere.
///
/// # Errors
/// Those of [`symmetrize`]; [`crate::Error::Params`] for a stiffness that does not fit the mesh.
pub fn symmetrize_with(
    mesh: &Mesh,
    stiffness: &Stiffness,
    params: &Params,
    ctx: &mut Context<'_>,
) -> Result<Symmetrized> {
    stiffness.check(mesh)?;
    mesh.check()?;
    params.check()?;
    let before = find_in(Working::new(mesh)?, mesh, &params.detect(), ctx)?;
    let stiffness = stiffness.per_face(&before.working);
    made(mesh, before, stiffness, params, false, ctx)
}

/// Undoes the bend of `mesh` and does nothing else; where none is found that the parameters accept, the
/// outcome is [`Outcome::NoSymmetry`].
///
/// # Errors
/// Those of [`symmetrize`].
pub fn unbend(mesh: &Mesh, params: &Params, ctx: &mut Context<'_>) -> Result<Symmetrized> {
    let mut params = params.clone();
    params.optimize.final_steps = 0;
    params.optimize.finish_rounds = 0;
    let before = mirrors_in(mesh, &params, ctx)?;
    made(mesh, before, None, &params, true, ctx)
}

/// The mirrors of a mesh that is to be unbent.
fn mirrors_in(mesh: &Mesh, params: &Params, ctx: &mut Context<'_>) -> Result<Detected> {
    mesh.check()?;
    params.check()?;
    let detect = params.detect().mirrors_only();
    find_in(Working::new(mesh)?, mesh, &detect, ctx)
}

/// [`symmetrize_with`], or [`unbend`] where `only` that is to be done, of `mesh` whose symmetries were found and whose
/// faces are as stiff.
fn made(
    mesh: &Mesh,
    mut before: Detected,
    stiffness: Option<Vec<f64>>,
    params: &Params,
    only: bool,
    ctx: &mut Context<'_>,
) -> Result<Symmetrized> {
    let detect = params.detect().mirrors_only();
    let measured = ctx.stage("measure", |ctx| before.asymmetry(&[], ctx))?;
    let wall = before.wall.clone();
    let settings = settings_for(wall.as_ref(), stiffness.as_deref(), &detect, params);
    let mean = measured.mean / 100.0 * before.diagonal;
    let exact = measured.max <= EXACT || measured.rms <= ROUNDED && measured.max <= STRAY;
    let arranged = match (before.wall.is_some(), only) {
        (false, false) => arranged::symmetrized(&mut before, (mean, exact), params, settings, ctx)?,
        _ => mirrored(&before, (mean, exact), (params, only), settings, ctx)?,
    };
    let Arranged {
        done,
        bend,
        bent,
        part,
    } = arranged;
    let faces = FaceSamples::of(&before);
    let input = AsymmetryReport::new(&measured, &before.working.normalization);
    let report = Report {
        head: Head::new(params, ctx),
        outcome: done.outcome,
        warnings: Vec::new(),
        stiffness: stiffness.as_deref().map(StiffnessReport::new),
        input: InputReport::new(mesh, &before, &faces, Some(input)),
        bend,
        result: None,
        steps: done.steps.clone(),
        run: None,
    };
    let mut job = Symmetrized {
        shape: mesh.clone(),
        outcome: done.outcome,
        before,
        after: None,
        bend: bent,
        goals: Vec::new(),
        planes: [measured.plane; 2],
        report,
    };
    if done.outcome != Outcome::NoSymmetry {
        let again = match (&job.before.wall, done.goals.is_empty()) {
            (Some(_), _) => params.detect().whole_mirrors(),
            (None, true) => detect.clone(),
            (None, false) => params.detect(),
        };
        job.conclude(done, mesh, &again, ctx)?;
        guard::give_up_on_worse(&mut job, mesh, part, &detect, ctx)?;
        plane::give_up_on_worse(&mut job, ctx);
        guard::say_part(&job, part, ctx);
    }
    if let Some(bend) = &mut job.report.bend {
        bend.follow(&job.report.steps);
    }
    job.report.warnings = ctx.warnings().to_vec();
    Ok(job)
}

/// A drawing with its group or its one line made exact, straight or bent, or else the turns of some of its rings; or a
/// shape of which `only` the bend is to be undone. Its asymmetry is that `mean` (fraction of L), or it is `exact`.
fn mirrored(
    before: &Detected,
    (mean, exact): (f64, bool),
    (params, only): (&Params, bool),
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Arranged> {
    let surface = &before.working.surface;
    let goals = match only {
        true => Vec::new(),
        false => plane::goals(before, settings),
    };
    let turned = |ctx: &mut Context<'_>| {
        ctx.stage("orbits", |ctx| {
            orbits(surface, &before.detection, &goals, settings, ctx)
        })
    };
    if plane::turns_first(before, &goals) {
        return Ok(Arranged::plain(turned(ctx)?));
    }
    let unmoved = |outcome| Optimized::unmoved(surface, &before.detection, outcome);
    if exact && mirrors(&before.detection).next().is_some() {
        let outcome = match only {
            true => Outcome::NoSymmetry,
            false => Outcome::Converged,
        };
        return Ok(Arranged::plain(unmoved(outcome)));
    }
    let looked = bent::unbend(before, mean, &params.straighten, settings, ctx)?;
    let done = match looked.done {
        Some(done) => done,
        None if only || !plane::mirrored(before) => match goals.is_empty() {
            true => unmoved(Outcome::NoSymmetry),
            false => turned(ctx)?,
        },
        None => optimize(surface, &before.detection, settings, ctx)?,
    };
    Ok(Arranged {
        done: guard::mended(before, done, ctx)?,
        bend: looked.report,
        bent: looked.bent,
        part: false,
    })
}

/// The settings of the work.
fn settings_for<'a>(
    wall: Option<&'a Wall>,
    stiffness: Option<&'a [f64]>,
    detect: &'a DetectParams,
    params: &'a Params,
) -> Settings<'a> {
    Settings {
        wall,
        stiffness,
        region: None,
        part: false,
        detect,
        deform: &params.deform,
        optimize: &params.optimize,
    }
}

/// Says what the stages do not see as the document has it.
fn warn_of(mended: &Mended, ctx: &mut Context<'_>) {
    let kinds = [
        (
            mended.unplaced,
            "left out: they have corners without a finite position",
        ),
        (
            mended.duplicate,
            "left out: an earlier one has the same corners",
        ),
        (
            mended.turned,
            "turned to run the same way round as their neighbours",
        ),
    ];
    for (count, what) in kinds.into_iter().filter(|(count, _)| *count > 0) {
        ctx.warn(format!(
            "for the work {count} faces are {what}; the file's own stay as they are"
        ));
    }
}

/// What became of a shape.
fn compared(before: &Detected, after: &Detected) -> Result<Distortion> {
    let [old, new] = [before, after].map(|d| &d.working.surface);
    let (Some(outline), Some(moved)) = (&before.wall, &after.wall) else {
        return Ok(distortion(old, new, before.diagonal));
    };
    let body = Igarashi::new(outline.clone())?;
    let inside = body.filled(&new.positions)?;
    let inside = (body.sheet(), inside.as_slice());
    Ok(distortion_of_outline(
        (outline, moved),
        inside,
        before.diagonal,
    ))
}

/// A shape whose mirrored surface lies nowhere further than this from it, % of D, is symmetric to the
/// rounding of single-precision coordinates: not a bit of it is changed.
const EXACT: f64 = 2e-5;

/// The same of coordinates with six digits, as text has them: rms distance, and that of single vertices, % of D.
const ROUNDED: f64 = 1e-4;
const STRAY: f64 = 5e-3;

impl Symmetrized {
    /// The `document` whose mesh went in, with everything it says, deformed as its mesh was.
    pub fn document(&self, document: &Document) -> Document {
        let after = self.after.as_ref();
        after.map_or_else(
            || document.clone(),
            |after| document.deformed(&self.before.working, &after.working.surface.positions),
        )
    }

    /// The symmetries of the result, the highest first.
    pub fn symmetries(&self) -> &[Symmetry] {
        self.after.as_ref().map_or(&[], Detected::symmetries)
    }

    /// Takes over what was `done` to `mesh`: the moved shape, its symmetries and figures.
    fn conclude(
        &mut self,
        done: Optimized,
        mesh: &Mesh,
        params: &DetectParams,
        ctx: &mut Context<'_>,
    ) -> Result<()> {
        let before = &self.before;
        self.outcome = done.outcome;
        self.report.outcome = done.outcome;
        self.report.steps = done.steps;
        self.shape = before.working.moved_document(mesh, &done.positions);
        let working = Working {
            surface: before.working.surface.with_positions(done.positions),
            ..before.working.clone()
        };
        let positions = &working.surface.positions;
        let wall = before
            .wall
            .as_ref()
            .map(|wall| wall.moved(positions.clone()));
        let diagonal = self.shape.diagonal();
        let mut after = ctx.stage("detect again", |ctx| {
            Detected::find((working, wall), diagonal, params, ctx)
        })?;
        let faces = FaceSamples::of(&after);
        carry_ids(
            &before.working.surface,
            (&before.detection.samples, &before.detection.symmetries),
            (&after.detection.samples, &mut after.detection.symmetries),
            done.next_id,
        );
        let result = ctx.stage("measure again", |ctx| {
            let known: Vec<Plane> = done.plane.into_iter().collect();
            let measured = after.asymmetry(&known, ctx)?;
            ctx.progress(0.5)?;
            self.planes[1] = measured.plane;
            Ok(ResultReport {
                asymmetry: AsymmetryReport::new(&measured, &after.working.normalization),
                distortion: compared(before, &after)?,
                energy: done.energy,
                exact: exact(&after, &done.goals),
                symmetries: symmetry::all(&after, &faces),
            })
        })?;
        self.report.result = Some(result);
        self.goals = done.goals;
        self.after = Some(after);
        Ok(())
    }
}
