//! Rows and grids: motions that are powers of one or two steps.

use crate::detect::arrange::{MIN_ORDER, TOLERANCE, is_closed};
use crate::detect::groups::Group;
use crate::detect::surroundings::Surroundings;
use crate::geom::{Point, PointIndex, Vector};
use crate::group::{Within, patterns};
use crate::patch::Symmetry;
use crate::patch::ground::touch_one;
use crate::transform::Isometry;

/// Rows and grids of the motions that are in no group.
pub fn rows(
    surroundings: &Surroundings<'_>,
    symmetries: &[Symmetry],
    used: &mut [bool],
) -> Vec<Group> {
    let samples = surroundings.ground.samples;
    let count = samples.list.len();
    let open: Vec<usize> = (0..symmetries.len())
        .filter(|&k| !used[k] && !is_closed(&symmetries[k], surroundings))
        .collect();
    let within = Within {
        space: surroundings.space,
        tolerance: TOLERANCE,
    };
    let generators: Vec<Isometry> = open.iter().map(|&k| symmetries[k].q_from_p).collect();
    // A motion holds from a row's first copy on when it is known with a patch that has that copy.
    let mut known = |t: &Isometry| {
        let both = generators.iter().flat_map(|k| [*k, k.inverse()]);
        both.map(|k| (within.space.distance(&k, t), k))
            .filter(|(d, _)| *d < TOLERANCE)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, k)| k)
    };
    let mut groups = Vec::new();
    for pattern in patterns(&generators, within, &mut known) {
        let (steps, elements) = (pattern.steps(), pattern.elements());
        let order = elements.len();
        if order < MIN_ORDER {
            continue;
        }
        let is_element = |t: &Isometry| {
            let near = |g: &Isometry| within.space.distance(g, t) < TOLERANCE;
            elements.iter().any(|g| near(g) || near(&g.inverse()))
        };
        let members: Vec<usize> = open
            .iter()
            .copied()
            .filter(|&k| is_element(&symmetries[k].q_from_p))
            .collect();
        let first = first_copy(&members, symmetries, &steps[0], surroundings, count);
        if !elements.iter().all(|t| is_there(&first, t, surroundings)) {
            continue;
        }
        for &k in &members {
            used[k] = true;
        }
        groups.push(Group {
            name: pattern.to_string(),
            order,
            axis: None,
            point: middle(&first, surroundings),
            step: Some(steps[0]),
            orbit: elements
                .iter()
                .map(|t| carried(&first, t, surroundings))
                .collect(),
            elements,
            symmetries: members.iter().map(|&k| symmetries[k].id).collect(),
            pattern: Some(pattern),
        });
    }
    groups
}

/// The samples of a row's first copy: those that the step carries on and nothing is carried to.
fn first_copy(
    members: &[usize],
    symmetries: &[Symmetry],
    step: &Isometry,
    surroundings: &Surroundings<'_>,
    count: usize,
) -> Vec<u32> {
    let space = surroundings.space;
    let mut starts = vec![false; count];
    let mut ends = vec![false; count];
    for &k in members {
        let s = &symmetries[k];
        let forwards =
            space.distance(&s.q_from_p, step) < space.distance(&s.q_from_p.inverse(), step);
        let image = s.image.iter().copied();
        let patch = s.pairs.iter().map(|p| p.sample);
        let (from, to): (Vec<u32>, Vec<u32>) = if forwards {
            (patch.collect(), image.collect())
        } else {
            (image.collect(), patch.collect())
        };
        from.iter().for_each(|&i| starts[i as usize] = true);
        to.iter().for_each(|&i| ends[i as usize] = true);
    }
    (0..count as u32)
        .filter(|&i| starts[i as usize] && !ends[i as usize])
        .collect()
}

/// Share of the first copy that every other one has at the least.
const COPIED: f64 = 0.8;

/// Whether `t` carries most of the first `copy` onto the surface: steps that hold between other copies may lead from this one to where there is
/// none.
fn is_there(copy: &[u32], t: &Isometry, surroundings: &Surroundings<'_>) -> bool {
    let patch = &surroundings.params.patch;
    let near = |s: &&u32| {
        let ground = surroundings.ground;
        touch_one(ground, t, **s, patch.copy_tolerance, patch.min_cos, None).is_some()
    };
    copy.iter().filter(near).count() as f64 >= COPIED * copy.len() as f64
}

fn middle(samples: &[u32], surroundings: &Surroundings<'_>) -> Point {
    let list = &surroundings.ground.samples.list;
    let sum: Vector = samples
        .iter()
        .map(|&i| list[i as usize].position.coords)
        .sum();
    Point::from(sum / samples.len().max(1) as f64)
}

/// The samples where `t` carries those of `copy`.
fn carried(copy: &[u32], t: &Isometry, surroundings: &Surroundings<'_>) -> Vec<u32> {
    let samples = surroundings.ground.samples;
    let places: Vec<[f64; 3]> = copy
        .iter()
        .map(|&i| t.apply(&samples.list[i as usize].position).coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let near = |i: &u32| {
        let x = samples.list[*i as usize].position;
        let hit = index.nearest(&x.coords.into());
        hit.is_some_and(|(_, d2)| d2 < samples.spacing * samples.spacing)
    };
    (0..samples.list.len() as u32).filter(near).collect()
}
