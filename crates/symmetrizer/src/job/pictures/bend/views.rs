//! From where a bend is seen best.

use crate::geom::{Matrix3, Vector, sorted_eigen};
use crate::picture::{Angle, Stance, View};
use crate::straighten::Straightened;

/// Cosine from which the axis of a bend counts as upright.
const UPRIGHT: f64 = 0.8;

/// Three views of a shape whose local mirrors have the `normals`: along the axis about which they turn
/// most, and from ahead on both sides.
pub fn views(straight: &Straightened, normals: &[Vector]) -> [(&'static str, View); 3] {
    let stance = Stance::about(Some(&straight.plane), &straight.positions);
    let (up, front) = (stance.up, stance.front);
    let right = up.cross(&front);
    let axis = axis(normals);
    // In the straight shape's mirror, so that this is seen edge-on.
    let normal = straight.plane.normal;
    let level = axis - normal * normal.dot(&axis);
    let left = View::new(right * 0.8 - up * 0.42 - front, up);
    [
        ("along the axis of the bend", along(&level, &stance)),
        ("from the right", stance.view(Angle::ThreeQuarter)),
        ("from the left", left),
    ]
}

/// The axis about which the normals turn most.
fn axis(normals: &[Vector]) -> Vector {
    let mean = normals.iter().sum::<Vector>() / normals.len().max(1) as f64;
    let spread: Matrix3 = normals
        .iter()
        .map(|n| (n - mean) * (n - mean).transpose())
        .sum();
    mean.cross(&sorted_eigen(&spread).1.column(2))
}

/// The view along `axis`, from above or from ahead.
fn along(axis: &Vector, stance: &Stance) -> View {
    let axis = axis.try_normalize(1e-9).unwrap_or(stance.up);
    let (up, front) = (stance.up, stance.front);
    let upright = axis.dot(&up).abs() > UPRIGHT;
    let toward = if upright { up } else { front + up * 0.5 };
    let eye = if axis.dot(&toward) < 0.0 { -axis } else { axis };
    View::new(-eye, if upright { -front } else { up })
}
