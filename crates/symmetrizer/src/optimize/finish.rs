//! The finish at full resolution: what the control mesh is too coarse to carry.
//!
//! Each vertex is drawn half of the way, along its normal, to its mirrored closest point; the field of
//! these displacements is smoothed by a screened Laplacian, so that the surface moves as cloth and
//! not as dust, and keeps the detail that is finer than the smoothing length.

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::smooth::SmoothField;
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::optimize::params::OptimizeParams;
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
    /// rms displacement of the vertices by the finish, fraction of L.
    pub rms: f64,
}

/// Closest points are looked for this far, fraction of L.
const REACH: f64 = 0.05;

/// Runs the rounds of the finish on `surface` under the mirror `plane`.
///
/// # Errors
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn finish(
    surface: Surface,
    plane: Plane,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Finished> {
    let start = surface.positions.clone();
    let mut done = Finished {
        positions: Vec::new(),
        plane,
        rounds: 0,
        rms: 0.0,
    };
    let fail = |_| Error::Numerical {
        stage: "finish",
        step: 0,
        what: "the smoothing system could not be solved".into(),
    };
    let mut field = SmoothField::new(&surface, params.finish_length).map_err(fail)?;
    let mut now = surface;
    for round in 0..params.finish_rounds {
        ctx.progress(round as f64 / params.finish_rounds as f64)?;
        let closest = ClosestPoint::new(&now);
        let (targets, confidence, plane) = targets(&now, &closest, done.plane);
        done.plane = plane;
        let moves = field.solve(&targets, &confidence).map_err(fail)?;
        let moved = now.positions.iter().zip(&moves).map(|(x, u)| x + u);
        now = now.with_positions(moved.collect());
        done.rounds = round + 1;
    }
    let squares = now.positions.iter().zip(&start);
    let total: f64 = squares.map(|(a, b)| (a - b).norm_squared()).sum();
    done.rms = (total / start.len().max(1) as f64).sqrt();
    done.positions = now.positions;
    Ok(done)
}

/// Each vertex's displacement along its normal (equation 1), the confidence in it, and the mirror
/// refitted to the pairs.
fn targets(
    surface: &Surface,
    closest: &ClosestPoint,
    plane: Plane,
) -> (Vec<Vector>, Vec<f64>, Plane) {
    let mirror = Isometry::mirror(&plane);
    let found: Vec<Option<(Point, f64)>> = (0..surface.positions.len())
        .into_par_iter()
        .map(|v| partner(surface, closest, &mirror, v))
        .collect();
    let pairs: Vec<Correspondence> = found
        .iter()
        .enumerate()
        .filter_map(|(v, q)| {
            q.map(|(q, c)| Correspondence {
                p: surface.positions[v],
                q,
                weight: c * surface.vertex_areas[v],
            })
        })
        .collect();
    let plane = optimal_mirror(&pairs, Ambient::Space).map_or(plane, |fit| fit.plane);
    let mirror = Isometry::mirror(&plane);
    let mut targets = vec![Vector::zeros(); found.len()];
    let mut confidence = vec![0.0; found.len()];
    for (v, q) in found.iter().enumerate() {
        if let Some((q, c)) = q {
            let n = surface.vertex_normals[v];
            let (d_p, _) = displacements(&surface.positions[v], q, &mirror);
            targets[v] = n * n.dot(&d_p);
            confidence[v] = *c;
        }
    }
    (targets, confidence, plane)
}

/// The facing surface point closest to the mirror image of vertex `v` and the confidence in it.
fn partner(
    surface: &Surface,
    closest: &ClosestPoint,
    mirror: &Isometry,
    v: usize,
) -> Option<(Point, f64)> {
    let image = mirror.apply(&surface.positions[v]);
    let normal = mirror.rotate(&surface.vertex_normals[v]);
    let hit = closest.nearest_facing(&image, &normal, 0.2, REACH)?;
    let away = image - hit.point;
    // Sideways contact means the image lies beyond a boundary or a fold.
    if away.dot(&normal).abs() < 0.5 * hit.distance && hit.distance > 1e-3 {
        return None;
    }
    let point = curved(surface, &hit);
    let facing = surface.face_normals[hit.at.face as usize]
        .dot(&normal)
        .max(0.0);
    let near = 1.0 - (hit.distance / REACH).powi(2);
    Some((point, facing.powi(2) * near * near))
}

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
