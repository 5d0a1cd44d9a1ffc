//! The second step: triangles of their own size and form, turned.

use rayon::prelude::*;

use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;

/// A rotation of the plane by its cosine and sine.
#[derive(Debug, Clone, Copy)]
pub struct Turn(f64, f64);

impl Turn {
    /// By an angle, radians.
    pub fn by(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self(cos, sin)
    }

    /// The mean of those of a triangle's corners.
    pub fn mean(corners: &[u32; 3], rotations: &[Matrix3]) -> Self {
        let sum: Matrix3 = corners.iter().map(|&v| rotations[v as usize]).sum();
        Self::along(sum[(0, 0)] + sum[(1, 1)], sum[(1, 0)] - sum[(0, 1)])
    }

    fn along(cos: f64, sin: f64) -> Self {
        let length = cos.hypot(sin);
        if length > 0.0 {
            Self(cos / length, sin / length)
        } else {
            Self(1.0, 0.0)
        }
    }

    /// A vector of the plane, turned.
    pub fn apply(&self, v: &Vector) -> Vector {
        let Self(cos, sin) = self;
        Vector::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, 0.0)
    }
}

/// The rotation of each triangle of `rest` that fits `positions` best: over its centred corners p at rest and q, the
/// angle atan2(sum p x q, sum p . q).
pub fn turns(rest: &Surface, positions: &[Point]) -> Vec<Turn> {
    let turn = |corners: &[u32; 3]| {
        let centred = |x: &[Point]| {
            let x = corners.map(|v| x[v as usize].coords);
            let center = (x[0] + x[1] + x[2]) / 3.0;
            x.map(|x| x - center)
        };
        let (p, q) = (centred(&rest.positions), centred(positions));
        let pairs = || p.iter().zip(&q);
        let cos = pairs().map(|(p, q)| p.dot(q)).sum();
        let sin = pairs().map(|(p, q)| p.x * q.y - p.y * q.x).sum();
        Turn::along(cos, sin)
    };
    rest.triangles
        .par_iter()
        .with_min_len(1024)
        .map(turn)
        .collect()
}
