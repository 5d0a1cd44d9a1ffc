//! What is left to be done in the plane when the rest is done: places where the outline has come to cross itself, and
//! the area.

use crate::deform::Igarashi;
use crate::error::Result;
use crate::geom::Point;
use crate::shape::crossings::{crossing_faces, new_crossings};
use crate::shape::wall::Wall;
use crate::transform::Plane;

/// Edges to either side of a crossing that are let go at first, and how often twice as many.
const NEAR: usize = 2;
const WIDER: u32 = 3;
/// Sizes that differ by less are the same.
const SAME: f64 = 2e-3;

/// The outline of `wall` at `positions` without crossings that the wall has not, where that can be had, and with its
/// area: made of two sides that differ it would be smaller than either. The mirror `plane` stays where it is.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn tidied(wall: &Wall, positions: Vec<Point>, plane: &Plane) -> Result<Vec<Point>> {
    let body = Igarashi::new(wall.clone())?;
    let mut now = uncrossed(wall, &body, positions)?;
    let area = |inside: Vec<Point>| body.sheet().surface.with_positions(inside).area();
    let size = (body.sheet().surface.area() / area(body.filled(&now)?)).sqrt();
    if (size - 1.0).abs() < SAME {
        return Ok(now);
    }
    let middle = wall.surface.with_positions(now.clone()).centroid();
    let fixed = middle - plane.signed_distance(&middle) * plane.normal;
    for x in &mut now {
        // A wall keeps its height.
        let height = x.z;
        *x = fixed + size * (*x - fixed);
        x.z = height;
    }
    Ok(now)
}

/// Armpits, notches and claws that were folded over, as the inside has them where the outline is let go: of ever wider
/// surroundings the first that leave fewest crossings.
fn uncrossed(wall: &Wall, body: &Igarashi, positions: Vec<Point>) -> Result<Vec<Point>> {
    let known = crossing_faces(&wall.surface);
    let crossed = |x: &[Point]| {
        let now = wall.surface.with_positions(x.to_vec());
        new_crossings(&known, &crossing_faces(&now))
    };
    let mut crossing = crossed(&positions);
    let mut best = (crossing.len(), positions.clone());
    let mut free = vec![false; wall.edges()];
    for wider in 0..WIDER {
        if crossing.is_empty() {
            break;
        }
        for &face in &crossing {
            mark(wall, face as usize / 2, NEAR << wider, &mut free);
        }
        let now = body.let_go(&positions, &free)?;
        crossing = crossed(&now);
        if crossing.len() < best.0 {
            best = (crossing.len(), now);
        }
    }
    Ok(best.1)
}

/// Marks an edge and so many to either side of it on its ring.
fn mark(wall: &Wall, edge: usize, beside: usize, marks: &mut [bool]) {
    let Some(ring) = wall.rings.iter().find(|ring| ring.contains(&edge)) else {
        return;
    };
    let count = ring.len();
    let first = edge - ring.start + count * (1 + beside / count) - beside;
    for k in 0..=2 * beside + 1 {
        marks[ring.start + (first + k) % count] = true;
    }
}
