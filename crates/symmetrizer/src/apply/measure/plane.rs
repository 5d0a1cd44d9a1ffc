//! What a deformation did to a shape of the plane.

use crate::apply::measure::Distortion;
use crate::apply::measure::distortion::{displacement, edge_stretch};
use crate::deform::elastic::Motion;
use crate::geom::Point;
use crate::sample::outline::turning;
use crate::shape::crossings::{crossing_faces, new_crossings};
use crate::shape::sheet::Sheet;
use crate::shape::wall::Wall;

/// Places of the outline at which it is compared how it turns.
const PLACES: usize = 1000;
/// Radius over which it does, fraction of L.
const RADIUS: f64 = 0.04;

/// Compares two states of an outline, `before` and `after`, of which `sheet` is the inside at first and `inside` the
/// places of its vertices then; `diagonal` is that of `before`, in the same (working) units.
///
/// Displacements are those of the outline, weighted by length; stretch, area and turned triangles are those of the
/// inside. Crossings count edges of the outline; the curvature is how it turns, evenly along it.
pub fn distortion_of_outline(
    (before, after): (&Wall, &Wall),
    (sheet, inside): (&Sheet, &[Point]),
    diagonal: f64,
) -> Distortion {
    let percent = 100.0 / diagonal;
    let (old, new) = (&before.surface, &after.surface);
    let back = Motion::between(&new.positions, &old.positions, &old.vertex_areas);
    let aligned: Vec<Point> = new.positions.iter().map(|x| back.apply(x)).collect();
    let (rms, max) = displacement(old, &aligned);
    let (rms_unaligned, max_unaligned) = displacement(old, &new.positions);
    let crossings = new_crossings(&crossing_faces(old), &crossing_faces(new));
    let mut edges: Vec<u32> = crossings.iter().map(|face| face / 2).collect();
    edges.dedup();
    let moved = sheet.surface.with_positions(inside.to_vec());
    Distortion {
        rms: rms * percent,
        max: max * percent,
        rms_unaligned: rms_unaligned * percent,
        max_unaligned: max_unaligned * percent,
        edge_stretch_p99: edge_stretch(&sheet.surface, &moved, 0.99),
        area_ratio: moved.area() / sheet.surface.area(),
        volume_ratio: None,
        inverted_faces: moved.face_normals.iter().filter(|n| n.z < 0.0).count(),
        new_crossings: edges.len(),
        curvature_correlation: turning_correlation(before, after),
    }
}

/// The correlation of how both states turn at the same places of the outline.
fn turning_correlation(before: &Wall, after: &Wall) -> Option<f64> {
    let total: f64 = (0..before.rings.len()).map(|r| before.length(r)).sum();
    let mut pairs: Vec<[f64; 2]> = Vec::new();
    for ring in 0..before.rings.len() {
        let length = before.length(ring);
        let count = (length / total * PLACES as f64).ceil();
        for k in 0..count as usize {
            let at = before.at(ring, k as f64 * length / count);
            let [old, new] = [before, after].map(|wall| {
                let (ring, along) = wall.along(&at);
                turning(wall, ring, along, RADIUS).asinh()
            });
            pairs.push([old, new]);
        }
    }
    let count = pairs.len().max(1) as f64;
    let mean = |k: usize| pairs.iter().map(|p| p[k]).sum::<f64>() / count;
    let means = [mean(0), mean(1)];
    let moment = |i: usize, j: usize| {
        let products = pairs.iter().map(|p| (p[i] - means[i]) * (p[j] - means[j]));
        products.sum::<f64>() / count
    };
    let spread = (moment(0, 0) * moment(1, 1)).sqrt();
    (spread > 1e-12).then(|| moment(0, 1) / spread)
}
