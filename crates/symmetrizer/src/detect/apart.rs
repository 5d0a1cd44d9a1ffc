//! Mirrors of parts that move against each other, told apart: a head turned on its body draws the
//! body's plane towards its own, and the other way round, as both hold nearly where they meet.

use crate::detect::surroundings::Surroundings;
use crate::geom::{Point, median};
use crate::patch::ground::{contacts, touch};
use crate::patch::refine::{refine, weigh};
use crate::patch::{PatchPair, Symmetry};
use crate::transform::{Class, Isometry};

/// A place belongs to another mirror that holds there better by this factor; ours.
const CLEARLY: f64 = 0.7;
/// Rounds at the most.
const ROUNDS: usize = 20;
/// At rest: no mirror moves by more in a round, rms fraction of L.
const AT_REST: f64 = 1e-5;
/// A mirror keeps at least this share of its places, else it stays as it was.
const KEPT: f64 = 0.3;

/// Refits each mirror to the places that no other holds clearly better.
pub fn apart(surroundings: &Surroundings<'_>, mirrors: &mut [Symmetry]) {
    if mirrors.len() < 2 {
        return;
    }
    let mut planes: Vec<Isometry> = mirrors.iter().map(|s| s.q_from_p).collect();
    for _ in 0..ROUNDS {
        let held: Vec<Vec<Option<PatchPair>>> =
            planes.iter().map(|t| on(surroundings, t)).collect();
        let next: Vec<Isometry> = (0..planes.len())
            .map(|k| {
                refitted(
                    surroundings,
                    &planes[k],
                    &mirrors[k],
                    own(surroundings, &held, k),
                )
            })
            .collect();
        let moved = planes.iter().zip(&next);
        let moved = moved.map(|(s, t)| surroundings.space.distance(s, t));
        let rests = moved.fold(0.0, f64::max) < AT_REST;
        planes = next;
        if rests {
            break;
        }
    }
    for (mirror, t) in mirrors.iter_mut().zip(planes) {
        let t = Isometry::mirror(&t.nearest_mirror(&Point::origin()).canonical());
        settle_at(surroundings, mirror, t);
    }
}

/// What a mirror holds for, each place with its partner.
fn on(surroundings: &Surroundings<'_>, t: &Isometry) -> Vec<Option<PatchPair>> {
    let patch = &surroundings.params.patch;
    touch(surroundings.ground, t, patch.tolerance, patch.min_cos)
}

/// Of the places that mirror `k` holds for those around which no other holds clearly better.
fn own(
    surroundings: &Surroundings<'_>,
    held: &[Vec<Option<PatchPair>>],
    k: usize,
) -> Vec<PatchPair> {
    let neighbors = &surroundings.ground.samples.neighbors;
    let tolerance = surroundings.params.patch.tolerance;
    // One place alone is noise.
    let around = |j: usize, s: u32| {
        let at = |i: u32| held[j][i as usize].map_or(tolerance, |p| p.residual);
        let near = &neighbors[s as usize];
        let sum: f64 = near.iter().map(|&i| at(i)).sum();
        (at(s) + sum) / (1 + near.len()) as f64
    };
    let kept = |p: &&PatchPair| {
        let mine = around(k, p.sample);
        (0..held.len()).all(|j| j == k || around(j, p.sample) > CLEARLY * mine)
    };
    held[k].iter().flatten().filter(kept).copied().collect()
}

/// One step of the mirror towards its `own` places within its patch.
fn refitted(
    surroundings: &Surroundings<'_>,
    t: &Isometry,
    mirror: &Symmetry,
    own: Vec<PatchPair>,
) -> Isometry {
    let member = mirror.membership(surroundings.ground.samples.list.len());
    let own: Vec<PatchPair> = own
        .into_iter()
        .filter(|p| member[p.sample as usize])
        .collect();
    if (own.len() as f64) < KEPT * mirror.pairs.len() as f64 {
        return *t;
    }
    let mut residuals: Vec<f64> = own.iter().map(|p| p.residual).collect();
    let middle = median(&mut residuals).unwrap_or_default();
    let mut contacts = contacts(surroundings.ground, &own);
    weigh(t, &mut contacts, middle);
    refine(t, Class::Mirror, &contacts)
}

/// The mirror at `t`, with the places of its patch that it still holds for.
fn settle_at(surroundings: &Surroundings<'_>, mirror: &mut Symmetry, t: Isometry) {
    let count = surroundings.ground.samples.list.len();
    let member = mirror.membership(count);
    let held = on(surroundings, &t).into_iter().flatten();
    let pairs: Vec<PatchPair> = held.filter(|p| member[p.sample as usize]).collect();
    if pairs.is_empty() {
        return;
    }
    let squares = pairs.iter().map(|p| p.residual.powi(2));
    mirror.rms = (squares.sum::<f64>() / pairs.len() as f64).sqrt();
    mirror.area_fraction = pairs.len() as f64 / count as f64;
    mirror.image = pairs.iter().map(|p| p.sample).collect();
    mirror.pairs = pairs;
    mirror.q_from_p = t;
}
