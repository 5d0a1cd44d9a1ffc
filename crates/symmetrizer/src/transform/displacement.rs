//! Optimal displacements (section 3, equation 1) and the rigid motion that carries one mirror into
//! another.
//!
//! p, q: a pair; T': the transformation it is moved to; d_p, d_q: the smallest displacements for
//! which T'(p + d_p) = q + d_q.

use crate::geom::{Point, Vector, exp_rotation};
use crate::transform::isometry::{Isometry, Plane};

/// The smallest displacements of `p` and `q` after which `q_from_p` maps one onto the other:
/// d_p = (T'^-1(q) - p) / 2, d_q = (T'(p) - q) / 2 (equation 1). Lengths as the points'.
pub fn displacements(p: &Point, q: &Point, q_from_p: &Isometry) -> (Vector, Vector) {
    let d_p = (q_from_p.inverse().apply(q) - p) / 2.0;
    let d_q = (q_from_p.apply(p) - q) / 2.0;
    (d_p, d_q)
}

/// The part `fraction` of the smallest rigid motion S with S(plane `from`) = plane `to`: the
/// rotation about the line where the planes meet (a translation when they are parallel).
///
/// Carrying a symmetric part from mirror T to mirror T' by equation 1 alone moves its points along
/// chords and squeezes the part by the cosine of the angle between the planes; S is the same
/// motion along the arc, and S^2 = T' T (ours, `docs/decisions/0003-merge-along-the-arc.md`).
/// `near` picks where rounding is smallest: a point of the part that moves.
pub fn carry(from: &Plane, to: &Plane, fraction: f64, near: &Point) -> Isometry {
    let n = from.normal;
    let (n_to, d_to) = if n.dot(&to.normal) >= 0.0 {
        (to.normal, to.offset)
    } else {
        (-to.normal, -to.offset)
    };
    let foot = near - from.signed_distance(near) * n;
    let height = n_to.dot(&foot.coords) - d_to;
    let axis = n.cross(&n_to);
    let sine = axis.norm();
    if sine < 1e-7 {
        return Isometry {
            linear: nalgebra::Matrix3::identity(),
            translation: -fraction * height * n_to,
        };
    }
    // The line's nearest point to `foot`: go within plane `from` along the descent of n_to.
    let along = axis.cross(&n) / sine;
    let pivot = foot - along * (height / n_to.dot(&along));
    let linear = exp_rotation(&(axis / sine * (fraction * sine.atan2(n.dot(&n_to)))));
    Isometry {
        linear,
        translation: pivot.coords - linear * pivot.coords,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planes() -> (Plane, Plane) {
        let from = Plane {
            normal: Vector::new(0.3, -0.5, 0.8).normalize(),
            offset: 0.4,
        };
        let to = Plane {
            normal: Vector::new(-0.1, -0.7, 0.5).normalize(),
            offset: -0.2,
        };
        (from, to)
    }

    #[test]
    fn equation_1_maps_exactly_and_splits_evenly() {
        let (_, to) = planes();
        let t = Isometry::mirror(&to);
        let (p, q) = (Point::new(1.0, 2.0, -0.5), Point::new(-0.3, 0.7, 1.1));
        let (d_p, d_q) = displacements(&p, &q, &t);
        assert!((t.apply(&(p + d_p)) - (q + d_q)).norm() < 1e-14);
        assert!((d_p.norm() - d_q.norm()).abs() < 1e-14);
    }

    #[test]
    fn carry_maps_the_plane_and_squares_to_the_product_of_mirrors() {
        let (from, to) = planes();
        for flip in [1.0, -1.0] {
            let to = Plane {
                normal: to.normal * flip,
                offset: to.offset * flip,
            };
            let s = carry(&from, &to, 1.0, &Point::new(0.2, 0.1, 0.3));
            let product = Isometry::mirror(&to).after(&Isometry::mirror(&from));
            let square = s.after(&s);
            // The shorter of the two motions: S^2 is the product or, where the normals had to be
            // turned round, still carries the mirror of `from` to that of `to`.
            let carried = s.after(&Isometry::mirror(&from)).after(&s.inverse());
            assert!((carried.linear - Isometry::mirror(&to).linear).norm() < 1e-12);
            assert!((carried.translation - Isometry::mirror(&to).translation).norm() < 1e-12);
            assert!((square.linear - product.linear).norm() < 1e-12);
            assert!((square.translation - product.translation).norm() < 1e-12);
        }
    }

    #[test]
    fn carry_in_two_halves_is_carry() {
        let (from, to) = planes();
        let near = Point::new(0.2, 0.1, 0.3);
        let half = carry(&from, &to, 0.5, &near);
        let whole = carry(&from, &to, 1.0, &near);
        let twice = half.after(&half);
        assert!((twice.linear - whole.linear).norm() < 1e-13);
        assert!((twice.translation - whole.translation).norm() < 1e-13);
    }

    #[test]
    fn nearly_parallel_planes_do_not_lose_digits() {
        let from = Plane {
            normal: Vector::z(),
            offset: 0.1,
        };
        for angle in [0.0, 1e-12, 1e-8, 1e-6, 1e-4] {
            let to = Plane {
                normal: Vector::new(f64::sin(angle), 0.0, f64::cos(angle)),
                offset: 0.15,
            };
            let s = carry(&from, &to, 1.0, &Point::new(0.3, 0.2, 0.0));
            let x = Point::new(0.3, -0.4, 0.1);
            assert!(to.signed_distance(&s.apply(&x)).abs() < 1e-6, "{angle}");
        }
    }
}
