//! How a shape stands: files come in any orientation, so up and front are read off the mirror
//! plane and the shape.

use crate::geom::{Point, Vector, any_orthogonal, sorted_eigen};
use crate::picture::camera::{View, unit};
use crate::transform::isometry::Plane;

/// A file axis counts as lying in the mirror plane when the sine of its angle to it is below this.
const NEARLY_IN_PLANE: f64 = 0.36;

/// A named view of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Angle {
    /// The mirror plane is seen edge-on and vertical.
    Front,
    /// From the front, right and above.
    ThreeQuarter,
    /// Along the mirror plane's normal.
    Side,
    /// From behind, edge-on.
    Back,
    /// From above, with the front at the bottom of the picture.
    Top,
}

impl Angle {
    /// Every angle, in the order of a contact sheet.
    pub const ALL: [Self; 5] = [
        Self::Front,
        Self::ThreeQuarter,
        Self::Side,
        Self::Back,
        Self::Top,
    ];

    /// A caption.
    pub fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::ThreeQuarter => "three-quarter",
            Self::Side => "side",
            Self::Back => "back",
            Self::Top => "top",
        }
    }
}

/// Which way a shape stands: orthogonal unit vectors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stance {
    /// Upwards.
    pub up: Vector,
    /// Out of the shape's face, towards whoever looks at its front.
    pub front: Vector,
}

impl Stance {
    /// The stance of the shape with the vertices `positions` and the mirror plane `plane`.
    ///
    /// Up is the file's y axis, else its z axis, if it nearly lies in the plane, else the longest
    /// in-plane direction of the shape; the front is the side to which the upper part (a head)
    /// leans, else the file's +z or +x side. Without a plane: y up, +z front.
    pub fn about(plane: Option<&Plane>, positions: &[Point]) -> Self {
        let Some(normal) = plane.and_then(|p| unit(p.normal)) else {
            return Self {
                up: Vector::y(),
                front: Vector::z(),
            };
        };
        let up = upright(&normal, positions);
        let front = up.cross(&normal);
        Self {
            up,
            front: front * facing(&up, &front, positions),
        }
    }

    /// The view of this stance from `angle`.
    pub fn view(&self, angle: Angle) -> View {
        let right = self.up.cross(&self.front);
        let eye = match angle {
            Angle::Front => self.front,
            Angle::ThreeQuarter => self.front + right * 0.8 + self.up * 0.42,
            Angle::Side => right,
            Angle::Back => -self.front,
            Angle::Top => return View::new(-self.up, -self.front),
        };
        View::new(-eye, self.up)
    }
}

/// The views of a shape in the order of [`Angle::ALL`].
pub fn views_about(plane: Option<&Plane>, positions: &[Point]) -> Vec<View> {
    let stance = Stance::about(plane, positions);
    Angle::ALL.iter().map(|&a| stance.view(a)).collect()
}

fn upright(normal: &Vector, positions: &[Point]) -> Vector {
    let in_plane = |v: Vector| v - normal * normal.dot(&v);
    for axis in [Vector::y(), Vector::z()] {
        if normal.dot(&axis).abs() < NEARLY_IN_PLANE {
            return in_plane(axis).normalize();
        }
    }
    let longest =
        unit(in_plane(main_axis(positions, in_plane))).unwrap_or_else(|| any_orthogonal(normal));
    // The sign that has more of y, or of z where y says nothing.
    let upness = longest.y + 1e-3 * longest.z;
    if upness < 0.0 { -longest } else { longest }
}

/// The principal direction of the flattened vertices.
fn main_axis(positions: &[Point], flatten: impl Fn(Vector) -> Vector) -> Vector {
    let Some(mean) = mean(positions.iter()) else {
        return Vector::zeros();
    };
    let mut covariance = nalgebra::Matrix3::zeros();
    for p in positions.iter().filter(|p| finite(p)) {
        let v = flatten(p.coords - mean);
        covariance += v * v.transpose();
    }
    let size = covariance.amax();
    if !(size.is_finite() && size > 0.0) {
        return Vector::zeros();
    }
    let (_, vectors) = sorted_eigen(&(covariance / size));
    vectors.column(2).into_owned()
}

/// +1 where the front is along `front`, -1 where it is the other way.
fn facing(up: &Vector, front: &Vector, positions: &[Point]) -> f64 {
    lean(up, front, positions).unwrap_or_else(|| {
        let default = front.z + 0.5 * front.x;
        if default < 0.0 { -1.0 } else { 1.0 }
    })
}

/// The side to which the upper part leans, if clearly so.
fn lean(up: &Vector, front: &Vector, positions: &[Point]) -> Option<f64> {
    let mean = mean(positions.iter())?;
    let height = |p: &Point| up.dot(&(p.coords - mean));
    let range = |axis: &Vector| {
        let values = positions.iter().filter(|p| finite(p));
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| {
            let x = axis.dot(&(p.coords - mean));
            (l.min(x), h.max(x))
        })
    };
    let (low, high) = range(up);
    let threshold = low + 0.7 * (high - low);
    let top = mean_of_upper(positions, |p| height(p) >= threshold)?;
    let (back, forth) = range(front);
    let lean = front.dot(&(top - mean));
    (lean.abs() > 0.06 * (forth - back)).then(|| lean.signum())
}

fn mean_of_upper(positions: &[Point], keep: impl Fn(&Point) -> bool) -> Option<Vector> {
    mean(positions.iter().filter(|p| keep(p)))
}

fn mean<'a>(points: impl Iterator<Item = &'a Point>) -> Option<Vector> {
    let (mut sum, mut count) = (Vector::zeros(), 0.0);
    for p in points.filter(|p| finite(p)) {
        sum += p.coords;
        count += 1.0;
    }
    (count > 0.0).then(|| sum / count)
}

fn finite(p: &Point) -> bool {
    p.iter().all(|c| c.is_finite())
}
