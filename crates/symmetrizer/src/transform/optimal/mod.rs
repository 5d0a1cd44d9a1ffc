//! Appendix A in closed form: the isometry of each kind that makes a set of pairs symmetric with
//! the smallest displacements.
//!
//! p, q: pairs; w: weights, W their sum. What is minimised is section 3's symmetry cost
//! E = sum w (|d_p|^2 + |d_q|^2) = 1/2 sum w |T p - q|^2. All forms are centred: the printed ones
//! cancel far from the origin.

mod improper;
mod mirror;
mod orthogonal;
mod rigid;
#[cfg(test)]
mod tests;

pub use improper::{optimal_glide, optimal_improper, optimal_inversion};
pub use mirror::{MirrorFit, optimal_mirror};
pub use orthogonal::{FramePair, Frames};
pub use rigid::{optimal_half_turn, optimal_rigid, optimal_translation};

pub use crate::geom::Ambient;
use crate::geom::{Matrix3, Point, Vector, sorted_eigen};
use crate::transform::isometry::Isometry;

/// A weighted pair of points: a symmetry should carry p onto q; a mirror, a half-turn and an
/// inversion then exchange them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correspondence {
    /// One point.
    pub p: Point,
    /// Its partner.
    pub q: Point,
    /// At least 0.
    pub weight: f64,
}

/// The optimal isometry of a kind for a set of pairs, and how well it is determined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The optimum T.
    pub isometry: Isometry,
    /// The symmetry cost E = 1/2 sum w |T p - q|^2 (section 3), length^2 times weight.
    pub cost: f64,
    /// rms |T p - q| over the pairs.
    pub rms: f64,
    /// 1 - E / E(p = q): the share of the pairs' squared distances that T accounts for; 0 where
    /// every p is its q.
    pub explained: f64,
    /// The stiffness of the least determined rotation over the greatest singular value; what it
    /// is exactly stands with each function. 0: undetermined.
    pub conditioning: f64,
    /// Whether the pairs determine T: the conditioning and, for half-turns, the explained fraction
    /// pass the thresholds of their function. Whether T holds is another question: see `rms`.
    pub is_well_conditioned: bool,
}

impl Fit {
    /// `isometry` measured on `pairs` of total weight `total`, with its conditioning and whether
    /// that is good enough.
    fn measured(
        pairs: &[Correspondence],
        isometry: Isometry,
        total: f64,
        conditioning: f64,
        is_well_conditioned: bool,
    ) -> Self {
        let residual = |x: &Correspondence| x.weight * (isometry.apply(&x.p) - x.q).norm_squared();
        let spread = |x: &Correspondence| x.weight * (x.p - x.q).norm_squared();
        let squares: f64 = pairs.iter().map(residual).sum();
        let apart: f64 = pairs.iter().map(spread).sum();
        Self {
            isometry,
            cost: 0.5 * squares,
            rms: (squares / total).sqrt(),
            explained: if apart > 0.0 {
                1.0 - squares / apart
            } else {
                0.0
            },
            conditioning,
            is_well_conditioned,
        }
    }
}

/// The smallest relative gap of eigenvalues at which a normal or an axis counts as determined, and
/// the smallest explained fraction at which pairs speak for a mirror or a half-turn (measured on
/// degenerate sets: spheres, half-turns, translations).
const SMALLEST_GAP: f64 = 0.05;
const SMALLEST_EXPLAINED: f64 = 0.9;

/// The sum of the weights, where it is a number above 0.
fn total_weight(pairs: &[Correspondence]) -> Option<f64> {
    let total: f64 = pairs.iter().map(|c| c.weight).sum();
    (total > 0.0 && total.is_finite()).then_some(total)
}

/// The weighted means of p and of q, for pairs of total weight `total`.
fn means(pairs: &[Correspondence], total: f64) -> (Vector, Vector) {
    let p = pairs.iter().map(|x| x.p.coords * (x.weight / total));
    let q = pairs.iter().map(|x| x.q.coords * (x.weight / total));
    (p.sum(), q.sum())
}

/// What the involutions share: c, the weighted mean of the midpoints, and
/// M = sum w (p~ q~^T + q~ p~^T) with p~ = p - c, q~ = q - c.
///
/// With s = (p + q)/2 - c and del = p - q it is 2 sum w s s^T - 1/2 sum w del del^T: the
/// appendix's A - b b^T / 2m with weights and centred.
struct Swaps {
    total: f64,
    centre: Vector,
    m: Matrix3,
    /// sum w |p - q|^2.
    spread: f64,
}

impl Swaps {
    /// `None` without pairs of positive total weight, or where every pair is one and the same
    /// point.
    fn of(pairs: &[Correspondence]) -> Option<Self> {
        let total = total_weight(pairs)?;
        let (p, q) = means(pairs, total);
        let centre = (p + q) / 2.0;
        let mut m = Matrix3::zeros();
        let mut spread = 0.0;
        for x in pairs {
            let s = (x.p.coords + x.q.coords) / 2.0 - centre;
            let del = x.p - x.q;
            m += x.weight * (2.0 * s * s.transpose() - 0.5 * del * del.transpose());
            spread += x.weight * del.norm_squared();
        }
        let norm = m.norm();
        (norm > 0.0 && norm.is_finite()).then_some(Self {
            total,
            centre,
            m,
            spread,
        })
    }
}

/// Sorted eigenpairs of M; in the plane those of its upper 2x2 block, with z last.
fn eigen_in(m: Matrix3, ambient: Ambient) -> (Vector, Matrix3) {
    match ambient {
        Ambient::Space => sorted_eigen(&m),
        Ambient::Plane => {
            let e = m.fixed_view::<2, 2>(0, 0).into_owned().symmetric_eigen();
            let first = usize::from(e.eigenvalues[1] < e.eigenvalues[0]);
            let column =
                |i: usize| Vector::new(e.eigenvectors[(0, i)], e.eigenvectors[(1, i)], 0.0);
            let vectors = Matrix3::from_columns(&[column(first), column(1 - first), Vector::z()]);
            let last = e.eigenvalues[1 - first];
            (Vector::new(e.eigenvalues[first], last, last), vectors)
        }
    }
}

/// The gap between two eigenvalues over the greatest absolute one.
fn relative_gap(lambda: &Vector, low: usize, high: usize) -> f64 {
    (lambda[high] - lambda[low]) / lambda.amax()
}
