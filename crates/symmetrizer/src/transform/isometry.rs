//! One type for every isometry of space: x -> R x + t with R orthogonal, det R = +-1.

use crate::geom::{Matrix3, Point, Vector, sorted_eigen};

/// An isometry x -> `linear` x + `translation`; a mirror is one kind of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Isometry {
    /// Orthogonal, determinant +1 or -1.
    pub linear: Matrix3,
    /// Model units.
    pub translation: Vector,
}

/// The mirror plane n.x = d of a reflection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal n.
    pub normal: Vector,
    /// Offset d along the normal, model units.
    pub offset: f64,
}

impl Plane {
    /// The plane through `point` with unit normal `normal`.
    pub fn through(point: &Point, normal: Vector) -> Self {
        Self {
            normal,
            offset: normal.dot(&point.coords),
        }
    }

    /// The same plane with the largest component of the normal positive, so that planes compare
    /// and print alike.
    pub fn canonical(self) -> Self {
        if self.normal[self.normal.iamax()] < 0.0 {
            Self {
                normal: -self.normal,
                offset: -self.offset,
            }
        } else {
            self
        }
    }

    /// Signed distance n.x - d.
    pub fn signed_distance(&self, x: &Point) -> f64 {
        self.normal.dot(&x.coords) - self.offset
    }
}

impl Isometry {
    /// x -> x.
    pub fn identity() -> Self {
        Self {
            linear: Matrix3::identity(),
            translation: Vector::zeros(),
        }
    }

    /// The reflection in `plane`: R = I - 2 n n^T, t = 2 d n.
    pub fn mirror(plane: &Plane) -> Self {
        let n = plane.normal;
        Self {
            linear: Matrix3::identity() - 2.0 * n * n.transpose(),
            translation: 2.0 * plane.offset * n,
        }
    }

    /// The image of a point.
    pub fn apply(&self, x: &Point) -> Point {
        Point::from(self.linear * x.coords + self.translation)
    }

    /// The image of a direction.
    pub fn rotate(&self, v: &Vector) -> Vector {
        self.linear * v
    }

    /// The product: first `other`, then `self`.
    pub fn after(&self, other: &Self) -> Self {
        Self {
            linear: self.linear * other.linear,
            translation: self.linear * other.translation + self.translation,
        }
    }

    /// The inverse isometry.
    pub fn inverse(&self) -> Self {
        let linear = self.linear.transpose();
        Self {
            linear,
            translation: -(linear * self.translation),
        }
    }

    /// Whether the isometry turns left hands into right hands.
    pub fn is_improper(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// The mirror that comes nearest to an improper isometry on points around `center`: its normal is
    /// the direction that is turned round most.
    pub fn nearest_mirror(&self, center: &Point) -> Plane {
        let symmetric = self.linear + self.linear.transpose();
        let normal = sorted_eigen(&symmetric).1.column(0).into_owned();
        Plane::through(&nalgebra::center(center, &self.apply(center)), normal)
    }

    /// The plane, where this is a pure reflection (to 1e-6 in R and, relative to |t|, in t).
    pub fn as_mirror(&self) -> Option<Plane> {
        if !self.is_improper() || (self.linear.trace() - 1.0).abs() > 1e-6 {
            return None;
        }
        // R = I - 2 n n^T, so n is the column of I - R with the largest norm.
        let nn = Matrix3::identity() - self.linear;
        let column = (0..3).max_by(|&a, &b| nn[(a, a)].total_cmp(&nn[(b, b)]))?;
        let normal = nn.column(column).normalize();
        let offset = normal.dot(&self.translation) / 2.0;
        let glide = (self.translation - 2.0 * offset * normal).norm();
        (glide <= 1e-6 * (1.0 + self.translation.norm()))
            .then(|| Plane { normal, offset }.canonical())
    }
}
