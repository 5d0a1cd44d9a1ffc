//! Shapes of the plane: their lines, bends and turns, and what is made of them.
#![allow(clippy::print_stdout)]
#[path = "../common/mod.rs"]
mod common;
mod shared;

mod bent;
mod exact;
mod inside;
mod lines;
mod tangled;
mod turns;
