//! Samples of outlines: evenly along their length, described by how they turn.

use rayon::prelude::*;

use crate::context::Context;
use crate::error::{Error, Result};
use crate::geom::{Ambient, Point};
use crate::sample::samples::{Describer, Sample, SampleParams, Samples};
use crate::sample::signature::{SCALES, Signature};
use crate::shape::wall::Wall;

/// Samples on the shortest ring.
const LEAST: usize = 8;
/// A ring around which a radius reaches further than this share says nothing of that radius.
const AROUND: f64 = 0.25;
/// Chords run between mean places over this share of the radius to either side: what is traced from a bitmap has
/// teeth of a pixel, which turn by as much as fingers do.
const SMOOTH: f64 = 0.5;
/// Neighbours along the ring, in samples.
const NEXT: usize = 2;

/// The signature at a length along a ring: at each radius r the angle by which the outline turns from the chord
/// over the r before to that over the r behind, which is k r of its curvature k, and the size of the change of
/// that over r; the same for a shape and its mirror image, as rings run round shapes to their left.
pub fn signature(wall: &Wall, ring: usize, along: f64, r0: f64) -> Signature {
    let length = wall.length(ring);
    let turn = |s: f64, r: f64| {
        let place = |way: f64| wall.mean_place(ring, s + way, SMOOTH * r);
        turned([place(-r), place(0.0), place(r)])
    };
    let at = |scale: usize| {
        let r = r0 * f64::from(1 << scale);
        if r > AROUND * length {
            return None;
        }
        let change = turn(along + r / 2.0, r) - turn(along - r / 2.0, r);
        Some([turn(along, r).asinh(), change.abs().asinh()])
    };
    Signature(std::array::from_fn::<_, SCALES, _>(at))
}

/// The angle by which a ring turns at the length `along` from the chord over `radius` before to that behind, radians.
pub fn turning(wall: &Wall, ring: usize, along: f64, radius: f64) -> f64 {
    turned([-radius, 0.0, radius].map(|way| wall.place(ring, along + way)))
}

/// The angle between the ways from the first place to the second and on to the third.
fn turned([a, b, c]: [Point; 3]) -> f64 {
    let (u, v) = (b - a, c - b);
    (u.x * v.y - u.y * v.x).atan2(u.dot(&v))
}

/// Samples the outline of `describer`'s `wall` (section 2): `params.outline` of them over its length.
///
/// # Errors
/// [`Error::Params`] for fewer than 100 samples; [`Error::Cancelled`].
pub fn sample_outline(
    describer: &Describer<'_>,
    wall: &Wall,
    params: &SampleParams,
    ctx: &mut Context<'_>,
) -> Result<Samples> {
    if params.outline < 100 {
        return Err(Error::params("sample.outline", "at least 100 are needed"));
    }
    let lengths: Vec<f64> = (0..wall.rings.len()).map(|r| wall.length(r)).collect();
    let spacing = lengths.iter().sum::<f64>() / params.outline as f64;
    let (mut places, mut neighbors) = (Vec::new(), Vec::new());
    for (ring, length) in lengths.iter().enumerate() {
        let count = ((length / spacing).round() as usize).max(LEAST);
        let first = places.len();
        for k in 0..count {
            places.push(wall.at(ring, (k as f64 + 0.5) * length / count as f64));
            let next = (1..=NEXT).flat_map(|d| [(k + d) % count, (k + count - d) % count]);
            neighbors.push(next.map(|k| (first + k) as u32).collect());
        }
    }
    ctx.progress(0.2)?;
    let list: Vec<Sample> = places.par_iter().map(|at| describer.sample(at)).collect();
    Ok(Samples {
        area: describer.surface.area() / list.len().max(1) as f64,
        list,
        spacing,
        radius: describer.radius(),
        ambient: Ambient::Plane,
        neighbors,
    })
}
