//! Axis, angle, plane, fixed point and shift of an isometry of known kind.

use crate::geom::{Matrix3, Point, Vector, exp_rotation, sorted_eigen};
use crate::transform::isometry::Isometry;
use crate::transform::kind::Kind;
use crate::transform::space::TransformSpace;

/// What an isometry of a kind is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elements {
    /// The kind.
    pub kind: Kind,
    /// The unit axis of a rotation, screw or rotoreflection, or the normal of a mirror or glide
    /// plane, largest component positive.
    pub axis: Option<Vector>,
    /// The point nearest to the support's centroid that is on the axis or in the plane; the fixed
    /// point of an inversion or rotoreflection; the centroid itself for the rest.
    pub point: Point,
    /// Rotation about `axis` in radians, in (-pi, pi]; the inverse has the other sign. 0 where
    /// nothing turns.
    pub angle: f64,
    /// What is left when `point` is held: the pitch of a screw along its axis, the glide in its
    /// plane, the translation; else 0.
    pub shift: Vector,
    /// The smallest n <= 64 such that the angle is a multiple of 2 pi / n within the tolerance;
    /// of kinds that turn.
    pub order: Option<u32>,
}

/// The greatest order that is looked for.
const GREATEST_ORDER: u32 = 64;

impl Elements {
    /// The elements of `t`, which is an isometry of `kind` up to rounding.
    pub(super) fn read(kind: Kind, t: &Isometry, space: &TransformSpace, tolerance: f64) -> Self {
        let centre = space.centre();
        let moved = t.apply(&centre) - centre;
        let still = Self {
            kind,
            axis: None,
            point: centre,
            angle: 0.0,
            shift: Vector::zeros(),
            order: None,
        };
        match kind {
            Kind::Identity => still,
            Kind::Translation => Self {
                shift: moved,
                ..still
            },
            Kind::Inversion => Self {
                point: centre + moved / 2.0,
                ..still
            },
            Kind::Mirror | Kind::Glide => still.across(&t.linear, &moved),
            Kind::Rotation | Kind::Screw => {
                let turn = turn_of(&t.linear);
                still.about(turn, &moved).ordered(space, tolerance)
            }
            Kind::Rotoreflection => {
                let (axis, half_more) = turn_of(&-t.linear);
                let turn = (axis, wrapped(half_more + std::f64::consts::PI));
                let screwed = still.about(turn, &moved);
                Self {
                    point: screwed.point + screwed.shift / 2.0,
                    shift: Vector::zeros(),
                    ..screwed
                }
                .ordered(space, tolerance)
            }
        }
    }

    /// With the plane of the reflection `linear` that moves `point` by `moved`.
    fn across(self, linear: &Matrix3, moved: &Vector) -> Self {
        let axis = turn_of(&-linear).0;
        let out = axis * axis.dot(moved);
        Self {
            axis: Some(axis),
            point: self.point + out / 2.0,
            shift: moved - out,
            ..self
        }
        .without_rest()
    }

    /// With the axis and angle that, and the shift along the axis, move `point` by `moved`.
    fn about(self, (axis, angle): (Vector, f64), moved: &Vector) -> Self {
        let along = axis * axis.dot(moved);
        Self {
            axis: Some(axis),
            point: self.point + fixed_across(&axis, angle, &(moved - along)),
            angle,
            shift: along,
            ..self
        }
        .without_rest()
    }

    /// Kinds without a shift of their own have none, not even that of rounding.
    fn without_rest(self) -> Self {
        match self.kind {
            Kind::Mirror | Kind::Rotation => Self {
                shift: Vector::zeros(),
                ..self
            },
            _ => self,
        }
    }

    /// With the order of the angle, an error of which moves points by the support's distance from
    /// the axis times it.
    fn ordered(self, space: &TransformSpace, tolerance: f64) -> Self {
        let axis = self.axis.unwrap_or_else(Vector::z);
        let radius = space.radius_about(&self.point, &axis);
        let moves = |delta: f64| 2.0 * (delta / 2.0).sin().abs() * radius;
        let turns = self.angle / std::f64::consts::TAU;
        let fits = |n: &u32| {
            let n = f64::from(*n);
            moves((turns * n - (turns * n).round()) / n * std::f64::consts::TAU) <= tolerance
        };
        Self {
            order: (1..=GREATEST_ORDER).find(fits),
            ..self
        }
    }

    /// The elements of `t`, an isometry of `kind` up to rounding, without an order.
    pub fn exactly(kind: Kind, t: &Isometry, space: &TransformSpace) -> Self {
        Self {
            order: None,
            ..Self::read(kind, t, space, 0.0)
        }
    }

    /// The isometry that has these elements.
    pub fn isometry(&self) -> Isometry {
        let axis = self.axis.unwrap_or_else(Vector::zeros);
        let turn = exp_rotation(&(axis * self.angle));
        let across = Matrix3::identity() - 2.0 * axis * axis.transpose();
        let linear = match self.kind {
            Kind::Identity | Kind::Translation => Matrix3::identity(),
            Kind::Rotation | Kind::Screw => turn,
            Kind::Mirror | Kind::Glide => across,
            Kind::Inversion => -Matrix3::identity(),
            Kind::Rotoreflection => turn * across,
        };
        Isometry {
            linear,
            translation: self.point.coords - linear * self.point.coords + self.shift,
        }
    }
}

/// The unit axis, largest component positive, and the angle in (-pi, pi] of a rotation. The axis
/// of the identity is any.
pub fn turn_of(rotation: &Matrix3) -> (Vector, f64) {
    let r = rotation;
    let sine = Vector::new(
        r[(2, 1)] - r[(1, 2)],
        r[(0, 2)] - r[(2, 0)],
        r[(1, 0)] - r[(0, 1)],
    ) / 2.0;
    let cosine = (r.trace() - 1.0) / 2.0;
    // The antisymmetric part gives the axis of small angles, the symmetric one that of large ones.
    let axis = if cosine > 0.0 && sine.norm() > 0.0 {
        sine.normalize()
    } else {
        let (_, vectors) = sorted_eigen(&((r + r.transpose()) / 2.0));
        vectors.column(2).into_owned()
    };
    let axis = if axis[axis.iamax()] < 0.0 {
        -axis
    } else {
        axis
    };
    (axis, wrapped(sine.dot(&axis).atan2(cosine)))
}

/// The angle in (-pi, pi]; a half-turn within rounding is +pi.
fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let angle = angle - TAU * (angle / TAU).round();
    if angle < -PI + 1e-12 { PI } else { angle }
}

/// The x across `axis` with R x + u = x for the rotation R by `angle` about `axis`; u is across
/// the axis too.
fn fixed_across(axis: &Vector, angle: f64, u: &Vector) -> Vector {
    let cot = (angle / 2.0).cos() / (angle / 2.0).sin();
    (u + axis.cross(u) * cot) / 2.0
}
