//! Orbits: equation 1 for any number of copies.
//!
//! Of two places that a symmetry exchanges each moves half of the way (section 3); of the k copies of a place that
//! a group, a row or a slide makes, each moves to where their mean is for it. Several goals share one surface: a
//! place that is in the orbits of more than one moves to the mean of all its copies, so that goals that go together
//! are all met and goals that do not are told by what is left of them.

pub mod contract;
pub mod freedom;
pub mod goal;
mod ground;
pub mod joint;
pub mod means;
pub mod merge;
pub mod rounds;
pub mod schedule;
mod slides;

pub use goal::{Goal, Link, Orbit};
pub use joint::{Parts, jointed};
pub use merge::merge;
pub use rounds::apart;
pub use schedule::orbits;
