//! Whether two triangles pass through each other, after Moeller (1997), "A fast triangle-triangle
//! intersection test", with strict inequalities.

use crate::geom::{Point, Vector};

/// Share of the triangles' size below which a distance is rounding; ours.
const TOLERANCE: f64 = 1e-9;

/// Whether a piece of line longer than the tolerance lies inside both triangles and each has
/// corners strictly on both sides of the other's plane. Triangles without area cross nothing.
pub(super) fn cross(a: &[Point; 3], b: &[Point; 3]) -> bool {
    let tolerance = TOLERANCE * size(a).max(size(b));
    let (Some(n_a), Some(n_b)) = (unit_normal(a), unit_normal(b)) else {
        return false;
    };
    let b_from_a = sides(b, &a[0], &n_a, tolerance);
    if !straddles(&b_from_a) {
        return false;
    }
    let a_from_b = sides(a, &b[0], &n_b, tolerance);
    if !straddles(&a_from_b) {
        return false;
    }
    // Both planes are cut by the same line; compare the pieces of it inside the triangles.
    let line = n_a.cross(&n_b);
    let length = line.norm();
    if length < TOLERANCE {
        return false;
    }
    let along = line / length;
    let (low_a, high_a) = piece(a, &a_from_b, &a[0], &along);
    let (low_b, high_b) = piece(b, &b_from_a, &a[0], &along);
    high_a.min(high_b) - low_a.max(low_b) > tolerance
}

/// The longest edge.
fn size(t: &[Point; 3]) -> f64 {
    let edge = |i: usize, j: usize| (t[i] - t[j]).norm();
    edge(0, 1).max(edge(1, 2)).max(edge(2, 0))
}

fn unit_normal(t: &[Point; 3]) -> Option<Vector> {
    let (u, v) = (t[1] - t[0], t[2] - t[0]);
    u.cross(&v).try_normalize(TOLERANCE * u.norm() * v.norm())
}

/// Signed distances of the corners from the plane through `point`; within the tolerance, 0.
fn sides(t: &[Point; 3], point: &Point, normal: &Vector, tolerance: f64) -> [f64; 3] {
    t.map(|x| {
        let d = normal.dot(&(x - point));
        if d.abs() > tolerance { d } else { 0.0 }
    })
}

fn straddles(sides: &[f64; 3]) -> bool {
    sides.iter().any(|&d| d > 0.0) && sides.iter().any(|&d| d < 0.0)
}

/// Where the triangle's edges meet the other plane, as an interval along the line.
fn piece(t: &[Point; 3], sides: &[f64; 3], origin: &Point, along: &Vector) -> (f64, f64) {
    let mut interval = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..3 {
        let j = (i + 1) % 3;
        let (d, e) = (sides[i], sides[j]);
        // Edges on one side do not meet it; an edge with one end on it meets it there.
        if d * e > 0.0 || d == e {
            continue;
        }
        let at = t[i] + (t[j] - t[i]) * (d / (d - e));
        let s = along.dot(&(at - origin));
        interval = (interval.0.min(s), interval.1.max(s));
    }
    interval
}
