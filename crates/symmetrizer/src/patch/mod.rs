//! From a cluster of votes to a symmetry: verification and region growing (section 2).

pub mod grow;
pub mod ids;
pub mod judge;
pub mod likeness;
pub mod refine;
pub mod symmetry;

pub use grow::{PatchParams, grow_patch};
pub use ids::carry_ids;
pub use symmetry::{PatchPair, Refusal, Symmetry};
