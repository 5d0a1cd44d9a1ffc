//! Continuous symmetries: parts of a surface that slide along themselves (Gelfand and Guibas 2004,
//! slippage analysis). Beyond the paper: the velocity field of the sliding is settled robustly on the
//! whole surface, so that the pieces of a turned part are found as one.

mod classify;
mod fit;
mod ground;
mod implies;
mod orbit;
mod params;
mod part;
mod search;
mod starts;
mod twist;

pub use params::SlipParams;
pub use search::continuous;

use crate::geom::{Point, Vector};
use crate::sample::Samples;

/// The ways in which a surface can slide along itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Slip {
    /// Turns about one axis by any angle: a surface of revolution.
    Revolution,
    /// Shifts along one direction by any length: an extrusion.
    Extrusion,
    /// Turns with a shift along the axis in proportion.
    Helix,
    /// Turns about one axis and shifts along it.
    Cylinder,
    /// Turns about one point.
    Sphere,
    /// Shifts within a plane and turns in it.
    Plane,
}

impl Slip {
    /// The name, as reports have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Revolution => "revolution",
            Self::Extrusion => "extrusion",
            Self::Helix => "helix",
            Self::Cylinder => "cylinder",
            Self::Sphere => "sphere",
            Self::Plane => "plane",
        }
    }
}

/// A continuous symmetry of a part of a surface, working coordinates.
#[derive(Debug, Clone)]
pub struct Continuous {
    /// How it slides.
    pub slip: Slip,
    /// Unit direction of the axis, of an extrusion's shift or of a plane's normal; none for a sphere.
    pub axis: Option<Vector>,
    /// A point of the axis, the middle of a sphere, a point of the plane: that nearest to the patch's
    /// centroid.
    pub point: Point,
    /// Shift per radian of a helix, fraction of L.
    pub pitch: f64,
    /// The samples of the patch, increasing.
    pub samples: Vec<u32>,
    /// The patch as a share of the surface's area.
    pub area_fraction: f64,
    /// rms angle between the slide and the surface, radians.
    pub rms: f64,
}

/// Directions of normals, this far apart (cosine), from which on an extrusion is more than flat faces.
const DIRECTION: f64 = 0.966;
const MIN_DIRECTIONS: usize = 5;

impl Continuous {
    /// Whether it is worth telling. A plane's slides, and those along the edges of a few flat faces, keep
    /// flat ground out of other symmetries; nobody would look for them.
    pub fn is_telling(&self, samples: &Samples) -> bool {
        match self.slip {
            Slip::Plane => false,
            Slip::Extrusion => {
                let mut directions: Vec<Vector> = Vec::new();
                for &i in &self.samples {
                    let n = samples.list[i as usize].crisp;
                    if directions.iter().all(|d| d.dot(&n) < DIRECTION) {
                        directions.push(n);
                    }
                }
                directions.len() >= MIN_DIRECTIONS
            }
            _ => true,
        }
    }
}
