//! What kind of symmetry each of those found is: a rotation, a glide, ...

use crate::detect::{Detection, Wanted};
use crate::patch::Symmetry;
use crate::sample::Samples;
use crate::transform::{Class, Elements, Kind, TransformSpace};

/// The least distance, rms over the patch in fractions of L, at which a simpler kind is another one.
/// On shapes of known symmetry the right kind is at most 0.001 away, the next simpler one 0.007 or more.
const SAME: f64 = 0.002;

/// The least error of an isometry, rms over the patch in fractions of L, in telling its order; on
/// exact copies it is 0.0001 to 0.0003.
const ERROR: f64 = 0.0005;

/// An order n is told where the angles k/n of a turn, k coprime to a number up to n, lie so far
/// apart that no more than about this share of all angles has one within the error.
const BY_CHANCE: f64 = 0.25;

/// The kind of `symmetry`, one of `samples`, and its elements in working coordinates.
///
/// It is the simplest kind with a member that moves the patch by no more than the rms by which the
/// symmetry misses the surface: that member fits as well.
pub fn elements(symmetry: &Symmetry, samples: &Samples) -> Elements {
    let place = |sample: u32| samples.list[sample as usize].position;
    let patch = symmetry.pairs.iter().map(|p| (place(p.sample), 1.0));
    let space = TransformSpace::new(patch);
    if symmetry.class == Class::Mirror {
        return Elements::exactly(Kind::Mirror, &symmetry.q_from_p, &space);
    }
    let (_, snapped) = symmetry.q_from_p.snapped(&space, symmetry.rms.max(SAME));
    let count = symmetry.pairs.len().max(1) as f64;
    let error = (3.0 * symmetry.rms / count.sqrt()).clamp(ERROR, SAME);
    let found = snapped.elements(&space, error);
    Elements {
        order: found
            .order
            .filter(|&n| is_telling(n, &found, &space, error)),
        ..found
    }
}

/// Whether an angle within `error` of one of order `n` is hardly so by chance.
fn is_telling(n: u32, found: &Elements, space: &TransformSpace, error: f64) -> bool {
    let Some(axis) = found.axis else {
        return false;
    };
    // What tells the angle is the patch's own extent, not its distance from the axis.
    let radius = space.radius_about(&space.centre(), &axis);
    let turns = error / (radius * std::f64::consts::TAU);
    n <= 2 || turns * f64::from(n * n) <= BY_CHANCE
}

/// Drops what was found beside what is `wanted`: a cloud has several kinds.
pub fn keep_wanted(found: &mut Detection, wanted: &Wanted) {
    let samples = &found.samples;
    found
        .symmetries
        .retain(|s| wanted.has(elements(s, samples).kind));
    let left: Vec<u32> = found.symmetries.iter().map(|s| s.id).collect();
    for group in &mut found.groups {
        group.symmetries.retain(|id| left.contains(id));
    }
    found.groups.retain(|g| !g.symmetries.is_empty());
    if !wanted.continuous() {
        found.continuous.clear();
    }
}
