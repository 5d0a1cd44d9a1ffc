//! Cotangent weights of a surface's edges, fit for systems that must stay positive definite.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::shape::Surface;

/// Cotangent sums are kept within this range: obtuse angles would else push neighbours apart.
const COTANGENT_RANGE: (f64, f64) = (0.05, 10.0);

/// Half the sum of the cotangents opposite to each edge (u < v), each times its face's stiffness where
/// there is one.
pub fn edge_weights(surface: &Surface, stiffness: Option<&[f64]>) -> BTreeMap<(u32, u32), f64> {
    let mut sides: Vec<Side> = (0..surface.triangles.len())
        .into_par_iter()
        .flat_map_iter(|f| sides(surface, f, stiffness.map_or(1.0, |s| s[f])))
        .collect();
    // Stable: the sides of an edge stay in the order of their faces.
    sides.par_sort_by_key(|side| side.edge);
    let weight = |sides: &[Side]| {
        let sum = |of: fn(&Side) -> f64| sides.iter().map(of).sum::<f64>();
        let cotangents = sum(|s| s.half_cotangent).clamp(COTANGENT_RANGE.0, COTANGENT_RANGE.1);
        let stiff = cotangents * sum(|s| s.stiffness);
        (sides[0].edge, stiff / sides.len() as f64)
    };
    sides
        .chunk_by(|a, b| a.edge == b.edge)
        .map(weight)
        .collect()
}

/// An edge as one of its faces has it.
struct Side {
    edge: (u32, u32),
    half_cotangent: f64,
    stiffness: f64,
}

/// The sides of face `f`, which is so stiff.
fn sides(surface: &Surface, f: usize, stiffness: f64) -> [Side; 3] {
    let corners = surface.triangles[f];
    let x = surface.corners(f as u32);
    let doubled = 2.0 * surface.face_areas[f];
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let dot = (x[i] - x[k]).dot(&(x[j] - x[k]));
        Side {
            edge: (corners[i].min(corners[j]), corners[i].max(corners[j])),
            half_cotangent: 0.5 * dot / doubled.max(1e-300),
            stiffness,
        }
    })
}
