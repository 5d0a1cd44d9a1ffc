//! Isometries that turn left hands into right hands: any, the glide, the inversion.

use crate::geom::Matrix3;
use crate::transform::isometry::Isometry;
use crate::transform::optimal::orthogonal::{Frames, Hand, optimal};
use crate::transform::optimal::{
    Ambient, Correspondence, Fit, SMALLEST_GAP, eigen_in, means, relative_gap, total_weight,
};

/// The improper isometry that minimises 1/2 sum w |T p - q|^2, any of mirror, glide, inversion and
/// rotoreflection; as [`optimal_rigid`](super::optimal_rigid) with the other determinant. Frames
/// are given right-handed all the same: e2 of C_q is turned round here.
///
/// Where a pure mirror is wanted, fit that one: it is not this one without its angle.
pub fn optimal_improper(
    pairs: &[Correspondence],
    frames: Option<Frames<'_>>,
    ambient: Ambient,
) -> Option<Fit> {
    optimal(pairs, frames, ambient, Hand::Turned)
}

/// The glide, a mirror with a translation along its plane, that minimises 1/2 sum w |T p - q|^2:
/// its normal is the eigenvector of the smallest eigenvalue of sum w (p~ q~^T + q~ p~^T), p~ and
/// q~ centred separately. E = 1/2 sum w |p~ - q~|^2 + lambda_1.
///
/// Not to be used where a mirror is wanted: it hides a shift. The conditioning is
/// (lambda_2 - lambda_1) / max |lambda|; whether the pairs speak for a glide `rms` tells. `None` without pairs of positive total weight, and where
/// nothing gives a direction.
pub fn optimal_glide(pairs: &[Correspondence], ambient: Ambient) -> Option<Fit> {
    let total = total_weight(pairs)?;
    let (p_mean, q_mean) = means(pairs, total);
    let mut m = Matrix3::zeros();
    for x in pairs {
        let h = x.weight * (x.p.coords - p_mean) * (x.q.coords - q_mean).transpose();
        m += h + h.transpose();
    }
    let norm = m.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        return None;
    }
    let (lambda, vectors) = eigen_in(m, ambient);
    let n = vectors.column(0);
    let linear = Matrix3::identity() - 2.0 * n * n.transpose();
    let isometry = Isometry {
        linear,
        translation: q_mean - linear * p_mean,
    };
    let gap = relative_gap(&lambda, 0, 1);
    Some(Fit::measured(
        pairs,
        isometry,
        total,
        gap,
        gap > SMALLEST_GAP,
    ))
}

/// The inversion that minimises 1/2 sum w |T p - q|^2, about the mean of the midpoints; always
/// determined. In the plane z = 0 it is the half-turn. `None` without pairs of positive total
/// weight.
pub fn optimal_inversion(pairs: &[Correspondence]) -> Option<Fit> {
    let total = total_weight(pairs)?;
    let (p_mean, q_mean) = means(pairs, total);
    let isometry = Isometry {
        linear: -Matrix3::identity(),
        translation: p_mean + q_mean,
    };
    Some(Fit::measured(pairs, isometry, total, 1.0, true))
}
