//! Makes nearly symmetric shapes symmetric, after *Symmetrization* (Mitra, Guibas, Pauly 2007).
//!
//! The modules stand on floors and use only what is below them; a test keeps it so
//! (`tests/floors.rs`). Read upwards, they are the pipeline of the paper.

pub mod context;
pub mod error;
pub mod geom;
pub mod picture;
pub mod shape;
pub mod transform;

pub use context::{CancelToken, Context, Event};
pub use error::{Error, Result, Warning};
pub use shape::mesh::Mesh;
