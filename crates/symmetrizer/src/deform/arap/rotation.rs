//! The rotation nearest to a matrix, from a near one: a few steps where a singular value
//! decomposition would start anew (Müller, Bender, Chentanez, Macklin 2016).

use crate::geom::{Matrix3, Vector, exp_rotation};

/// Steps at the most; from the rotation of the last iteration one or two suffice.
const STEPS: usize = 20;
/// Steps end below this turn, radians.
const ENOUGH: f64 = 1e-9;

/// The rotation R near `start` that makes tr(R^T m) largest. Where `m` says nothing `start` stays.
pub fn nearest_rotation(m: &Matrix3, start: &Matrix3) -> Matrix3 {
    let scale = m.norm();
    if scale < f64::MIN_POSITIVE {
        return *start;
    }
    let mut r = *start;
    for _ in 0..STEPS {
        let (mut torque, mut stiffness) = (Vector::zeros(), 0.0);
        for k in 0..3 {
            let (axis, wanted) = (r.column(k), m.column(k));
            torque += axis.cross(&wanted);
            stiffness += axis.dot(&wanted);
        }
        let omega = torque / (stiffness.abs() + 1e-9 * scale);
        r = exp_rotation(&omega) * r;
        if omega.norm() < ENOUGH {
            break;
        }
    }
    nalgebra::Rotation3::from_matrix_eps(
        &r,
        1e-14,
        2,
        nalgebra::Rotation3::from_matrix_unchecked(r),
    )
    .into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::nearest_orthogonal;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn it_is_that_of_the_singular_values() {
        let mut rng = Pcg64::seed_from_u64(3);
        for _ in 0..200 {
            let noise = Matrix3::from_fn(|_, _| 0.3 * rng.random_range(-1.0..1.0));
            let omega = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0));
            let m = exp_rotation(&omega) * (Matrix3::identity() + noise);
            let found = nearest_rotation(&m, &Matrix3::identity());
            assert!((found - nearest_orthogonal(&m, false)).norm() < 1e-6);
        }
    }

    #[test]
    fn nothing_leaves_it_as_it_is() {
        let r = exp_rotation(&Vector::new(0.3, 0.2, 0.1));
        assert_eq!(nearest_rotation(&Matrix3::zeros(), &r), r);
    }
}
