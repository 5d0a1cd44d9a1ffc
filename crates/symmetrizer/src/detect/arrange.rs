//! Which symmetries belong together: point groups, rows and grids, copies of one element.

use std::collections::BTreeMap;

use crate::detect::groups::Group;
use crate::detect::surroundings::Surroundings;
use crate::geom::{Point, PointIndex, Vector};
use crate::group::{Pattern, Within, fixed_together, patterns, point_group};
use crate::patch::Symmetry;
use crate::transform::{Class, Isometry, TransformSpace};

/// Isometries that count as one, rms displacement over the ground they share, fraction of L.
const TOLERANCE: f64 = 0.02;
/// Two grounds are one when this share of both together lies in both.
const SAME_GROUND: f64 = 0.7;
/// Two places of copies are one when this share of both together lies in both.
const SAME_COPY: f64 = 0.5;
/// A group is worth the name from this order on.
const MIN_ORDER: usize = 3;

/// The groups of `symmetries`, those of most of the surface first.
pub fn arrange(surroundings: &Surroundings<'_>, symmetries: &[Symmetry]) -> Vec<Group> {
    let count = surroundings.ground.samples.list.len();
    let grounds: Vec<Vec<bool>> = symmetries.iter().map(|s| s.ground(count)).collect();
    let mut used = vec![false; symmetries.len()];
    let mut groups = point_groups(surroundings, symmetries, &grounds, &mut used);
    groups.extend(rows(surroundings, symmetries, &mut used));
    groups.extend(copies(symmetries, count, &used));
    groups
}

/// The share of both sets together that lies in both.
fn likeness(a: &[bool], b: &[bool]) -> f64 {
    let (mut both, mut any) = (0, 0);
    for (a, b) in a.iter().zip(b) {
        both += usize::from(*a && *b);
        any += usize::from(*a || *b);
    }
    both as f64 / any.max(1) as f64
}

/// Whether patch and image are one and the same ground.
fn is_closed(s: &Symmetry, count: usize) -> bool {
    let mut image = vec![false; count];
    for &i in &s.image {
        image[i as usize] = true;
    }
    s.class == Class::Mirror || likeness(&s.membership(count), &image) > SAME_GROUND
}

fn point_groups(
    surroundings: &Surroundings<'_>,
    symmetries: &[Symmetry],
    grounds: &[Vec<bool>],
    used: &mut [bool],
) -> Vec<Group> {
    let count = surroundings.ground.samples.list.len();
    let size = |k: usize| grounds[k].iter().filter(|m| **m).count();
    let mut order: Vec<usize> = (0..symmetries.len()).collect();
    order.retain(|&k| is_closed(&symmetries[k], count));
    order.sort_by_key(|&k| std::cmp::Reverse(size(k)));
    let mut groups = Vec::new();
    let mut seen = vec![false; symmetries.len()];
    for &first in &order {
        if seen[first] {
            continue;
        }
        let here: Vec<usize> = order
            .iter()
            .copied()
            .filter(|&k| !seen[k] && likeness(&grounds[first], &grounds[k]) > SAME_GROUND)
            .collect();
        for &k in &here {
            seen[k] = true;
        }
        groups.extend(groups_on(
            surroundings,
            symmetries,
            &grounds[first],
            &here,
            used,
        ));
    }
    groups
}

/// The point groups of symmetries that share one ground.
fn groups_on(
    surroundings: &Surroundings<'_>,
    symmetries: &[Symmetry],
    ground: &[bool],
    here: &[usize],
    used: &mut [bool],
) -> Vec<Group> {
    let list = &surroundings.ground.samples.list;
    let support = list.iter().zip(ground).filter(|(_, m)| **m);
    let space = TransformSpace::new(support.map(|(s, _)| (s.position, 1.0)));
    let within = Within {
        space: &space,
        tolerance: TOLERANCE,
    };
    let isometries: Vec<Isometry> = here.iter().map(|&k| symmetries[k].q_from_p).collect();
    let mut groups = Vec::new();
    for set in fixed_together(&isometries, within) {
        let generators: Vec<Isometry> = set.iter().map(|&i| isometries[i]).collect();
        let mut known = |t: &Isometry| {
            let both = isometries.iter().flat_map(|k| [*k, k.inverse()]);
            both.map(|k| (space.distance(&k, t), k))
                .filter(|(d, _)| *d < TOLERANCE)
                .min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, k)| k)
        };
        let Some(group) = point_group(&generators, within, &mut known) else {
            continue;
        };
        if group.elements.len() < MIN_ORDER {
            continue;
        }
        let members: Vec<usize> = here
            .iter()
            .copied()
            .filter(|&k| {
                let t = &symmetries[k].q_from_p;
                group
                    .elements
                    .iter()
                    .any(|g| space.distance(g, t) < TOLERANCE)
            })
            .collect();
        for &k in &members {
            used[k] = true;
        }
        groups.push(Group {
            name: group.name.to_string(),
            order: group.elements.len(),
            axis: group.axis,
            point: group.centre,
            step: None,
            elements: group.elements,
            symmetries: members.iter().map(|&k| symmetries[k].id).collect(),
            orbit: Vec::new(),
        });
    }
    groups
}

/// Rows and grids of the motions that are in no group.
fn rows(surroundings: &Surroundings<'_>, symmetries: &[Symmetry], used: &mut [bool]) -> Vec<Group> {
    let samples = surroundings.ground.samples;
    let count = samples.list.len();
    let open: Vec<usize> = (0..symmetries.len())
        .filter(|&k| !used[k] && !is_closed(&symmetries[k], count))
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
        let (steps, elements, order) = powers(&pattern);
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
        for &k in &members {
            used[k] = true;
        }
        let first = first_copy(&members, symmetries, &steps[0], surroundings, count);
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
        });
    }
    groups
}

/// The steps of a pattern, the motions from its first copy to each, and the number of copies.
fn powers(pattern: &Pattern) -> (Vec<Isometry>, Vec<Isometry>, usize) {
    let powers = |t: &Isometry, n: usize| {
        let mut all = vec![Isometry::identity()];
        for k in 1..n {
            all.push(t.after(&all[k - 1]));
        }
        all
    };
    match pattern {
        Pattern::Row(row) => (vec![row.step], powers(&row.step, row.count), row.count),
        Pattern::Grid(grid) => {
            let [a, b] = [0, 1].map(|i| powers(&grid.steps[i], grid.counts[i]));
            let all = b.iter().flat_map(|y| a.iter().map(move |x| y.after(x)));
            (
                grid.steps.to_vec(),
                all.collect(),
                grid.counts[0] * grid.counts[1],
            )
        }
    }
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

/// Copies of one element in free positions: places that motions carry onto each other.
fn copies(symmetries: &[Symmetry], count: usize, used: &[bool]) -> Vec<Group> {
    let mut places: Vec<Vec<bool>> = Vec::new();
    let mut links: Vec<(usize, usize, usize)> = Vec::new();
    for (k, s) in symmetries.iter().enumerate() {
        if used[k] || is_closed(s, count) {
            continue;
        }
        let mut image = vec![false; count];
        for &i in &s.image {
            image[i as usize] = true;
        }
        let patch = s.membership(count);
        if likeness(&patch, &image) > 0.2 {
            continue;
        }
        let ends = [patch, image].map(|set| {
            let known = places.iter().position(|p| likeness(p, &set) > SAME_COPY);
            known.unwrap_or_else(|| {
                places.push(set);
                places.len() - 1
            })
        });
        links.push((ends[0], ends[1], k));
    }
    let mut groups: Vec<Group> = connected(places.len(), &links)
        .into_iter()
        .filter(|members| members.len() >= MIN_ORDER)
        .map(|members| copies_of(&members, &places, &links, symmetries))
        .collect();
    groups.sort_by_key(|g| std::cmp::Reverse(g.orbit.iter().map(Vec::len).sum::<usize>()));
    groups
}

/// The sets of places that links connect, each with its motion from the set's first place.
fn connected(
    count: usize,
    links: &[(usize, usize, usize)],
) -> Vec<BTreeMap<usize, Vec<(usize, bool)>>> {
    let mut sets = Vec::new();
    let mut seen = vec![false; count];
    for first in 0..count {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        // For each place the symmetries, forwards or backwards, that lead to it.
        let mut paths = BTreeMap::from([(first, Vec::new())]);
        let mut front = vec![first];
        while let Some(place) = front.pop() {
            for &(a, b, k) in links {
                for (from, to, forwards) in [(a, b, true), (b, a, false)] {
                    if from == place && !seen[to] {
                        seen[to] = true;
                        let mut path: Vec<(usize, bool)> = paths[&place].clone();
                        path.push((k, forwards));
                        paths.insert(to, path);
                        front.push(to);
                    }
                }
            }
        }
        sets.push(paths);
    }
    sets
}

fn copies_of(
    members: &BTreeMap<usize, Vec<(usize, bool)>>,
    places: &[Vec<bool>],
    links: &[(usize, usize, usize)],
    symmetries: &[Symmetry],
) -> Group {
    let along = |path: &Vec<(usize, bool)>| {
        path.iter().fold(Isometry::identity(), |t, &(k, forwards)| {
            let s = &symmetries[k].q_from_p;
            if forwards {
                s.after(&t)
            } else {
                s.inverse().after(&t)
            }
        })
    };
    let samples = |p: &usize| {
        let place = places[*p].iter().zip(0..);
        place.filter(|(m, _)| **m).map(|(_, i)| i).collect()
    };
    Group {
        name: format!("{} copies", members.len()),
        order: members.len(),
        axis: None,
        point: Point::origin(),
        step: None,
        elements: members.values().map(along).collect(),
        symmetries: links
            .iter()
            .filter(|(a, _, _)| members.contains_key(a))
            .map(|&(.., k)| symmetries[k].id)
            .collect(),
        orbit: members.keys().map(samples).collect(),
    }
}
