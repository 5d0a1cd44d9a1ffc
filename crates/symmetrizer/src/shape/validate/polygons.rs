//! Faces with more than three corners: how many, how flat, how they are cut.

use rayon::prelude::*;

use super::faces::Faces;
use super::finding::{Finding, Tally};
use super::kind::Kind;
use crate::geom::{Point, Vector};

/// How far the corners of a face may be off its plane, as a share of its half width.
const BEND: f64 = 0.01;
/// How much of a face may be folded over, as a share of its area.
const FOLD: f64 = 1e-6;

/// The findings on faces with more than three corners.
pub(super) fn findings(faces: &Faces<'_>) -> Vec<Finding> {
    let polygons = &faces.mesh.polygons;
    let of = |wanted: &(dyn Fn(usize) -> bool + Sync)| -> Tally {
        let these = (0..polygons.len()).into_par_iter().filter(|&f| wanted(f));
        let these: Vec<u32> = these.map(|f| f as u32).collect();
        these.into_iter().collect()
    };
    let corners = |f: usize| -> Option<Vec<Point>> {
        let polygon = polygons.get(f);
        let positions = polygon.iter().map(|&v| faces.mesh.positions[v as usize]);
        (polygon.len() > 3 && faces.can_be_cut(f)).then(|| positions.collect())
    };
    vec![
        Finding::new(Kind::Bent, of(&|f| corners(f).is_some_and(|c| is_bent(&c)))),
        Finding::new(Kind::Folded, of(&|f| corners(f).is_some_and(|c| folds(&c)))),
        Finding::new(Kind::Polygon, of(&|f| polygons.get(f).len() > 4)),
        Finding::new(Kind::Quad, of(&|f| polygons.get(f).len() == 4)),
    ]
}

/// The doubled areas of the triangles into which a face is cut, as vectors across them.
fn areas(corners: &[Point]) -> impl Iterator<Item = Vector> {
    let from_first = |p: &Point| p - corners[0];
    corners[1..]
        .windows(2)
        .map(move |w| from_first(&w[0]).cross(&from_first(&w[1])))
}

fn is_bent(corners: &[Point]) -> bool {
    let center = corners.iter().map(|p| p.coords).sum::<Vector>() / corners.len() as f64;
    let across: Vector = areas(corners).sum();
    let Some(normal) = across.try_normalize(0.0) else {
        return false;
    };
    let arms = corners.iter().map(|p| p.coords - center);
    let width = arms.clone().map(|a| a.norm()).fold(0.0, f64::max);
    let off = arms.map(|a| a.dot(&normal).abs()).fold(0.0, f64::max);
    off > BEND * width
}

fn folds(corners: &[Point]) -> bool {
    let across: Vector = areas(corners).sum();
    let against = areas(corners).map(|a| -a.dot(&across));
    against.fold(0.0, f64::max) > FOLD * across.norm_squared()
}
