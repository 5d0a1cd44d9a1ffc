//! The elastic joint between two prisms (Botsch et al. 2006).
//!
//! E_ij = integral over the shared side face of |f_ij - f_ji|^2, w_ij = |e|^2 / (A_i + A_j). The
//! integrand is biquadratic, so the mean over 2x2 Gauss points is the integral; both prisms carry
//! the same rest patch, so four rest points X_g say all: E_ij = 1/4 sum_g |x_i^g - x_j^g|^2.

use nalgebra::{Matrix6, Vector6};

use crate::deform::primo::motion::Motion;
use crate::geom::{Matrix3, Point, Vector, skew};

/// Gauss abscissae of [0, 1] with two points: 1/2 -+ 1/(2 sqrt 3).
const GAUSS: [f64; 2] = [0.211_324_865_405_187_13, 0.788_675_134_594_812_9];

/// A joint between prisms `i` and `j`.
#[derive(Debug, Clone)]
pub struct Joint {
    /// One prism.
    pub i: usize,
    /// The other prism.
    pub j: usize,
    /// Rest positions of the four Gauss points of the shared face.
    pub points: [Point; 4],
    /// w_ij / 4 with the stiffness of both prisms in it.
    pub weight: f64,
}

/// The Hessian blocks and gradients of one joint under Gauss-Newton.
pub struct Blocks {
    /// H_ii, H_jj, H_ij.
    pub hessian: [Matrix6<f64>; 3],
    /// g_i, g_j.
    pub gradient: [Vector6<f64>; 2],
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
    /// E_ij with its weight.
    pub fn energy(&self, motions: &[Motion]) -> f64 {
        let (i, j) = (&motions[self.i], &motions[self.j]);
        let gap = |x: &Point| (i.apply(x) - j.apply(x)).norm_squared();
        self.weight * self.points.iter().map(gap).sum::<f64>()
    }

    /// The Gauss-Newton blocks about the present centres, unknowns (omega, v) per prism.
    pub fn blocks(&self, motions: &[Motion]) -> Blocks {
        let (mi, mj) = (&motions[self.i], &motions[self.j]);
        let mut out = Blocks {
            hessian: [Matrix6::zeros(); 3],
            gradient: [Vector6::zeros(); 2],
        };
        let w = self.weight;
        for x in &self.points {
            let (x_i, x_j) = (mi.apply(x), mj.apply(x));
            let (y_i, y_j) = (x_i - mi.center, x_j - mj.center);
            let r = x_i - x_j;
            add(&mut out.hessian[0], w, &y_i, &y_i);
            add(&mut out.hessian[1], w, &y_j, &y_j);
            add(&mut out.hessian[2], -w, &y_i, &y_j);
            out.gradient[0] += wrench(&y_i, &(w * r));
            out.gradient[1] -= wrench(&y_j, &(w * r));
        }
        out
    }
}

/// Adds `w [(a.b) I - b a^T, [a]; -[b], I]`: the product of two points' twist Jacobians.
pub fn add(h: &mut Matrix6<f64>, w: f64, a: &Vector, b: &Vector) {
    let turn = Matrix3::identity() * a.dot(b) - b * a.transpose();
    let mut block = |r, c, m: Matrix3| {
        let mut view = h.fixed_view_mut::<3, 3>(r, c);
        view += w * m;
    };
    block(0, 0, turn);
    block(0, 3, skew(a));
    block(3, 0, -skew(b));
    block(3, 3, Matrix3::identity());
}

/// (y x f, f): a force at arm y as a wrench.
pub fn wrench(y: &Vector, f: &Vector) -> Vector6<f64> {
    let m = y.cross(f);
    Vector6::new(m.x, m.y, m.z, f.x, f.y, f.z)
}
