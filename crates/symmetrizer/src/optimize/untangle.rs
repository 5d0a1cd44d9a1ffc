//! Undoing displacements where they would push the surface through itself: fingers of a fist that
//! another hand has open, teeth, folds.

use crate::geom::{Point, PointIndex, Vector};
use crate::shape::Surface;
use crate::shape::crossings::{Crossings, faces_of, new_crossings};

/// Attempts at the most, each reaching further.
const ATTEMPTS: usize = 5;

/// Displacements fade in over this distance from a crossing, in the first attempt, fraction of L.
const FADE: f64 = 0.015;

/// The surface between `before` and `after` (the same triangles) that is `after` except near faces that
/// cross in it and did not in `before`: there it goes back, smoothly, to `before`.
///
/// Returns the surface and the share of its area that went back by half or more.
pub fn untangle(before: &Surface, after: Surface) -> (Surface, f64) {
    let mut crossings = Crossings::new(before);
    let old = faces_of(&crossings.among(before, |_| true));
    crossings.follow(&after);
    let mut pairs = crossings.among(&after, |_| true);
    let mut kept = vec![1.0_f64; before.positions.len()];
    let mut now = after.clone();
    for attempt in 0..ATTEMPTS {
        let new = new_crossings(&old, &faces_of(&pairs));
        if new.is_empty() {
            break;
        }
        let fade = FADE * (1.0 + 0.5 * attempt as f64);
        restrain(&mut kept, before, &new, fade);
        let next = blended(before, &after, &kept);
        // Only what moved by it can cross anew.
        let changed = changed_faces(&now, &next);
        now = next;
        crossings.follow(&now);
        pairs.retain(|pair| pair.iter().all(|&f| !changed[f as usize]));
        pairs.extend(crossings.among(&now, |f| changed[f as usize]));
    }
    let areas = kept.iter().zip(&before.vertex_areas);
    let back: f64 = areas.filter(|(k, _)| **k <= 0.5).map(|(_, a)| a).sum();
    let share = back / before.area();
    (now, share)
}

/// `before` with the share `kept` of each vertex's way to `after`.
fn blended(before: &Surface, after: &Surface, kept: &[f64]) -> Surface {
    let blend = |v: usize| -> Point {
        let moved: Vector = after.positions[v] - before.positions[v];
        before.positions[v] + kept[v] * moved
    };
    before.with_positions((0..kept.len()).map(blend).collect())
}

/// Whether a face has a corner that lies elsewhere.
fn changed_faces(before: &Surface, after: &Surface) -> Vec<bool> {
    let moved = |&v: &u32| before.positions[v as usize] != after.positions[v as usize];
    let changed = |corners: &[u32; 3]| corners.iter().any(moved);
    before.triangles.iter().map(changed).collect()
}

/// Lowers the share of the displacement that is kept to 0 at the faces and smoothly less around them.
fn restrain(kept: &mut [f64], surface: &Surface, faces: &[u32], fade: f64) {
    let centers: Vec<[f64; 3]> = faces
        .iter()
        .flat_map(|&f| surface.corners(f))
        .map(|p| p.coords.into())
        .collect();
    let index = PointIndex::new(&centers);
    for (v, x) in surface.positions.iter().enumerate() {
        let Some((_, d2)) = index.nearest(&x.coords.into()) else {
            continue;
        };
        let s = (d2.sqrt() / fade - 0.25).clamp(0.0, 1.0);
        kept[v] = kept[v].min(s * s * (3.0 - 2.0 * s));
    }
}
