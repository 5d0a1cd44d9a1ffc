//! Drawings: what is read, what comes back, and what is refused.

#[path = "../common/mod.rs"]
mod common;
mod shared;

mod bad;
mod bitmaps;
mod others;
mod real;
mod shapes;
mod writing;
