//! How far a surface is from being its own mirror image: one number, 0 = symmetric.
//!
//! 20,000 area-uniform samples are mirrored in the plane that minimises the mean distance of the
//! images from the surface; that distance over D, the bounding-box diagonal, in percent. A mesh
//! that stands for an exactly symmetric shape but is triangulated unevenly has a small asymmetry
//! all the same, its tessellation floor (about 0.007 % at 12k triangles).

use crate::apply::measure::percentile;
use crate::apply::measure::refine::distances;
use crate::apply::measure::search::local_minima;
use crate::context::Context;
use crate::error::{Error, Result};
use crate::geom::{Ambient, Point};
use crate::sample::uniform::uniform;
use crate::shape::wall::Wall;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::isometry::Plane;

/// Samples mirrored (docs/definitions.md).
const SAMPLES: usize = 20_000;
/// On an outline.
const ON_OUTLINE: usize = 5_000;
/// A plane is near-equal when its mean is at most this multiple of the best; ours.
const NEAR_RATIO: f64 = 1.25;
/// ... or at most this much above the best, in percent of D; ours.
const NEAR_EXCESS: f64 = 0.05;
/// Mirror distances of a surface, in percent of the bounding-box diagonal D.
#[derive(Debug, Clone, PartialEq)]
pub struct Asymmetry {
    /// The plane that minimises `mean`, working coordinates, canonical.
    pub plane: Plane,
    /// Mean distance.
    pub mean: f64,
    /// Root of the mean squared distance.
    pub rms: f64,
    /// The distance that 95 % of the samples do not exceed.
    pub p95: f64,
    /// The distance that 99 % of the samples do not exceed.
    pub p99: f64,
    /// The largest distance.
    pub max: f64,
    /// Other planes that are nearly as good (mean at most 1.25 times, or 0.05 above, the best), best
    /// first; all differ from each other by more than 5 degrees or 2 % of L.
    pub also_near: Vec<NearPlane>,
}

/// A plane whose mean distance nearly equals the best one's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearPlane {
    /// Working coordinates, canonical.
    pub plane: Plane,
    /// Mean distance, percent of D.
    pub mean: f64,
}

/// Measures `surface`, whose bounding-box diagonal is `diagonal` (working units:
/// [`crate::Mesh::diagonal`] over the normalization's scale).
///
/// The plane is searched for in all orientations; `candidates` (working coordinates) are planes
/// that the caller already knows, from detection or from an earlier state. The same surface,
/// candidates and seed give the same bits with any number of threads.
///
/// # Errors
/// [`Error::Numerical`] where the surface has no finite area or `diagonal` is not positive,
/// [`Error::Cancelled`] when asked to stop.
pub fn asymmetry(
    surface: &Surface,
    diagonal: f64,
    candidates: &[Plane],
    ctx: &Context<'_>,
) -> Result<Asymmetry> {
    measured(
        surface,
        diagonal,
        candidates,
        (SAMPLES, Ambient::Space),
        ctx,
    )
}

/// The same of an outline, over its length: `wall` is the wall over it, the planes are at right angles to it.
///
/// # Errors
/// As [`asymmetry`].
pub fn asymmetry_of_outline(
    wall: &Wall,
    diagonal: f64,
    candidates: &[Plane],
    ctx: &Context<'_>,
) -> Result<Asymmetry> {
    let how = (ON_OUTLINE, Ambient::Plane);
    measured(&wall.surface, diagonal, candidates, how, ctx)
}

fn measured(
    surface: &Surface,
    diagonal: f64,
    candidates: &[Plane],
    (count, ambient): (usize, Ambient),
    ctx: &Context<'_>,
) -> Result<Asymmetry> {
    let samples = samples(surface, diagonal, count, ctx)?;
    let closest = ClosestPoint::new(surface);
    let minima = local_minima(&samples, candidates, &closest, ambient);
    ctx.check()?;
    let percent = 100.0 / diagonal;
    let mut near = minima.into_iter().map(|f| NearPlane {
        plane: f.plane.canonical(),
        mean: f.mean * percent,
    });
    let best = near.next().ok_or_else(|| failed("no plane was found"))?;
    let limit = (NEAR_RATIO * best.mean).max(best.mean + NEAR_EXCESS);
    let mut all = distances(&best.plane, &samples, &closest);
    all.iter_mut().for_each(|d| *d *= percent);
    Ok(Asymmetry {
        also_near: near.filter(|f| f.mean <= limit).collect(),
        ..summary(best.plane, all)
    })
}

/// The figures of the distances `all`, percent of D.
fn summary(plane: Plane, mut all: Vec<f64>) -> Asymmetry {
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let rms = (all.iter().map(|d| d * d).sum::<f64>() / count).sqrt();
    all.sort_by(f64::total_cmp);
    Asymmetry {
        plane,
        mean,
        rms,
        p95: percentile(&all, 0.95),
        p99: percentile(&all, 0.99),
        max: percentile(&all, 1.0),
        also_near: Vec::new(),
    }
}

/// The distance from the surface of every vertex's mirror image in `plane` (working coordinates),
/// percent of `diagonal` (working units), for colour maps.
pub fn per_vertex(surface: &Surface, diagonal: f64, plane: &Plane) -> Vec<f64> {
    let closest = ClosestPoint::new(surface);
    distances(plane, &surface.positions, &closest)
        .into_iter()
        .map(|d| d * 100.0 / diagonal)
        .collect()
}

fn samples(
    surface: &Surface,
    diagonal: f64,
    count: usize,
    ctx: &Context<'_>,
) -> Result<Vec<Point>> {
    ctx.check()?;
    if !(diagonal > 0.0 && diagonal.is_finite()) {
        return Err(failed("the bounding-box diagonal is not positive"));
    }
    let samples = uniform(surface, count, &mut ctx.rng("measure"));
    if samples.is_empty() {
        return Err(failed("the surface has no finite area"));
    }
    Ok(samples.iter().map(|at| surface.point(at)).collect())
}

fn failed(what: &str) -> Error {
    Error::Numerical {
        stage: "measure",
        step: 0,
        what: what.into(),
    }
}
