//! The elastic joint between two prisms (Botsch et al. 2006).
//!
//! E_ij = integral over the shared side face of |f_ij - f_ji|^2, w_ij = |e|^2 / (A_i + A_j). The
//! integrand is biquadratic, so the mean over 2x2 Gauss points is the integral; both prisms carry
//! the same rest patch, so its mean mu and covariance C over the Gauss points say all:
//! E_ij = tr((R_i - R_j) C (R_i - R_j)^T) + |x_i(mu) - x_j(mu)|^2.

use crate::deform::elastic::{Blocks, Motion, Spring};
use crate::deform::solver::{Coupling, Twist};
use crate::geom::{Matrix3, Point, Vector};

/// Gauss abscissae of [0, 1] with two points: 1/2 -+ 1/(2 sqrt 3).
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// A joint between prisms `i` and `j`.
#[derive(Debug, Clone)]
pub struct Joint {
    /// One prism.
    pub i: usize,
    /// The other prism.
    pub j: usize,
    /// Mean mu of the Gauss points of the shared face, at rest.
    pub mu: Point,
    /// Their covariance C.
    pub c: Matrix3,
    /// w_ij with the stiffness of both prisms in it.
    pub weight: f64,
}

/// The Gauss points of the side face over the edge a-b with unit normals n_a, n_b and half height h.
pub fn gauss_points(a: &Point, b: &Point, n_a: &Vector, n_b: &Vector, h: f64) -> [Point; 4] {
    std::array::from_fn(|g| {
        let (u, v) = (GAUSS[g & 1], GAUSS[g >> 1]);
        let x = a + (b - a) * u;
        x + (n_a * (1.0 - u) + n_b * u) * (h * (2.0 * v - 1.0))
    })
}

impl Joint {
    /// The joint of weight w_ij between prisms `i` and `j` whose shared face has these Gauss points.
    pub fn new(i: usize, j: usize, points: &[Point; 4], weight: f64) -> Self {
        let mu = Point::from(points.iter().map(|x| x.coords).sum::<Vector>() / 4.0);
        let c = points.iter().map(|x| (x - mu) * (x - mu).transpose());
        Self {
            i,
            j,
            mu,
            c: c.sum::<Matrix3>() / 4.0,
            weight,
        }
    }
}

impl Spring for Joint {
    fn ends(&self) -> [usize; 2] {
        [self.i, self.j]
    }

    fn weight(&self) -> f64 {
        self.weight
    }

    fn set_weight(&mut self, weight: f64) {
        self.weight = weight;
    }

    fn energy(&self, motions: &[Motion]) -> f64 {
        let (i, j) = (&motions[self.i], &motions[self.j]);
        let turn = i.rotation - j.rotation;
        let gap = i.apply(&self.mu) - j.apply(&self.mu);
        self.weight * ((turn * self.c).dot(&turn) + gap.norm_squared())
    }

    /// With a point of the face at arm y_i = R_i xi + p from centre i and y_j = R_j xi + q from
    /// centre j, xi its place relative to mu: sum y_j y_i^T = R_j C R_i^T + q p^T, and the gap is
    /// r = (R_i - R_j) xi + e.
    fn blocks(&self, motions: &[Motion]) -> Blocks {
        let (mi, mj) = (&motions[self.i], &motions[self.j]);
        let (x_i, x_j) = (mi.apply(&self.mu), mj.apply(&self.mu));
        let (p, q, e) = (x_i - mi.center, x_j - mj.center, x_i - x_j);
        let w = self.weight;
        let spread = |a: &Motion, b: &Motion| w * a.rotation * self.c * b.rotation.transpose();
        let across = spread(mj, mi);
        let torque = axial(&across);
        let wrench = |arm: &Vector, sign: f64| {
            let m = sign * (w * arm.cross(&e) - torque);
            let f = sign * w * e;
            Twist::new(m.x, m.y, m.z, f.x, f.y, f.z)
        };
        Blocks {
            hessian: [
                Coupling::new(w, &spread(mi, mi), &p, &p),
                Coupling::new(w, &spread(mj, mj), &q, &q),
                -Coupling::new(w, &across, &p, &q),
            ],
            gradient: [wrench(&p, 1.0), wrench(&q, -1.0)],
        }
    }
}

/// The sum of u x v over a sum of v u^T.
pub(crate) fn axial(m: &Matrix3) -> Vector {
    Vector::new(
        m[(2, 1)] - m[(1, 2)],
        m[(0, 2)] - m[(2, 0)],
        m[(1, 0)] - m[(0, 1)],
    )
}
