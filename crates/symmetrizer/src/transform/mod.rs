//! Isometries, the space they form, and the closed forms of section 3 and appendix A.

pub mod isometry;

pub use isometry::Isometry;
