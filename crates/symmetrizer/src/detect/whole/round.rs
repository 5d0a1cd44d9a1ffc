//! Shapes that are round as a whole, roughly: what a potter turns, and what has warped since
//! (`docs/decisions/0035-roundish-shapes.md`).

use rayon::prelude::*;

use crate::detect::Cloud;
use crate::detect::surroundings::{SHARE_OF_ANY, Surroundings};
use crate::detect::whole::holds::{ANGLES, ANY, FILLED, LEAST, Whole, is_whole, root_mean};
use crate::detect::whole::slopes::Slopes;
use crate::detect::whole::{SLACK, WORSE, axes};
use crate::patch::{Refusal, Symmetry};
use crate::slip::{Continuous, Slip};
use crate::transform::{Axis, Class, Isometry};

/// What is round is at least this share of the surface: there may be a handle or a spout.
const ROUND: f64 = 0.9;
/// A shape that is round roughly is worth more than a part of it that is so exactly where it is larger by this share of the surface.
const MORE: f64 = 0.02;
/// An axis that is not yet fitted may miss by so many times [`LEAST`], what is not round among it.
const NEARLY: f64 = 3.0;

/// The surface as one of revolution, where it is round as a whole, roughly; `clouds` are the votes. What the turning implies is taken out
/// of `symmetries`, into the list of what was refused.
pub fn revolution(
    surroundings: &Surroundings<'_>,
    clouds: &[Cloud],
    symmetries: &mut Vec<Symmetry>,
    refused: &mut Vec<Refusal>,
) -> Option<Continuous> {
    let known = surroundings.continuous.iter();
    let known = known.map(|c| c.area_fraction).fold(0.0, f64::max);
    if known + MORE > 1.0 {
        return None;
    }
    let whole = Whole::new(surroundings, clouds);
    let wholes = symmetries.iter().filter(|s| is_whole(s));
    let missed = wholes.clone().map(|s| whole.missed_by_all(&s.q_from_p));
    let most = WORSE * missed.fold(f64::INFINITY, f64::min) + SLACK;
    let mirrors = wholes.filter(|s| s.class == Class::Mirror);
    let mirrors: Vec<Isometry> = mirrors.map(|s| s.q_from_p).collect();
    let suggested = axes::suggested(surroundings, symmetries).into_iter();
    let meeting = axes::meeting(surroundings, &mirrors).into_iter();
    let axes = meeting.chain(suggested.map(|s| s.axis));
    let found = axes.filter_map(|axis| about(&whole, &axis, most));
    let found = found.filter(|round| round.area_fraction >= known + MORE);
    let round = found.min_by(|a, b| a.rms.total_cmp(&b.rms))?;
    for s in std::mem::take(symmetries) {
        match surroundings.more_than(std::slice::from_ref(&round), s) {
            Err(refusal) => refused.push(*refusal),
            Ok(s) => symmetries.push(s),
        }
    }
    Some(round)
}

/// The surface as one of revolution about an axis, which is fitted, that misses by `most` at the most, fraction of L; `None` where it
/// is none, or where nothing tells this axis from others.
fn about(whole: &Whole<'_>, axis: &Axis, most: f64) -> Option<Continuous> {
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
