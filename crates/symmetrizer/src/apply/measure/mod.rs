//! Numbers for the report: how symmetric a shape is, and what a deformation did to it.

pub mod asymmetry;
pub mod curvature;
pub mod distortion;
pub mod plane;
mod refine;
mod report;
mod search;
mod volume;

pub use crate::shape::inverted::inverted_faces;
pub use asymmetry::{Asymmetry, NearPlane, asymmetry, asymmetry_of_outline, per_vertex};
pub use curvature::{curvature_correlation, mean_curvature};
pub use distortion::{Distortion, distortion};
pub use plane::distortion_of_outline;
pub use report::{AsymmetryReport, Measure, NearReport, PlaneReport};

/// The smallest of `sorted` that at least the share `p` of them do not exceed; 0 of none.
fn percentile(sorted: &[f64], p: f64) -> f64 {
    let rank = (p * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0)
}
