//! The finish at full resolution: what the control mesh is too coarse to carry.
//!
//! Each vertex is drawn half of the way, along its normal, to its mirrored closest point; the field of
//! these displacements is smoothed by a screened Laplacian, so that the surface moves as cloth and
//! not as dust. The smoothing length falls from round to round and the rounds end as soon as the
//! shape is symmetric enough: detail is rubbed out no further than that takes.

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::smooth::SmoothField;
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::optimize::schedule::Settings;
use crate::optimize::untangle::untangle;
use crate::shape::{ClosestPoint, Hit, Surface};
use crate::transform::{Ambient, Correspondence, Isometry, Plane, displacements, optimal_mirror};

/// What the finish did.
#[derive(Debug, Clone)]
pub struct Finished {
    /// Vertex positions, working coordinates.
    pub positions: Vec<Point>,
    /// The mirror at the end, working coordinates.
    pub plane: Plane,
    /// Rounds run.
    pub rounds: usize,
    /// Mean distance of mirrored vertices from the surface before and after, area-weighted, fraction
    /// of L.
    pub asymmetry: [f64; 2],
    /// Share of the area where it was undone because the surface would have crossed itself.
    pub undone: f64,
}

/// Closest points that draw a vertex lie within this distance, fraction of L.
const REACH: f64 = 0.05;

/// Factor of the smoothing length from round to round.
const REFINE: f64 = 0.8;

/// The first rounds, whose smoothing length is far above any detail, are run in any case: they cost
/// nothing and draw in what the mean does not show, such as the tip of an ear.
const COARSE_ROUNDS: usize = 5;

/// A round that leaves more than this share of the asymmetry gains nothing that is worth its change.
const STALLED: f64 = 0.995;

/// Runs the rounds of the finish on `surface` under the mirror `plane` until the mean asymmetry is
/// `goal` (fraction of L) or falls no further.
///
/// # Errors
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn finish(
    surface: Surface,
    plane: Plane,
    goal: f64,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Finished> {
    let params = settings.optimize;
    let fail = |_| Error::Numerical {
        stage: "finish",
        step: 0,
        what: "the smoothing system could not be solved".into(),
    };
    let mut field = SmoothField::new(&surface, settings.stiffness).map_err(fail)?;
    let mut now = surface.clone();
    let mut aim = Aim::at(&now, plane);
    let before = aim.asymmetry;
    let mut rounds = 0;
    let [mut lambda, shortest] = params.finish_lengths;
    let mut reached = false;
    while !reached && rounds < params.finish_rounds {
        ctx.progress(rounds as f64 / params.finish_rounds as f64)?;
        let moves = field
            .solve(&aim.targets, &aim.confidence, lambda)
            .map_err(fail)?;
        let mut next = displaced(&now, &moves, 1.0);
        let mut next_aim = Aim::at(&next, aim.plane);
        if rounds >= COARSE_ROUNDS && next_aim.asymmetry > STALLED * aim.asymmetry {
            if lambda <= shortest {
                break;
            }
            // Nothing to gain at this length: try the next without taking the round.
            rounds += 1;
            lambda = (lambda * REFINE).max(shortest);
            continue;
        }
        let below = next_aim.asymmetry <= goal;
        reached = below && rounds + 1 >= COARSE_ROUNDS;
        if reached && aim.asymmetry > goal {
            // No further than the goal: the part of the last round that takes it there.
            let fraction = (aim.asymmetry - goal) / (aim.asymmetry - next_aim.asymmetry);
            next = displaced(&now, &moves, fraction);
            next_aim = Aim::at(&next, aim.plane);
        }
        (now, aim) = (next, next_aim);
        rounds += 1;
        lambda = (lambda * REFINE).max(shortest);
    }
    let (now, undone) = untangle(&surface, now);
    if undone > 0.0 {
        aim = Aim::at(&now, aim.plane);
    }
    Ok(Finished {
        undone,
        positions: now.positions,
        plane: aim.plane,
        rounds,
        asymmetry: [before, aim.asymmetry],
    })
}

/// The surface with `fraction` of the displacements `moves`.
fn displaced(surface: &Surface, moves: &[Vector], fraction: f64) -> Surface {
    let moved = surface.positions.iter().zip(moves);
    surface.with_positions(moved.map(|(x, u)| x + u * fraction).collect())
}

/// Where every vertex should go, and how asymmetric the surface is.
struct Aim {
    /// Displacement along the normal (equation 1).
    targets: Vec<Vector>,
    /// Confidence in each, 0 for none.
    confidence: Vec<f64>,
    /// The mirror refitted to the pairs.
    plane: Plane,
    /// Area-weighted mean distance of the mirrored vertices from the surface.
    asymmetry: f64,
}

/// A vertex's partner.
struct Partner {
    point: Point,
    confidence: f64,
}

impl Aim {
    fn at(surface: &Surface, plane: Plane) -> Self {
        let closest = ClosestPoint::new(surface);
        let mirror = Isometry::mirror(&plane);
        let found: Vec<(f64, Option<Partner>)> = (0..surface.positions.len())
            .into_par_iter()
            .map(|v| partner(surface, &closest, &mirror, v))
            .collect();
        let total: f64 = surface.vertex_areas.iter().sum();
        let weighted = found.iter().zip(&surface.vertex_areas);
        let asymmetry = weighted.map(|((d, _), a)| d * a).sum::<f64>() / total;
        let plane = refit(surface, &found).unwrap_or(plane);
        let mirror = Isometry::mirror(&plane);
        let mut targets = vec![Vector::zeros(); found.len()];
        let mut confidence = vec![0.0; found.len()];
        for (v, (_, partner)) in found.iter().enumerate() {
            if let Some(q) = partner {
                let n = surface.vertex_normals[v];
                let (d_p, _) = displacements(&surface.positions[v], &q.point, &mirror);
                targets[v] = n * n.dot(&d_p);
                confidence[v] = q.confidence;
            }
        }
        Self {
            targets,
            confidence,
            plane,
            asymmetry,
        }
    }
}

/// Appendix A over all vertices and their partners.
fn refit(surface: &Surface, found: &[(f64, Option<Partner>)]) -> Option<Plane> {
    let pairs: Vec<Correspondence> = found
        .iter()
        .enumerate()
        .filter_map(|(v, (_, partner))| {
            partner.as_ref().map(|q| Correspondence {
                p: surface.positions[v],
                q: q.point,
                weight: q.confidence * surface.vertex_areas[v],
            })
        })
        .collect();
    optimal_mirror(&pairs, Ambient::Space).map(|fit| fit.plane)
}

/// The distance of the mirror image of vertex `v` from the surface, and its partner there where the
/// contact means something.
fn partner(
    surface: &Surface,
    closest: &ClosestPoint,
    mirror: &Isometry,
    v: usize,
) -> (f64, Option<Partner>) {
    let image = mirror.apply(&surface.positions[v]);
    let normal = mirror.rotate(&surface.vertex_normals[v]);
    let nearest = closest.nearest(&image, f64::INFINITY);
    let distance = nearest.map_or(0.0, |hit| hit.distance);
    let facing = |hit: &Hit| surface.face_normals[hit.at.face as usize].dot(&normal);
    let hit = match nearest {
        Some(hit) if facing(&hit) >= MIN_COS => Some(hit),
        _ => closest.nearest_facing(&image, &normal, MIN_COS, REACH),
    };
    let partner = hit.filter(|hit| hit.distance < REACH).and_then(|hit| {
        let away = image - hit.point;
        // Sideways contact means the image lies beyond a boundary or a fold.
        if away.dot(&normal).abs() < 0.5 * hit.distance && hit.distance > 1e-3 {
            return None;
        }
        let near = 1.0 - (hit.distance / REACH).powi(2);
        let mutual = mutual(surface, closest, mirror, v, &hit);
        Some(Partner {
            point: curved(surface, &hit),
            confidence: facing(&hit).powi(2) * near * near * mutual,
        })
    });
    (distance, partner)
}

/// 1 where the partner's own closest point is vertex `v` again, 0 where it is elsewhere: a finger that
/// is drawn to its neighbour's image is not drawn back.
fn mutual(
    surface: &Surface,
    closest: &ClosestPoint,
    mirror: &Isometry,
    v: usize,
    hit: &Hit,
) -> f64 {
    let x = &surface.positions[v];
    let normal = mirror.rotate(&surface.normal(&hit.at));
    let back = closest.nearest_facing(&mirror.apply(&hit.point), &normal, MIN_COS, REACH);
    back.map_or(0.0, |back| {
        let missed = (back.point - x).norm() / (hit.distance + 0.01);
        let s = (1.0 - missed).clamp(0.0, 1.0);
        1.0 - (1.0 - s).powi(4)
    })
}

/// Partners face the mirrored normal at least this well.
const MIN_COS: f64 = 0.2;

/// The hit moved from the flat triangle to the curved surface that its vertex normals suggest.
///
/// Vertices lie on the shape but faces cut below it where it is convex; taken as they are, closest
/// points would draw every vertex inwards a little each round. Phong tessellation (Boubekeur and Alexa
/// 2008) with shape factor 1/2 lifts a chord to its arc exactly to second order. Creases are left flat.
fn curved(surface: &Surface, hit: &Hit) -> Point {
    let corners = surface.triangles[hit.at.face as usize];
    let face_normal = surface.face_normals[hit.at.face as usize];
    let mut lifted = Vector::zeros();
    for (&v, b) in corners.iter().zip(hit.at.bary) {
        let n = surface.vertex_normals[v as usize];
        if n.dot(&face_normal) < SMOOTH_COS {
            return hit.point;
        }
        lifted -= b * n.dot(&(hit.point - surface.positions[v as usize])) * n;
    }
    hit.point + 0.5 * lifted
}

/// Vertex normals that lean further than 35 degrees from the face mark a crease.
const SMOOTH_COS: f64 = 0.82;
