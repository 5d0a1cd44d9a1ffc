//! What leaves an axis in its place: the turns about it, of the highest order that holds, and what there is beside them.

use std::f64::consts::{PI, TAU};

use crate::detect::whole::axes::Suggested;
use crate::detect::whole::holds::{FAR, LEAST, TELLING, Whole};
use crate::geom::{Point, Vector, any_orthogonal};
use crate::patch::Symmetry;
use crate::transform::{Axis, Class, Isometry, Plane};

/// Orders at the most.
const MOST: u32 = 60;
/// A turn about an axis that is not yet fitted may miss by this share of what any angle does.
const NEARLY: f64 = 0.6;
/// Places that are tried around an axis, over what a turn leaves of them, and steps towards the best.
const PLACES: u32 = 24;
const STEPS: usize = 6;

/// The turns about an axis.
pub struct Turn {
    /// As it was fitted.
    axis: Axis,
    order: u32,
    /// The turn by one step.
    pub step: Symmetry,
}

/// The turn of the highest order about an axis, which is fitted; `None` where none holds for the whole, or where the highest that may is
/// `known`.
pub fn turn(
    whole: &Whole<'_>,
    Suggested { axis, only_half }: &Suggested,
    known: &dyn Fn(&Isometry) -> bool,
) -> Option<Turn> {
    let most = if *only_half { 2 } else { MOST };
    let within = |orders: Vec<u32>, bound: f64| {
        let turns = orders.iter().map(|&n| axis.rotation(wide(n)));
        let near = whole.all_within(&turns.collect::<Vec<Isometry>>(), bound);
        let both = orders.into_iter().zip(near);
        both.filter_map(|(n, near)| near.then_some(n))
            .collect::<Vec<u32>>()
    };
    let primes = within((2..=most).filter(|&n| is_prime(n)).collect(), NEARLY * FAR);
    if primes.is_empty() {
        return None;
    }
    let any = whole.any_missed(axis, &Isometry::identity());
    if any < LEAST {
        return None;
    }
    let primes = within(primes, NEARLY * any);
    let orders = (2..=most).rev().filter(|&n| is_product(n, &primes));
    let orders = within(orders.collect(), NEARLY * any);
    let highest = axis.rotation(TAU / f64::from(*orders.first()?));
    if known(&highest) {
        return None;
    }
    orders.into_iter().find_map(|n| turn_of(whole, axis, n))
}

/// The angle nearest to half a round of which all turns of an order are multiples, radians: a small turn misses little of anything.
fn wide(order: u32) -> f64 {
    let steps = (1..=order / 2).rev().find(|&k| gcd(k, order) == 1);
    f64::from(steps.unwrap_or(1)) * TAU / f64::from(order)
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

fn is_prime(n: u32) -> bool {
    (2..n).all(|k| !n.is_multiple_of(k))
}

/// Whether `n` has no other factors than `primes`.
fn is_product(n: u32, primes: &[u32]) -> bool {
    let rest = primes.iter().fold(n, |mut rest, p| {
        while rest.is_multiple_of(*p) {
            rest /= p;
        }
        rest
    });
    rest == 1
}

/// The turns of one `order`, the axis fitted; `None` where they do not hold for the whole or hold no better than what is between them.
fn turn_of(whole: &Whole<'_>, axis: &Axis, order: u32) -> Option<Turn> {
    let step = TAU / f64::from(order);
    // About half a turn tells best where the axis is, and is wrong by half a step where the order is.
    let far = f64::from(order / 2) * step;
    let axis = whole.fitted_axis(axis, far)?;
    let between = whole.missed(&axis.rotation(far + 0.5 * step));
    let telling = |angle: f64| whole.missed(&axis.rotation(angle)) <= TELLING * between;
    if between < LEAST || !telling(step) || !telling(far) {
        return None;
    }
    whole.held(&axis.rotation(far), Class::Proper)?;
    let step = whole.held(&axis.rotation(step), Class::Proper)?;
    Some(Turn { axis, order, step })
}

/// What else leaves the axis of a `turn` in its place and holds for the whole: the mirror across it, the turn by half a step with that,
/// the reflection in its middle, a half-turn across it, a mirror along it. All others follow.
pub fn beside(whole: &Whole<'_>, turn: &Turn) -> Vec<Symmetry> {
    let axis = turn.axis;
    let centre = axis.foot(&whole.surroundings.space.centre());
    let across = Isometry::mirror(&Plane::through(&centre, axis.direction));
    let half = PI / f64::from(turn.order);
    let between = axis.rotation(half).after(&across);
    let point = axis.rotation(PI).after(&across);
    let first = any_orthogonal(&axis.direction);
    let around = |angle: f64| axis.rotation(angle).rotate(&first);
    let turned = |angle: f64| half_turn(&centre, around(angle));
    let along = |angle: f64| Isometry::mirror(&Plane::through(&centre, around(angle)));
    let mut found = Vec::new();
    let any = whole.any_missed(&axis, &across).max(LEAST);
    for t in [across, between, point] {
        let nearly = whole.missed(&t) <= NEARLY * any;
        found.extend(nearly.then(|| whole.symmetry(&t)).flatten());
    }
    found.extend(best_around(whole, half, &turned).and_then(|t| whole.symmetry(&t)));
    found.extend(best_around(whole, half, &along).and_then(|t| whole.symmetry(&t)));
    found
}

/// The half-turn about the line through a point.
fn half_turn(centre: &Point, direction: Vector) -> Isometry {
    let axis = Axis {
        point: *centre,
        direction,
    };
    axis.rotation(PI)
}

/// Of isometries around an axis, which come round after an angle of `period`, the one that holds best; `None` where it does not hold
/// clearly better than the worst does.
fn best_around(whole: &Whole<'_>, period: f64, at: &dyn Fn(f64) -> Isometry) -> Option<Isometry> {
    let missed = |angles: &[f64]| {
        let tried: Vec<Isometry> = angles.iter().map(|&angle| at(angle)).collect();
        whole.all_missed(&tried)
    };
    let mut step = period / f64::from(PLACES);
    let angles: Vec<f64> = (0..PLACES).map(|k| f64::from(k) * step).collect();
    let tried: Vec<(f64, f64)> = angles.iter().copied().zip(missed(&angles)).collect();
    let worst = tried.iter().map(|t| t.1).fold(0.0, f64::max);
    let (mut best, mut least) = tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    for _ in 0..STEPS {
        step /= 2.0;
        let beside = [best - step, best + step];
        for (angle, miss) in beside.into_iter().zip(missed(&beside)) {
            if miss < least {
                (best, least) = (angle, miss);
            }
        }
    }
    (worst >= LEAST && least <= TELLING * worst).then(|| at(best))
}
