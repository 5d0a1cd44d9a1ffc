//! The best rotation and the best rigid motion between corresponding points (Kabsch; the
//! determinant corrected).
//!
//! The letters: p, q corresponding points, w their weights, ~ about the weighted means;
//! H = sum w p~ q~^T = U S V^T, R = V diag(1, 1, det(V U^T)) U^T, so that R p ~ q.

use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal};

/// `p` moved rigidly (no reflection, no scale) as near to `q` as it gets in the weighted rms.
pub(super) fn align_rigidly(p: &[Point], q: &[Point], w: &[f64]) -> Vec<Point> {
    let total: f64 = w.iter().sum();
    let mean = |x: &[Point]| {
        let sum: Vector = x.iter().zip(w).map(|(x, w)| x.coords * *w).sum();
        Point::from(sum / total)
    };
    let (p_mean, q_mean) = (mean(p), mean(q));
    let mut h = Matrix3::zeros();
    for ((p, q), w) in p.iter().zip(q).zip(w) {
        h += (p - p_mean) * (q - q_mean).transpose() * *w;
    }
    let r = nearest_orthogonal(&h.transpose(), false);
    p.iter().map(|p| q_mean + r * (p - p_mean)).collect()
}
