//! Section 4: samples glide, clusters contract, clusters merge, the rest follows.

mod aim;
pub mod contract;
pub mod finish;
pub mod glide;
pub mod merge;
pub mod moving;
pub mod orbits;
pub mod outcome;
pub mod params;
mod rounds;
pub mod schedule;
mod tidy;
pub mod untangle;

pub use outcome::{Optimized, Outcome, Step};
pub use params::OptimizeParams;
pub use schedule::{complete, optimize};
