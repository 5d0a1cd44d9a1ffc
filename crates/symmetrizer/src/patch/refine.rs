//! Refitting a mirror to the surface: weighted Gauss-Newton on closest points, mostly along
//! normals, so that samples may slide while the plane settles.
//!
//! r_i = m_i . (T x_i - y_i) with y_i the closest point to T x_i and m_i its normal, plus a small
//! share of the full difference; the unknowns are a turn of the normal n (two degrees of freedom)
//! and a shift of the offset d.

use nalgebra::{Matrix3 as M3, Vector3};

use crate::geom::{Point, Vector, any_orthogonal};
use crate::transform::Plane;

/// A point x, the closest surface point y to its mirror image, y's normal and a weight.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// Before mirroring.
    pub x: Point,
    /// Closest to the image of x.
    pub y: Point,
    /// Unit surface normal at y.
    pub normal: Vector,
    /// At least 0.
    pub weight: f64,
}

/// Share of the point-to-point term beside point-to-plane: enough to hold what slides (ours).
const POINT_TO_POINT: f64 = 0.05;

/// One Gauss-Newton step of the plane towards its contacts; the plane itself where the contacts
/// leave it undetermined.
pub fn refine_plane(plane: &Plane, contacts: &[Contact]) -> Plane {
    let n = plane.normal;
    let u = any_orthogonal(&n);
    let v = n.cross(&u);
    // Turn about a point near the contacts, else turn and shift are badly coupled.
    let total: f64 = contacts.iter().map(|c| c.weight).sum();
    if total <= 0.0 {
        return *plane;
    }
    let center = contacts
        .iter()
        .map(|c| c.x.coords * (c.weight / total))
        .sum::<Vector>();
    let offset = plane.offset - n.dot(&center);
    let mut h = M3::<f64>::zeros();
    let mut g = Vector3::<f64>::zeros();
    for c in contacts {
        let x = c.x.coords - center;
        let s = n.dot(&x) - offset;
        let residual = x - 2.0 * s * n - (c.y.coords - center);
        // d(T x) for n -> n + a u + b v, d -> d + e.
        let turn = |t: &Vector| -2.0 * (t.dot(&x) * n + s * t);
        let columns = [turn(&u), turn(&v), 2.0 * n];
        let along = Vector3::from(columns.map(|k| k.dot(&c.normal)));
        let r = residual.dot(&c.normal);
        h += c.weight * along * along.transpose();
        g += c.weight * along * r;
        for axis in 0..3 {
            let row = Vector3::from(columns.map(|k| k[axis]));
            h += c.weight * POINT_TO_POINT * row * row.transpose();
            g += c.weight * POINT_TO_POINT * row * residual[axis];
        }
    }
    let ridge = 1e-9 * h.trace();
    let Some(factor) = (h + M3::identity() * ridge).cholesky() else {
        return *plane;
    };
    let step = factor.solve(&g);
    let normal = (n - step[0] * u - step[1] * v).normalize();
    Plane {
        normal,
        offset: offset - step[2] + normal.dot(&center),
    }
}
