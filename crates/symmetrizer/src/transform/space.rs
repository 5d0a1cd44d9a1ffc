//! Transformation space with the displacement metric.
//!
//! phi(T) = (R C^1/2, R mu + t) in R^12, with mu and C the centroid and covariance of a support:
//! |phi(T) - phi(T')| is exactly the rms displacement |T x - T' x| over that support. Distances are
//! Euclidean, in the support's own unit (fractions of L on a working surface), without angles,
//! signs or a preferred origin; classical multidimensional scaling of them is PCA of phi.

use nalgebra::SVector;

use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal, sorted_eigen};
use crate::transform::isometry::Isometry;

/// A transformation as a point of transformation space.
pub type Phi = SVector<f64, 12>;

/// The embedding of isometries for one weighted support.
#[derive(Debug, Clone)]
pub struct TransformSpace {
    mu: Vector,
    root_c: Matrix3,
}

impl TransformSpace {
    /// The space whose distance is the rms displacement over `support` (points with weights of
    /// positive sum).
    pub fn new(support: impl Iterator<Item = (Point, f64)> + Clone) -> Self {
        let total: f64 = support.clone().map(|(_, w)| w).sum();
        let mu = support
            .clone()
            .map(|(x, w)| x.coords * (w / total))
            .sum::<Vector>();
        let c = support
            .map(|(x, w)| {
                let d = x.coords - mu;
                d * d.transpose() * (w / total)
            })
            .sum::<Matrix3>();
        let (values, vectors) = sorted_eigen(&c);
        let root = Matrix3::from_diagonal(&values.map(|v| v.max(0.0).sqrt()));
        Self {
            mu,
            root_c: vectors * root * vectors.transpose(),
        }
    }

    /// The centroid of the support.
    pub fn centre(&self) -> Point {
        Point::from(self.mu)
    }

    /// The rms distance of the support from its centroid.
    pub fn radius(&self) -> f64 {
        self.root_c.norm()
    }

    /// The rms distance of the support from the line through `point` along the unit vector `axis`.
    pub fn radius_about(&self, point: &Point, axis: &Vector) -> f64 {
        let across = Matrix3::identity() - axis * axis.transpose();
        let away = (across * (self.mu - point.coords)).norm_squared();
        ((across * self.root_c).norm_squared() + away).sqrt()
    }

    /// Six points of equal weight with the centroid and the covariance of the support: sums of
    /// squared displacements over them are those over the support.
    pub fn probes(&self) -> [Point; 6] {
        std::array::from_fn(|i| {
            let step = self.root_c.column(i / 2) * 3.0_f64.sqrt();
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            Point::from(self.mu + step * sign)
        })
    }

    /// phi(T).
    pub fn embed(&self, t: &Isometry) -> Phi {
        let turned = t.linear * self.root_c;
        let moved = t.linear * self.mu + t.translation;
        Phi::from_iterator(turned.iter().chain(moved.iter()).copied())
    }

    /// The isometry whose phi is nearest to `phi`, proper or improper as asked: the mean of a set of
    /// isometries from the mean of their phi.
    pub fn nearest(&self, phi: &Phi, improper: bool) -> Isometry {
        let turned = Matrix3::from_iterator(phi.iter().take(9).copied());
        let moved = Vector::from_iterator(phi.iter().skip(9).copied());
        let linear = nearest_orthogonal(&(turned * self.root_c), improper);
        Isometry {
            linear,
            translation: moved - linear * self.mu,
        }
    }

    /// The rms displacement between two transformations over the support.
    pub fn distance(&self, a: &Isometry, b: &Isometry) -> f64 {
        (self.embed(a) - self.embed(b)).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transform::Plane;

    #[test]
    fn distance_is_the_rms_displacement() {
        let support: Vec<(Point, f64)> = (0..50)
            .map(|i| {
                let t = f64::from(i);
                let x = Point::new(t.sin() + 3.0, (1.7 * t).cos(), 0.2 * (0.3 * t).sin());
                (x, 1.0 + (t * 0.9).sin().abs())
            })
            .collect();
        let space = TransformSpace::new(support.iter().copied());
        let a = Isometry::mirror(&Plane {
            normal: Vector::new(0.2, 0.9, -0.1).normalize(),
            offset: 0.7,
        });
        let b = Isometry {
            linear: crate::geom::exp_rotation(&Vector::new(0.3, -1.0, 0.4)),
            translation: Vector::new(0.1, -2.0, 0.5),
        };
        let total: f64 = support.iter().map(|(_, w)| w).sum();
        let mean: f64 = support
            .iter()
            .map(|(x, w)| w * (a.apply(x) - b.apply(x)).norm_squared())
            .sum::<f64>()
            / total;
        assert!((space.distance(&a, &b) - mean.sqrt()).abs() < 1e-13);
        for t in [a, b] {
            let again = space.nearest(&space.embed(&t), t.is_improper());
            assert!(space.distance(&t, &again) < 1e-13);
        }
    }
}
