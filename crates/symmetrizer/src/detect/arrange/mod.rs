//! Which symmetries belong together: point groups, rows and grids, copies of one element.

mod copies;
mod points;
mod rows;

use crate::detect::groups::Group;
use crate::detect::surroundings::Surroundings;
use crate::group::{Within, fixed_together};
use crate::patch::Symmetry;
use crate::transform::Class;

/// Isometries that count as one, rms displacement over the ground they share, fraction of L.
const TOLERANCE: f64 = 0.02;
/// Two grounds are one when this share of both together lies in both.
const SAME_GROUND: f64 = 0.7;
/// A group is worth the name from this order on.
const MIN_ORDER: usize = 3;

/// The groups of `symmetries`, those of most of the surface first.
pub fn arrange(surroundings: &Surroundings<'_>, symmetries: &[Symmetry]) -> Vec<Group> {
    let count = surroundings.ground.samples.list.len();
    let grounds: Vec<Vec<bool>> = symmetries.iter().map(|s| s.ground(count)).collect();
    let mut used = vec![false; symmetries.len()];
    let mut groups = points::point_groups(surroundings, symmetries, &grounds, &mut used);
    groups.extend(rows::rows(surroundings, symmetries, &mut used));
    groups.extend(copies::copies(surroundings, symmetries, &used));
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

/// Whether patch and image are one and the same ground, and the motion leaves a point of it in its place: the steps of a long row
/// carry most of it onto itself, too.
fn is_closed(s: &Symmetry, surroundings: &Surroundings<'_>) -> bool {
    if s.class == Class::Mirror {
        return true;
    }
    let count = surroundings.ground.samples.list.len();
    let mut image = vec![false; count];
    for &i in &s.image {
        image[i as usize] = true;
    }
    let within = Within {
        space: surroundings.space,
        tolerance: TOLERANCE,
    };
    let turns = || !fixed_together(&[s.q_from_p], within).is_empty();
    likeness(&s.membership(count), &image) > SAME_GROUND && turns()
}
