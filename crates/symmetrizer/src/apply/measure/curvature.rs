//! Mean curvature of a surface and how well a deformation kept it: does the detail survive?
//!
//! The letters: at vertex i, h_i n_i the cotangent Laplacian 1/2 sum (cot a + cot b)(x_i - x_j),
//! A_i the mixed area (Meyer et al. 2003), H_i = <.., n_i> / (2 A_i). Positive where the surface is
//! convex (outward normals): a sphere of radius r has H = 1/r.

use kiddo::{ImmutableKdTree, SquaredEuclidean};
use rayon::prelude::*;

use crate::geom::Point;
use crate::shape::Surface;

/// Cotangents stay within this, those of about 3 and 177 degrees: beyond it a triangle is so thin
/// that its angles are noise; ours.
const MAX_COT: f64 = 20.0;
/// Radius of the averaging, fraction of L (docs/definitions.md: the smallest
/// curvature radius r0).
const RADIUS: f64 = 0.02;
/// ... and at least so many mean edges, so that coarse meshes are smoothed too.
const EDGES: f64 = 2.5;
/// At most so many vertices are asked, evenly by their number: on a dense surface averages of neighbours
/// are nearly the same.
const ASKED: usize = 40_000;

/// Integrated curvature and area of each vertex.
struct Integrals {
    /// H A.
    curvature: Vec<f64>,
    /// A, mixed area.
    area: Vec<f64>,
}

/// The mean curvature at each vertex, 1/L, unsmoothed; 0 for a vertex without area.
pub fn mean_curvature(surface: &Surface) -> Vec<f64> {
    let Integrals { curvature, area } = integrals(surface);
    curvature
        .iter()
        .zip(&area)
        .map(|(h, a)| if *a > 0.0 { h / a } else { 0.0 })
        .collect()
}

/// Pearson correlation, weighted by area, of the mean curvatures of two states of one surface,
/// each averaged over max(0.02 L, 2.5 mean edges) with the neighbours and weights of `before`.
/// None where one of the two does not vary.
pub fn curvature_correlation(before: &Surface, after: &Surface) -> Option<f64> {
    let count = before.positions.len();
    let every = count.div_ceil(ASKED).max(1);
    let asked: Vec<usize> = (0..count).step_by(every).collect();
    let (x, y) = smoothed_pair(before, after, &asked);
    let weights: Vec<f64> = asked.iter().map(|&v| before.vertex_areas[v]).collect();
    pearson(&x, &y, &weights)
}

fn integrals(surface: &Surface) -> Integrals {
    let count = surface.positions.len();
    let mut curvature = vec![0.0; count];
    let mut area = vec![0.0; count];
    for (f, corners) in surface.triangles.iter().enumerate() {
        let x = surface.corners(f as u32);
        let cot = cotangents(&x, surface.face_areas[f]);
        let mixed = mixed_areas(&x, &cot, surface.face_areas[f]);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let v = corners[i] as usize;
            // Edge ij lies opposite corner k. The Laplacian is 2 H n, hence a quarter.
            let pull = (x[i] - x[j]) * cot[k] + (x[i] - x[k]) * cot[j];
            curvature[v] += 0.25 * pull.dot(&surface.vertex_normals[v]);
            area[v] += mixed[i];
        }
    }
    Integrals { curvature, area }
}

/// Clamped cotangents of the corner angles; 0 for a triangle without area.
fn cotangents(x: &[Point; 3], area: f64) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (a, b) = (x[(i + 1) % 3] - x[i], x[(i + 2) % 3] - x[i]);
        let cot = a.dot(&b) / (2.0 * area);
        if cot.is_finite() {
            cot.clamp(-MAX_COT, MAX_COT)
        } else {
            0.0
        }
    })
}

/// The corners' shares of a triangle's area: Voronoi, or 1/2, 1/4, 1/4 in an obtuse triangle.
fn mixed_areas(x: &[Point; 3], cot: &[f64; 3], area: f64) -> [f64; 3] {
    if let Some(obtuse) = cot.iter().position(|&c| c < 0.0) {
        return std::array::from_fn(|i| area * if i == obtuse { 0.5 } else { 0.25 });
    }
    let squared = |i: usize, j: usize| (x[i] - x[j]).norm_squared();
    let shares: [f64; 3] = std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        (squared(i, j) * cot[k] + squared(i, k) * cot[j]) / 8.0
    });
    // Clamped cotangents do not add up to the area by themselves.
    let sum: f64 = shares.iter().sum();
    if sum > 0.0 {
        shares.map(|s| s * area / sum)
    } else {
        [area / 3.0; 3]
    }
}

/// The curvatures of both states at the vertices `asked`, averaged over the same neighbours.
fn smoothed_pair(before: &Surface, after: &Surface, asked: &[usize]) -> (Vec<f64>, Vec<f64>) {
    let radius = RADIUS.max(EDGES * before.mean_edge());
    let (old, new) = (integrals(before), integrals(after));
    let points: Vec<[f64; 3]> = before.positions.iter().map(|&p| p.into()).collect();
    let Ok(tree) = ImmutableKdTree::<f64, 3>::new_from_slice(&points) else {
        return (Vec::new(), Vec::new());
    };
    asked
        .par_iter()
        .map(|&v| {
            let near = neighbours(before, &tree, v, radius);
            (average(&old, &near), average(&new, &near))
        })
        .unzip()
}

/// Vertices within `radius` of vertex `v` on its side of the surface, in order of index, each with
/// its weight (1 - d^2/r^2)^2.
fn neighbours(
    surface: &Surface,
    tree: &ImmutableKdTree<f64, 3>,
    v: usize,
    radius: f64,
) -> Vec<(usize, f64)> {
    let at: [f64; 3] = surface.positions[v].into();
    let squared = radius * radius;
    let mut near: Vec<(usize, f64)> = tree
        .query(&at)
        .within::<SquaredEuclidean<f64>>(squared)
        .unsorted()
        .execute()
        .into_iter()
        .map(|hit| {
            let fall = 1.0 - hit.distance / squared;
            (hit.item as usize, fall * fall)
        })
        // The far side of a thin part is another piece of surface.
        .filter(|(u, _)| surface.vertex_normals[*u].dot(&surface.vertex_normals[v]) >= 0.0)
        .collect();
    near.sort_unstable_by_key(|(u, _)| *u);
    near
}

fn average(integrals: &Integrals, near: &[(usize, f64)]) -> f64 {
    let sum = |values: &[f64]| near.iter().map(|(u, w)| values[*u] * w).sum::<f64>();
    let area = sum(&integrals.area);
    if area > 0.0 {
        sum(&integrals.curvature) / area
    } else {
        0.0
    }
}

fn pearson(x: &[f64], y: &[f64], w: &[f64]) -> Option<f64> {
    let total: f64 = w.iter().sum();
    let mean = |x: &[f64]| x.iter().zip(w).map(|(x, w)| x * w).sum::<f64>() / total;
    let (x_mean, y_mean) = (mean(x), mean(y));
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for ((x, y), w) in x.iter().zip(y).zip(w) {
        let (dx, dy) = (x - x_mean, y - y_mean);
        xx += w * dx * dx;
        yy += w * dy * dy;
        xy += w * dx * dy;
    }
    // Below this the variation is rounding: curvatures are of order 1/L = 1.
    let least = 1e-24 * total * (1.0 + x_mean * x_mean);
    (xx > least && yy > least).then(|| (xy / (xx * yy).sqrt()).clamp(-1.0, 1.0))
}
