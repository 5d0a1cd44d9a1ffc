//! The orthogonal matrix nearest to another.

use crate::geom::{Matrix3, Vector};

/// The orthogonal matrix nearest to `m` of determinant -1 if `improper`, else +1 (Kabsch 1976).
pub fn nearest_orthogonal(m: &Matrix3, improper: bool) -> Matrix3 {
    match polar(m) {
        Some(nearest) if (nearest.determinant() < 0.0) == improper => nearest,
        _ => nearest_by_svd(m, improper),
    }
}

/// Steps of Newton's method at the most; six are usual.
const POLAR_STEPS: usize = 12;
/// It is done with when a step is shorter: errors square.
const POLAR_REST: f64 = 1e-9;
/// Below this determinant, of a matrix of norm 1, it is left to the singular values.
const POLAR_LEAST: f64 = 1e-9;

/// The orthogonal polar factor of `m`, the nearest of all orthogonal matrices: Newton's method with scaling (Higham 1986), several
/// times as fast as singular values. `None` for a matrix that is all but singular.
fn polar(m: &Matrix3) -> Option<Matrix3> {
    let mut x = m / m.norm();
    // Of a matrix of zeros it is not a number.
    let sure = x.determinant().abs() > POLAR_LEAST;
    if !sure {
        return None;
    }
    for _ in 0..POLAR_STEPS {
        let inverse = x.try_inverse()?.transpose();
        let scale = (inverse.norm() / x.norm()).sqrt();
        let next = 0.5 * (scale * x + inverse / scale);
        let step = (next - x).norm();
        x = next;
        if step < POLAR_REST {
            return Some(x);
        }
    }
    None
}

fn nearest_by_svd(m: &Matrix3, improper: bool) -> Matrix3 {
    let svd = m.svd(true, true);
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
        return Matrix3::identity();
    };
    let hand = if improper { -1.0 } else { 1.0 };
    // The direction with the least to say takes the sign.
    let least = svd.singular_values.imin();
    let mut sign = Vector::repeat(1.0);
    sign[least] = hand * (u * v_t).determinant().signum();
    u * Matrix3::from_diagonal(&sign) * v_t
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;

    /// Both ways come to the same, and of a rotation times a stretch it is the rotation, however flat the stretch.
    #[test]
    fn a_turned_stretch_has_its_turn() {
        let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.3).into_inner();
        let axes = Rotation3::from_euler_angles(1.4, 0.3, -0.7).into_inner();
        for least in [1.0, 1e-2, 1e-5, 1e-7, 0.0] {
            let stretch = Matrix3::from_diagonal(&Vector::new(3.0, 0.7, least));
            let m = turn * axes * stretch * axes.transpose();
            let [newton, svd] = [nearest_orthogonal(&m, false), nearest_by_svd(&m, false)];
            assert!((newton - turn).norm() < 1e-9, "{least}: {newton}");
            assert!((svd - turn).norm() < 1e-9, "{least}: {svd}");
        }
    }

    /// The handedness is that which is asked for, also where the matrix has the other.
    #[test]
    fn handedness_is_as_asked() {
        let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.3).into_inner();
        for least in [-0.3, -1e-3, 0.0, 1e-3, 0.3] {
            let m = turn * Matrix3::from_diagonal(&Vector::new(2.0, 1.0, least));
            for improper in [false, true] {
                let found = nearest_orthogonal(&m, improper);
                let hand = if improper { -1.0 } else { 1.0 };
                assert!((found.determinant() - hand).abs() < 1e-9);
                let least = Matrix3::from_diagonal(&Vector::new(1.0, 1.0, hand));
                assert!((found - turn * least).norm() < 1e-9, "{found}");
            }
        }
        assert_eq!(
            nearest_orthogonal(&Matrix3::zeros(), false),
            Matrix3::identity()
        );
    }
}
