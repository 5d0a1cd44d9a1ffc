//! The plot of transformation space: a density for each class of isometries that was looked for.

use crate::cluster::Projection;
use crate::job::Detected;
use crate::job::pictures::{flat, hue};
use crate::picture::canvas::Text;
use crate::picture::{Canvas, DensityPlot, Extent, PlotMode};
use crate::report::refusals::highest_of;
use crate::shape::validate::grouped;
use crate::transform::Isometry;

/// Side of the plot, pixels: of one alone, of each of several.
const SIDES: [u32; 2] = [900, 640];
/// Space for the title above several plots, pixels.
const TITLE: u32 = 44;
/// The colour of clusters that are no symmetries: grey.
const REFUSED_COLOR: usize = 9;
/// How far a vote is spread in plots, in units of what clustering takes: less shows the ridges
/// between clusters.
const SHARPNESS: f64 = 0.5;

/// The votes of `found`, each class in the two main axes of its own cloud, clusters marked: symmetries
/// by their ids, the highest modes that are none in grey.
pub fn density(found: &Detected, bandwidth: f64, title: &str) -> Canvas {
    if let Some(page) = flat::plotted(found, bandwidth, title) {
        return page;
    }
    let clouds = &found.detection.clouds;
    let side = SIDES[usize::from(clouds.len() > 1)];
    let top = if title.is_empty() { 0 } else { TITLE };
    let mut canvas = Canvas::new(side * clouds.len().max(1) as u32, side + top);
    let width = f64::from(canvas.width()) - 32.0;
    canvas.text(Text::new(title, 16.0, 28.0, 20.0).bold().within(width));
    for (cloud, of_class) in clouds.iter().enumerate() {
        let projection = Projection::new(of_class.votes.points());
        let votes = Votes::new(found, cloud, found, &projection);
        let title = plot_title(found, cloud);
        let plot = votes.plot(bandwidth, None, &title);
        plot.draw(&mut canvas, cloud as u32 * side, top, side);
    }
    canvas
}

/// What a cloud has: "mirrors: 9,000 votes, 2 symmetries".
pub fn plot_title(found: &Detected, cloud: usize) -> String {
    let cloud = &found.detection.clouds[cloud];
    let of_class = found.symmetries().iter().filter(|s| s.class == cloud.class);
    let symmetries = match of_class.count() {
        1 => "1 symmetry".to_owned(),
        n => format!("{n} symmetries"),
    };
    let votes = grouped(cloud.pairs.len());
    format!("{}: {votes} votes, {symmetries}", cloud.class.members())
}

/// The votes of a cloud, projected.
pub(super) struct Votes {
    pub points: Vec<[f64; 2]>,
    pub weights: Vec<f64>,
    pub modes: Vec<PlotMode>,
}

impl Votes {
    /// The votes of a cloud of `state` in the transformation space of `home`, so that the states of one
    /// job can be compared.
    pub fn new(state: &Detected, cloud: usize, home: &Detected, projection: &Projection) -> Self {
        let cloud = &state.detection.clouds[cloud];
        let place = |t: &Isometry| projection.project(&home.detection.space.embed(t));
        let mark = |t: &Isometry, height, label, color| PlotMode {
            position: place(t),
            label,
            height,
            color,
        };
        let refused = highest_of(state).into_iter();
        let refused = refused
            .filter(|r| r.class == cloud.class)
            .map(|r| mark(&r.q_from_p, r.height, String::new(), REFUSED_COLOR));
        let symmetries = state.symmetries().iter();
        let symmetries = symmetries
            .filter(|s| s.class == cloud.class)
            .map(|s| mark(&s.q_from_p, s.height, s.id.to_string(), hue(s.id)));
        Self {
            points: cloud.pairs.iter().map(|v| place(&v.q_from_p)).collect(),
            weights: cloud.pairs.iter().map(|v| v.weight).collect(),
            modes: symmetries.chain(refused).collect(),
        }
    }

    /// The plot, in its own axes or in those given.
    pub fn plot<'a>(
        &'a self,
        bandwidth: f64,
        axes: Option<Extent>,
        title: &'a str,
    ) -> DensityPlot<'a> {
        DensityPlot {
            points: &self.points,
            weights: &self.weights,
            modes: &self.modes,
            bandwidth: SHARPNESS * bandwidth,
            shown: Default::default(),
            axes,
            title,
        }
    }
}
