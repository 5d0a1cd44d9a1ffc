//! The pictures of a job: both states side by side, one state's views, transformation space.
//!
//! All of it is computed from the job when it is asked for; planes and their clusters have the
//! same colour, that of the symmetry's id.

use crate::apply::measure::per_vertex;
use crate::cluster::Projection;
use crate::job::{Detected, Measured, Symmetrized};
use crate::picture::{
    Angle, Canvas, DensityPlot, Extent, Panel, PlotMode, ReportPicture, ScalarField, Sheet,
    categorical, render_sheet, strongest,
};
use crate::transform::{Isometry, Plane};

/// Planes drawn in one picture at the most, the highest symmetries'.
const PLANES: usize = 3;
/// The colour of clusters that are no symmetries: grey.
const REFUSED_COLOR: usize = 9;
/// Side of the plot of transformation space, pixels.
const PLOT_SIDE: u32 = 900;
/// How far a vote is spread in plots, in units of what clustering takes: less shows the ridges
/// between clusters.
const SHARPNESS: f64 = 0.5;
/// Width and height of one view of a sheet, pixels.
pub const VIEW_SIZE: [u32; 2] = [420, 440];
/// The scale of colours reaches at least this far, % of D: less is the triangulation's, and a shape
/// that is symmetric looks so.
const PALE: f64 = 0.02;
/// What colours stand for.
const SCALE_LABEL: &str = "asymmetry, % of D";

/// The job in one picture, headed by `title`: input above result, coloured by asymmetry, with the
/// planes and the votes. Where no symmetry was found, the input's views alone.
pub fn before_after(job: &Symmetrized, title: &str) -> Canvas {
    let before = &job.before;
    let Some(after) = &job.after else {
        return views(before, title);
    };
    let bandwidth = job.report.head.params.cluster.bandwidth;
    let projection = Projection::new(before.detection.clouds[0].votes.points());
    let votes = [before, after].map(|state| Votes::new(state, before, &projection));
    let axes = common_axes(&votes, bandwidth);
    let colors = [(before, job.planes[0]), (after, job.planes[1])]
        .map(|(d, plane)| per_vertex(&d.working.surface, d.diagonal, &plane));
    let planes = [before, after].map(colored_planes);
    let surfaces = [before, after].map(|d| &d.working.surface);
    let panel = |k: usize| Panel {
        positions: &surfaces[k].positions,
        scalar: &colors[k],
        planes: &planes[k],
        density: Some(votes[k].plot(bandwidth, Some(axes), "")),
    };
    let page = ReportPicture {
        title,
        subtitle: &figures(job),
        before: panel(0),
        after: panel(1),
        triangles: &surfaces[0].triangles,
        scale_max: Some(strongest(colors.iter().map(Vec::as_slice)).max(PALE)),
        scale_label: SCALE_LABEL,
    };
    page.canvas()
}

/// The votes of `found` in the two main axes of transformation space, clusters marked: symmetries
/// by their ids, modes that are none in grey.
pub fn density(found: &Detected, bandwidth: f64, title: &str) -> Canvas {
    let projection = Projection::new(found.detection.clouds[0].votes.points());
    let votes = Votes::new(found, found, &projection);
    votes.plot(bandwidth, None, title).canvas(PLOT_SIDE)
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
    let after = &result.asymmetry;
    format!(
        "mean asymmetry {:.2} → {:.2} % of D   ·   99th percentile {:.1} → {:.1} %   ·   largest {:.1} → {:.1} %",
        before.mean, after.mean, before.p99, after.p99, before.max, after.max
    )
}

fn colored_planes(found: &Detected) -> Vec<(Plane, [u8; 3])> {
    let highest = found.symmetries().iter().take(PLANES);
    highest
        .map(|s| (s.plane(), categorical(s.id as usize)))
        .collect()
}

/// The square around the votes and marks of both states.
fn common_axes(votes: &[Votes; 2], bandwidth: f64) -> Extent {
    let points = votes.iter().flat_map(|v| &v.points);
    let marks = votes.iter().flat_map(|v| &v.modes).map(|m| &m.position);
    Extent::around(points.chain(marks), bandwidth)
}

/// The votes of a state, projected.
struct Votes {
    points: Vec<[f64; 2]>,
    weights: Vec<f64>,
    modes: Vec<PlotMode>,
}

impl Votes {
    /// The votes of `state` in the transformation space of `home`, so that the states of one job
    /// can be compared.
    fn new(state: &Detected, home: &Detected, projection: &Projection) -> Self {
        let found = &state.detection;
        let place = |t: &Isometry| projection.project(&home.detection.space.embed(t));
        let mark = |t: &Isometry, height, label, color| PlotMode {
            position: place(t),
            label,
            height,
            color,
        };
        let refused = found.refused.iter();
        let refused = refused.map(|r| mark(&r.q_from_p, r.height, String::new(), REFUSED_COLOR));
        let symmetries = found.symmetries.iter();
        let symmetries =
            symmetries.map(|s| mark(&s.q_from_p, s.height, s.id.to_string(), s.id as usize));
        Self {
            points: found.clouds[0]
                .pairs
                .iter()
                .map(|v| place(&v.q_from_p))
                .collect(),
            weights: found.clouds[0].pairs.iter().map(|v| v.weight).collect(),
            modes: symmetries.chain(refused).collect(),
        }
    }

    fn plot<'a>(&'a self, bandwidth: f64, axes: Option<Extent>, title: &'a str) -> DensityPlot<'a> {
        DensityPlot {
            points: &self.points,
            weights: &self.weights,
            modes: &self.modes,
            bandwidth: SHARPNESS * bandwidth,
            axes,
            title,
        }
    }
}
