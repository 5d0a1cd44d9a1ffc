//! Faces with more than three corners: how many, how flat, how they are cut.

use std::ops::RangeInclusive;

use super::faces::Faces;
use super::finding::{Finding, Place, Tally};
use super::kind::Kind;
use crate::geom::{Point, Vector};

/// How far the corners of a face may be off its plane, as a share of its half width.
const BEND: f64 = 0.01;
/// How much of a face may be folded over, as a share of its area.
const FOLD: f64 = 1e-6;

/// The findings on faces with more than three corners.
pub(super) fn findings(faces: &Faces<'_>) -> Vec<Finding> {
    let polygons = &faces.mesh.polygons;
    let with_corners = |range: RangeInclusive<usize>| -> Tally {
        let these = (0..polygons.len()).filter(|&f| range.contains(&polygons.get(f).len()));
        these.map(|f| f as u32).collect()
    };
    let mut bent = Tally::default();
    let mut folded = Tally::default();
    let at = |v: u32| faces.mesh.positions[v as usize];
    for triangles in faces.cut.chunk_by(|a, b| a.1 == b.1) {
        let face = triangles[0].1;
        if triangles.len() < 2 || !faces.can_be_cut(face as usize) {
            continue;
        }
        let areas: Vec<Vector> = triangles.iter().map(|(t, _)| area(t.map(at))).collect();
        let across: Vector = areas.iter().sum();
        let corners = polygons.get(face as usize).iter().map(|&v| at(v));
        if is_bent(&corners.collect::<Vec<_>>(), &across) {
            bent.add(Place::One(face));
        }
        if folds(&areas, &across) {
            folded.add(Place::One(face));
        }
    }
    vec![
        Finding::new(Kind::Bent, bent),
        Finding::new(Kind::Folded, folded),
        Finding::new(Kind::Polygon, with_corners(5..=usize::MAX)),
        Finding::new(Kind::Quad, with_corners(4..=4)),
    ]
}

/// Twice the area of a triangle, as a vector across it.
fn area([a, b, c]: [Point; 3]) -> Vector {
    (b - a).cross(&(c - a))
}

fn is_bent(corners: &[Point], across: &Vector) -> bool {
    let center = corners.iter().map(|p| p.coords).sum::<Vector>() / corners.len() as f64;
    let Some(normal) = across.try_normalize(0.0) else {
        return false;
    };
    let arms = corners.iter().map(|p| p.coords - center);
    let width = arms.clone().map(|a| a.norm()).fold(0.0, f64::max);
    let off = arms.map(|a| a.dot(&normal).abs()).fold(0.0, f64::max);
    off > BEND * width
}

fn folds(areas: &[Vector], across: &Vector) -> bool {
    let against = areas.iter().map(|a| -a.dot(across));
    against.fold(0.0, f64::max) > FOLD * across.norm_squared()
}
