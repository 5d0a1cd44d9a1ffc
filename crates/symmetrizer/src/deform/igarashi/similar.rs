//! The first step: triangles that may turn and grow, whatever that takes, which is one linear system.
//!
//! At rest each corner is v_c = v_a + x (v_b - v_a) + y R (v_b - v_a), R a quarter turn; the sum of the squares by
//! which that is missed is made small.

use crate::deform::igarashi::system::Held;
use crate::deform::solver::{Entries, SolveError};
use crate::geom::Point;
use crate::shape::Surface;

/// Share of the mean diagonal that is added to it: parts that too few pulls hold stay where they are.
const RIDGE: f64 = 1e-12;
/// Weight of a place that is held.
const HELD: f64 = 1e6;

/// Positions of the vertices of `rest`.
///
/// # Errors
/// [`SolveError`].
pub fn positions(rest: &Surface, stiffness: &[f64], held: &Held) -> Result<Vec<Point>, SolveError> {
    let n = rest.positions.len();
    let mut entries = Entries::default();
    for (f, corners) in rest.triangles.iter().enumerate() {
        for k in 0..3 {
            let turned = [0, 1, 2].map(|j| corners[(j + k) % 3] as usize);
            corner(&mut entries, rest, turned, stiffness[f]);
        }
    }
    let mut right = vec![0.0; 2 * n];
    let mut hold = |terms: &[(usize, f64)], target: &Point, weight: f64| {
        for axis in 0..2 {
            let terms: Vec<(usize, f64)> = terms.iter().map(|(v, t)| (2 * v + axis, *t)).collect();
            entries.add_square(&terms, weight);
            terms
                .iter()
                .for_each(|(i, t)| right[*i] += weight * t * target[axis]);
        }
    };
    for pull in &held.pulls {
        let corners = rest.triangles[pull.at.face as usize];
        let terms = [0, 1, 2].map(|k| (corners[k] as usize, pull.at.bary[k]));
        hold(&terms, &pull.target, pull.weight);
    }
    for (v, place) in held.places.iter().enumerate() {
        if let Some(x) = place {
            hold(&[(v, 1.0)], x, HELD);
        }
    }
    let ridge = RIDGE * entries.mean_diagonal(2 * n);
    for v in 0..n {
        for axis in 0..2 {
            entries.add(2 * v + axis, 2 * v + axis, ridge);
            right[2 * v + axis] += ridge * rest.positions[v][axis];
        }
    }
    entries.factorized(2 * n)?.solve(&mut right)?;
    Ok(right
        .chunks_exact(2)
        .map(|x| Point::new(x[0], x[1], 0.0))
        .collect())
}

/// Adds the square by which the corner c misses its place beside a and b.
fn corner(entries: &mut Entries, rest: &Surface, [a, b, c]: [usize; 3], weight: f64) {
    let at = |v: usize| rest.positions[v];
    let (u, w) = (at(b) - at(a), at(c) - at(a));
    let square = u.norm_squared();
    let (x, y) = (u.dot(&w) / square, (u.x * w.y - u.y * w.x) / square);
    // v_c - v_a - x (v_b - v_a) - y R (v_b - v_a), R (d_x, d_y) = (-d_y, d_x).
    let along = |axis: usize, turned: f64| {
        let other = 1 - axis;
        [
            (2 * c + axis, 1.0),
            (2 * a + axis, x - 1.0),
            (2 * b + axis, -x),
            (2 * b + other, turned * y),
            (2 * a + other, -turned * y),
        ]
    };
    entries.add_square(&along(0, 1.0), weight);
    entries.add_square(&along(1, -1.0), weight);
}
