//! Refitting an isometry to the surface: weighted Gauss-Newton on closest points, mostly along
//! normals, so that samples may slide while the isometry settles.
//!
//! r_i = m_i . (T x_i - y_i) with y_i the closest point to T x_i and m_i its normal, plus a small
//! share of the full difference. The unknowns are a twist (omega, v) of the image about its centroid
//! c, T' x = c + exp(omega) (T x - c) + v, or, for a mirror, a turn of the normal n and a shift of
//! the offset d.

use nalgebra::{Matrix3 as M3, Matrix6, Vector3, Vector6};

use crate::geom::{Ambient, Point, Vector, any_orthogonal, exp_rotation};
use crate::transform::{Class, Isometry, Plane};

/// A point x, the closest surface point y to its image, y's normal and a weight.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// Before the isometry.
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

/// One Gauss-Newton step of `t` towards its contacts within its class; `t` itself where the contacts
/// leave it undetermined.
pub fn refine(t: &Isometry, class: Class, contacts: &[Contact]) -> Isometry {
    match class {
        Class::Mirror => {
            let plane = t.nearest_mirror(&Point::origin());
            Isometry::mirror(&refine_plane(&plane, contacts))
        }
        Class::Proper | Class::Improper => refine_motion(t, contacts),
    }
}

/// Weights 1 / (1 + r^2 / s^2)^2 by the distance r of a contact's ends under `t` (Geman and
/// McClure): what holds to within about s counts, what merely reaches the tolerance does not.
pub fn weigh(t: &Isometry, contacts: &mut [Contact], s: f64) {
    // Below this all that differs is the triangulation.
    let s = s.max(2e-4);
    for c in contacts {
        let r = (t.apply(&c.x) - c.y).norm() / s;
        c.weight = (1.0 + r * r).powi(-2);
    }
}

fn refine_motion(t: &Isometry, contacts: &[Contact]) -> Isometry {
    let total: f64 = contacts.iter().map(|c| c.weight).sum();
    if total <= 0.0 {
        return *t;
    }
    let images: Vec<Point> = contacts.iter().map(|c| t.apply(&c.x)).collect();
    let center = contacts
        .iter()
        .zip(&images)
        .map(|(c, z)| z.coords * (c.weight / total))
        .sum::<Vector>();
    let mut h = Matrix6::<f64>::zeros();
    let mut g = Vector6::<f64>::zeros();
    for (c, z) in contacts.iter().zip(&images) {
        let arm = z.coords - center;
        let residual = z - c.y;
        let mut add = |direction: &Vector, weight: f64| {
            let row = twist_row(&arm, direction);
            h.syger(weight, &row, &row, 1.0);
            g.axpy(weight * residual.dot(direction), &row, 1.0);
        };
        add(&c.normal, c.weight);
        for axis in [Vector::x(), Vector::y(), Vector::z()] {
            add(&axis, POINT_TO_POINT * c.weight);
        }
    }
    let ridge = 1e-9 * h.trace();
    let Some(factor) = (h + Matrix6::identity() * ridge).cholesky() else {
        return *t;
    };
    let step = factor.solve(&-g);
    let turn = exp_rotation(&Vector::new(step[0], step[1], step[2]));
    let shift = Vector::new(step[3], step[4], step[5]);
    Isometry {
        linear: turn * t.linear,
        translation: turn * (t.translation - center) + center + shift,
    }
}

/// The change along `direction` of a point at `arm` from the centre per unit of each twist component.
fn twist_row(arm: &Vector, direction: &Vector) -> Vector6<f64> {
    let moment = arm.cross(direction);
    Vector6::new(
        moment.x,
        moment.y,
        moment.z,
        direction.x,
        direction.y,
        direction.z,
    )
}

/// How firmly contacts hold a motion against sliding along the surface: the smallest over the mean
/// eigenvalue of the point-to-plane normal matrix, turns counted at the contacts' rms distance from
/// their centre. 0 for a plane, a cylinder, a sphere, any surface of revolution (Gelfand and Guibas 2004); in the plane,
/// where there are one turn and two shifts, for a straight line and a circle.
pub fn firmness(contacts: &[Contact], ambient: Ambient) -> f64 {
    let total: f64 = contacts.iter().map(|c| c.weight).sum();
    if total <= 0.0 {
        return 0.0;
    }
    let center = contacts
        .iter()
        .map(|c| c.y.coords * (c.weight / total))
        .sum::<Vector>();
    let spread: f64 = contacts
        .iter()
        .map(|c| c.weight / total * (c.y.coords - center).norm_squared())
        .sum::<f64>()
        .sqrt();
    let mut h = Matrix6::<f64>::zeros();
    for c in contacts {
        let arm = (c.y.coords - center) / spread.max(1e-12);
        let row = twist_row(&arm, &c.normal);
        h.syger(c.weight / total, &row, &row, 1.0);
    }
    h.fill_upper_triangle_with_lower_triangle();
    let (least, mean) = match ambient {
        Ambient::Space => {
            let eigen = h.symmetric_eigenvalues();
            (eigen.min(), eigen.mean())
        }
        Ambient::Plane => {
            let eigen = h.fixed_view::<3, 3>(2, 2).symmetric_eigenvalues();
            (eigen.min(), eigen.mean())
        }
    };
    (least / mean).max(0.0)
}

/// One Gauss-Newton step of the plane towards its contacts; the plane itself where the contacts
/// leave it undetermined.
fn refine_plane(plane: &Plane, contacts: &[Contact]) -> Plane {
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
