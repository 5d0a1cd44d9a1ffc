//! Merging two clusters (section 4.2): both parts turn until one mirror serves them.

use crate::context::Context;
use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::optimize::moving::{Couple, Moving, fit_mirror, guided_couples};
use crate::optimize::params::OptimizeParams;
use crate::patch::ground::touch;
use crate::patch::{PatchParams, Symmetry};
use crate::transform::displacement::carry;
use crate::transform::{
    Ambient, Correspondence, Isometry, Plane, TransformSpace, displacements, optimal_mirror,
};

/// What a merge did.
#[derive(Debug, Clone)]
pub struct Merged {
    /// The common mirror, working coordinates.
    pub plane: Plane,
    /// Steps taken.
    pub steps: usize,
    /// Distance of the two mirrors in transformation space before and after, fraction of L.
    pub distance: [f64; 2],
    /// Deformation energy at the end.
    pub energy: f64,
    /// Whether the energy limit ended it.
    pub limited: bool,
}

/// Near the energy limit steps are halved down to this part of the time step.
const SMALLEST_STEP: f64 = 16.0;

/// A place is missed by no more than this, fraction of L, by points that face its way to within this cosine.
const FAR: f64 = 0.08;
const MIN_COS: f64 = 0.3;
/// How often what is missed is averaged among neighbours: a part hangs together.
const AVERAGED: usize = 4;

/// One of the two parts: its couples and the samples they came from.
struct Part {
    couples: Vec<Couple>,
    member: Vec<bool>,
    plane: Plane,
}

/// The samples of each of two symmetries that speak for it alone: what both claim goes to the one
/// whose mirror fits it better.
pub fn ownership(a: &Symmetry, b: &Symmetry, count: usize) -> [Vec<bool>; 2] {
    let residuals = |s: &Symmetry| {
        let mut r = vec![f64::INFINITY; count];
        for pair in &s.pairs {
            r[pair.sample as usize] = pair.residual;
        }
        r
    };
    let (r_a, r_b) = (residuals(a), residuals(b));
    let own = |mine: &[f64], other: &[f64]| {
        let pairs = mine.iter().zip(other);
        pairs.map(|(m, o)| m.is_finite() && m < o).collect()
    };
    [own(&r_a, &r_b), own(&r_b, &r_a)]
}

/// Merges the clusters of `a` and `b`: each step fits both mirrors and their common optimum (both
/// clusters' pairs pooled with the same total weight) and carries each part along the arc towards
/// it, while it contracts.
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn merge(
    moving: &mut Moving<'_>,
    [a, b]: [&Symmetry; 2],
    patch: &PatchParams,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Merged> {
    let planes = [a.plane(), b.plane()];
    let [member_a, member_b] = territories(moving, planes);
    let part = |plane, member| Part {
        couples: Vec::new(),
        member,
        plane,
    };
    let mut parts = [part(planes[0], member_a), part(planes[1], member_b)];
    let mut done = Merged {
        plane: parts[0].plane,
        steps: 0,
        distance: [f64::INFINITY; 2],
        energy: moving.deformer.energy(),
        limited: false,
    };
    let dt = moving.step;
    for k in 0..params.merge_steps {
        ctx.progress(k as f64 / params.merge_steps as f64)?;
        if k % params.redetect_every == 0 {
            renew(moving, &mut parts, patch);
        }
        let before = moving.deformer.state();
        let Some(energy) = step(moving, &mut parts, &mut done, ctx)? else {
            break;
        };
        if params.max_deformation.is_some_and(|m| energy > m) {
            moving.deformer.restore(&before);
            // Closer to the limit in smaller steps, before giving up.
            moving.step /= 2.0;
            done.limited = moving.step < dt / SMALLEST_STEP;
            if done.limited {
                break;
            }
            continue;
        }
        done.steps += 1;
        done.energy = energy;
        if done.distance[1] < params.merged_distance {
            break;
        }
    }
    moving.step = dt;
    Ok(done)
}

/// The samples of each of two parts: those around which its mirror holds better than the other's, whether in a
/// patch or not. Patches overlap on what is round and leave out what one of them barely misses (the
/// bunny's snout), which would then be left behind.
fn territories(moving: &Moving<'_>, planes: [Plane; 2]) -> [Vec<bool>; 2] {
    let snapshot = moving.snapshot();
    let neighbors = &snapshot.samples.neighbors;
    let [a, b] = planes.map(|plane| {
        let touched = touch(&snapshot.ground(), &Isometry::mirror(&plane), FAR, MIN_COS);
        let missed = touched
            .iter()
            .map(|hit| hit.map_or(FAR, |hit| hit.residual));
        let mut missed: Vec<f64> = missed.collect();
        for _ in 0..AVERAGED {
            missed = averaged(&missed, neighbors);
        }
        missed
    });
    let nearer = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a < b).collect();
    [nearer(&a, &b), nearer(&b, &a)]
}

/// Each value's mean with those of its neighbours.
fn averaged(values: &[f64], neighbors: &[Vec<u32>]) -> Vec<f64> {
    let mean = |(value, near): (&f64, &Vec<u32>)| {
        let sum: f64 = near.iter().map(|&i| values[i as usize]).sum();
        (value + sum) / (1 + near.len()) as f64
    };
    values.iter().zip(neighbors).map(mean).collect()
}

/// Pairs each part anew under its own mirror.
fn renew(moving: &Moving<'_>, parts: &mut [Part; 2], patch: &PatchParams) {
    let snapshot = moving.snapshot();
    for part in parts {
        let couples = guided_couples(
            &snapshot,
            &part.plane,
            1.5 * patch.tolerance,
            patch.min_cos,
            |s| part.member[s as usize],
        );
        // Closest points may lose a part for a moment; its old pairs still ride along.
        if !couples.is_empty() {
            part.couples = couples;
        }
    }
}

/// One step of both parts; `None` where a mirror is undetermined. Returns the energy.
fn step(
    moving: &mut Moving<'_>,
    parts: &mut [Part; 2],
    done: &mut Merged,
    ctx: &mut Context<'_>,
) -> Result<Option<f64>> {
    let ends = [0, 1].map(|k| moving.ends(&parts[k].couples));
    for k in 0..2 {
        let Some(fit) = fit_mirror(&parts[k].couples, &ends[k], moving.samples.ambient) else {
            return Ok(None);
        };
        parts[k].plane = fit.plane;
    }
    let Some(common) = pooled(parts, &ends, moving.samples.ambient) else {
        return Ok(None);
    };
    let mirrors = [0, 1].map(|k| Isometry::mirror(&parts[k].plane));
    let support = ends.iter().flatten().map(|(p, _)| (*p, 1.0));
    let distance = TransformSpace::new(support).distance(&mirrors[0], &mirrors[1]);
    if done.steps == 0 {
        done.distance[0] = distance;
    }
    done.distance[1] = distance;
    done.plane = common;
    let dt = moving.step;
    let carries = [0, 1].map(|k| {
        let center = ends[k].iter().map(|(p, _)| p.coords).sum::<Vector>() / ends[k].len() as f64;
        carry(&parts[k].plane, &common, dt, &Point::from(center))
    });
    let split = parts[0].couples.len();
    let couples: Vec<Couple> = parts.iter().flat_map(|p| p.couples.clone()).collect();
    let both: Vec<(Point, Point)> = ends.concat();
    let displace = |i: usize, p: &Point, q: &Point| {
        let k = usize::from(i >= split);
        let (d_p, d_q) = displacements(p, q, &mirrors[k]);
        let to = |x: &Point, d: Vector| (carries[k].apply(&(x + d * dt)) - x) / dt;
        (to(p, d_p), to(q, d_q))
    };
    let deformed = moving.pull(&couples, &both, displace, ctx)?;
    Ok(Some(deformed.energy))
}

/// The optimal mirror of both parts together, each with the same total weight, so
/// that both parts turn.
fn pooled(parts: &[Part; 2], ends: &[Vec<(Point, Point)>; 2], ambient: Ambient) -> Option<Plane> {
    let mut pairs = Vec::new();
    for (part, ends) in parts.iter().zip(ends) {
        let total: f64 = part.couples.iter().map(|c| c.weight).sum();
        for (c, (p, q)) in part.couples.iter().zip(ends) {
            pairs.push(Correspondence {
                p: *p,
                q: *q,
                weight: c.weight / total,
            });
        }
    }
    optimal_mirror(&pairs, ambient).map(|fit| fit.plane)
}
