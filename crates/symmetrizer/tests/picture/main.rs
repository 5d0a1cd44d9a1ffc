//! Pictures show what they should, whatever the input.

mod look;
mod models;
mod pages;
mod rendering;
mod stances;
