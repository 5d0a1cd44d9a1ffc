//! From a cluster of votes to a symmetry: verification and region growing (section 2).

pub mod ground;
pub mod grow;
pub mod ids;
pub mod judge;
pub mod likeness;
pub mod params;
mod reach;
pub mod refine;
pub mod settle;
pub mod symmetry;

pub use ground::Ground;
pub use grow::{Candidate, grow_patch, grow_settled};
pub use ids::carry_ids;
pub use params::PatchParams;
pub use settle::{Settled, settled};
pub use symmetry::{PatchPair, Refusal, Symmetry};
