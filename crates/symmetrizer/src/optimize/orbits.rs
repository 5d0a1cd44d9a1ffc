//! A whole group at once: each orbit moves to its mean.
//!
//! Equation 1 halves the way between two points that a symmetry exchanges; of the k copies of a point that a group of
//! order k has, each goes to where their mean is for it. The displacements are smoothed over the surface, over ever
//! shorter lengths, as in the finish.

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::smooth::SmoothField;
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::optimize::untangle::untangle;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::Isometry;

/// Rounds at the most.
const ROUNDS: usize = 24;
/// Smoothing lengths of the first and the last, fractions of L.
const LENGTHS: [f64; 2] = [0.03, 0.001];
/// Factor of the length from round to round.
const REFINE: f64 = 0.7;
/// Copies lie within this distance, fraction of L, and face the same way to within this cosine.
const REACH: f64 = 0.05;
const MIN_COS: f64 = 0.2;
/// Rounds that leave more than this share of the distances gain nothing.
const STALLED: f64 = 0.98;
/// Distances that are small enough, fraction of L.
const DONE: f64 = 1e-6;

/// What was done.
pub struct Orbited {
    /// Vertex positions.
    pub positions: Vec<Point>,
    /// Rounds that were taken.
    pub rounds: usize,
    /// Mean distance of copies from the surface before and after, over the surface and the group, fraction of L.
    pub residual: [f64; 2],
}

/// Moves the orbits of `surface` under a point group, all of its `elements`, to their means. A shape that has the
/// group has it about its centroid, so that is where it is taken to be.
///
/// # Errors
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn orbits(
    surface: &Surface,
    elements: &[Isometry],
    stiffness: Option<&[f64]>,
    ctx: &mut Context<'_>,
) -> Result<Orbited> {
    let failure = |_| Error::Numerical {
        stage: "orbits",
        step: 0,
        what: "the smoothing system could not be solved".into(),
    };
    let mut field = SmoothField::new(surface, stiffness).map_err(failure)?;
    let mut closest = ClosestPoint::new(surface);
    let mut now = surface.clone();
    let elements: Vec<Isometry> = about(&centroid(surface), elements);
    let elements = elements.as_slice();
    let mut aim = Aim::at(&now, elements, &closest);
    let before = aim.residual;
    let mut length = LENGTHS[0];
    let mut rounds = 0;
    for round in 0..ROUNDS {
        ctx.progress(round as f64 / ROUNDS as f64)?;
        if aim.residual < DONE {
            break;
        }
        let moves = field
            .solve(&aim.targets, &aim.confidence, length)
            .map_err(failure)?;
        let moved = now.positions.iter().zip(&moves).map(|(x, u)| x + u);
        let next = now.with_positions(moved.collect());
        closest.follow(&next);
        let then = Aim::at(&next, elements, &closest);
        let gained = then.residual < STALLED * aim.residual;
        if gained {
            (now, aim) = (next, then);
            rounds += 1;
        } else {
            closest.follow(&now);
            if length <= LENGTHS[1] {
                break;
            }
        }
        length = (length * REFINE).max(LENGTHS[1]);
    }
    let (now, _) = untangle(surface, now);
    closest.follow(&now);
    Ok(Orbited {
        residual: [before, Aim::at(&now, elements, &closest).residual],
        positions: now.positions,
        rounds,
    })
}

/// The mean place of a surface by area.
pub fn centroid(surface: &Surface) -> Point {
    let weighted = surface.positions.iter().zip(&surface.vertex_areas);
    let sum: Vector = weighted.map(|(x, a)| x.coords * *a).sum();
    Point::from(sum / surface.area())
}

/// The same elements with this fixed point.
fn about(centre: &Point, elements: &[Isometry]) -> Vec<Isometry> {
    let moved = |g: &Isometry| Isometry {
        linear: g.linear,
        translation: centre.coords - g.linear * centre.coords,
    };
    elements.iter().map(moved).collect()
}

/// Where the vertices should go.
struct Aim {
    /// The way to the mean of the copies, along the normal.
    targets: Vec<Vector>,
    /// The share of the copies that were found.
    confidence: Vec<f64>,
    /// Mean distance of the copies from the surface.
    residual: f64,
}

impl Aim {
    fn at(surface: &Surface, elements: &[Isometry], closest: &ClosestPoint) -> Self {
        let all: Vec<(Vector, f64, f64)> = (0..surface.positions.len())
            .into_par_iter()
            .map(|v| orbit(surface, elements, closest, v))
            .collect();
        let area = surface.area();
        let missed = all.iter().zip(&surface.vertex_areas);
        Self {
            residual: missed.map(|((_, _, d), a)| d * a).sum::<f64>() / area,
            targets: all.iter().map(|a| a.0).collect(),
            confidence: all.iter().map(|a| a.1).collect(),
        }
    }
}

/// The way of a vertex to the mean of its copies, the share of them that was found, and their mean distance.
fn orbit(
    surface: &Surface,
    elements: &[Isometry],
    closest: &ClosestPoint,
    v: usize,
) -> (Vector, f64, f64) {
    let (x, n) = (surface.positions[v], surface.vertex_normals[v]);
    let (mut sum, mut found, mut missed) = (0.0, 0.0, 0.0);
    for g in elements {
        let (image, normal) = (g.apply(&x), g.rotate(&n));
        let hit = closest.nearest_facing(&image, &normal, MIN_COS, REACH);
        missed += hit.map_or(REACH, |hit| hit.distance);
        if let Some(hit) = hit {
            sum += normal.dot(&(hit.point - image));
            found += 1.0;
        }
    }
    let count = elements.len().max(1) as f64;
    // The vertex is one of its copies: the mean is over all of them.
    (
        n * (sum / f64::max(found, 1.0)),
        found / count,
        missed / count,
    )
}
