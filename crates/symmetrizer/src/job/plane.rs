//! Shapes of the plane: a drawing's outline goes through the stages as the wall over it, and the drawing follows.

use crate::apply::measure::asymmetry_of_outline;
use crate::context::Context;
use crate::deform::Stiffness;
use crate::detect::DetectParams;
use crate::drawing::{Drawing, Outline, Turns};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::job::firm::per_face;
use crate::job::follow::Follow;
use crate::job::{Detected, Measured, Symmetrized, made};
use crate::optimize::orbit::{Goal, Orbit};
use crate::optimize::outcome::mirrors;
use crate::optimize::plan;
use crate::optimize::schedule::Settings;
use crate::optimize::{Outcome, Step};
use crate::params::Params;
use crate::shape::Mesh;
use crate::shape::wall::Wall;
use crate::shape::working::Working;
use crate::straighten::When;
use crate::transform::{Class, Isometry};

/// A drawing made symmetric, and how.
pub struct Drawn {
    /// The result.
    pub drawing: Drawing,
    /// What was done to its outline; the vertices of its shape are the corners of that.
    pub job: Symmetrized,
}

impl Drawn {
    /// The result's outline alone, exactly symmetric under its group of turns, or about its line, to the last digit of
    /// a written file; see [`Drawing::exact`] and [`Drawing::exact_under`].
    ///
    /// # Errors
    /// [`Error::Input`] where no symmetry of the whole was found, and those of the drawing.
    pub fn exact(&self) -> Result<Drawing> {
        let Some(after) = &self.job.after else {
            let what = "there is no symmetry that the drawing could have exactly";
            return Err(Error::input(what, "write it without --exact"));
        };
        let normalization = after.working.normalization;
        if self.job.goals.iter().any(|g| !g.is_of_the_whole()) {
            let what = "what is symmetric is only a part of the drawing";
            return Err(Error::input(what, "write it without --exact"));
        }
        let copies = |g: &Goal| matches!(g.orbit, Orbit::Regular(_) | Orbit::Free(_));
        if self.job.goals.iter().any(copies) {
            let what = "copies in rows and in free positions cannot be written exactly";
            return Err(Error::input(what, "write them without --exact"));
        }
        if let Some(turns) = self.job.goals.first().and_then(turns) {
            return self.drawing.exact_under(&Turns {
                center: normalization.to_document(&turns.center),
                ..turns
            });
        }
        let plane = self.job.planes[1];
        let on = normalization.to_document(&Point::from(plane.normal * plane.offset));
        self.drawing
            .exact(plane.normal, plane.normal.dot(&on.coords))
    }
}

/// The turns of a group that was made exact, about the point that they leave in its place; of its lines the one that
/// is nearest to upright. `None` without turns.
fn turns(goal: &Goal) -> Option<Turns> {
    let Orbit::Group(elements) = &goal.orbit else {
        return None;
    };
    let (lines, proper): (Vec<&Isometry>, Vec<&Isometry>) =
        elements.iter().partition(|g| g.is_improper());
    let turn = proper.first()?;
    let back = nalgebra::Matrix2::identity() - turn.linear.fixed_view::<2, 2>(0, 0);
    let center = back.try_inverse()? * turn.translation.xy();
    let origin = Point::origin();
    let normals = lines.iter().map(|g| g.nearest_mirror(&origin).normal);
    let upright = normals.max_by(|a, b| a.x.abs().total_cmp(&b.x.abs()));
    Some(Turns {
        order: proper.len() + 1,
        center: Point::new(center.x, center.y, 0.0),
        mirror: upright.map(|n| if n.x < 0.0 { -n } else { n }),
    })
}

/// Share of an outline that one line must hold for: a drawing of which only a part has a line, straight or bent, is
/// left as it is.
const WHOLE: f64 = 0.7;

/// Whether one mirror holds for the whole of a shape of the plane, or the shape is one of space.
pub(super) fn mirrored(found: &Detected) -> bool {
    let holds = mirrors(&found.detection).any(|s| s.area_fraction >= WHOLE);
    found.wall.is_none() || holds
}

/// Points of an outline that are worked on; of more, those are left out that say least, at first those within this
/// share of the diagonal of the lines between the others.
const POINTS: usize = 1500;
const FINEST: f64 = 1e-5;
/// Beyond this share detail is lost: of outlines in more parts than these the longest stand for all.
const COARSEST: f64 = 2e-3;
const PARTS: usize = 200;

/// A drawing is to lose this share of its asymmetry at the least, and to come as near to symmetric as this, % of D, or it is left: those
/// that come out right are within .06.
const BETTER: f64 = 0.5;
const NEAR: f64 = 0.15;
/// Asymmetry, % of D, that may come and go.
const FLOOR: f64 = 0.01;

/// Takes a drawing's result back where it is hardly more symmetric than the input, or crosses itself where the input
/// does not; says so where it was asked for.
pub(super) fn give_up_on_worse(job: &mut Symmetrized, ctx: &mut Context<'_>) {
    let (Some(wall), Some(result)) = (&job.before.wall, &job.report.result) else {
        return;
    };
    let before = job.report.input.shape.mean_asymmetry();
    let worse = result.asymmetry.mean > (BETTER * before + FLOOR).min(NEAR);
    let crossed = result.distortion.new_crossings;
    if asked_for(job) {
        if crossed > 0 {
            ctx.warn(format!(
                "the drawing crosses itself: {crossed} edges of its outline do that did not"
            ));
        }
        return;
    }
    if worse || crossed > 0 {
        let why = match crossed {
            0 if result.asymmetry.mean > NEAR => "it would not come near enough to that",
            0 => "it would be little more so",
            _ => "it would cross itself",
        };
        ctx.warn(format!(
            "the drawing is left as it is: made symmetric, {why} ({:.2} % of D from symmetric, was {before:.2})",
            result.asymmetry.mean
        ));
        let shape = corners(wall);
        leave(job, shape);
    }
}

/// Takes the result of a `job` back: its shape is the input's, `shape`.
fn leave(job: &mut Symmetrized, shape: Mesh) {
    if let Some(bend) = &mut job.report.bend {
        bend.removed = 0.0;
    }
    job.report.result = None;
    job.report.steps.clear();
    job.report.outcome = Outcome::NoSymmetry;
    job.outcome = Outcome::NoSymmetry;
    job.after = None;
    job.goals.clear();
    job.shape = shape;
}

/// Whether it was to be done all the same: what is uncertain, only a part of it, or nothing but unbending. The orbits
/// of a group have no line to be measured by.
fn asked_for(job: &Symmetrized) -> bool {
    let params = &job.report.head.params;
    let orbits = |step: &Step| matches!(step, Step::Orbits { .. });
    params.straighten.when == When::Uncertain
        || params.straighten.share < 1.0
        || params.optimize.max_deformation.is_some()
        || params.optimize.final_steps == 0
        || job.report.steps.iter().any(orbits)
}

/// Turns of rings that hold for this share of an outline come first where no line holds for as much of it as this: the
/// lines of the rings hold for them and for a little of the rest.
const TURNED: f64 = 0.4;
const LINED: f64 = 0.9;

/// Copies in free positions that together have less than this share of an outline are not made alike by themselves: the toes of
/// a lizard are nearly copies, too.
const COPIED: f64 = 0.6;

/// Whether the groups of turns among the `goals` come before the lines of a drawing.
pub(super) fn turns_first(found: &Detected, goals: &[Goal]) -> bool {
    let order = |g: &Goal| turns(g).map_or(0, |turns| turns.order);
    // Half a turn of a part is what any two lines across each other make.
    let several = goals.iter().filter(|g| order(g) > 2);
    let share: f64 = several.map(|g| g.area_fraction).sum();
    let lined = mirrors(&found.detection).any(|s| s.area_fraction >= LINED);
    let whole = goals.iter().any(|g| order(g) > 1 && g.is_of_the_whole());
    whole || share >= TURNED && !lined
}

/// What else than lines a drawing has that is to be made exact: groups with turns, rows, grids, and copies that are most of it or
/// are asked for.
pub(super) fn goals(found: &Detected, settings: Settings<'_>) -> Vec<Goal> {
    if found.wall.is_none() {
        return Vec::new();
    }
    let all = found.symmetries().iter();
    let motions: Vec<u32> = all
        .filter(|s| s.class != Class::Mirror)
        .map(|s| s.id)
        .collect();
    let asked = settings.optimize.only.is_some();
    let mut goals = plan::goals(&found.detection, settings.optimize);
    goals.retain(|g| {
        let moves = g.symmetries.iter().any(|id| motions.contains(id));
        let free = matches!(g.orbit, Orbit::Free(_));
        moves && (!free || asked || g.area_fraction >= COPIED)
    });
    let free = |g: &Goal| matches!(g.orbit, Orbit::Free(_));
    let (copies, mut ordered): (Vec<Goal>, Vec<Goal>) = goals.into_iter().partition(free);
    // What is in order already is told by that.
    let of_its_own = |copies: &Goal| !ordered.iter().any(|g| lies_in(copies, g));
    let copies: Vec<Goal> = copies.into_iter().filter(of_its_own).collect();
    ordered.extend(copies);
    ordered
}

/// Whether most of the places of `goal` are places of `other`.
fn lies_in(goal: &Goal, other: &Goal) -> bool {
    let samples = || goal.places.iter().flatten();
    let inside = |i: &&u32| other.places.iter().any(|p| p.binary_search(i).is_ok());
    2 * samples().filter(inside).count() > samples().count()
}

/// Finds the symmetries of a drawing's outline.
///
/// # Errors
/// [`Error::Input`] for a drawing without an area, [`Error::Params`], [`Error::Cancelled`].
pub fn detect_drawing(
    drawing: &Drawing,
    params: &Params,
    ctx: &mut Context<'_>,
) -> Result<(Mesh, Detected)> {
    params.check()?;
    warn_of(drawing, ctx);
    let (mesh, wall) = walled(drawing.outline())?;
    let found = found(drawing.outline(), wall, &params.detect(), ctx)?;
    Ok((mesh, found))
}

/// Makes a drawing symmetric, as [`crate::symmetrize`] does a mesh.
///
/// # Errors
/// Those of [`detect_drawing`]; [`Error::Numerical`].
pub fn symmetrize_drawing(
    drawing: &Drawing,
    params: &Params,
    ctx: &mut Context<'_>,
) -> Result<Drawn> {
    symmetrize_drawing_with(drawing, &Stiffness::default(), params, ctx)
}

/// [`symmetrize_drawing`] with a `stiffness` that is not the same everywhere.
///
/// # Errors
/// Those of [`symmetrize_drawing`]; [`Error::Params`] for a stiffness that does not fit the drawing.
pub fn symmetrize_drawing_with(
    drawing: &Drawing,
    stiffness: &Stiffness,
    params: &Params,
    ctx: &mut Context<'_>,
) -> Result<Drawn> {
    work(drawing, stiffness, (params, false), ctx)
}

/// Undoes the bend of a drawing and does nothing else, as [`crate::unbend`] does of a mesh.
///
/// # Errors
/// Those of [`symmetrize_drawing`].
pub fn unbend_drawing(drawing: &Drawing, params: &Params, ctx: &mut Context<'_>) -> Result<Drawn> {
    let mut params = params.clone();
    params.optimize.final_steps = 0;
    params.optimize.finish_rounds = 0;
    work(drawing, &Stiffness::default(), (&params, true), ctx)
}

fn work(
    drawing: &Drawing,
    stiffness: &Stiffness,
    (params, only): (&Params, bool),
    ctx: &mut Context<'_>,
) -> Result<Drawn> {
    params.check()?;
    warn_of(drawing, ctx);
    let detect = params.detect().whole_mirrors();
    let (mesh, wall) = walled(drawing.outline())?;
    let stiffness = per_face(stiffness, drawing, &wall)?;
    let before = found(drawing.outline(), wall, &detect, ctx)?;
    let job = made(&mesh, before, stiffness, params, only, ctx)?;
    let drawing = match (&job.before.wall, &job.after) {
        (Some(wall), Some(after)) => ctx.stage("redraw", |_| {
            let follow = Follow::new(wall, &after.working.surface.positions)?;
            drawing.deformed(&|x| follow.place(&x))
        })?,
        _ => drawing.clone(),
    };
    Ok(Drawn { drawing, job })
}

/// Says how the file was read.
fn warn_of(drawing: &Drawing, ctx: &mut Context<'_>) {
    for warning in drawing.warnings() {
        ctx.warn(warning.0.clone());
    }
}

/// The rings of an outline with no more points than the work needs.
fn few(outline: &Outline) -> Vec<Vec<Point>> {
    if outline.len() <= POINTS {
        return outline.rings.iter().map(|r| r.points.clone()).collect();
    }
    let mut share = FINEST;
    loop {
        let rings = outline.simplified(share * outline.diagonal());
        if rings.iter().map(Vec::len).sum::<usize>() <= POINTS {
            return rings;
        }
        if share > COARSEST && rings.len() > PARTS {
            return longest(rings);
        }
        share *= 2.0;
    }
}

/// The longest rings of thousands, with no more points than the work needs, one at the least.
fn longest(rings: Vec<Vec<Point>>) -> Vec<Vec<Point>> {
    let length = |ring: &Vec<Point>| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| (b - a).norm()).sum()
    };
    let lengths: Vec<f64> = rings.iter().map(length).collect();
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]));
    let mut points = 0;
    let within = |&r: &usize| {
        points += rings[r].len();
        points <= POINTS
    };
    let count = order.iter().copied().take_while(within).count().max(1);
    order.truncate(count);
    order.sort_unstable();
    order.into_iter().map(|r| rings[r].clone()).collect()
}

/// The mesh of an outline's corners and the wall over it.
fn walled(outline: &Outline) -> Result<(Mesh, Wall)> {
    if outline.is_empty() {
        return Err(Error::input(
            "the drawing has no area",
            "it needs a closed path that is filled, or a stroke that has a width",
        ));
    }
    let wall = Wall::new(&few(outline))?;
    Ok((corners(&wall), wall))
}

/// A vertex for each edge of an outline, where it starts.
fn corners(wall: &Wall) -> Mesh {
    let places = (0..wall.edges()).map(|e| wall.normalization.to_document(&wall.start(e)));
    Mesh {
        positions: places.collect(),
        ..Mesh::default()
    }
}

/// The symmetries of an outline, over which `wall` stands.
fn found(
    outline: &Outline,
    wall: Wall,
    params: &DetectParams,
    ctx: &mut Context<'_>,
) -> Result<Detected> {
    let diagonal = outline.diagonal();
    let working = Working::of_wall(&wall);
    ctx.stage("detect", |ctx| {
        Detected::find((working, Some(wall)), diagonal, params, ctx)
    })
}

/// Measures how far a drawing's outline is from symmetric.
///
/// # Errors
/// [`Error::Input`] for a drawing without an area, [`Error::Numerical`], [`Error::Cancelled`].
pub fn measure_drawing(drawing: &Drawing, ctx: &mut Context<'_>) -> Result<(Mesh, Measured)> {
    warn_of(drawing, ctx);
    let (mesh, wall) = walled(drawing.outline())?;
    let diagonal = drawing.outline().diagonal() / wall.normalization.scale;
    let asymmetry = ctx.stage("measure", |ctx| {
        asymmetry_of_outline(&wall, diagonal, &[], ctx)
    })?;
    let measured = Measured {
        working: Working::of_wall(&wall),
        wall: Some(wall),
        diagonal,
        asymmetry,
        distortion: None,
    };
    Ok((mesh, measured))
}
