//! How a part slides: the kind with the most freedoms whose slides all keep to the surface.

use crate::geom::{Matrix3, Point, Vector, sorted_eigen};
use crate::slip::Slip;
use crate::slip::ground::Ground;
use crate::slip::twist::{Moments, Twist};

/// A kind of slide with its place.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// The kind.
    pub slip: Slip,
    /// Axis, direction or normal, unit; none for a sphere.
    pub axis: Option<Vector>,
    /// A point of it nearest to the part's centroid.
    pub point: Point,
    /// Shift per radian of a helix, fraction of L.
    pub pitch: f64,
}

impl Kind {
    /// rms angle, radians, between the surface at `samples` and the kind's slides, the worst of them;
    /// for planes and spheres that between the normals.
    pub fn rms(&self, ground: &Ground, samples: &[u32], twist: &Twist) -> f64 {
        let axis = self.axis.unwrap_or_default();
        let turn = Twist::turn(&axis, &self.point);
        let along = |t: Twist| rms(samples, |i| ground.angle(&t, i));
        let tilt = |i: u32, normal: &Vector| {
            let n = &ground.normals[i as usize];
            n.cross(normal).norm().atan2(n.dot(normal).abs())
        };
        match self.slip {
            Slip::Revolution => along(turn),
            Slip::Extrusion => along(Twist::shift(&axis)),
            Slip::Helix => along(*twist),
            Slip::Cylinder => along(turn).max(along(Twist::shift(&axis))),
            Slip::Plane => rms(samples, |i| tilt(i, &axis)),
            Slip::Sphere => rms(samples, |i| {
                tilt(i, &(ground.positions[i as usize] - self.point))
            }),
        }
    }
}

fn rms(samples: &[u32], angle: impl Fn(u32) -> f64) -> f64 {
    let sum: f64 = samples.iter().map(|&i| angle(i).powi(2)).sum();
    (sum / samples.len().max(1) as f64).sqrt()
}

/// The kind of the part whose samples `sliding` slide along `twist`; `None` where the twist itself does not
/// keep to the surface.
pub fn classify(ground: &Ground, sliding: &[u32], twist: &Twist) -> Option<Kind> {
    let sums = ground.moments(sliding);
    let centroid = ground.centroid(sliding);
    let limit = ground.tolerance.sin().powi(2);
    let normals: Matrix3 = sliding
        .iter()
        .map(|&i| ground.normals[i as usize])
        .map(|n| n * n.transpose())
        .sum();
    let (values, vectors) = sorted_eigen(&(normals / sliding.len().max(1) as f64));
    if 1.0 - values[2] <= limit {
        let normal = vectors.column(2).into_owned();
        return Some(kind(Slip::Plane, Some(normal), centroid));
    }
    if let Some(center) = center(ground, sliding) {
        let turns = [Vector::x(), Vector::y(), Vector::z()].map(|e| Twist::turn(&e, &center));
        if turns.iter().all(|t| sums.quotient(t) <= limit) {
            return Some(kind(Slip::Sphere, None, center));
        }
    }
    let direction = vectors.column(0).into_owned();
    if let Some(point) = axis_point(ground, sliding, &direction, &centroid)
        && values[0] <= limit
        && sums.quotient(&Twist::turn(&direction, &point)) <= limit
    {
        return Some(kind(Slip::Cylinder, Some(direction), point));
    }
    one_freedom(&sums, twist, &centroid, (direction, values[0]), limit)
}

/// Extrusion, revolution or helix: the first two by what fits better, the last where neither does.
fn one_freedom(
    sums: &Moments,
    twist: &Twist,
    centroid: &Point,
    (direction, shift): (Vector, f64),
    limit: f64,
) -> Option<Kind> {
    let axis = twist.axis(centroid);
    let turn = axis.map_or(1.0, |(axis, point, _)| {
        sums.quotient(&Twist::turn(&axis, &point))
    });
    if shift <= limit && shift <= turn {
        return Some(kind(Slip::Extrusion, Some(direction), *centroid));
    }
    let (axis, point, pitch) = axis?;
    if turn <= limit {
        return Some(kind(Slip::Revolution, Some(axis), point));
    }
    (sums.quotient(twist) <= limit).then_some(Kind {
        pitch,
        ..kind(Slip::Helix, Some(axis), point)
    })
}

fn kind(slip: Slip, axis: Option<Vector>, point: Point) -> Kind {
    Kind {
        slip,
        axis,
        point,
        pitch: 0.0,
    }
}

/// The point nearest to all normal lines.
fn center(ground: &Ground, samples: &[u32]) -> Option<Point> {
    let (mut m, mut b) = (Matrix3::zeros(), Vector::zeros());
    for &i in samples {
        let n = &ground.normals[i as usize];
        let across = Matrix3::identity() - n * n.transpose();
        m += across;
        b += across * ground.positions[i as usize].coords;
    }
    Some(Point::from(m.cholesky()?.solve(&b)))
}

/// The point of the axis along `direction`, level with `centroid`, about which the samples turn best.
fn axis_point(
    ground: &Ground,
    samples: &[u32],
    direction: &Vector,
    centroid: &Point,
) -> Option<Point> {
    let mut m = direction * direction.transpose() * samples.len() as f64;
    let mut b = Vector::zeros();
    for &i in samples {
        let g = ground.normals[i as usize].cross(direction);
        m += g * g.transpose();
        b += g * g.dot(&(ground.positions[i as usize] - centroid));
    }
    Some(centroid + m.cholesky()?.solve(&b))
}
