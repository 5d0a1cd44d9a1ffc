//! What symmetries are good for: uses of a detected or enforced symmetry.

pub mod measure;
