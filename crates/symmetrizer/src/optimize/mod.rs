//! Section 4: samples glide, clusters contract, clusters merge, the rest follows.

mod aim;
mod balance;
mod contact;
pub mod contract;
pub mod ease;
pub mod finish;
pub mod glide;
pub mod mend;
pub mod merge;
pub mod moving;
pub mod orbit;
pub mod outcome;
pub mod params;
mod part;
pub mod plan;
mod rounds;
pub mod schedule;
pub mod tangles;
mod tidy;
mod uncross;
pub mod untangle;

pub use mend::mend;
pub use outcome::{Met, Optimized, Outcome, Step};
pub use params::OptimizeParams;
pub use schedule::{complete, optimize};
