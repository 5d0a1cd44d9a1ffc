//! Carrying a fine surface along with a control mesh that was deformed by other means.

use rayon::prelude::*;

use crate::deform::elastic::{Binding, Motion, Sites};
use crate::geom::{Matrix3, Point, nearest_orthogonal};
use crate::shape::Surface;

/// Positions of the vertices of `fine` when `control` goes to the positions `moved`: each vertex of the
/// control mesh carries what lies around it and turns it as its own neighbourhood turned, so detail of
/// the fine surface keeps its form and follows the rotation.
pub fn carry(fine: &Surface, control: &Surface, moved: &[Point]) -> Vec<Point> {
    let after = control.with_positions(moved.to_vec());
    let motions = motions(control, &after);
    let binding = Binding::within_reach(fine, control, &Sites::vertices(control));
    binding.places(&fine.positions, &motions)
}

/// The rigid motion of each vertex's neighbourhood, the closest in the sense of least squares over its edges
/// and its normal.
pub fn motions(before: &Surface, after: &Surface) -> Vec<Motion> {
    let count = before.positions.len();
    let mut moments = vec![Matrix3::zeros(); count];
    for corners in before.triangles.iter() {
        for k in 0..3 {
            let (u, v) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
            let old = before.positions[v] - before.positions[u];
            let new = after.positions[v] - after.positions[u];
            let moment = new * old.transpose();
            moments[u] += moment;
            moments[v] += moment;
        }
    }
    let motion = |v: usize| {
        // The normal counts as much as the edges: a flat neighbourhood would leave it open.
        let normal = after.vertex_normals[v] * before.vertex_normals[v].transpose();
        let moment = moments[v] + normal * moments[v].norm();
        Motion {
            rotation: nearest_orthogonal(&moment, false),
            rest_center: before.positions[v],
            center: after.positions[v],
        }
    };
    (0..count).into_par_iter().map(motion).collect()
}
