//! The measurements as the report has them: planes in document coordinates.

use serde::Serialize;

use crate::apply::measure::asymmetry::{Asymmetry, asymmetry};
use crate::apply::measure::distortion::{Distortion, distortion};
use crate::context::Context;
use crate::error::Result;
use crate::shape::Surface;
use crate::shape::working::Normalization;
use crate::transform::isometry::Plane;

/// What `measure` says of one state of a shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Measure {
    /// How far the shape is from symmetric.
    pub asymmetry: AsymmetryReport,
    /// What became of the shape it was made from, where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distortion: Option<Distortion>,
}

/// [`Asymmetry`] with its planes in document coordinates; distances in percent of D.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AsymmetryReport {
    /// Mean distance of the mirrored samples from the surface.
    pub mean: f64,
    /// Root mean square.
    pub rms: f64,
    /// 95th percentile.
    pub p95: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Largest.
    pub max: f64,
    /// The plane that minimises the mean.
    #[serde(flatten)]
    pub plane: PlaneReport,
    /// Other planes that are nearly as good, best first.
    pub also_near: Vec<NearReport>,
}

/// A near-equal plane in document coordinates.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NearReport {
    /// Mean distance, percent of D.
    pub mean: f64,
    /// The plane.
    #[serde(flatten)]
    pub plane: PlaneReport,
}

/// The plane n.x = offset in document coordinates, largest component of n positive.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PlaneReport {
    /// Unit normal n.
    pub normal: [f64; 3],
    /// Offset, document units.
    pub offset: f64,
}

impl Measure {
    /// Measures one state of a shape; `diagonal` and `candidates` in working units, see
    /// [`asymmetry`].
    ///
    /// # Errors
    /// Those of [`asymmetry`].
    pub fn of(
        surface: &Surface,
        normalization: &Normalization,
        diagonal: f64,
        candidates: &[Plane],
        ctx: &Context<'_>,
    ) -> Result<Self> {
        let asymmetry = asymmetry(surface, diagonal, candidates, ctx)?;
        Ok(Self {
            asymmetry: AsymmetryReport::new(&asymmetry, normalization),
            distortion: None,
        })
    }

    /// The same with the distortion from `before` to `after`; `diagonal` is that of `before`.
    pub fn with_distortion(self, before: &Surface, after: &Surface, diagonal: f64) -> Self {
        Self {
            distortion: Some(distortion(before, after, diagonal)),
            ..self
        }
    }
}

impl AsymmetryReport {
    /// The figures of `asymmetry`, its planes taken to document coordinates.
    pub fn new(asymmetry: &Asymmetry, normalization: &Normalization) -> Self {
        let near = |n: &super::NearPlane| NearReport {
            mean: n.mean,
            plane: PlaneReport::new(&n.plane, normalization),
        };
        Self {
            mean: asymmetry.mean,
            rms: asymmetry.rms,
            p95: asymmetry.p95,
            p99: asymmetry.p99,
            max: asymmetry.max,
            plane: PlaneReport::new(&asymmetry.plane, normalization),
            also_near: asymmetry.also_near.iter().map(near).collect(),
        }
    }
}

impl PlaneReport {
    /// `plane` (working coordinates) in document coordinates.
    pub fn new(plane: &Plane, normalization: &Normalization) -> Self {
        let n = plane.normal;
        let document = Plane {
            normal: n,
            offset: n.dot(&normalization.center.coords) + plane.offset * normalization.scale,
        }
        .canonical();
        Self {
            normal: document.normal.into(),
            offset: document.offset,
        }
    }
}
