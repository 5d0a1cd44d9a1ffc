//! Which vertices lie in which places of which goals.

use rayon::prelude::*;

use crate::geom::PointIndex;
use crate::optimize::orbit::goal::Goal;
use crate::sample::Samples;
use crate::shape::Surface;

/// A vertex's membership in a place.
#[derive(Debug, Clone, Copy)]
pub struct Member {
    /// The goal's index.
    pub goal: usize,
    /// The place's.
    pub place: usize,
    /// 1 well inside, falling to 0 at its rim.
    pub weight: f64,
}

/// For each of `count` samples the places that it is in.
pub fn members_of_samples(count: usize, goals: &[Goal]) -> Vec<Vec<Member>> {
    let mut members = vec![Vec::new(); count];
    for (goal, g) in goals.iter().enumerate() {
        for (place, samples) in g.places.iter().enumerate() {
            for &i in samples {
                members[i as usize].push(Member {
                    goal,
                    place,
                    weight: 1.0,
                });
            }
        }
    }
    members
}

/// For each vertex of `surface` the places that it is in: as far as the samples around it are, those that lie on
/// the same side of the surface. On a goal of the whole it is in all places that any sample near it is in.
pub fn members(surface: &Surface, samples: &Samples, goals: &[Goal]) -> Vec<Vec<Member>> {
    let places: Vec<[f64; 3]> = samples
        .list
        .iter()
        .map(|s| s.position.coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let inside: Vec<Vec<Vec<bool>>> = goals
        .iter()
        .map(|goal| {
            let flags = |place: &Vec<u32>| {
                let mut flags = vec![false; samples.list.len()];
                place.iter().for_each(|&i| flags[i as usize] = true);
                flags
            };
            goal.places.iter().map(flags).collect()
        })
        .collect();
    (0..surface.positions.len())
        .into_par_iter()
        .map(|v| {
            let near = around(surface, samples, &index, v);
            let mut members = Vec::new();
            for (goal, flags) in inside.iter().enumerate() {
                for (place, flags) in flags.iter().enumerate() {
                    let of: f64 = near.iter().filter(|(i, _)| flags[*i]).map(|n| n.1).sum();
                    let whole = goals[goal].is_of_the_whole() && goals[goal].places.len() == 1;
                    // Half of the samples around a vertex at the rim are inside; what copies stand on differs there.
                    let weight = if whole {
                        1.0
                    } else {
                        (2.0 * of - 1.0).max(0.0)
                    };
                    if weight > 1e-3 {
                        members.push(Member {
                            goal,
                            place,
                            weight,
                        });
                    }
                }
            }
            members
        })
        .collect()
}

/// The samples around a vertex, their weights with sum 1.
fn around(
    surface: &Surface,
    samples: &Samples,
    index: &PointIndex<3>,
    v: usize,
) -> Vec<(usize, f64)> {
    let (x, n) = (surface.positions[v], surface.vertex_normals[v]);
    let radius = 1.5 * samples.spacing;
    let facing = |i: &u32| samples.list[*i as usize].normal.dot(&n) > 0.0;
    let mut near: Vec<u32> = index.within(&x.coords.into(), radius);
    near.retain(facing);
    if near.is_empty() {
        near.extend(index.nearest(&x.coords.into()).map(|hit| hit.0));
    }
    let weight = |i: &u32| {
        let d = (samples.list[*i as usize].position - x).norm() / radius;
        (1.0 - d * d).max(1e-6)
    };
    let total: f64 = near.iter().map(weight).sum();
    near.iter()
        .map(|i| (*i as usize, weight(i) / total))
        .collect()
}
