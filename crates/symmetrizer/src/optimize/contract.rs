//! Contracting a cluster (section 4.2): its patch is pulled towards exact symmetry.

use crate::context::Context;
use crate::error::Result;
use crate::optimize::glide::glide;
use crate::optimize::moving::{Couple, Moving, guided_couples};
use crate::optimize::params::OptimizeParams;
use crate::patch::{PatchParams, Symmetry};
use crate::sample::Sample;
use crate::transform::Plane;

/// What a contraction did.
#[derive(Debug, Clone)]
pub struct Contracted {
    /// The cluster's mirror at the end, working coordinates.
    pub plane: Plane,
    /// Steps taken.
    pub steps: usize,
    /// Mean symmetry cost sum (|d_p|^2 + |d_q|^2) / couples at the first and at the last step, L^2.
    pub cost: [f64; 2],
    /// Couples at the end.
    pub couples: usize,
    /// Deformation energy at the end.
    pub energy: f64,
    /// Whether the energy limit ended it.
    pub limited: bool,
}

impl Contracted {
    fn start(moving: &Moving<'_>, plane: Plane) -> Self {
        Self {
            plane,
            steps: 0,
            cost: [0.0; 2],
            couples: 0,
            energy: moving.deformer.energy(),
            limited: false,
        }
    }
}

/// One contraction step and its figures; false where it must not go on: the mirror is undetermined, or
/// the step would have passed the energy limit and was taken back.
fn advance(
    moving: &mut Moving<'_>,
    couples: &[Couple],
    done: &mut Contracted,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<bool> {
    let before = moving.deformer.state();
    let Some((fit, deformed)) = moving.contract_step(couples, ctx)? else {
        return Ok(false);
    };
    if params.max_deformation.is_some_and(|m| deformed.energy > m) {
        moving.deformer.restore(&before);
        done.limited = true;
        return Ok(false);
    }
    let cost = fit.cost / couples.iter().map(|c| c.weight).sum::<f64>();
    if done.steps == 0 {
        done.cost[0] = cost;
    }
    done.cost[1] = cost;
    done.plane = fit.plane;
    done.steps += 1;
    done.couples = couples.len();
    done.energy = deformed.energy;
    Ok(true)
}

/// Contracts the patch of `symmetry`: glide, then `steps` of the optimal mirror, optimal
/// displacements and deformation, pairs renewed on the way.
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn contract(
    moving: &mut Moving<'_>,
    symmetry: &Symmetry,
    steps: usize,
    patch: &PatchParams,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Contracted> {
    let member = symmetry.membership(moving.samples.list.len());
    let mut done = Contracted::start(moving, symmetry.plane());
    let mut couples: Vec<Couple> = Vec::new();
    for k in 0..steps {
        if k % params.redetect_every == 0 {
            let snapshot = moving.snapshot();
            // Twice the tolerance: what nearly joins the patch is drawn in with it.
            couples = guided_couples(
                &snapshot,
                &done.plane,
                2.0 * patch.tolerance,
                patch.min_cos,
                |s| member[s as usize],
            );
            if let Some(glided) = glide(&snapshot.ground(), &mut couples) {
                done.plane = glided.plane;
            }
        }
        if !advance(moving, &couples, &mut done, params, ctx)? {
            break;
        }
    }
    Ok(done)
}

/// The last contraction, under the final mirror of the whole shape: every sample with the closest
/// facing point to its image, whether or not a descriptor ever matched it, the reach narrowing as
/// the halves come together. Only samples for which `wanted` holds take part.
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn contract_whole(
    moving: &mut Moving<'_>,
    plane: Plane,
    wanted: impl Fn(&Sample) -> bool,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Contracted> {
    let mut done = Contracted::start(moving, plane);
    let rounds = params.final_steps.div_ceil(params.redetect_every).max(1);
    let mut couples = Vec::new();
    let mut met = false;
    for k in 0..params.final_steps {
        ctx.progress(k as f64 / params.final_steps as f64)?;
        let anew = k % params.redetect_every == 0;
        if met && !anew {
            continue;
        }
        if anew {
            let round = k / params.redetect_every;
            let narrowing = round as f64 / rounds as f64;
            let reach = WIDE * (1.0 - narrowing) + NARROW * narrowing;
            let snapshot = moving.snapshot();
            let wanted = |s: u32| wanted(&snapshot.samples.list[s as usize]);
            couples = guided_couples(&snapshot, &done.plane, reach, 0.3, wanted);
        }
        let was = done.cost[1];
        if !advance(moving, &couples, &mut done, params, ctx)? {
            break;
        }
        // Couples that have come together as far as they will wait to be chosen anew.
        met = !anew && done.cost[1] > STALLED * was;
    }
    Ok(done)
}

/// A step that leaves more than this share of the cost has nothing left to gain from its couples.
const STALLED: f64 = 0.97;
/// Reach of closest points in the first and in the last round, fractions of L.
const WIDE: f64 = 0.1;
const NARROW: f64 = 0.04;
