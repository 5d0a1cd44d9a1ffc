//! Symmetries of the whole: turns of any order about the axes that a shape suggests, what else leaves such an axis in its
//! place, and all that follows from these and from whole mirrors (`docs/decisions/0034-symmetries-of-the-whole.md`).
//!
//! Votes find them badly where much of the surface slides along itself, as the disc of a ratchet does, and a single motion is
//! believed only where it holds as well as a copy does by chance. What holds for the whole of a shape and comes round may hold
//! as roughly as a mirror.

mod about;
mod axes;
mod holds;

use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::surroundings::{Surroundings, is_same};
use crate::error::Result;
use crate::group::{PointGroup, Within, fixed_together, point_group};
use crate::patch::Symmetry;
use crate::transform::{Isometry, Kind};
use holds::Whole;

/// Isometries that count as one, rms displacement over the surface, fraction of L.
const TOLERANCE: f64 = 0.02;
/// A product may hold worse than the worst of what it is made of by this factor: two errors add up.
const PRODUCT: f64 = 2.0;
/// What holds for the whole may hold worse than the best of the others that do by this factor and by this much, fraction of L, and
/// for less of the surface by this share: where a box is exact what a cube would have besides is none of its symmetries.
const WORSE: f64 = 2.5;
const SLACK: f64 = 5e-4;
const LESS: f64 = 0.05;

/// Adds to `symmetries` those of the whole surface that are not among them; `clouds` are the votes.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn whole(
    surroundings: &Surroundings<'_>,
    clouds: &[Cloud],
    symmetries: &mut Vec<Symmetry>,
    ctx: &mut Context<'_>,
) -> Result<()> {
    if !surroundings.params.wanted.has(Kind::Rotation) {
        return Ok(());
    }
    let whole = Whole::new(surroundings, clouds);
    close(&whole, symmetries);
    for axis in axes::suggested(surroundings, symmetries) {
        ctx.progress(0.0)?;
        let Some(turn) = about::turn(&whole, &axis) else {
            continue;
        };
        let beside = about::beside(&whole, &turn);
        let mut found = vec![turn.step];
        found.extend(beside);
        let best = Best::of(symmetries.iter().chain(&found));
        found.retain(|s| best.has(s));
        let before = symmetries.len();
        for s in found {
            add(s, symmetries, surroundings);
        }
        if symmetries.len() > before {
            close(&whole, symmetries);
        }
    }
    Ok(())
}

/// How well the best of the whole's symmetries holds, and for how much.
struct Best {
    rms: f64,
    area_fraction: f64,
}

impl Best {
    fn of<'a>(symmetries: impl Iterator<Item = &'a Symmetry>) -> Self {
        let none = Self {
            rms: f64::INFINITY,
            area_fraction: 0.0,
        };
        let wholes = symmetries.filter(|k| holds::is_whole(k));
        wholes.fold(none, |best, k| Self {
            rms: best.rms.min(k.rms),
            area_fraction: best.area_fraction.max(k.area_fraction),
        })
    }

    /// Whether `s` holds about as well.
    fn has(&self, s: &Symmetry) -> bool {
        let well = s.rms <= WORSE * self.rms + SLACK;
        holds::is_whole(s) && well && s.area_fraction >= self.area_fraction - LESS
    }
}

/// Adds what follows from the symmetries of the whole that leave one point in its place.
fn close(whole: &Whole<'_>, symmetries: &mut Vec<Symmetry>) {
    let within = Within {
        space: whole.surroundings.space,
        tolerance: TOLERANCE,
    };
    let best = Best::of(symmetries.iter());
    let wholes: Vec<Symmetry> = symmetries.iter().filter(|s| best.has(s)).cloned().collect();
    let isometries: Vec<Isometry> = wholes.iter().map(|s| s.q_from_p).collect();
    for set in fixed_together(&isometries, within) {
        let of_set = || set.iter().map(|&i| &wholes[i]);
        let worst = of_set().map(|s| s.rms).fold(0.0, f64::max);
        let mut made: Vec<Symmetry> = Vec::new();
        let mut verify = |t: &Isometry| {
            let known = isometries
                .iter()
                .chain(made.iter().map(|s| &s.q_from_p))
                .flat_map(|k| [*k, k.inverse()])
                .map(|k| (within.space.distance(&k, t), k))
                .filter(|(d, _)| *d < TOLERANCE)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, k)| k);
            if known.is_some() {
                return known;
            }
            let s = whole.symmetry(t)?;
            let holds = s.rms <= PRODUCT * worst + SLACK;
            let t = s.q_from_p;
            holds.then(|| made.push(s)).map(|()| t)
        };
        let generators: Vec<Isometry> = of_set().map(|s| s.q_from_p).collect();
        let group = point_group(&generators, within, &mut verify);
        let belongs = |s: &Symmetry| group.as_ref().is_some_and(|g| has(g, s, within));
        for s in made.into_iter().filter(belongs) {
            add(s, symmetries, whole.surroundings);
        }
    }
}

/// Whether a group has `s`.
fn has(group: &PointGroup, s: &Symmetry, within: Within<'_>) -> bool {
    let near = |g: &Isometry| within.space.distance(g, &s.q_from_p) < within.tolerance;
    group.elements.iter().any(near)
}

/// Adds `s` where neither it nor its inverse is there.
fn add(s: Symmetry, symmetries: &mut Vec<Symmetry>, surroundings: &Surroundings<'_>) {
    let params = surroundings.params;
    let near = 0.5 * params.cluster.bandwidth;
    let known = |k: &Symmetry| holds::is_whole(k) && is_same(k, &s, surroundings.space, near);
    let wanted = params.wanted.classes().contains(&s.class);
    if wanted && !symmetries.iter().any(known) {
        symmetries.push(s);
    }
}
