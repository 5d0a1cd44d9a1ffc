//! The pictures of a job: both states side by side, one state's views, transformation space.
//!
//! All of it is computed from the job when it is asked for; planes, patches and their clusters have
//! the same colour, that of the symmetry's id.

pub mod bend;
mod flat;
mod parts;
mod plots;

pub use parts::symmetries;
pub use plots::{density, plot_title};

use plots::Votes;

use crate::apply::measure::per_vertex;
use crate::cluster::Projection;
use crate::error::Result;
use crate::job::{Detected, Measured, Symmetrized};
use crate::optimize::Step;
use crate::optimize::orbit::apart;
use crate::picture::{
    Angle, Canvas, Extent, Panel, ReportPicture, ScalarField, Sheet, categorical, render_sheet,
    strongest,
};
use crate::transform::{Class, Plane};

/// Planes drawn in one picture at the most, the highest symmetries'.
const PLANES: usize = 3;
/// Goals named in a picture's figures at the most.
const NAMED: usize = 4;
/// Width and height of one view of a sheet, pixels.
pub const VIEW_SIZE: [u32; 2] = [420, 440];
/// The scale of colours reaches at least this far, % of D: less is the triangulation's, and a shape
/// that is symmetric looks so.
const PALE: f64 = 0.02;
/// What colours stand for.
const SCALE_LABEL: &str = "asymmetry, % of D";
/// The same where orbits were drawn to their means.
const ORBIT_LABEL: &str = "distance from the mean of all copies, % of D";

/// The job in one picture, headed by `title`: input above result, coloured by asymmetry, with the
/// planes and the votes; below them the bend that was found. Where no symmetry was found, the input's
/// views in the place of both states.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn before_after(job: &Symmetrized, title: &str) -> Result<Canvas> {
    if let Some(page) = flat::before_after(job, title, &figures(job))? {
        return Ok(page);
    }
    let states = states(job, title);
    Ok(match bend::rows(job)? {
        Some(rows) => states.above(rows),
        None => states,
    })
}

/// Input above result.
fn states(job: &Symmetrized, title: &str) -> Canvas {
    let before = &job.before;
    let Some(after) = &job.after else {
        return views(before, title);
    };
    let bandwidth = job.report.head.params.cluster.bandwidth;
    let votes = told(job).map(|cloud| {
        let projection = Projection::new(before.detection.clouds[cloud].votes.points());
        [before, after].map(|state| Votes::new(state, cloud, before, &projection))
    });
    let axes = votes.as_ref().map(|v| common_axes(v, bandwidth));
    let colors = [(before, job.planes[0]), (after, job.planes[1])]
        .map(|(state, plane)| colored(job, state, &plane));
    let planes = [before, after].map(colored_planes);
    let surfaces = [before, after].map(|d| &d.working.surface);
    let panel = |k: usize| Panel {
        positions: &surfaces[k].positions,
        scalar: &colors[k],
        planes: &planes[k],
        density: votes.as_ref().map(|v| v[k].plot(bandwidth, axes, "")),
    };
    let page = ReportPicture {
        title,
        subtitle: &figures(job),
        before: panel(0),
        after: panel(1),
        triangles: &surfaces[0].triangles,
        scale_max: Some(strongest(colors.iter().map(Vec::as_slice)).max(PALE)),
        scale_label: match job.goals.is_empty() {
            true => SCALE_LABEL,
            false => ORBIT_LABEL,
        },
    };
    page.canvas()
}

/// The cloud that tells most of what was done: that of the first goal's symmetries, else the first, that of mirrors. None where
/// nothing was looked for by votes.
fn told(job: &Symmetrized) -> Option<usize> {
    let detection = &job.before.detection;
    let mut ids = job.goals.iter().flat_map(|g| &g.symmetries);
    let class = ids.find_map(|id| {
        let found = detection.symmetries.iter().find(|s| s.id == *id);
        found.map(|s| s.class)
    });
    let at = class.and_then(|class| detection.clouds.iter().position(|c| c.class == class));
    let after = job.after.as_ref().map_or(0, |a| a.detection.clouds.len());
    let first = (after > 0 && !detection.clouds.is_empty()).then_some(0);
    at.filter(|&k| k < after).or(first)
}

/// What is to be seen on each vertex of a state: how far it is from its mirror image, or from the mean of its copies,
/// % of D.
fn colored(job: &Symmetrized, state: &Detected, plane: &Plane) -> Vec<f64> {
    let surface = &state.working.surface;
    if job.goals.is_empty() {
        return per_vertex(surface, state.diagonal, plane);
    }
    // The goals' places are samples of the input, which ride on its surface.
    let mut samples = job.before.detection.samples.clone();
    for s in &mut samples.list {
        s.position = surface.point(&s.at);
        s.normal = surface.normal(&s.at);
    }
    let apart = apart(surface, &samples, &job.goals).into_iter();
    apart.map(|d| 100.0 * d / state.diagonal).collect()
}

/// Views of `found` with the planes of its symmetries.
pub fn views(found: &Detected, title: &str) -> Canvas {
    let surface = &found.working.surface;
    render_sheet(&Sheet {
        title,
        positions: &surface.positions,
        triangles: &surface.triangles,
        scalar: None,
        planes: &colored_planes(found),
        upright: None,
        angles: &[Angle::Front, Angle::ThreeQuarter, Angle::Side, Angle::Top],
        size: VIEW_SIZE,
    })
}

/// What a sheet of [`measured_views`] shows.
#[derive(Debug, Clone, Copy)]
pub struct Shown<'a> {
    /// A line above the views; none if empty.
    pub title: &'a str,
    /// Which views, from left to right.
    pub angles: &'a [Angle],
    /// Width and height of one view, pixels.
    pub size: [u32; 2],
    /// Whether vertices are coloured by their asymmetry.
    pub asymmetry: bool,
    /// Whether the mirror plane is drawn.
    pub plane: bool,
}

/// Views of a shape that stands as its measured mirror plane says.
pub fn measured_views(measured: &Measured, shown: &Shown<'_>) -> Canvas {
    if let Some(page) = flat::measured(measured, shown.title, shown.plane) {
        return page;
    }
    let surface = &measured.working.surface;
    let plane = measured.asymmetry.plane;
    let values = shown
        .asymmetry
        .then(|| per_vertex(surface, measured.diagonal, &plane));
    let planes = [(plane, categorical(0))];
    render_sheet(&Sheet {
        title: shown.title,
        positions: &surface.positions,
        triangles: &surface.triangles,
        scalar: values.as_deref().map(|values| ScalarField {
            values,
            max: Some(strongest([values]).max(PALE)),
            label: SCALE_LABEL,
        }),
        planes: if shown.plane { &planes } else { &[] },
        upright: Some(plane),
        angles: shown.angles,
        size: shown.size,
    })
}

/// The line below the title.
fn figures(job: &Symmetrized) -> String {
    let (Some(before), Some(result)) = (&job.report.input.shape.asymmetry, &job.report.result)
    else {
        return String::new();
    };
    let goals = job.report.steps.iter().find_map(|step| match step {
        Step::Orbits { goals, .. } if !job.goals.is_empty() => Some(goals),
        _ => None,
    });
    if let Some(goals) = goals {
        let kept = goals.iter().filter(|g| g.kept).take(NAMED);
        let lines = kept.map(|g| {
            let [before, after] = g.residual.map(|r| 100.0 * r);
            format!("{}: {before:.3} → {after:.3} % of L apart", g.name)
        });
        return lines.collect::<Vec<_>>().join("   ·   ");
    }
    let after = &result.asymmetry;
    format!(
        "mean asymmetry {:.2} → {:.2} % of D   ·   99th percentile {:.1} → {:.1} %   ·   largest {:.1} → {:.1} %",
        before.mean, after.mean, before.p99, after.p99, before.max, after.max
    )
}

/// The colour of a symmetry, by its number in [`categorical`]: any but the last, which is grey.
fn hue(id: u32) -> usize {
    (id % 9) as usize
}

fn color(id: u32) -> [u8; 3] {
    categorical(hue(id))
}

fn colored_planes(found: &Detected) -> Vec<(Plane, [u8; 3])> {
    let mirrors = found.symmetries().iter();
    let highest = mirrors.filter(|s| s.class == Class::Mirror).take(PLANES);
    highest.map(|s| (s.plane(), color(s.id))).collect()
}

/// The square around the votes and marks of both states.
fn common_axes(votes: &[Votes; 2], bandwidth: f64) -> Extent {
    let points = votes.iter().flat_map(|v| &v.points);
    let marks = votes.iter().flat_map(|v| &v.modes).map(|m| &m.position);
    Extent::around(points.chain(marks), bandwidth)
}
