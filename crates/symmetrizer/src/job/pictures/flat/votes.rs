//! Votes for lines as points of the plane (figure 2).

use crate::geom::Point;
use crate::job::Detected;
use crate::job::pictures::flat::SIDE;
use crate::job::pictures::hue;
use crate::optimize::outcome::mirrors;
use crate::patch::Symmetry;
use crate::picture::{Axis, Canvas, DensityPlot, Extent, PlotMode};
use crate::transform::{Isometry, Plane};

/// How far a vote is spread in plots, in units of what clustering takes.
const SHARPNESS: f64 = 0.5;
/// Half of the range of distances in plots, fraction of L: as wide as the angles, by how far images move.
const FARTHEST: f64 = std::f64::consts::FRAC_PI_8;

/// Votes as lines: half their angle in radians, and twice their distance from the centre, so that images move alike
/// along both.
pub struct Votes {
    points: Vec<[f64; 2]>,
    weights: Vec<f64>,
    modes: Vec<PlotMode>,
    bandwidth: f64,
}

/// The place of a line in the plot; its angle is the same again after half a turn, with the other sign of the
/// distance.
fn line_at(plane: &Plane) -> [f64; 2] {
    let angle = plane.normal.y.atan2(plane.normal.x);
    let turned = angle.rem_euclid(std::f64::consts::PI);
    let sign = if (turned - angle).abs() < 1e-9 || (turned - angle).abs() > 6.0 {
        1.0
    } else {
        -1.0
    };
    [turned / 2.0, 2.0 * sign * plane.offset]
}

/// The place again where it lies beside the other border.
fn wrapped([x, y]: [f64; 2]) -> [[f64; 2]; 2] {
    let whole = std::f64::consts::FRAC_PI_2;
    let other = if x < whole / 2.0 {
        x + whole
    } else {
        x - whole
    };
    [[x, y], [other, -y]]
}

/// The votes for lines of what was `found`.
pub fn density(found: &Detected, bandwidth: f64) -> Votes {
    let Some(cloud) = found.detection.clouds.first() else {
        return Votes {
            points: Vec::new(),
            weights: Vec::new(),
            modes: Vec::new(),
            bandwidth,
        };
    };
    // Every vote is its own mirror, wherever it was cast.
    let origin = Point::origin();
    let place = |t: &Isometry| line_at(&t.nearest_mirror(&origin));
    let votes = cloud.pairs.iter();
    let mark = |s: &Symmetry| PlotMode {
        position: line_at(&s.plane()),
        label: s.id.to_string(),
        height: s.height,
        color: hue(s.id),
    };
    Votes {
        points: votes
            .clone()
            .flat_map(|v| wrapped(place(&v.q_from_p)))
            .collect(),
        weights: votes.flat_map(|v| [v.weight; 2]).collect(),
        modes: mirrors(&found.detection).map(mark).collect(),
        bandwidth,
    }
}

impl Votes {
    pub fn plot<'a>(&'a self, title: &'a str) -> DensityPlot<'a> {
        DensityPlot {
            points: &self.points,
            weights: &self.weights,
            modes: &self.modes,
            bandwidth: SHARPNESS * self.bandwidth,
            axes: Some(Extent {
                x: [0.0, std::f64::consts::FRAC_PI_2],
                y: [-2.0 * FARTHEST, 2.0 * FARTHEST],
            }),
            shown: [
                Axis {
                    caption: "angle of the line's normal, degrees",
                    unit: 360.0 / std::f64::consts::PI,
                },
                Axis {
                    caption: "distance from the centre, fraction of L",
                    unit: 0.5,
                },
            ],
            title,
        }
    }

    pub fn draw(&self, page: &mut Canvas, [x, y]: [u32; 2], title: &str) {
        self.plot(title).draw(page, x, y, SIDE);
    }
}
