//! What is left to be done in the plane when the rest is done: places where the outline has come to cross itself, and
//! the area.

use crate::deform::Igarashi;
use crate::error::Result;
use crate::geom::Point;
use crate::optimize::uncross::uncrossed;
use crate::shape::wall::Wall;
use crate::transform::Plane;

/// Sizes that differ by less are the same.
const SAME: f64 = 2e-3;

/// The outline of `wall` at `positions` without crossings that the wall has not, where that can be had, and with its
/// area: made of two sides that differ it would be smaller than either. The mirror `plane` stays where it is.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn tidied(wall: &Wall, positions: Vec<Point>, plane: &Plane) -> Result<Vec<Point>> {
    let body = Igarashi::new(wall.clone())?;
    let mut now = uncrossed(wall, &body, positions, plane)?;
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
