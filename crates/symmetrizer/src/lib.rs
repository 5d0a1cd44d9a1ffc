//! Makes nearly symmetric shapes symmetric, after *Symmetrization* (Mitra, Guibas, Pauly 2007).
//!
//! The modules stand on floors and use only what is below them; a test keeps it so
//! (`tests/floors.rs`). Read upwards, they are the pipeline of the paper.

pub mod apply;
pub mod cluster;
pub mod context;
pub mod deform;
pub mod detect;
pub mod drawing;
pub mod error;
pub mod field;
pub mod geom;
pub mod group;
pub mod job;
pub mod optimize;
pub mod pair;
pub mod params;
pub mod patch;
pub mod picture;
mod raster;
pub mod report;
pub mod sample;
pub mod shape;
pub mod slip;
pub mod straighten;
pub mod transform;

pub use context::{CancelToken, Context, Event};
pub use drawing::Drawing;
pub use error::{Error, Result, Warning};
pub use job::{
    Detected, Drawn, Measured, Symmetrized, detect_document, detect_drawing, detect_in,
    measure_drawing, measure_in, symmetrize, symmetrize_drawing, symmetrize_drawing_with,
    symmetrize_with, unbend, unbend_drawing,
};
pub use optimize::Outcome;
pub use params::Params;
pub use report::Report;
pub use shape::mesh::Mesh;

/// The README's example, compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
