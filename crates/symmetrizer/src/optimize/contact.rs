//! Closest points as contacts of a curved surface.

use crate::geom::{Point, Vector};
use crate::shape::{Hit, Surface};

/// Vertex normals that lean further than 35 degrees from the face mark a crease.
pub(super) const SMOOTH_COS: f64 = 0.82;

/// The hit moved from the flat triangle to the curved surface that its vertex normals suggest.
///
/// Vertices lie on the shape but faces cut below it where it is convex; taken as they are, closest
/// points would draw every vertex inwards a little each round. Phong tessellation (Boubekeur and Alexa
/// 2008) with shape factor 1/2 lifts a chord to its arc exactly to second order. Creases are left flat.
pub(super) fn curved(surface: &Surface, hit: &Hit) -> Point {
    let corners = surface.triangles[hit.at.face as usize];
    let face_normal = surface.face_normals[hit.at.face as usize];
    let mut lifted = Vector::zeros();
    for (&v, b) in corners.iter().zip(hit.at.bary) {
        let n = surface.vertex_normals[v as usize];
        if n.dot(&face_normal) < SMOOTH_COS {
            return hit.point;
        }
        lifted -= b * n.dot(&(hit.point - surface.positions[v as usize])) * n;
    }
    hit.point + 0.5 * lifted
}
