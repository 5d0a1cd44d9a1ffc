//! Faces that a deformation has turned over.

use rayon::prelude::*;

use crate::geom::{Matrix3, Vector, nearest_orthogonal};
use crate::shape::surface::Surface;

/// The faces, sorted, that are turned over against the surface around them.
///
/// Around each face, over the two rings of vertices next to it, one rotation R fits the edges
/// before to those after best, inner ones counted twice. The face is inverted when its normal after
/// makes more than a right angle with R times its normal before. So a part that turns as a whole, even upside down, has no
/// inverted faces; a fold has. Faces without area are never counted.
pub fn inverted_faces(before: &Surface, after: &Surface) -> Vec<u32> {
    let around = spread(before, &edge_covariances(before, after));
    let turned_over = |&f: &u32| {
        let corners = before.triangles[f as usize];
        let h: Matrix3 = corners.iter().map(|&v| around[v as usize]).sum();
        let expected = nearest_orthogonal(&h.transpose(), false) * before.face_normals[f as usize];
        expected.dot(&after.face_normals[f as usize]) < 0.0
    };
    (0..before.triangles.len() as u32)
        .into_par_iter()
        .filter(turned_over)
        .collect()
}

/// For each vertex the sum of e e'^T over the sides of the faces at it, e before and e' after.
fn edge_covariances(before: &Surface, after: &Surface) -> Vec<Matrix3> {
    let mut sums = vec![Matrix3::zeros(); before.positions.len()];
    let side = |s: &Surface, [u, v]: [u32; 2]| -> Vector {
        s.positions[v as usize] - s.positions[u as usize]
    };
    for e in sides(before) {
        let product = side(before, e) * side(after, e).transpose();
        for v in e {
            sums[v as usize] += product;
        }
    }
    sums
}

/// Adds to each vertex's matrix, which counts twice, those at the other ends of sides.
fn spread(surface: &Surface, own: &[Matrix3]) -> Vec<Matrix3> {
    let mut sums: Vec<Matrix3> = own.iter().map(|m| 2.0 * m).collect();
    for [u, v] in sides(surface) {
        sums[u as usize] += own[v as usize];
        sums[v as usize] += own[u as usize];
    }
    sums
}

/// The sides of all faces: each inner edge twice.
fn sides(surface: &Surface) -> impl Iterator<Item = [u32; 2]> {
    let faces = surface.triangles.iter();
    faces.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
}
