//! Which symmetries of an outline belong together: turns about a centre, with lines through it, of the whole or of
//! rings; and of what is in none of them rows, copies, and groups of parts.

use crate::detect::arrange::arrange as arranged;
use crate::detect::groups::Group;
use crate::detect::numbered;
use crate::detect::surroundings::{Surroundings, as_good};
use crate::detect::turns::{self, Turn};
use crate::patch::Symmetry;
use crate::shape::wall::Wall;
use crate::transform::{Class, Isometry, Kind};

/// Adds to the `symmetries` of the outline over which `wall` stands turns of any order, in place of those of their powers
/// that votes have found, and says which belong together.
pub fn arrange(
    surroundings: &Surroundings<'_>,
    wall: &Wall,
    symmetries: &mut Vec<Symmetry>,
) -> Vec<Group> {
    let turns = match surroundings.params.wanted.has(Kind::Rotation) {
        true => turns::turns(surroundings.ground, wall),
        false => Vec::new(),
    };
    let good = |turn: &Turn| !is_echo(&turn.symmetry, symmetries, surroundings);
    let turns: Vec<Turn> = turns.into_iter().filter(good).collect();
    let near = 0.5 * surroundings.params.cluster.bandwidth;
    symmetries.retain(|s| {
        !turns
            .iter()
            .any(|turn| is_power(s, &turn.symmetry, surroundings, near))
    });
    let first = symmetries.len();
    let (lines, turns): (Vec<_>, Vec<_>) = turns.into_iter().map(|t| (t.line, t.symmetry)).unzip();
    symmetries.extend(turns);
    numbered(symmetries);
    let turns = symmetries[first..].iter().zip(&lines);
    let mut groups: Vec<Group> = turns
        .map(|(turn, line)| turns::group(turn, line.as_ref(), symmetries))
        .collect();
    let others: Vec<Symmetry> = symmetries
        .iter()
        .filter(|s| !groups.iter().any(|g| g.symmetries.contains(&s.id)))
        .cloned()
        .collect();
    // Any two lines across each other make half a turn: of a part that is not worth a name.
    let several = |g: &Group| g.pattern.is_some() || !g.orbit.is_empty() || turns_of(g) > 2;
    groups.extend(arranged(surroundings, &others).into_iter().filter(several));
    groups
}

/// Whether a `turn` holds worse than others of the `symmetries` that do not leave its centre in its place: where copies in a row are exact,
/// half a turn of the row may nearly be one of their steps.
fn is_echo(turn: &Symmetry, symmetries: &[Symmetry], surroundings: &Surroundings<'_>) -> bool {
    let centre = turns::fixed_point(&turn.q_from_p);
    let near = 0.5 * surroundings.params.cluster.bandwidth;
    let moves = |s: &&Symmetry| (s.q_from_p.apply(&centre) - centre).norm() > near;
    let others: Vec<Symmetry> = symmetries.iter().filter(moves).cloned().collect();
    as_good(turn.clone(), &others, surroundings.ground).is_err()
}

/// Whether `s` is a power of `turn`, to within `near`, rms fraction of L, and holds where that does.
fn is_power(s: &Symmetry, turn: &Symmetry, surroundings: &Surroundings<'_>, near: f64) -> bool {
    if s.class != Class::Proper {
        return false;
    }
    let count = surroundings.ground.samples.list.len();
    let (own, whole) = (s.ground(count), turn.ground(count));
    let outside = own.iter().zip(&whole).filter(|(o, w)| **o && !**w).count();
    let inside = own.iter().filter(|o| **o).count() - outside;
    let mut powers = std::iter::successors(Some(turn.q_from_p), |t| Some(turn.q_from_p.after(t)));
    let same = |t: Isometry| surroundings.space.distance(&t, &s.q_from_p) < near;
    inside > outside && powers.by_ref().take(turns::order(turn) as usize).any(same)
}

/// How many turns a group has, the identity among them.
fn turns_of(group: &Group) -> usize {
    group.elements.iter().filter(|t| !t.is_improper()).count()
}
