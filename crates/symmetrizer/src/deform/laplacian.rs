//! Cotangent weights of a surface's edges, fit for systems that must stay positive definite.

use std::collections::BTreeMap;

use crate::shape::Surface;

/// Cotangent sums are kept within this range: obtuse angles would else push neighbours apart.
const COTANGENT_RANGE: (f64, f64) = (0.05, 10.0);

/// Half the sum of the cotangents opposite to each edge (u < v), each times its face's stiffness where
/// there is one.
pub fn edge_weights(surface: &Surface, stiffness: Option<&[f64]>) -> BTreeMap<(u32, u32), f64> {
    let mut weights = BTreeMap::new();
    for (f, corners) in surface.triangles.iter().enumerate() {
        let x = surface.corners(f as u32);
        let doubled = 2.0 * surface.face_areas[f];
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let dot = (x[i] - x[k]).dot(&(x[j] - x[k]));
            let (u, v) = (corners[i].min(corners[j]), corners[i].max(corners[j]));
            let sum = weights.entry((u, v)).or_insert((0.0, 0.0, 0.0));
            let s = stiffness.map_or(1.0, |s| s[f]);
            sum.0 += 0.5 * dot / doubled.max(1e-300);
            sum.1 += s;
            sum.2 += 1.0;
        }
    }
    let clamped = |(cotangents, stiffness, faces): (f64, f64, f64)| {
        cotangents.clamp(COTANGENT_RANGE.0, COTANGENT_RANGE.1) * stiffness / faces
    };
    weights.into_iter().map(|(e, w)| (e, clamped(w))).collect()
}
