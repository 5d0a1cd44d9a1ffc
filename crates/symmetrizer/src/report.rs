//! The report of a job as JSON, the same bytes for any number of threads but for its `run` part.
//!
//! Lengths of the document (`diagonal`, `scale`, `offset`, matrices) are in document units; `rms`,
//! distances and costs of symmetries and steps are in fractions of the scale L (costs: of L^2);
//! asymmetry and distortion are in percent of the diagonal D.

pub mod bend;
pub mod faces;
pub mod groups;
mod json;
pub mod place;
pub mod refusals;
pub mod symmetry;
mod validate;

use serde::Serialize;

use crate::apply::measure::{AsymmetryReport, Distortion};
use crate::context::Context;
use crate::error::{Error, Result, Warning};
use crate::job::{Detected, Measured};
use crate::optimize::{Outcome, Step};
use crate::params::Params;
use crate::report::faces::FaceSamples;
use crate::shape::working::Working;
use crate::shape::{Mesh, Validation};

pub use bend::{BendReport, KeptReport};
pub use groups::{ContinuousReport, ExactReport, GroupReport};
pub use refusals::{RefusalReport, RefusedCount};
pub use symmetry::SymmetryReport;
pub use validate::ValidateReport;

/// The number of the report's format; it changes when a key changes its meaning.
pub const SCHEMA: u32 = 1;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What every report begins with.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Head {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the library.
    pub version: &'static str,
    /// The job's seed.
    pub seed: u64,
    /// All parameters, those left at their defaults too.
    pub params: Params,
}

/// The report of [`crate::symmetrize`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Format, version, seed, parameters.
    #[serde(flatten)]
    pub head: Head,
    /// How the run ended.
    pub outcome: Outcome,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// The stiffness that was asked for; none where it is 1 everywhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<StiffnessReport>,
    /// The shape as it came.
    pub input: InputReport,
    /// The bend that its local mirrors have; none where they are one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bend: Option<BendReport>,
    /// The shape as it went; none where no symmetry was found.
    pub result: Option<ResultReport>,
    /// What was done, in order.
    pub steps: Vec<Step>,
    /// Time and memory, filled in by a caller with a clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunReport>,
}

/// The report of [`crate::detect_in`]: that of a run without its second half.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DetectReport {
    /// Format, version, seed, parameters.
    #[serde(flatten)]
    pub head: Head,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// The shape and what was found in it.
    pub input: InputReport,
    /// Time and memory, filled in by a caller with a clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunReport>,
}

/// The report of [`crate::measure_in`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the library.
    pub version: &'static str,
    /// The job's seed.
    pub seed: u64,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// The shape.
    pub input: ShapeReport,
    /// What the caller named the original.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub against: Option<String>,
    /// How the shape differs from it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distortion: Option<Distortion>,
    /// Time and memory, filled in by a caller with a clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunReport>,
}

/// How stiff the shape was.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StiffnessReport {
    /// What the caller named the field; none for a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The least over the faces, a multiple of the usual.
    pub min: f64,
    /// The greatest.
    pub max: f64,
}

impl StiffnessReport {
    /// Of these values for each face.
    pub fn new(per_face: &[f64]) -> Self {
        Self {
            file: None,
            min: per_face.iter().copied().fold(f64::INFINITY, f64::min),
            max: per_face.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// A shape.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShapeReport {
    /// What the caller named it.
    pub file: Option<String>,
    /// Vertices of the document.
    pub vertices: usize,
    /// Triangles after fan triangulation of the document.
    pub faces: usize,
    /// The document's polygon of each triangle; none where it has triangles only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_faces: Option<Vec<u32>>,
    /// The bounding-box diagonal D, document units.
    pub diagonal: f64,
    /// The scale L, document units.
    pub scale: f64,
    /// Counts of what is unusual.
    pub validate: Validation,
    /// How far from symmetric; none where nobody asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub asymmetry: Option<AsymmetryReport>,
}

/// A shape and its symmetries before anything was done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputReport {
    /// The shape.
    #[serde(flatten)]
    pub shape: ShapeReport,
    /// The symmetries found, the highest first.
    pub symmetries: Vec<SymmetryReport>,
    /// Which of them belong together.
    pub groups: Vec<GroupReport>,
    /// Parts that slide along themselves.
    pub continuous: Vec<ContinuousReport>,
    /// The highest clusters of each class that were looked at and are no symmetries.
    pub refused: Vec<RefusalReport>,
    /// All of those by reason.
    pub refused_counts: Vec<RefusedCount>,
}

/// A shape and its symmetries after the work.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResultReport {
    /// How far from symmetric.
    pub asymmetry: AsymmetryReport,
    /// What became of the shape besides.
    pub distortion: Distortion,
    /// Deformation energy, about the mean square strain.
    pub energy: f64,
    /// Groups, rows, copies and single symmetries that were made exact beside the mirror of the whole, as they are.
    pub exact: Vec<ExactReport>,
    /// The symmetries found, those of the input under their ids.
    pub symmetries: Vec<SymmetryReport>,
}

/// What a run took; not part of what must be the same every time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunReport {
    /// Time of each stage, in the order in which they first began.
    pub timings: Vec<Timing>,
    /// Threads that worked.
    pub threads: usize,
    /// Largest resident memory, bytes, where the system tells.
    pub peak_memory: Option<u64>,
}

/// The time that a stage took.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Timing {
    /// The stage; one within another is `outer/inner` and counts there too.
    pub stage: String,
    /// How often it ran.
    pub runs: usize,
    /// Seconds, all its runs together.
    pub seconds: f64,
}

impl Head {
    /// The head of a report on work done with `params` and `ctx`.
    pub fn new(params: &Params, ctx: &Context<'_>) -> Self {
        Self {
            schema: SCHEMA,
            version: VERSION,
            seed: ctx.seed(),
            params: params.clone(),
        }
    }
}

impl DetectReport {
    /// The report on what was found in `mesh`.
    pub fn new(mesh: &Mesh, found: &Detected, params: &Params, ctx: &Context<'_>) -> Self {
        Self {
            head: Head::new(params, ctx),
            warnings: ctx.warnings().to_vec(),
            input: InputReport::new(mesh, found, &FaceSamples::of(found), None),
            run: None,
        }
    }
}

impl MeasureReport {
    /// The report on `mesh`, of which `measured` are the figures.
    pub fn new(mesh: &Mesh, measured: &Measured, ctx: &Context<'_>) -> Self {
        let asymmetry = AsymmetryReport::new(&measured.asymmetry, &measured.working.normalization);
        Self {
            schema: SCHEMA,
            version: VERSION,
            seed: ctx.seed(),
            warnings: ctx.warnings().to_vec(),
            input: ShapeReport::new(mesh, &measured.working, Some(asymmetry)),
            against: None,
            distortion: measured.distortion,
            run: None,
        }
    }
}

impl ShapeReport {
    /// The report on `mesh`, of which `working` is the working surface.
    pub fn new(mesh: &Mesh, working: &Working, asymmetry: Option<AsymmetryReport>) -> Self {
        let file_faces: Vec<u32> = mesh.triangles().map(|(_, polygon)| polygon).collect();
        Self {
            file: None,
            vertices: mesh.positions.len(),
            faces: file_faces.len(),
            file_faces: (file_faces.len() != mesh.polygons.len()).then_some(file_faces),
            diagonal: mesh.diagonal(),
            scale: working.normalization.scale,
            validate: Validation::of(mesh, working),
            asymmetry,
        }
    }
}

impl ShapeReport {
    /// Mean asymmetry, % of D; 0 where it was not measured.
    pub fn mean_asymmetry(&self) -> f64 {
        self.asymmetry.as_ref().map_or(0.0, |a| a.mean)
    }
}

impl InputReport {
    /// The report on `mesh` and what was `found` in it.
    pub fn new(
        mesh: &Mesh,
        found: &Detected,
        faces: &FaceSamples,
        asymmetry: Option<AsymmetryReport>,
    ) -> Self {
        Self {
            shape: ShapeReport::new(mesh, &found.working, asymmetry),
            symmetries: symmetry::all(found, faces),
            groups: groups::groups(found, faces),
            continuous: groups::continuous(found, faces),
            refused: refusals::highest(found),
            refused_counts: refusals::counts(found),
        }
    }
}

/// A report as the text of a JSON file: an object's keys on lines of their own, lists of numbers on
/// one line.
///
/// # Errors
/// [`Error::Unsupported`] for a value that JSON cannot hold, which no report of ours has.
pub fn to_json(report: &impl Serialize) -> Result<String> {
    json::pretty(report).map_err(|e| Error::Unsupported(format!("the report: {e}")))
}
