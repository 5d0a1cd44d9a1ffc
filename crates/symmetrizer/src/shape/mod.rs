//! Shapes: the document with the file's own structure, the working surface the stages run
//! on, points on a surface, closest points, curvature, files, generated models.

pub mod boundary;
pub mod closest;
pub mod cloud;
pub mod crossings;
pub mod curvature;
pub mod document;
pub mod fairing;
pub mod inverted;
pub mod io;
pub mod mesh;
pub mod models;
pub mod sheet;
pub mod surface;
mod triangles_cross;
pub mod triangulate;
pub mod validate;
pub mod wall;
pub mod working;

pub use closest::{ClosestPoint, Hit};
pub use document::Document;
pub use mesh::Mesh;
pub use surface::{Surface, SurfacePoint};
pub use validate::{Findings, Validation};
pub use working::Working;
