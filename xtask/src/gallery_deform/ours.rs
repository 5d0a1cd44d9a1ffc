//! Our deformers on an exhibit.

use symmetrizer::deform::{DeformParams, Deformer, Model, deformer, relax};
use symmetrizer::{Context, Result};

use super::exhibit::{Exhibit, PARTS};
use super::result::Deformed;
use crate::bench_deform::clock::Clock;
use crate::constraints::pulls;

/// A step that lowers the total by less than this share of it ends a part of the motion, and the whole.
const ON_THE_WAY: f64 = 1e-2;
const AT_THE_END: f64 = 1e-6;
/// The exhibit is at rest when another relaxation lowers the total by less than this share of it.
const GAIN: f64 = 1e-4;
/// Stiffness length of the handles, fraction of L: so short that they are met.
const GRIP: f64 = 0.002;
/// More than any exhibit has: nothing is decimated.
const ALL_FACES: usize = 100_000;

/// Half heights that are tried, fractions of L: the default, and one with which the bar keeps its curvature as well as
/// with SRE-ARAP by default (it has half a thickness of 0.09).
pub const HALF_HEIGHTS: [f64; 2] = [0.02, 0.12];
/// PriMo and its rival.
pub const MODELS: [Model; 2] = [Model::Primo, Model::Arap];

/// The exhibit deformed until it is at rest under the handles.
///
/// # Errors
/// Those of deformation.
pub fn deformed(exhibit: &Exhibit, model: Model, half_height: f64) -> Result<Deformed> {
    let clock = Clock::start();
    let params = DeformParams {
        model,
        half_height,
        control_faces: ALL_FACES,
        ..DeformParams::default()
    };
    let mut deformer = deformer(&exhibit.surface, &params)?;
    let steps = move_handles(deformer.as_mut(), exhibit)?;
    Ok(Deformed {
        method: format!("{}, h = {half_height}", name(model)),
        positions: deformer.positions(),
        steps,
        seconds: clock.wall(),
        peer: false,
    })
}

fn name(model: Model) -> &'static str {
    match model {
        Model::Primo => "PriMo",
        Model::Arap => "smooth ARAP",
    }
}

/// Makes the handles' motion part by part; the steps that it took.
fn move_handles(deformer: &mut dyn Deformer, exhibit: &Exhibit) -> Result<usize> {
    let mut ctx = Context::new(0);
    let pulls = |part| pulls(&exhibit.surface, &exhibit.part(part), GRIP);
    let mut steps = 0;
    for part in 1..PARTS {
        steps += relax(deformer, &pulls(part), ON_THE_WAY, &mut ctx)?.steps;
    }
    // A relaxation may end at its limit of steps: another one must gain nothing.
    let (pulls, mut before) = (pulls(PARTS), f64::INFINITY);
    loop {
        let relaxed = relax(deformer, &pulls, AT_THE_END, &mut ctx)?;
        steps += relaxed.steps;
        if before - relaxed.total <= GAIN * relaxed.total {
            return Ok(steps);
        }
        before = relaxed.total;
    }
}
