//! Copies of one element in free positions.

use std::collections::BTreeMap;

use crate::detect::arrange::{MIN_ORDER, SAME_GROUND, is_closed, likeness};
use crate::detect::groups::Group;
use crate::detect::surroundings::Surroundings;
use crate::geom::Point;
use crate::patch::Symmetry;
use crate::transform::Isometry;

/// Two places of copies are one when this share of both together lies in both.
const SAME_COPY: f64 = 0.5;

/// A smaller set of which more than this share lies in a place is a piece of that.
const PIECE: f64 = 0.7;

/// Copies of one element in free positions: places that motions carry onto each other.
pub fn copies(
    surroundings: &Surroundings<'_>,
    symmetries: &[Symmetry],
    used: &[bool],
) -> Vec<Group> {
    let count = surroundings.ground.samples.list.len();
    let tolerance = surroundings.params.patch.copy_tolerance;
    let quality = |k: &usize| {
        let s = &symmetries[*k];
        s.area_fraction * (1.0 - s.rms / tolerance)
    };
    let mut ordered: Vec<usize> = (0..symmetries.len()).collect();
    ordered.retain(|&k| !used[k] && !is_closed(&symmetries[k], surroundings));
    ordered.sort_by(|a, b| quality(b).total_cmp(&quality(a)));
    let mut places: Vec<Vec<bool>> = Vec::new();
    // Of the sets that are clearly one place most have a sample of it.
    let mut votes: Vec<Vec<i32>> = Vec::new();
    let mut links: Vec<Link> = Vec::new();
    for k in ordered {
        let s = &symmetries[k];
        let mut image = vec![false; count];
        for &i in &s.image {
            image[i as usize] = true;
        }
        let patch = s.membership(count);
        if likeness(&patch, &image) > 0.2 {
            continue;
        }
        let sets = [patch, image];
        if sets.iter().any(|set| is_piece(set, &places)) {
            continue;
        }
        let ends = sets.map(|set| {
            let known = places.iter().position(|p| likeness(p, &set) > SAME_COPY);
            let place = known.unwrap_or_else(|| {
                places.push(set.clone());
                votes.push(vec![0; count]);
                places.len() - 1
            });
            if likeness(&places[place], &set) > SAME_GROUND {
                let inside = votes[place].iter_mut().zip(&set);
                inside.for_each(|(votes, s)| *votes += if *s { 1 } else { -1 });
            }
            place
        });
        links.push((ends[0], ends[1], k));
    }
    let places: Vec<Vec<bool>> = votes
        .iter()
        .map(|votes| votes.iter().map(|v| *v > 0).collect())
        .collect();
    let mut groups: Vec<Group> = connected(places.len(), &links)
        .into_iter()
        .filter(|members| members.len() >= MIN_ORDER)
        .map(|members| copies_of(&members, &places, &links, symmetries))
        .collect();
    groups.sort_by_key(|g| std::cmp::Reverse(g.orbit.iter().map(Vec::len).sum::<usize>()));
    groups
}

/// Whether a set of samples is a piece of one of the `places`, and not that itself.
fn is_piece(set: &[bool], places: &[Vec<bool>]) -> bool {
    let count = set.iter().filter(|s| **s).count();
    let of = |place: &Vec<bool>| {
        let inside = set.iter().zip(place).filter(|(s, p)| **s && **p).count();
        inside as f64 > PIECE * count as f64 && likeness(place, set) <= SAME_COPY
    };
    places.iter().any(of)
}

/// That a symmetry, the third, carries one place to another.
type Link = (usize, usize, usize);

/// The sets of places that `links` connect, each with the way there from the set's first place: for each place the symmetries,
/// forwards or backwards, that lead to it. Of all ways those over the best links are taken, which come first among them (Prim):
/// by a piece of an element others may look like it.
fn connected(count: usize, links: &[Link]) -> Vec<BTreeMap<usize, Vec<(usize, bool)>>> {
    let ways = || {
        let ways = |&(a, b, k): &Link| [(a, b, k, true), (b, a, k, false)];
        links.iter().flat_map(ways)
    };
    let mut sets: Vec<BTreeMap<usize, Vec<(usize, bool)>>> = Vec::new();
    for first in 0..count {
        if sets.iter().any(|paths| paths.contains_key(&first)) {
            continue;
        }
        let mut paths = BTreeMap::from([(first, Vec::new())]);
        while let Some((from, to, k, forwards)) =
            ways().find(|(from, to, ..)| paths.contains_key(from) && !paths.contains_key(to))
        {
            let mut path: Vec<(usize, bool)> = paths[&from].clone();
            path.push((k, forwards));
            paths.insert(to, path);
        }
        sets.push(paths);
    }
    sets
}

fn copies_of(
    members: &BTreeMap<usize, Vec<(usize, bool)>>,
    places: &[Vec<bool>],
    links: &[Link],
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
