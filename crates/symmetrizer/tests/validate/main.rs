//! What is found in meshes whose faults are known, kind by kind, with counts and places.

#[path = "../common/mod.rs"]
mod common;
mod faces;
mod files;
mod joined;

use symmetrizer::Mesh;
use symmetrizer::geom::Point;
use symmetrizer::shape::mesh::Polygons;
use symmetrizer::shape::validate::{Finding, Findings, Kind};

fn mesh(positions: &[[f64; 3]], faces: &[&[u32]]) -> Mesh {
    let mut polygons = Polygons::default();
    faces.iter().for_each(|f| polygons.push(f));
    Mesh {
        positions: positions.iter().map(|p| Point::from(*p)).collect(),
        polygons,
    }
}

/// Digits beyond single precision, so that the finding on precision stays out of the way.
const S: f64 = 1.000_000_000_1;
const TETRAHEDRON: [[f64; 3]; 4] = [[0.0; 3], [S, 0.0, 0.0], [0.0, S, 0.0], [0.0, 0.0, S]];
const OUTWARDS: [&[u32]; 4] = [&[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[1, 2, 3]];

/// Kinds and counts in the order in which they are told.
fn told(found: &Findings) -> Vec<(Kind, usize)> {
    found.findings.iter().map(|f| (f.kind, f.count)).collect()
}

#[track_caller]
fn finding(found: &Findings, kind: Kind) -> &Finding {
    found
        .get(kind)
        .unwrap_or_else(|| panic!("no {kind:?} in {:?}", told(found)))
}

#[track_caller]
fn check(mesh: &Mesh, expected: &[(Kind, usize)]) -> Findings {
    let found = Findings::of(mesh);
    assert_eq!(told(&found), expected);
    found
}
