//! Deformation carried on until it has come to rest.

use crate::context::Context;
use crate::deform::{Deformer, Pull};
use crate::error::Result;

/// Steps at the most.
const STEPS: usize = 200;

/// What came of it.
#[derive(Debug, Clone, Copy)]
pub struct Relaxed {
    /// Steps taken.
    pub steps: usize,
    /// Deformation energy, see [`Deformer::energy`].
    pub energy: f64,
    /// Energy and pulls together, in the same unit: what the steps make small.
    pub total: f64,
}

/// Deforms towards fixed targets until a step lowers the total by less than `tolerance` of it.
///
/// # Errors
/// As [`Deformer::deform`].
pub fn relax(
    deformer: &mut dyn Deformer,
    pulls: &[Pull],
    tolerance: f64,
    ctx: &mut Context<'_>,
) -> Result<Relaxed> {
    let mut done = Relaxed {
        steps: 0,
        energy: deformer.energy(),
        total: f64::INFINITY,
    };
    while done.steps < STEPS {
        ctx.progress(done.steps as f64 / STEPS as f64)?;
        done.energy = deformer.deform(pulls, ctx)?.energy;
        done.steps += 1;
        let before = std::mem::replace(&mut done.total, total(deformer, pulls, done.energy));
        if before - done.total <= tolerance * done.total {
            break;
        }
    }
    Ok(done)
}

/// Energy plus the pulls' share, per area.
pub fn total(deformer: &dyn Deformer, pulls: &[Pull], energy: f64) -> f64 {
    let at: Vec<_> = pulls.iter().map(|p| p.at).collect();
    let missed = |(p, x): (&Pull, crate::geom::Point)| p.weight * (x - p.target).norm_squared();
    let pulled: f64 = pulls.iter().zip(deformer.places(&at)).map(missed).sum();
    energy + pulled / deformer.rest().area()
}
