//! How well any mirror holds: what a particular one has to do better than.

use rayon::prelude::*;

use crate::geom::{Ambient, Point, Vector, directions, median};
use crate::patch::Ground;
use crate::transform::{Isometry, Plane};

/// Mirrors asked,
const MIRRORS: usize = 16;
/// each of about so many samples.
const SAMPLES: usize = 160;

/// How far the images of samples lie from the surface, rms, under the median of mirrors through the middle of the shape that are spread
/// evenly over all directions; fraction of L. Some .07 on animals, .03 on a cube with bumps, .013 to .02 on a roundish lump: what
/// holds to within .006 says much about the first, and little about the last. Without bound in the plane, where any outline tells more. Ours.
pub fn any_mirror(ground: &Ground<'_>) -> f64 {
    let list = &ground.samples.list;
    if list.is_empty() || ground.samples.ambient == Ambient::Plane {
        return f64::INFINITY;
    }
    let middle = list.iter().map(|s| s.position.coords).sum::<Vector>() / list.len() as f64;
    let step = list.len().div_ceil(SAMPLES);
    let mut residuals: Vec<f64> = directions(MIRRORS)
        .collect::<Vec<Vector>>()
        .into_par_iter()
        .map(|normal| {
            let mirror = Isometry::mirror(&Plane::through(&Point::from(middle), normal));
            let distance = |x: &Point| ground.closest.nearest(&mirror.apply(x), f64::MAX);
            let squares = list.iter().step_by(step);
            let squares = squares.filter_map(|s| Some(distance(&s.position)?.distance.powi(2)));
            (squares.sum::<f64>() / list.len().div_ceil(step) as f64).sqrt()
        })
        .collect();
    median(&mut residuals).unwrap_or(0.0)
}
