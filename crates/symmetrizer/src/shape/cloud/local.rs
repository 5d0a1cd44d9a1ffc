//! The surface next to a point of a cloud: a plane, then a quadric over it.

use nalgebra::{SMatrix, SVector};

use crate::geom::{Matrix3, Point, Vector, sorted_eigen};

/// What the neighbours of a point say about the surface there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    /// Unit normal of the quadric, either way.
    pub normal: Vector,
    /// The point moved along the plane's normal onto the quadric.
    pub foot: Point,
    /// Spread of the neighbours about the quadric, the parameters of which are allowed for: an
    /// estimate of the noise's standard deviation.
    pub spread: f64,
    /// Whether the neighbours lie along a line, so that they tell no plane.
    pub in_line: bool,
}

/// Smallest ratio of the middle to the largest variance of neighbours that spread over a surface.
const ROUND: f64 = 0.02;
/// Steepest quadric over its plane that is believed.
const STEEP: f64 = 1.0;

/// Fits the surface next to `x` to its `neighbours`, the farthest last.
pub(super) fn local(x: &Point, neighbours: &[Point]) -> Local {
    let offsets: Vec<Vector> = neighbours.iter().map(|p| p - x).collect();
    let reach = offsets.iter().map(Vector::norm_squared).fold(0.0, f64::max);
    let radius = (1.2 * reach).sqrt().max(f64::MIN_POSITIVE);
    // Weights that fade to the rim keep the fit from jumping where a neighbour comes or goes.
    let weights: Vec<f64> = offsets
        .iter()
        .map(|v| 1.0 - (v / radius).norm_squared())
        .collect();
    let total: f64 = weights.iter().sum();
    let mean = weighted(&offsets, &weights).sum::<Vector>() / total;
    let spread = |v: &Vector| (v - mean) * (v - mean).transpose();
    let covariance: Matrix3 = offsets
        .iter()
        .zip(&weights)
        .map(|(v, w)| spread(v) * *w)
        .sum();
    let (variances, axes) = sorted_eigen(&(covariance / total));
    let [n, t1, t2] = [0, 1, 2].map(|k| axes.column(k).into_owned());
    let plane = Local {
        normal: n,
        foot: x + n * n.dot(&mean),
        spread: variances[0].max(0.0).sqrt(),
        in_line: variances[1] <= ROUND * variances[2],
    };
    let frame = [t1, t2, n];
    quadric(x, &offsets, &weights, frame, radius)
        .filter(|q| (q.foot - plane.foot).norm() <= 3.0 * plane.spread)
        .map_or(plane, |q| Local {
            in_line: plane.in_line,
            ..q
        })
}

fn weighted<'a>(v: &'a [Vector], w: &'a [f64]) -> impl Iterator<Item = Vector> + 'a {
    v.iter().zip(w).map(|(v, w)| v * *w)
}

/// The quadric over the plane of `frame`; `None` where the neighbours do not tell one.
fn quadric(
    x: &Point,
    offsets: &[Vector],
    weights: &[f64],
    [t1, t2, n]: [Vector; 3],
    radius: f64,
) -> Option<Local> {
    let mut a = SMatrix::<f64, 6, 6>::zeros();
    let mut b = SVector::<f64, 6>::zeros();
    let row = |v: &Vector| {
        let (x, y) = (v.dot(&t1) / radius, v.dot(&t2) / radius);
        SVector::<f64, 6>::from([x * x, x * y, y * y, x, y, 1.0])
    };
    for (v, &w) in offsets.iter().zip(weights) {
        let row = row(v);
        a += w * row * row.transpose();
        b += w * (v.dot(&n) / radius) * row;
    }
    // Curvatures that few neighbours tell apart stay small.
    (0..3).for_each(|k| a[(k, k)] += 1e-3 * a[(5, 5)] / 15.0);
    let q = a.cholesky()?.solve(&b);
    if q[3].hypot(q[4]) > STEEP {
        return None;
    }
    let gap = |v: &Vector| v.dot(&n) / radius - row(v).dot(&q);
    let square: f64 = offsets.iter().map(|v| gap(v).powi(2)).sum();
    let free = offsets.len().checked_sub(6).filter(|&n| n > 0)?;
    Some(Local {
        normal: (n - t1 * q[3] - t2 * q[4]).normalize(),
        foot: x + n * (q[5] * radius),
        spread: radius * (square / free as f64).sqrt(),
        in_line: false,
    })
}
