//! The way back: a symmetric shape takes on the pose, or a share of it, that it was straightened from.
//!
//! A place on the spine and its two sides are turned by the same rotation, so that the sides stay mirror
//! images of each other: the mirror is bent with the shape.

use crate::deform::poisson::integrate;
use crate::error::Result;
use crate::field::grow::Land;
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::{ClosestPoint, Surface};
use crate::straighten::bend::shared;
use crate::straighten::blend::Blend;
use crate::straighten::{Bend, Straightened};
use crate::transform::{Isometry, Plane};

/// A symmetric shape in its pose.
pub struct Posed {
    /// Vertex positions.
    pub positions: Vec<Point>,
    /// How far partners lie from opposite each other across the mirrors that were bent with the shape, mean,
    /// fraction of L.
    pub across: f64,
    /// How far the middle between them lies from where it was in the input, rms, fraction of L.
    pub line: f64,
}

/// `symmetric` under the mirror `plane`, which is `bend` undone as `straight` says and then made symmetric,
/// with `share` (0..=1) of the bend again.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn bend_again(
    land: &Land<'_>,
    bend: &Bend,
    straight: &Straightened,
    (symmetric, plane): (&Surface, &Plane),
    share: f64,
) -> Result<Posed> {
    let back = |turn: &Matrix3| {
        let back = (straight.frame * turn).transpose();
        nalgebra::Rotation3::from_matrix_unchecked(back)
            .powf(share)
            .into_inner()
    };
    let back: Vec<Matrix3> = shared(&bend.turns, &bend.field).iter().map(back).collect();
    let at_vertices = Blend::new(land.surface, land.samples).rotations(&back);
    let positions = integrate(symmetric, &at_vertices, None, &[])?;
    let posed = symmetric.with_positions(positions);
    let (across, line) = misfits(land, bend, (symmetric, plane), (&posed, &back));
    Ok(Posed {
        positions: posed.positions,
        across,
        line,
    })
}

/// Mean distance of partners from opposite, and rms way of the middle between them from the input.
fn misfits(
    land: &Land<'_>,
    bend: &Bend,
    (symmetric, plane): (&Surface, &Plane),
    (posed, back): (&Surface, &[Matrix3]),
) -> (f64, f64) {
    let mirror = Isometry::mirror(plane);
    let closest = ClosestPoint::new(symmetric);
    let (mut across, mut line, mut count) = (0.0, 0.0, 0.0);
    let trusted = land.samples.list.iter().zip(&bend.field.partners);
    for ((sample, partner), back) in trusted.zip(back) {
        let x = symmetric.point(&sample.at);
        let hit = closest.nearest(&mirror.apply(&x), f64::INFINITY);
        let (Some(_), Some(hit)) = (partner, hit) else {
            continue;
        };
        let normal: Vector = back * plane.normal;
        let middle = |s: &Surface| nalgebra::center(&s.point(&sample.at), &s.point(&hit.at));
        let way = posed.point(&hit.at) - posed.point(&sample.at);
        across += (way - normal * normal.dot(&way)).norm();
        line += (middle(posed) - middle(land.surface)).norm_squared();
        count += 1.0;
    }
    let count = f64::max(count, 1.0);
    (across / count, (line / count).sqrt())
}
