//! Faces that pass through each other.

use std::sync::Arc;

use super::faces::Faces;
use super::finding::{Finding, Tally};
use super::kind::Kind;
use super::size::Size;
use crate::geom::Point;
use crate::shape::crossings::crossing_faces;
use crate::shape::surface::Surface;

/// Triangles above which crossings are not looked for.
const MOST: usize = 500_000;

/// The faces that cross others, or a note that there are too many to look.
pub(super) fn finding(faces: &Faces<'_>, size: Option<&Size>) -> Finding {
    let count = faces.triangles.len();
    if count > MOST {
        return Finding::new(Kind::CrossingSkipped, Tally::of(count));
    }
    let mut crossing: Vec<u32> = size
        .and_then(|size| surface(faces, size))
        .map(|surface| crossing_faces(&surface))
        .unwrap_or_default()
        .into_iter()
        .map(|t| faces.face_of[t as usize])
        .collect();
    crossing.dedup();
    Finding::new(Kind::Crossing, crossing.into_iter().collect())
}

/// The joined surface with its box about the origin and a diagonal of 1.
fn surface(faces: &Faces<'_>, size: &Size) -> Option<Surface> {
    let usable = size.diagonal > 0.0 && size.diagonal.is_finite() && !faces.triangles.is_empty();
    let positions = faces.mesh.positions.iter();
    let place = |p: &Point| Point::from((p - size.center()) / size.diagonal);
    usable.then(|| {
        let triangles: Arc<[[u32; 3]]> = faces.triangles.as_slice().into();
        Surface::new(positions.map(place).collect(), triangles)
    })
}
