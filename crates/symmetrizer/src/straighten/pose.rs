//! The way back: a symmetric shape takes on the pose, or a share of it, that it was straightened from.
//!
//! A place on the spine and its two sides are turned by the same rotation, so that the sides stay mirror
//! images of each other: the mirror is bent with the shape.

use crate::deform::poisson::integrate;
use crate::error::Result;
use crate::field::grow::Land;
use crate::geom::{Matrix3, Point};
use crate::shape::Surface;
use crate::straighten::Bend;
use crate::straighten::bend::shared;
use crate::straighten::blend::Blend;

/// `symmetric`, which is `bend` undone and then turned as a whole by `frame`, with `share` (0..=1) of the bend
/// again; placed as nearly as it goes over the shape of `land`.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn bend_again(
    land: &Land<'_>,
    bend: &Bend,
    frame: &Matrix3,
    symmetric: &Surface,
    share: f64,
) -> Result<Vec<Point>> {
    let back = |turn: &Matrix3| {
        let back = (frame * turn).transpose();
        nalgebra::Rotation3::from_matrix_unchecked(back)
            .powf(share)
            .into_inner()
    };
    let back: Vec<Matrix3> = shared(&bend.turns, &bend.field).iter().map(back).collect();
    let at_vertices = Blend::new(land.surface, land.samples).rotations(&back);
    integrate(symmetric, &at_vertices, None, &[])
}
