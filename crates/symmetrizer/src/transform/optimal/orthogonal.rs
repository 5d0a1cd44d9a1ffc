//! The orthogonal matrix of given determinant that turns one set of vectors best into another.
//!
//! R maximises tr(R H), H = sum w p~ q~^T + lambda sum w C_p C_q^T with p~, q~ centred separately
//! and C the points' frames. With H = U S V^T that is R = V diag(1, 1, d) U^T, d = +-1 such that
//! det R is the wanted one (Kabsch 1976, Umeyama 1991). Without d, as appendix A prints it, data
//! of rank 2, three points for instance, give a reflection as often as a rotation.
//!
//! Here R comes from the equivalent 4x4 eigenproblem for its quaternion (Horn 1987), which knows
//! no reflections; the improper R is minus the rotation that turns p best into -q.

use nalgebra::{Matrix4, Quaternion, UnitQuaternion};

use crate::geom::Matrix3;
use crate::transform::isometry::Isometry;
use crate::transform::optimal::{Ambient, Correspondence, Fit, means, total_weight};

/// The frames of the two points of a pair: right-handed, columns n, e1, e2 with n the outward
/// normal and e1 a direction whose sign means nothing (that of a principal curvature).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramePair {
    /// The frame C_p.
    pub p: Matrix3,
    /// The frame C_q.
    pub q: Matrix3,
}

/// Frames to be turned into each other along with the points.
#[derive(Debug, Clone, Copy)]
pub struct Frames<'a> {
    /// One for each pair.
    pub pairs: &'a [FramePair],
    /// What an error of direction costs beside one of position, length^2 (appendix A's positive
    /// constant): the square of about half the radius in which the frames were measured.
    pub lambda: f64,
}

/// Whether T keeps or turns round the hands; the value is det R.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Hand {
    Kept,
    Turned,
}

impl Hand {
    fn determinant(self) -> f64 {
        match self {
            Self::Kept => 1.0,
            Self::Turned => -1.0,
        }
    }
}

/// The least conditioning that counts as determined (collinear points and slippable sets fail).
const SMALLEST_CONDITIONING: f64 = 1e-3;

/// How often the signs of the frames are chosen anew; they settle in two rounds on noisy data.
const SIGN_ROUNDS: usize = 5;

/// The isometry of the wanted `hand` that minimises 1/2 sum w |T p - q|^2 plus the frames' part.
///
/// `None` without pairs of positive total weight, where nothing gives a direction, or where frames
/// are not one for each pair.
pub(super) fn optimal(
    pairs: &[Correspondence],
    frames: Option<Frames<'_>>,
    ambient: Ambient,
    hand: Hand,
) -> Option<Fit> {
    let total = total_weight(pairs)?;
    let (p_mean, q_mean) = means(pairs, total);
    let moment =
        |x: &Correspondence| x.weight * (x.p.coords - p_mean) * (x.q.coords - q_mean).transpose();
    let positions: Matrix3 = pairs.iter().map(moment).sum();
    let (linear, conditioning) = match frames {
        None => best_turn(&positions, ambient, hand)?,
        Some(frames) => with_frames(&positions, pairs, frames, ambient, hand)?,
    };
    let isometry = Isometry {
        linear,
        translation: q_mean - linear * p_mean,
    };
    let determined = conditioning > SMALLEST_CONDITIONING;
    Some(Fit::measured(
        pairs,
        isometry,
        total,
        conditioning,
        determined,
    ))
}

/// The best R where frames count too: first by the normals alone, then by whole frames, each with
/// the sign of its e1 that agrees with R, until no sign changes.
fn with_frames(
    positions: &Matrix3,
    pairs: &[Correspondence],
    frames: Frames<'_>,
    ambient: Ambient,
    hand: Hand,
) -> Option<(Matrix3, f64)> {
    if frames.pairs.len() != pairs.len() {
        return None;
    }
    let weighted = || pairs.iter().map(|x| frames.lambda * x.weight);
    let normals = |(w, f): (f64, &FramePair)| w * f.p.column(0) * f.q.column(0).transpose();
    let by_normals: Matrix3 = weighted().zip(frames.pairs).map(normals).sum();
    let mut best = best_turn(&(positions + by_normals), ambient, hand)?;
    for _ in 0..SIGN_ROUNDS {
        let r = best.0;
        let whole = |(w, f): (f64, &FramePair)| w * f.p * agreeing(f, &r, hand).transpose();
        let by_frames: Matrix3 = weighted().zip(frames.pairs).map(whole).sum();
        best = best_turn(&(positions + by_frames), ambient, hand)?;
        if frames
            .pairs
            .iter()
            .all(|f| agreeing(f, &r, hand) == agreeing(f, &best.0, hand))
        {
            break;
        }
    }
    Some(best)
}

/// C_q of the wanted handedness (e2 turned round for improper T), with the sign of e1 and e2 that
/// agrees with R C_p.
fn agreeing(frames: &FramePair, r: &Matrix3, hand: Hand) -> Matrix3 {
    let q = &frames.q;
    let (n, e1, e2) = (q.column(0), q.column(1), q.column(2) * hand.determinant());
    let turned = r * frames.p;
    let agreement = turned.column(1).dot(&e1) + turned.column(2).dot(&e2);
    let sign = if agreement < 0.0 { -1.0 } else { 1.0 };
    Matrix3::from_columns(&[n.into_owned(), e1 * sign, e2 * sign])
}

/// The R of the wanted `hand` that maximises tr(R H), and its conditioning; `None` for H = 0 or
/// not finite.
fn best_turn(h: &Matrix3, ambient: Ambient, hand: Hand) -> Option<(Matrix3, f64)> {
    let norm = h.norm();
    if !(norm > 0.0 && norm.is_finite()) {
        return None;
    }
    match ambient {
        Ambient::Plane => best_turn_in_plane(h, hand),
        Ambient::Space => {
            let det = hand.determinant();
            let (r, conditioning) = best_rotation(&(h * det));
            Some((r * det, conditioning))
        }
    }
}

/// Horn's quaternion. The eigenvalues of K are S1 + S2 + d S3, S1 - S2 - d S3, ..., so that the
/// conditioning (S2 + d S3) / S1 is that of the two largest.
fn best_rotation(h: &Matrix3) -> (Matrix3, f64) {
    let [xx, xy, xz] = [h[(0, 0)], h[(0, 1)], h[(0, 2)]];
    let [yx, yy, yz] = [h[(1, 0)], h[(1, 1)], h[(1, 2)]];
    let [zx, zy, zz] = [h[(2, 0)], h[(2, 1)], h[(2, 2)]];
    #[rustfmt::skip]
    let k = Matrix4::new(
        xx + yy + zz, yz - zy,      zx - xz,      xy - yx,
        yz - zy,      xx - yy - zz, xy + yx,      zx + xz,
        zx - xz,      xy + yx,      yy - xx - zz, yz + zy,
        xy - yx,      zx + xz,      yz + zy,      zz - xx - yy,
    );
    let e = k.symmetric_eigen();
    let mut order = [0, 1, 2, 3];
    order.sort_by(|&a, &b| e.eigenvalues[b].total_cmp(&e.eigenvalues[a]));
    let (first, second) = (e.eigenvalues[order[0]], e.eigenvalues[order[1]]);
    let z = e.eigenvectors.column(order[0]);
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(z[0], z[1], z[2], z[3]));
    let linear = turn.to_rotation_matrix().into_inner();
    (linear, ((first - second) / (first + second)).max(0.0))
}

/// The rotation by theta = atan2(sum w p~ x q~, sum w p~ . q~), or the reflection, of the plane
/// z = 0; the conditioning is (S1 + d S2) / S1.
fn best_turn_in_plane(h: &Matrix3, hand: Hand) -> Option<(Matrix3, f64)> {
    let (cos, sin) = (h[(0, 0)] + h[(1, 1)], h[(0, 1)] - h[(1, 0)]);
    let (mirror_cos, mirror_sin) = (h[(0, 0)] - h[(1, 1)], h[(0, 1)] + h[(1, 0)]);
    let (turning, mirroring) = (cos.hypot(sin), mirror_cos.hypot(mirror_sin));
    let (wanted, c, s) = match hand {
        Hand::Kept => (turning, cos, sin),
        Hand::Turned => (mirroring, mirror_cos, mirror_sin),
    };
    if turning + mirroring <= 0.0 {
        return None;
    }
    let (s, c) = s.atan2(c).sin_cos();
    let d = hand.determinant();
    let linear = Matrix3::new(c, -d * s, 0.0, s, d * c, 0.0, 0.0, 0.0, 1.0);
    Some((linear, 2.0 * wanted / (turning + mirroring)))
}
