//! Our deformers on an exhibit.

use symmetrizer::deform::{DeformParams, Model, deformer, relax};
use symmetrizer::{Context, Result};

use super::exhibit::Exhibit;
use super::result::Deformed;
use crate::bench_deform::clock::Clock;
use crate::constraints::pulls;

/// The handles' motion is made in so many parts, so that no step has to turn anything by much.
pub const PARTS: usize = 9;
/// A step that lowers the total by less than this share of it ends a part of the motion, and the whole.
const ON_THE_WAY: f64 = 1e-2;
const AT_THE_END: f64 = 1e-6;
/// Stiffness length of the handles, fraction of L: so short that they are met.
const GRIP: f64 = 0.002;
/// More than any exhibit has: nothing is decimated.
const ALL_FACES: usize = 100_000;

/// The exhibit deformed until it is at rest under the handles.
///
/// # Errors
/// Those of deformation.
pub fn deformed(exhibit: &Exhibit, model: Model, half_height: f64) -> Result<Deformed> {
    let clock = Clock::start();
    let params = DeformParams {
        model,
        control_faces: ALL_FACES,
        half_height,
        ..DeformParams::default()
    };
    let mut ctx = Context::new(0);
    let mut deformer = deformer(&exhibit.surface, &params)?;
    let mut steps = 0;
    for part in 1..=PARTS {
        let targets = exhibit.targets(part as f64 / PARTS as f64);
        let pulls = pulls(&exhibit.surface, &targets, GRIP);
        let tolerance = if part < PARTS { ON_THE_WAY } else { AT_THE_END };
        for _ in 0..5 {
        let r = relax(deformer.as_mut(), &pulls, tolerance, &mut ctx)?;
        steps += r.steps;
        if part == PARTS { crate::terminal::note(&format!("{r:?}")); }
        if r.steps < 200 { break; }
        }
    }
    Ok(Deformed {
        method: format!("{model:?} {half_height}"),
        positions: deformer.positions(),
        steps: Some(steps),
        seconds: clock.wall(),
    })
}
