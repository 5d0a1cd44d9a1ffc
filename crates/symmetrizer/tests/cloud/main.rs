//! Point clouds: normals, their side, discs, and the symmetries found on them.

#[path = "../common/mod.rs"]
mod common;

mod bad;
mod drawn;
mod normals;
mod symmetries;
