//! The verbs: arguments and course of each.

pub mod convert;
pub mod detect;
pub mod measure;
pub mod params;
pub mod plot;
pub mod render;
pub mod run;
pub mod validate;
