//! Axes of rotation, and the motions that carry two of them to one (ours, `docs/decisions/0032-rotations-are-merged-at-a-hinge.md`).
//! Lengths are in the unit of the points.

use crate::geom::{Matrix3, Point, Vector, exp_rotation, sorted_eigen};
use crate::transform::isometry::{Isometry, Plane};

/// Lines whose directions differ by less than this sine count as parallel: where they come nearest is no place of theirs.
const PARALLEL: f64 = 0.01;

/// A line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// A point of it.
    pub point: Point,
    /// Its unit direction.
    pub direction: Vector,
}

/// The way of a part to the common axis: about a hinge from one direction to another, and the hinge to a place.
#[derive(Debug, Clone, Copy)]
pub struct Carry {
    hinge: Point,
    turn: Vector,
    way: Vector,
}

impl Axis {
    /// Of a rotation, half-turns among them; `None` of the identity and of what is improper.
    ///
    /// The direction d is the eigenvector of R + R^T to the eigenvalue 2. Of the points that the rotation keeps the one with
    /// d.p = 0 is the solution of (I - R + d d^T) p = t - (d.t) d; a shift along the axis counts for nothing.
    pub fn of(t: &Isometry) -> Option<Self> {
        let turns = (t.linear - Matrix3::identity()).norm() > 1e-6;
        if t.is_improper() || !turns {
            return None;
        }
        let symmetric = t.linear + t.linear.transpose();
        let direction = sorted_eigen(&symmetric).1.column(2).into_owned();
        let matrix = Matrix3::identity() - t.linear + direction * direction.transpose();
        let across = t.translation - direction.dot(&t.translation) * direction;
        let point = matrix.try_inverse()? * across;
        Some(Self {
            point: Point::from(point),
            direction,
        })
    }

    /// The point of it that is nearest to `x`.
    pub fn foot(&self, x: &Point) -> Point {
        self.point + self.direction * self.direction.dot(&(x - self.point))
    }

    /// The rotation about it by `angle` (radians).
    pub fn rotation(&self, angle: f64) -> Isometry {
        let linear = exp_rotation(&(self.direction * angle));
        Isometry {
            linear,
            translation: self.point.coords - linear * self.point.coords,
        }
    }

    /// Where the motion `t` takes it.
    pub fn carried(&self, t: &Isometry) -> Self {
        Self {
            point: t.apply(&self.point),
            direction: t.rotate(&self.direction).normalize(),
        }
    }

    /// The line nearest to it in `plane`.
    pub fn within(&self, plane: &Plane) -> Self {
        let n = plane.normal;
        let across = self.direction - self.direction.dot(&n) * n;
        Self {
            point: self.point - plane.signed_distance(&self.point) * n,
            direction: across.try_normalize(1e-9).unwrap_or(self.direction),
        }
    }

    /// The other way round where it does not run along `way`.
    fn along(self, way: &Vector) -> Self {
        let sign = if self.direction.dot(way) < 0.0 {
            -1.0
        } else {
            1.0
        };
        Self {
            direction: sign * self.direction,
            ..self
        }
    }
}

/// Two parts of a shape around axes of their own, one after the other along them.
#[derive(Debug, Clone, Copy)]
pub struct Jointed {
    /// The axes, both from the first part to the second.
    pub axes: [Axis; 2],
    /// The points of the axes beside the middles of the parts.
    pub feet: [Point; 2],
    /// The points of the axes where they come nearest to each other, between the feet.
    pub hinges: [Point; 2],
}

impl Jointed {
    /// Of parts around `axes` with these `middles`.
    pub fn new(axes: [Axis; 2], middles: [Point; 2]) -> Self {
        let feet = [0, 1].map(|k| axes[k].foot(&middles[k]));
        let way = feet[1] - feet[0];
        let axes = axes.map(|axis| axis.along(&way));
        let [a, b] = [axes[0].direction, axes[1].direction];
        let (reach_a, reach_b) = (way.dot(&a), way.dot(&b));
        let cosine = a.dot(&b);
        let sine_squared = 1.0 - cosine * cosine;
        // Points feet[0] + s a and feet[1] - t b.
        let (s, t) = if sine_squared < PARALLEL * PARALLEL {
            (reach_a / 2.0, reach_b / 2.0)
        } else {
            (
                (reach_a - cosine * reach_b) / sine_squared,
                (reach_b - cosine * reach_a) / sine_squared,
            )
        };
        let within = |x: f64, reach: f64| x.clamp(0.0, reach.max(0.0));
        Self {
            hinges: [
                feet[0] + within(s, reach_a) * a,
                feet[1] - within(t, reach_b) * b,
            ],
            axes,
            feet,
        }
    }

    /// The angle between the axes, radians.
    pub fn angle(&self) -> f64 {
        let [a, b] = self.axes.map(|axis| axis.direction);
        a.cross(&b).norm().atan2(a.dot(&b))
    }

    /// How far the axes miss each other where they come nearest, as a share of the way from part to part.
    pub fn gap(&self) -> f64 {
        let way = (self.feet[1] - self.feet[0]).norm();
        (self.hinges[1] - self.hinges[0]).norm() / way.max(f64::MIN_POSITIVE)
    }

    /// The largest angle between an axis and the way from part to part, radians.
    pub fn aslant(&self) -> f64 {
        let way = self.feet[1] - self.feet[0];
        let angles = self.axes.map(|axis| {
            let d = axis.direction;
            d.cross(&way).norm().atan2(d.dot(&way))
        });
        angles[0].max(angles[1])
    }

    /// The axis between both: its direction is their mean, and it goes through the middle of the hinges.
    pub fn common(&self) -> Axis {
        let [a, b] = self.axes.map(|axis| axis.direction);
        Axis {
            point: nalgebra::center(&self.hinges[0], &self.hinges[1]),
            direction: (a + b).try_normalize(1e-9).unwrap_or(a),
        }
    }

    /// The way of each part to the common axis: about its hinge, along an arc, as a bend is undone. The length from part to part is that along
    /// the bend: of the chord it would be less by the cosine of half of the angle.
    pub fn carries(&self) -> [Carry; 2] {
        let common = self.common();
        [0, 1].map(|k| {
            let d = self.axes[k].direction;
            let across = d.cross(&common.direction);
            let angle = across.norm().atan2(d.dot(&common.direction));
            let turn = across.try_normalize(1e-12).unwrap_or_else(Vector::zeros) * angle;
            Carry {
                hinge: self.hinges[k],
                turn,
                way: common.point - self.hinges[k],
            }
        })
    }
}

impl Carry {
    /// This `fraction` of it.
    pub fn part(&self, fraction: f64) -> Isometry {
        let linear = exp_rotation(&(self.turn * fraction));
        let place = self.hinge + self.way * fraction;
        Isometry {
            linear,
            translation: place.coords - linear * self.hinge.coords,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(point: [f64; 3], direction: [f64; 3]) -> Axis {
        Axis {
            point: Point::from(point),
            direction: Vector::from(direction).normalize(),
        }
    }

    fn is_on(x: &Point, axis: &Axis) -> bool {
        (axis.foot(x) - x).norm() < 1e-9
    }

    #[test]
    fn a_rotation_has_its_axis() {
        let line = axis([0.3, -2.0, 1.0], [0.2, 0.9, -0.4]);
        for angle in [0.01, 1.3, std::f64::consts::PI, -2.0] {
            let found = Axis::of(&line.rotation(angle)).expect("it turns");
            assert!(found.direction.cross(&line.direction).norm() < 1e-7);
            assert!(
                (line.foot(&found.point) - found.point).norm() < 1e-6,
                "{angle}"
            );
        }
        assert_eq!(Axis::of(&Isometry::identity()), None);
        let plane = Plane::through(&Point::new(1.0, 2.0, 3.0), Vector::y());
        let within = line.within(&plane);
        assert!(plane.signed_distance(&within.point).abs() < 1e-12);
        assert!(within.direction.y == 0.0 && (within.direction.norm() - 1.0).abs() < 1e-12);
    }

    /// A column that was bent by 40 degrees at a hinge: both halves come to lie on one axis, the hinge stays between them, and lengths
    /// along the column are kept.
    #[test]
    fn a_bent_column_is_straight_again() {
        let hinge = Point::new(0.5, 0.2, -0.3);
        let [down, up] = [[0.0, 0.0, 1.0], [0.6, 0.1, 0.8]].map(|d| Vector::from(d).normalize());
        let lines = [down, -up].map(|direction| Axis {
            point: hinge + 3.0 * direction,
            direction,
        });
        let off = Vector::new(0.3, -0.2, 0.0);
        let jointed = Jointed::new(lines, [hinge - 2.0 * down + off, hinge + 1.5 * up]);
        assert!((jointed.angle() - down.dot(&up).acos()).abs() < 1e-9);
        assert!(jointed.gap() < 1e-9);
        assert!(jointed.aslant() < jointed.angle());
        let [a, b] = jointed.carries().map(|c| c.part(1.0));
        let common = jointed.axes[0].carried(&a);
        assert!(
            common
                .direction
                .cross(&jointed.axes[1].carried(&b).direction)
                .norm()
                < 1e-9
        );
        let [low, high] = [a.apply(&jointed.feet[0]), b.apply(&jointed.feet[1])];
        assert!(is_on(&high, &common));
        let length = (jointed.feet[0] - hinge).norm() + (jointed.feet[1] - hinge).norm();
        assert!(((high - low).norm() - length).abs() < 1e-9);
        let halves = jointed.carries()[0].part(0.5);
        assert!((halves.apply(&hinge) - hinge).norm() < 1e-9);
    }

    /// Parallel axes beside each other are no column: the way from part to part runs across them.
    #[test]
    fn what_stands_side_by_side_is_aslant() {
        let lines = [
            axis([0.0; 3], [0.0, 0.0, 1.0]),
            axis([4.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
        ];
        let jointed = Jointed::new(
            lines,
            [Point::new(0.0, 0.0, 0.1), Point::new(4.0, 0.0, 0.5)],
        );
        assert!(jointed.aslant() > 1.4);
        let offset = [
            axis([0.0; 3], [0.0, 0.0, 1.0]),
            axis([0.2, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ];
        let jointed = Jointed::new(offset, [Point::origin(), Point::new(0.2, 0.0, 3.0)]);
        assert!(jointed.aslant() < 0.1 && (jointed.gap() - 0.2 / 9.04_f64.sqrt()).abs() < 1e-9);
        let [a, b] = jointed.carries().map(|c| c.part(1.0));
        let common = jointed.axes[0].carried(&a);
        assert!(is_on(&b.apply(&offset[1].point), &common));
    }
}
