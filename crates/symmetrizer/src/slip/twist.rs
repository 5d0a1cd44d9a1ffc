//! Twists, the velocity fields of sliding, and the twists along which samples slide best.
//!
//! The twist (omega, v) moves x at the velocity omega x x + v. Sample x with normal n leaves the
//! surface at c . (omega, v), c = (x x n, n) (Gelfand and Guibas 2004, section 3). The squared sine of the
//! angle between slide and surface, as a mean over samples weighted by squared speed, is the quotient
//! xi^T A xi / xi^T B xi, A = sum w c c^T, B = sum w V^T V, V = (-[x]x, I): unlike the eigenvalues
//! of A it depends neither on the unit of length nor on the origin.

use nalgebra::{Matrix6, Vector6};

use crate::geom::{Matrix3, Point, Vector, skew};

/// The velocity field x -> omega x x + v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Turn, radians per unit of time.
    pub omega: Vector,
    /// Velocity of the origin.
    pub v: Vector,
}

impl Twist {
    /// The turn about the axis through `point` along the unit vector `axis`.
    pub fn turn(axis: &Vector, point: &Point) -> Self {
        Self::screw(axis, point, 0.0)
    }

    /// The shift along a unit vector.
    pub fn shift(axis: &Vector) -> Self {
        Self {
            omega: Vector::zeros(),
            v: *axis,
        }
    }

    /// The turn about an axis with a shift of `pitch` per radian along it.
    pub fn screw(axis: &Vector, point: &Point, pitch: f64) -> Self {
        Self {
            omega: *axis,
            v: point.coords.cross(axis) + pitch * axis,
        }
    }

    /// The velocity at `x`.
    pub fn velocity(&self, x: &Point) -> Vector {
        self.omega.cross(&x.coords) + self.v
    }

    /// The point of the axis nearest to `x` and the shift per radian; `None` for a shift.
    pub fn axis(&self, x: &Point) -> Option<(Vector, Point, f64)> {
        let turn = self.omega.norm_squared();
        if turn <= 1e-18 * self.v.norm_squared() {
            return None;
        }
        let direction = self.omega / turn.sqrt();
        let foot = Point::from(self.omega.cross(&self.v) / turn);
        let point = foot + direction * direction.dot(&(x - foot));
        Some((direction, point, self.omega.dot(&self.v) / turn))
    }

    fn coords(&self) -> Vector6<f64> {
        let (o, v) = (&self.omega, &self.v);
        Vector6::new(o.x, o.y, o.z, v.x, v.y, v.z)
    }
}

/// The sums A and B of weighted samples.
#[derive(Debug, Clone, Copy)]
pub struct Moments {
    a: Matrix6<f64>,
    b: Matrix6<f64>,
}

impl Default for Moments {
    fn default() -> Self {
        Self {
            a: Matrix6::zeros(),
            b: Matrix6::zeros(),
        }
    }
}

impl std::ops::Add for Moments {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            a: self.a + other.a,
            b: self.b + other.b,
        }
    }
}

impl Moments {
    /// Those of samples (position, normal, weight).
    pub fn of<'a>(samples: impl Iterator<Item = (&'a Point, &'a Vector, f64)>) -> Self {
        let mut a = Matrix6::zeros();
        let (mut mass, mut first, mut second) = (0.0, Vector::zeros(), Matrix3::zeros());
        for (x, n, w) in samples {
            let m = x.coords.cross(n);
            let c = Vector6::new(m.x, m.y, m.z, n.x, n.y, n.z);
            a.syger(w, &c, &c, 1.0);
            mass += w;
            first += w * x.coords;
            second += w * x.coords * x.coords.transpose();
        }
        a.fill_upper_triangle_with_lower_triangle();
        let mut b = Matrix6::identity() * mass;
        let turn = Matrix3::identity() * second.trace() - second;
        b.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
        b.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(&first));
        b.fixed_view_mut::<3, 3>(3, 0).copy_from(&-skew(&first));
        Self { a, b }
    }

    /// Mean squared sine between the twist and the samples; 1 where they do not move.
    pub fn quotient(&self, twist: &Twist) -> f64 {
        let xi = twist.coords();
        let speed = (self.b * xi).dot(&xi);
        if speed <= 0.0 {
            return 1.0;
        }
        ((self.a * xi).dot(&xi) / speed).clamp(0.0, 1.0)
    }

    /// The correlation of two twists' velocities over the samples, -1 to 1.
    pub fn correlation(&self, one: &Twist, other: &Twist) -> f64 {
        let (x, y) = (one.coords(), other.coords());
        let square = (self.b * x).dot(&x) * (self.b * y).dot(&y);
        if square <= 0.0 {
            return 0.0;
        }
        (self.b * x).dot(&y) / square.sqrt()
    }

    /// The twists of stationary quotient, the best first; `None` for samples on a line.
    pub fn twists(&self) -> Option<[Twist; 6]> {
        let ridge = Matrix6::identity() * (1e-12 * self.b.trace());
        let inverse = (self.b + ridge).cholesky()?.l().try_inverse()?;
        let white = inverse * self.a * inverse.transpose();
        let eigen = white.symmetric_eigen();
        let mut order = [0, 1, 2, 3, 4, 5];
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        Some(order.map(|k| {
            let xi = inverse.transpose() * eigen.eigenvectors.column(k);
            Twist {
                omega: Vector::new(xi[0], xi[1], xi[2]),
                v: Vector::new(xi[3], xi[4], xi[5]),
            }
        }))
    }
}
