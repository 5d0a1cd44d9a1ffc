//! What a deformation did to a surface besides making it symmetric.
//!
//! Everything compares two states of the same triangles, `before` and `after`, in the same
//! coordinates (the working coordinates of `before`).

use crate::apply::measure::curvature::curvature_correlation;
use crate::apply::measure::percentile;
use crate::apply::measure::volume::volume;
use crate::deform::elastic::Motion;
use crate::geom::Point;
use crate::shape::Surface;
use crate::shape::crossings::{crossing_faces, new_crossings};
use crate::shape::inverted::inverted_faces;

/// Edges shorter than this fraction of L count as this long, so that a collapsed one gives a
/// large stretch and not an infinite one; ours.
const SHORTEST_EDGE: f64 = 1e-9;

/// Figures of a deformation. Displacements are in percent of the bounding-box diagonal D, means
/// are weighted by vertex area.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Distortion {
    /// Root mean square vertex displacement after the best rigid alignment.
    pub rms: f64,
    /// Largest vertex displacement after that alignment.
    pub max: f64,
    /// Root mean square vertex displacement as the surfaces lie.
    pub rms_unaligned: f64,
    /// Largest vertex displacement as the surfaces lie.
    pub max_unaligned: f64,
    /// 99th percentile over the edges of |ln(l' / l)|, l and l' the lengths before and after.
    pub edge_stretch_p99: f64,
    /// Area after over area before.
    pub area_ratio: f64,
    /// Volume after over volume before, holes closed; none where the surface encloses none.
    pub volume_ratio: Option<f64>,
    /// Faces turned over against the surface around them, see [`inverted_faces`].
    pub inverted_faces: usize,
    /// Faces that cross another one after but crossed none before.
    pub new_crossings: usize,
    /// Correlation of the smoothed mean curvatures before and after, weighted by area; none where
    /// the curvature does not vary.
    pub curvature_correlation: Option<f64>,
}

/// Compares `after` with `before`; `diagonal` is that of `before`, in the same (working) units.
///
/// Panics where the two do not have the same triangles: a bug of the caller.
pub fn distortion(before: &Surface, after: &Surface, diagonal: f64) -> Distortion {
    assert_eq!(before.triangles, after.triangles, "states of one surface");
    let percent = 100.0 / diagonal;
    let back = Motion::between(&after.positions, &before.positions, &before.vertex_areas);
    let aligned: Vec<Point> = after.positions.iter().map(|x| back.apply(x)).collect();
    let (rms, max) = displacement(before, &aligned);
    let (rms_unaligned, max_unaligned) = displacement(before, &after.positions);
    let crossings = new_crossings(&crossing_faces(before), &crossing_faces(after));
    Distortion {
        rms: rms * percent,
        max: max * percent,
        rms_unaligned: rms_unaligned * percent,
        max_unaligned: max_unaligned * percent,
        edge_stretch_p99: edge_stretch(before, after, 0.99),
        area_ratio: after.area() / before.area(),
        volume_ratio: volume_ratio(before, after),
        inverted_faces: inverted_faces(before, after).len(),
        new_crossings: crossings.len(),
        curvature_correlation: curvature_correlation(before, after),
    }
}

/// Area-weighted rms and maximum of the vertices' way from `before` to `positions`.
pub(super) fn displacement(before: &Surface, positions: &[Point]) -> (f64, f64) {
    let mut sum = 0.0;
    let mut max: f64 = 0.0;
    for ((p, q), w) in before
        .positions
        .iter()
        .zip(positions)
        .zip(&before.vertex_areas)
    {
        let squared = (q - p).norm_squared();
        sum += w * squared;
        max = max.max(squared);
    }
    let total: f64 = before.vertex_areas.iter().sum();
    ((sum / total).sqrt(), max.sqrt())
}

/// The `p`-quantile of |ln(l' / l)| over the edges.
pub(super) fn edge_stretch(before: &Surface, after: &Surface, p: f64) -> f64 {
    let length = |s: &Surface, [u, v]: [u32; 2]| {
        (s.positions[u as usize] - s.positions[v as usize])
            .norm()
            .max(SHORTEST_EDGE)
    };
    let mut stretch: Vec<f64> = before
        .edges()
        .into_iter()
        .map(|e| (length(after, e) / length(before, e)).ln().abs())
        .collect();
    stretch.sort_by(f64::total_cmp);
    percentile(&stretch, p)
}

fn volume_ratio(before: &Surface, after: &Surface) -> Option<f64> {
    // A sheet has a volume of rounding only: nothing to compare with.
    let old = volume(before);
    (old.abs() > 1e-6).then(|| volume(after) / old)
}
