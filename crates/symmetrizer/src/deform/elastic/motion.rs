//! The rigid motion of one element, about its own centre.

use crate::deform::solver::Twist;
use crate::geom::{Matrix3, Point, Vector, exp_rotation, nearest_orthogonal};

/// x -> R (x - c) + y: the rest centre c moves to y, the element turns by R about it.
#[derive(Debug, Clone, Copy)]
pub struct Motion {
    /// Rotation R.
    pub rotation: Matrix3,
    /// Rest centre c.
    pub rest_center: Point,
    /// Present centre y.
    pub center: Point,
}

impl Motion {
    /// At rest about `center`.
    pub fn rest(center: Point) -> Self {
        Self {
            rotation: Matrix3::identity(),
            rest_center: center,
            center,
        }
    }

    /// What takes the points `p` as near to `q` as a rigid motion does (no reflection, no scale) in the rms
    /// weighted by `w` (Kabsch; the determinant corrected).
    ///
    /// ~ about the weighted means; H = sum w q~ p~^T = U S V^T, R = U diag(1, 1, det(U V^T)) V^T, so that
    /// R p~ ~ q~.
    pub fn between(p: &[Point], q: &[Point], w: &[f64]) -> Self {
        let total: f64 = w.iter().sum();
        let mean = |x: &[Point]| {
            let sum: Vector = x.iter().zip(w).map(|(x, w)| x.coords * *w).sum();
            Point::from(sum / total)
        };
        let (rest_center, center) = (mean(p), mean(q));
        let weighted = p.iter().zip(q).zip(w);
        let h: Matrix3 = weighted
            .map(|((p, q), w)| (q - center) * (p - rest_center).transpose() * *w)
            .sum();
        Self {
            rotation: nearest_orthogonal(&h, false),
            rest_center,
            center,
        }
    }

    /// Where the rest point `x` is now.
    pub fn apply(&self, x: &Point) -> Point {
        self.center + self.rotation * (x - self.rest_center)
    }

    /// After the twist (omega, v) about the present centre: turned by `exp [omega]`, moved by v.
    /// The exponential keeps the motion rigid; the helical update of the twist diverges for large
    /// steps.
    pub fn twisted(&self, omega: &Vector, v: &Vector) -> Self {
        // Left as it accumulates, the product of many rotations would drift from orthogonality.
        let turned = nalgebra::Rotation3::from_matrix_eps(
            &(exp_rotation(omega) * self.rotation),
            1e-14,
            2,
            nalgebra::Rotation3::from_matrix_unchecked(exp_rotation(omega) * self.rotation),
        );
        Self {
            rotation: turned.into_inner(),
            rest_center: self.rest_center,
            center: self.center + v,
        }
    }

    /// The same for a twist of six numbers.
    pub fn moved(&self, twist: &Twist) -> Self {
        let (omega, v) = (twist.fixed_rows::<3>(0), twist.fixed_rows::<3>(3));
        self.twisted(&omega.into_owned(), &v.into_owned())
    }
}
