//! Motions that keep the hands: any (appendix A, rigid), the half-turn, the translation.

use crate::geom::{Matrix3, Vector, sorted_eigen};
use crate::transform::isometry::Isometry;
use crate::transform::optimal::orthogonal::{Frames, Hand, optimal};
use crate::transform::optimal::{
    Ambient, Correspondence, Fit, SMALLEST_EXPLAINED, SMALLEST_GAP, Swaps, eigen_in, means,
    total_weight,
};

/// The rigid motion that minimises 1/2 sum w |T p - q|^2 and, with `frames`, their error of
/// direction times lambda (appendix A, rigid, with the determinant it lacks).
///
/// The conditioning is (S2 + d S3) / S1 of the singular values of H, in the plane
/// (S1 + d S2) / S1; below 1e-3 the pairs do not determine the motion. `None` without pairs of
/// positive total weight, where nothing gives a direction, or where frames are not one for each
/// pair.
pub fn optimal_rigid(
    pairs: &[Correspondence],
    frames: Option<Frames<'_>>,
    ambient: Ambient,
) -> Option<Fit> {
    optimal(pairs, frames, ambient, Hand::Kept)
}

/// The half-turn that minimises 1/2 sum w |T p - q|^2: its axis goes through the mean of the
/// midpoints along the eigenvector of the largest eigenvalue of the mirror's M; in the plane it is
/// the z axis. E = 1/2 sum w |p~ + q~|^2 - lambda_3.
///
/// The conditioning is (lambda_3 - lambda_2) over the greatest eigenvalue of
/// sum w (p^ p^T + q^ q^T), p^ and q^ centred separately, in the plane 1: the distance of two
/// patches from each other must not make the axis look undetermined. `None` as for
/// [`optimal_mirror`](super::optimal_mirror).
pub fn optimal_half_turn(pairs: &[Correspondence], ambient: Ambient) -> Option<Fit> {
    let swaps = Swaps::of(pairs)?;
    let (axis, gap) = match ambient {
        Ambient::Plane => (Vector::z(), 1.0),
        Ambient::Space => {
            let (lambda, vectors) = eigen_in(swaps.m, ambient);
            let extent = greatest_extent(pairs, swaps.total);
            let gap = if extent > 0.0 {
                (lambda[2] - lambda[1]) / extent
            } else {
                0.0
            };
            (vectors.column(2).into_owned(), gap)
        }
    };
    let linear = 2.0 * axis * axis.transpose() - Matrix3::identity();
    let isometry = Isometry {
        linear,
        translation: swaps.centre - linear * swaps.centre,
    };
    let fit = Fit::measured(pairs, isometry, swaps.total, gap, gap > SMALLEST_GAP);
    Some(Fit {
        is_well_conditioned: fit.is_well_conditioned && fit.explained > SMALLEST_EXPLAINED,
        ..fit
    })
}

/// The greatest eigenvalue of sum w (p^ p^T + q^ q^T), p^ and q^ centred separately.
fn greatest_extent(pairs: &[Correspondence], total: f64) -> f64 {
    let (p_mean, q_mean) = means(pairs, total);
    let moment = |x: &Correspondence| {
        let (p, q) = (x.p.coords - p_mean, x.q.coords - q_mean);
        x.weight * (p * p.transpose() + q * q.transpose())
    };
    sorted_eigen(&pairs.iter().map(moment).sum()).0[2]
}

/// The translation that minimises 1/2 sum w |p + t - q|^2, mean q - mean p; always determined.
/// `None` without pairs of positive total weight.
pub fn optimal_translation(pairs: &[Correspondence]) -> Option<Fit> {
    let total = total_weight(pairs)?;
    let (p_mean, q_mean) = means(pairs, total);
    let isometry = Isometry {
        linear: Matrix3::identity(),
        translation: q_mean - p_mean,
    };
    Some(Fit::measured(pairs, isometry, total, 1.0, true))
}
