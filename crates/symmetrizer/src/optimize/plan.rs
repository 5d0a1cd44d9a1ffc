//! What is to be made exact, of all that detection found: groups, rows, copies, slides, and what is in none of them.

use crate::detect::{Detection, Group};
use crate::geom::{Vector, median};
use crate::optimize::orbit::{Goal, Orbit};
use crate::optimize::params::OptimizeParams;
use crate::patch::Symmetry;
use crate::slip::Continuous;
use crate::transform::{Class, Isometry, TransformSpace};

/// Images lie within this many times the median residual of the pairs, at least and at most as far as this, fraction
/// of L: where a symmetry holds well, what lies further away is none of its copies.
const REACH: f64 = 8.0;
const REACHES: [f64; 2] = [0.0015, 0.05];
/// The same of slides, whose residuals are angles.
const SLIDE_REACH: f64 = 0.015;
/// A symmetry in no group holds for this share of the surface, unless it is asked for: two small places of a natural
/// shape that are somewhat alike need not be more so.
const ALONE: f64 = 0.1;
/// A part that slides along itself is at least this share of the surface: the faces of a box do so, too.
const SLIDING: f64 = 0.5;
/// Clearly worse is an rms residual this many times another's, and by this much, fraction of L.
const WORSE: f64 = 1.7;
const SLACK: f64 = 5e-4;
/// Patch and image are one place where this share of the smaller lies in both.
const ONE_PLACE: f64 = 0.7;
/// Powers that are tried for a turn to come round.
const GREATEST_ORDER: usize = 64;
/// A power is the identity where it is this near, rms over the place, fraction of L.
const ROUND: f64 = 0.004;

/// The goals that there are for what `detection` found, those of most of the surface first: all that `params` ask
/// for.
pub fn goals(detection: &Detection, params: &OptimizeParams) -> Vec<Goal> {
    let asked = |ids: &[u32]| {
        let only = params.only.as_ref();
        only.is_none_or(|only| ids.iter().any(|id| only.contains(id)))
    };
    let mut goals: Vec<Goal> = Vec::new();
    if params.only.is_none() {
        let large = detection.continuous.iter();
        let large = large.filter(|c| c.area_fraction >= SLIDING);
        goals.extend(large.map(|c| of_slide(c, detection)));
    }
    let groups = detection.groups.iter();
    goals.extend(
        groups
            .map(|g| of_group(g, detection))
            .filter(|g| asked(&g.symmetries)),
    );
    let grouped: Vec<u32> = goals.iter().flat_map(|g| g.symmetries.clone()).collect();
    let least = if params.only.is_some() { 0.0 } else { ALONE };
    let alone = |s: &&Symmetry| {
        let evident = s.is_evident && s.area_fraction >= least;
        let echo = params.only.is_none() && is_echo(s, detection);
        evident && !echo && !grouped.contains(&s.id) && asked(&[s.id])
    };
    let singles = detection.symmetries.iter().filter(alone);
    goals.extend(singles.filter_map(|s| of_symmetry(s, detection)));
    goals.sort_by(|a, b| b.area_fraction.total_cmp(&a.area_fraction));
    goals.truncate(params.max_symmetries.unwrap_or(usize::MAX));
    goals
}

/// Whether another symmetry holds clearly better for most of what `s` holds for: a plate's mirror that also takes in what stands on it as
/// far as the tolerance is none of its own.
fn is_echo(s: &Symmetry, detection: &Detection) -> bool {
    let count = detection.samples.list.len();
    let own = s.ground(count);
    let size = own.iter().filter(|m| **m).count();
    let better = |k: &&Symmetry| k.id != s.id && s.rms > WORSE * k.rms + SLACK;
    detection.symmetries.iter().filter(better).any(|k| {
        let both = own.iter().zip(k.ground(count));
        2 * both.filter(|(a, b)| **a && *b).count() > size
    })
}

fn of_slide(slide: &Continuous, detection: &Detection) -> Goal {
    let list = &detection.samples.list;
    let axis = slide.axis.unwrap_or_else(Vector::z);
    let heights = slide
        .samples
        .iter()
        .map(|&i| axis.dot(&list[i as usize].position.coords));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    Goal {
        name: slide.slip.name().to_owned(),
        symmetries: Vec::new(),
        orbit: Orbit::Slide(Box::new(slide.clone()), high - low),
        places: vec![slide.samples.clone()],
        area_fraction: slide.area_fraction,
        reach: SLIDE_REACH,
        ambient: detection.samples.ambient,
        is_met: false,
    }
}

fn of_group(group: &Group, detection: &Detection) -> Goal {
    let members: Vec<&Symmetry> = detection
        .symmetries
        .iter()
        .filter(|s| group.symmetries.contains(&s.id))
        .collect();
    let count = detection.samples.list.len();
    let (orbit, places) = match &group.pattern {
        Some(pattern) => (Orbit::Regular(pattern.clone()), group.orbit.clone()),
        None if !group.orbit.is_empty() => {
            let back = group.elements[0].inverse();
            let frames = group.elements.iter().map(|t| t.after(&back));
            (Orbit::Free(frames.collect()), group.orbit.clone())
        }
        None => {
            let others = group.elements.iter().filter(|g| !is_identity(g));
            let ground = together(members.iter().map(|s| s.ground(count)), count);
            (Orbit::Group(others.copied().collect()), vec![ground])
        }
    };
    Goal {
        name: group.name.clone(),
        symmetries: group.symmetries.clone(),
        orbit,
        area_fraction: share(&places, count),
        places,
        reach: reach(&members),
        ambient: detection.samples.ambient,
        is_met: false,
    }
}

/// A symmetry that is in no group: the group that it generates where it keeps its place, else two copies.
fn of_symmetry(s: &Symmetry, detection: &Detection) -> Option<Goal> {
    let count = detection.samples.list.len();
    let patch: Vec<u32> = s.pairs.iter().map(|p| p.sample).collect();
    let (orbit, places) = if s.class == Class::Mirror {
        (
            Orbit::Group(vec![Isometry::mirror(&s.plane())]),
            vec![patch],
        )
    } else if keeps_its_place(s) {
        let ground = together(std::iter::once(s.ground(count)), count);
        (Orbit::Group(powers(s, detection)?), vec![ground])
    } else {
        let frames = vec![Isometry::identity(), s.q_from_p];
        (Orbit::Free(frames), vec![patch, s.image.clone()])
    };
    Some(Goal {
        name: format!("symmetry {}", s.id),
        symmetries: vec![s.id],
        orbit,
        area_fraction: share(&places, count),
        places,
        reach: reach(&[s]),
        ambient: detection.samples.ambient,
        is_met: false,
    })
}

/// The powers of a symmetry up to the last before the identity, exactly; none where there is no such.
fn powers(s: &Symmetry, detection: &Detection) -> Option<Vec<Isometry>> {
    let list = &detection.samples.list;
    let support = s
        .pairs
        .iter()
        .map(|p| (list[p.sample as usize].position, 1.0));
    let space = TransformSpace::new(support);
    let kind = s.q_from_p.snapped(&space, ROUND).0;
    let mut elements = s.q_from_p.nearest(kind, &space)?.elements(&space, ROUND);
    if let Some(order) = elements.order {
        // The angle exactly.
        let whole = std::f64::consts::TAU / f64::from(order);
        elements.angle = (elements.angle / whole).round() * whole;
    }
    let step = elements.isometry();
    let mut powers = vec![step];
    while powers.len() < GREATEST_ORDER {
        let next = step.after(&powers[powers.len() - 1]);
        if is_identity(&next) {
            return Some(powers);
        }
        powers.push(next);
    }
    None
}

fn is_identity(t: &Isometry) -> bool {
    let linear = (t.linear - nalgebra::Matrix3::identity()).norm();
    linear < 1e-6 && t.translation.norm() < 1e-6
}

/// Whether patch and image are about the same samples.
fn keeps_its_place(s: &Symmetry) -> bool {
    let patch = |i: &&u32| s.pairs.binary_search_by_key(*i, |p| p.sample).is_ok();
    let both = s.image.iter().filter(patch).count();
    let smaller = s.image.len().min(s.pairs.len()).max(1);
    both as f64 >= ONE_PLACE * smaller as f64
}

/// The samples that any of the sets has.
fn together(sets: impl Iterator<Item = Vec<bool>>, count: usize) -> Vec<u32> {
    let mut any = vec![false; count];
    for set in sets {
        any.iter_mut().zip(set).for_each(|(a, s)| *a |= s);
    }
    (0..count as u32).filter(|&i| any[i as usize]).collect()
}

/// All places as a share of the surface: samples stand for the same area each.
fn share(places: &[Vec<u32>], count: usize) -> f64 {
    let mut any = vec![false; count];
    for &i in places.iter().flatten() {
        any[i as usize] = true;
    }
    any.iter().filter(|a| **a).count() as f64 / count.max(1) as f64
}

fn reach(members: &[&Symmetry]) -> f64 {
    let residuals = |s: &&Symmetry| {
        let mut all: Vec<f64> = s.pairs.iter().map(|p| p.residual).collect();
        median(&mut all).unwrap_or(0.0)
    };
    let typical = members.iter().map(residuals).fold(0.0, f64::max);
    (REACH * typical).clamp(REACHES[0], REACHES[1])
}
