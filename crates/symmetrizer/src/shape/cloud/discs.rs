//! Discs: a small square in the tangent plane of each point, so large that together they have the
//! area of the surface.

use rayon::prelude::*;

use super::normals::median;
use crate::geom::{Point, PointIndex, Vector, any_orthogonal};

/// Neighbours by which the area is judged that a point stands for.
const NEIGHBOURS: usize = 12;
/// Cosine between normals from which two neighbours lie on one sheet.
const SAME_SHEET: f64 = 0.3;
/// A point stands for at most so many times the area that its neighbours do, else it is stray.
const STRAY: f64 = 3.0;

/// Corners of a disc, which follow each other.
pub(in crate::shape) const CORNERS: usize = 4;

/// The area that each point stands for: that of the circle through its k-th neighbour on the same
/// sheet over k.
pub(super) fn areas(points: &[Point], normals: &[Vector]) -> Vec<f64> {
    let places: Vec<[f64; 3]> = points.iter().map(|p| p.coords.into()).collect();
    let index = PointIndex::new(&places);
    let near: Vec<(f64, Vec<u32>)> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let others: Vec<u32> = index
                .nearest_n(&places[i], NEIGHBOURS + 1)
                .into_iter()
                .map(|(j, _)| j)
                .filter(|&j| j as usize != i)
                .collect();
            (own_area(points, normals, i, &others), others)
        })
        .collect();
    let around = |others: &[u32]| median(others.iter().map(|&j| near[j as usize].0));
    near.iter()
        .map(|(area, others)| area.min(STRAY * around(others)))
        .collect()
}

fn own_area(points: &[Point], normals: &[Vector], i: usize, others: &[u32]) -> f64 {
    let n = &normals[i];
    let same = |j: &&u32| normals[**j as usize].dot(n) > SAME_SHEET;
    let across = |j: &u32| {
        let d = points[*j as usize] - points[i];
        d.norm_squared() - d.dot(n).powi(2)
    };
    let sheet: Vec<f64> = others.iter().filter(same).map(across).collect();
    let reach = sheet.iter().copied().fold(0.0, f64::max);
    std::f64::consts::PI * reach / sheet.len().max(1) as f64
}

/// The squares, [`CORNERS`] vertices and two triangles for each point in its order; they face the way
/// of the normals.
pub(super) fn squares(
    points: &[Point],
    normals: &[Vector],
    areas: &[f64],
) -> (Vec<Point>, Vec<[u32; 3]>) {
    let mut corners = Vec::with_capacity(CORNERS * points.len());
    let mut triangles = Vec::with_capacity(2 * points.len());
    for ((x, n), area) in points.iter().zip(normals).zip(areas) {
        let first = corners.len() as u32;
        let half = (0.5 * area).sqrt();
        let t1 = any_orthogonal(n);
        let t2 = n.cross(&t1);
        corners.extend([t1, t2, -t1, -t2].map(|t| x + t * half));
        triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)));
    }
    (corners, triangles)
}
