//! The 6x6 block between two rigid elements: sixteen numbers instead of thirty-six.
//!
//! Springs of weights w between points at arms y_i and y_j from the elements' centres give, for twists
//! (omega, v): `[tr(M) I - M, [a]; -[b], s]` with M = sum w y_j y_i^T, a = sum w y_i, b = sum w y_j,
//! s = sum w.

use std::ops::{AddAssign, Neg};

use nalgebra::{Matrix6, Vector6};

use crate::geom::{Matrix3, Vector, skew};

/// A twist (omega, v) or a wrench (torque, force).
pub type Twist = Vector6<f64>;

/// The block of a row element i and a column element j.
#[derive(Debug, Clone, Copy)]
pub struct Coupling {
    /// M = sum w y_j y_i^T.
    m: Matrix3,
    /// a = sum w y_i.
    a: Vector,
    /// b = sum w y_j.
    b: Vector,
    /// s = sum w.
    s: f64,
}

impl Coupling {
    /// Nothing.
    pub fn zero() -> Self {
        Self {
            m: Matrix3::zeros(),
            a: Vector::zeros(),
            b: Vector::zeros(),
            s: 0.0,
        }
    }

    /// Springs of total weight `w` about mean arms p of i and q of j, with `spread` = sum w times
    /// (y_j - q)(y_i - p)^T.
    pub fn new(w: f64, spread: &Matrix3, p: &Vector, q: &Vector) -> Self {
        Self {
            m: spread + w * q * p.transpose(),
            a: w * p,
            b: w * q,
            s: w,
        }
    }

    /// The same springs seen from centres that lie at -d_i and -d_j from the present ones.
    pub fn shifted(&self, d_i: &Vector, d_j: &Vector) -> Self {
        Self {
            m: self.m
                + d_j * self.a.transpose()
                + self.b * d_i.transpose()
                + self.s * d_j * d_i.transpose(),
            a: self.a + self.s * d_i,
            b: self.b + self.s * d_j,
            s: self.s,
        }
    }

    /// The block of j and i.
    pub fn transposed(&self) -> Self {
        Self {
            m: self.m.transpose(),
            a: self.b,
            b: self.a,
            s: self.s,
        }
    }

    /// The block times a twist of element j.
    pub fn apply(&self, x: &Twist) -> Twist {
        let (omega, v) = (Vector::new(x[0], x[1], x[2]), Vector::new(x[3], x[4], x[5]));
        let top = self.m.trace() * omega - self.m * omega + self.a.cross(&v);
        let bottom = self.s * v - self.b.cross(&omega);
        Twist::new(top.x, top.y, top.z, bottom.x, bottom.y, bottom.z)
    }

    /// The block of j and i times a twist of element i.
    pub fn apply_transposed(&self, x: &Twist) -> Twist {
        let (omega, v) = (Vector::new(x[0], x[1], x[2]), Vector::new(x[3], x[4], x[5]));
        let top = self.m.trace() * omega - self.m.tr_mul(&omega) + self.b.cross(&v);
        let bottom = self.s * v - self.a.cross(&omega);
        Twist::new(top.x, top.y, top.z, bottom.x, bottom.y, bottom.z)
    }

    /// The block in full.
    pub fn matrix(&self) -> Matrix6<f64> {
        let mut out = Matrix6::zeros();
        let mut set = |r, c, m: &Matrix3| out.fixed_view_mut::<3, 3>(r, c).copy_from(m);
        set(0, 0, &(Matrix3::identity() * self.m.trace() - self.m));
        set(0, 3, &skew(&self.a));
        set(3, 0, &-skew(&self.b));
        set(3, 3, &(Matrix3::identity() * self.s));
        out
    }

    /// The sum of the block's diagonal.
    pub fn trace(&self) -> f64 {
        2.0 * self.m.trace() + 3.0 * self.s
    }
}

impl AddAssign for Coupling {
    fn add_assign(&mut self, other: Self) {
        self.m += other.m;
        self.a += other.a;
        self.b += other.b;
        self.s += other.s;
    }
}

impl Neg for Coupling {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            m: -self.m,
            a: -self.a,
            b: -self.b,
            s: -self.s,
        }
    }
}
