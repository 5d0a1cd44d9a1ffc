//! Copies of one element in free positions.

use std::collections::BTreeMap;

use crate::detect::arrange::{MIN_ORDER, is_closed, likeness};
use crate::detect::groups::Group;
use crate::geom::Point;
use crate::patch::Symmetry;
use crate::transform::Isometry;

/// Two places of copies are one when this share of both together lies in both.
const SAME_COPY: f64 = 0.5;

/// Copies of one element in free positions: places that motions carry onto each other.
pub fn copies(symmetries: &[Symmetry], count: usize, used: &[bool]) -> Vec<Group> {
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
        pattern: None,
        elements: members.values().map(along).collect(),
        symmetries: links
            .iter()
            .filter(|(a, _, _)| members.contains_key(a))
            .map(|&(.., k)| symmetries[k].id)
            .collect(),
        orbit: members.keys().map(samples).collect(),
    }
}
