//! Shape files: round trips, the features of each format, messages for damaged files.

#[path = "../common/mod.rs"]
mod common;

mod corpus;
mod files;
mod gltf;
mod obj;
mod off;
mod ply;
mod properties;
mod rich;
mod shared;
mod stl;
mod threemf;
mod xyz;
