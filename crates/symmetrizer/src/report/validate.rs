//! The report on what is wrong with a mesh.

use serde::Serialize;

use crate::context::Context;
use crate::error::Warning;
use crate::report::{RunReport, SCHEMA, VERSION};
use crate::shape::Findings;

/// The report on [`Findings`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ValidateReport {
    /// [`SCHEMA`].
    pub schema: u32,
    /// Version of the library.
    pub version: &'static str,
    /// The job's seed, on which nothing here depends.
    pub seed: u64,
    /// What the user should know.
    pub warnings: Vec<Warning>,
    /// What the caller named the shape.
    pub file: Option<String>,
    /// Whether a run can work on it.
    pub works: bool,
    /// What was found.
    #[serde(flatten)]
    pub findings: Findings,
    /// Time and memory, filled in by a caller with a clock.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunReport>,
}

impl ValidateReport {
    /// The report on `findings`.
    pub fn new(findings: Findings, ctx: &Context<'_>) -> Self {
        Self {
            schema: SCHEMA,
            version: VERSION,
            seed: ctx.seed(),
            warnings: ctx.warnings().to_vec(),
            file: None,
            works: findings.works(),
            findings,
            run: None,
        }
    }
}
