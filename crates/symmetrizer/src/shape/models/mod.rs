//! Generated shapes, for first steps, examples and tests: no file and no licence needed.

mod anatomy;
mod creature;
mod field;
mod mesher;

pub use creature::Creature;
