//! Point groups: symmetries of one ground that leave a point of it in its place.

use crate::detect::arrange::{MIN_ORDER, SAME_GROUND, TOLERANCE, is_closed, likeness};
use crate::detect::groups::Group;
use crate::detect::surroundings::Surroundings;
use crate::geom::Ambient;
use crate::group::{Name, Within, fixed_together, point_group};
use crate::patch::Symmetry;
use crate::transform::{Isometry, TransformSpace};

/// The point groups, those of most of the surface first.
pub fn point_groups(
    surroundings: &Surroundings<'_>,
    symmetries: &[Symmetry],
    grounds: &[Vec<bool>],
    used: &mut [bool],
) -> Vec<Group> {
    let size = |k: usize| grounds[k].iter().filter(|m| **m).count();
    let mut order: Vec<usize> = (0..symmetries.len()).collect();
    order.retain(|&k| is_closed(&symmetries[k], surroundings));
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
            .filter(|&k| !seen[k] && symmetries[k].is_of_whole == symmetries[first].is_of_whole)
            .filter(|&k| likeness(&grounds[first], &grounds[k]) > SAME_GROUND)
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
            name: named(group.name, surroundings.ground.samples.ambient),
            order: group.elements.len(),
            axis: group.axis,
            point: group.centre,
            step: None,
            pattern: None,
            elements: group.elements,
            symmetries: members.iter().map(|&k| symmetries[k].id).collect(),
            orbit: Vec::new(),
        });
    }
    groups
}

/// The name of a group: in the plane D is that of turns with as many lines.
fn named(name: Name, ambient: Ambient) -> String {
    match (name, ambient) {
        (Name::Cv(n), Ambient::Plane) => Name::D(n).to_string(),
        _ => name.to_string(),
    }
}
