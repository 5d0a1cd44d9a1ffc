//! Signed distance fields (negative inside): rounded primitives and their smooth unions.

use crate::geom::{Matrix3, Point, Vector};

/// A rounded solid.
pub(super) enum Solid {
    /// The hull of two balls.
    RoundCone {
        a: Point,
        b: Point,
        radius_a: f64,
        radius_b: f64,
    },
    /// An ellipsoid; the rows of `frame` are its axes.
    Ellipsoid {
        center: Point,
        radii: Vector,
        frame: Matrix3,
    },
}

/// The hull of the balls about `a` and `b`; neither ball may contain the other.
pub(super) fn cone(a: [f64; 3], radius_a: f64, b: [f64; 3], radius_b: f64) -> Solid {
    Solid::RoundCone {
        a: a.into(),
        b: b.into(),
        radius_a,
        radius_b,
    }
}

/// An ellipsoid along the coordinate axes.
pub(super) fn ellipsoid(center: [f64; 3], radii: [f64; 3]) -> Solid {
    Solid::Ellipsoid {
        center: center.into(),
        radii: radii.into(),
        frame: Matrix3::identity(),
    }
}

/// A leaf: an ellipsoid whose longest axis goes from its middle along `up` and whose thinnest axis
/// is the part of `facing` orthogonal to it; `radii` are length, width, thickness.
pub(super) fn leaf(center: [f64; 3], up: [f64; 3], facing: [f64; 3], radii: [f64; 3]) -> Solid {
    let up = Vector::from(up).normalize();
    let facing = Vector::from(facing);
    let front = (facing - up * up.dot(&facing)).normalize();
    let side = front.cross(&up);
    Solid::Ellipsoid {
        center: center.into(),
        radii: radii.into(),
        frame: Matrix3::from_rows(&[up.transpose(), side.transpose(), front.transpose()]),
    }
}

impl Solid {
    /// The signed distance of `p`: exact for cones, of first order near the surface of ellipsoids.
    pub fn distance(&self, p: &Point) -> f64 {
        match self {
            Self::RoundCone {
                a,
                b,
                radius_a,
                radius_b,
            } => round_cone(&(p - a), &(b - a), *radius_a, *radius_b),
            Self::Ellipsoid {
                center,
                radii,
                frame,
            } => ellipsoid_distance(&(frame * (p - center)), radii),
        }
    }
}

/// The distance in the half-plane through the axis: the nearest point lies on one ball or on the
/// line that touches both.
fn round_cone(x: &Vector, axis: &Vector, radius_a: f64, radius_b: f64) -> f64 {
    let length = axis.norm();
    let along = x.dot(axis) / length;
    let across = (x.norm_squared() - along * along).max(0.0).sqrt();
    let slope = (radius_a - radius_b) / length;
    let flank = (1.0 - slope * slope).max(0.0).sqrt();
    let foot = along * flank - across * slope;
    if foot <= 0.0 {
        x.norm() - radius_a
    } else if foot >= length * flank {
        (x - axis).norm() - radius_b
    } else {
        across * flank + along * slope - radius_a
    }
}

fn ellipsoid_distance(x: &Vector, radii: &Vector) -> f64 {
    let scaled = x.component_div(radii);
    let gradient = scaled.component_div(radii).norm();
    if gradient < 1e-9 {
        return -radii.min();
    }
    scaled.norm() * (scaled.norm() - 1.0) / gradient
}

/// The union of two solids with a fillet of about the size `blend` (polynomial smooth minimum).
pub(super) fn join(a: f64, b: f64, blend: f64) -> f64 {
    let overlap = (blend - (a - b).abs()).max(0.0) / blend;
    a.min(b) - overlap * overlap * blend / 4.0
}

/// `a` without `b`, with rounded rims.
pub(super) fn carve(a: f64, b: f64, blend: f64) -> f64 {
    -join(-a, b, blend)
}

/// From 0 at `low` to 1 at `high` with level ends; `low` may be the greater one.
pub(super) fn ramp(x: f64, low: f64, high: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The point on the other side of the plane y = 0.
pub(super) fn mirrored(p: &Point) -> Point {
    Point::new(p.x, -p.y, p.z)
}
