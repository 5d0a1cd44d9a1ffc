//! Merging rotations (section 4.2): of a shape that is bent, two parts with the same rotations about axes of their own turn until one axis
//! serves both.

use crate::context::Context;
use crate::deform::Pull;
use crate::error::Result;
use crate::geom::Point;
use crate::optimize::moving::Moving;
use crate::optimize::orbit::joint::Parts;
use crate::optimize::params::OptimizeParams;
use crate::transform::{Axis, Jointed};

/// What a merge did.
#[derive(Debug, Clone, Copy)]
pub struct Merged {
    /// The common axis, working coordinates.
    pub axis: Axis,
    /// Steps taken.
    pub steps: usize,
    /// Distance of the rotations in transformation space before and after, fraction of L.
    pub distance: [f64; 2],
    /// Deformation energy at the end.
    pub energy: f64,
    /// Whether the energy limit ended it.
    pub limited: bool,
}

/// Carries the `parts` to a common axis, step by step: about the place where their axes meet, along arcs, so that nothing is squeezed (as
/// mirrors are carried, decision 0003).
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn merge(
    moving: &mut Moving<'_>,
    parts: &Parts,
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Merged> {
    let mut places = places(moving, parts);
    let mut joint = parts.joint(&places);
    let mut done = Merged {
        axis: joint.common(),
        steps: 0,
        distance: [parts.apart(&joint, &places); 2],
        energy: moving.deformer.energy(),
        limited: false,
    };
    for k in 0..params.merge_steps {
        ctx.progress(k as f64 / params.merge_steps as f64)?;
        if done.distance[1] < params.merged_distance {
            break;
        }
        let before = moving.deformer.state();
        let pulls = pulls(moving, parts, &places, &joint);
        let energy = moving.deformer.deform(&pulls, ctx)?.energy;
        if params.max_deformation.is_some_and(|most| energy > most) {
            moving.deformer.restore(&before);
            done.limited = true;
            break;
        }
        places = self::places(moving, parts);
        joint = parts.joint(&places);
        done = Merged {
            axis: joint.common(),
            steps: done.steps + 1,
            distance: [done.distance[0], parts.apart(&joint, &places)],
            energy,
            limited: false,
        };
    }
    Ok(done)
}

/// Where the samples of both parts are.
fn places(moving: &Moving<'_>, parts: &Parts) -> [Vec<Point>; 2] {
    parts.at().map(|at| moving.deformer.places(at))
}

/// Each sample pulled as its part is carried; a sample of area A with A / l^2 over dt, as in a contraction.
fn pulls(
    moving: &Moving<'_>,
    parts: &Parts,
    places: &[Vec<Point>; 2],
    joint: &Jointed,
) -> Vec<Pull> {
    let weight = moving.samples.area / (moving.length * moving.length * moving.step);
    let carries = joint.carries().map(|carry| carry.part(moving.step));
    let of = |k: usize| {
        let carry = carries[k];
        let samples = parts.at()[k].iter().zip(&places[k]);
        samples.map(move |(at, x)| Pull {
            at: *at,
            target: carry.apply(x),
            weight,
        })
    };
    of(0).chain(of(1)).collect()
}
