//! Shapes that are round as a whole, roughly: what a potter turns, and what has warped since
//! (`docs/decisions/0035-roundish-shapes.md`).

use rayon::prelude::*;

use crate::detect::surroundings::SHARE_OF_ANY;
use crate::detect::whole::holds::{ANGLES, ANY, FILLED, LEAST, Whole, root_mean};
use crate::detect::whole::slopes::Slopes;
use crate::slip::{Continuous, Slip};
use crate::transform::{Axis, Isometry};

/// What is round is at least this share of the surface: there may be a handle or a spout.
const ROUND: f64 = 0.9;
/// An axis that is not yet fitted may miss by so many times [`LEAST`], what is not round among it.
const NEARLY: f64 = 3.0;

/// The surface as one of revolution about an axis, which is fitted, that misses by `most` at the most, fraction of L; `None` where it
/// is none, or where nothing tells this axis from others.
pub fn revolution(whole: &Whole<'_>, axis: &Axis, most: f64) -> Option<Continuous> {
    let surroundings = whole.surroundings;
    if whole.any_missed(axis, &Isometry::identity()) > NEARLY * LEAST {
        return None;
    }
    let axis = whole.fitted_axis(axis, ANY)?;
    let tolerance = surroundings.params.patch.tolerance;
    let most = most
        .min(FILLED * tolerance)
        .min(SHARE_OF_ANY * surroundings.any_mirror);
    let missed = missed(whole, &axis);
    let slopes = Slopes::new(surroundings.ground, &axis);
    let round: Vec<u32> = (0..missed.len() as u32)
        .filter(|&i| missed[i as usize] <= tolerance * tolerance && slopes.is_even(i))
        .collect();
    let area_fraction = round.len() as f64 / missed.len().max(1) as f64;
    let rms = root_mean(round.iter().map(|&i| missed[i as usize]));
    if area_fraction < ROUND || rms > most || !slopes.are_gentle(&round) {
        return None;
    }
    Some(Continuous {
        slip: Slip::Revolution,
        axis: Some(axis.direction),
        point: axis.foot(&surroundings.space.centre()),
        pitch: 0.0,
        area_fraction,
        rms: slopes.rms(&round),
        samples: round,
    })
}

/// For each sample the mean square by which turns about `axis` by any angle miss.
fn missed(whole: &Whole<'_>, axis: &Axis) -> Vec<f64> {
    let turns: Vec<Isometry> = (1..=ANGLES)
        .map(|k| axis.rotation(f64::from(k) * ANY))
        .collect();
    (0..whole.surroundings.ground.samples.list.len() as u32)
        .into_par_iter()
        .map(|s| {
            let squares = turns.iter().map(|t| whole.miss(t, s));
            squares.sum::<f64>() / f64::from(ANGLES)
        })
        .collect()
}
