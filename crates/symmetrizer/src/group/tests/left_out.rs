//! What the shape refuses is left out, what fixes another point is another group's.

use super::*;
use crate::group::{Name, fixed_together, point_group};
use std::f64::consts::TAU;

/// C4v about the z axis through `centre`.
fn c4v(centre: Vector) -> Vec<Isometry> {
    let at = shift(centre);
    (0..4)
        .map(|k| rotation(Vector::z(), f64::from(k) * TAU / 4.0))
        .flat_map(|t| [t, t.after(&mirror(Vector::x()))])
        .map(|t| seen_from(&at, &t))
        .collect()
}

#[test]
fn a_wrong_generator_is_left_out_wherever_it_stands() {
    let mut rng = rng(41);
    let space = space_at(Vector::zeros(), &mut rng);
    let truth = c4v(Vector::zeros());
    let wrong = [
        mirror(Vector::new(1.0, 0.3, 0.2)),
        rotation(Vector::new(0.2, 1.0, 0.5), 1.0),
        rotation(Vector::z(), 1.0),
    ];
    for w in wrong {
        for place in 0..3 {
            let mut given: Vec<Isometry> = [truth[2], truth[1]]
                .iter()
                .map(|t| noisy(t, &space, &mut rng))
                .collect();
            given.insert(place, w);
            let mut answers = shape(&truth, &space, &mut rng);
            let group = point_group(&given, within(&space), &mut answers).expect("a group");
            assert_eq!(group.name, Name::Cv(4));
            drop(answers);
            // Believed on its own, its products with the rest are refused all the same.
            let mut more = truth.clone();
            more.push(w);
            more.push(w.inverse());
            let mut answers = shape(&more, &space, &mut rng);
            let group = point_group(&given, within(&space), &mut answers).expect("a group");
            assert_eq!(group.name, Name::Cv(4), "place {place}");
        }
    }
}

/// A shape that agrees to everything, a sphere, must not make an endless group.
#[test]
fn a_sphere_gives_no_more_than_closes() {
    let mut rng = rng(42);
    let space = space_at(Vector::zeros(), &mut rng);
    let given = [
        rotation(Vector::z(), 1.0),
        mirror(Vector::x()),
        rotation(Vector::y(), TAU / 6.0),
    ];
    let mut asked = 0;
    let mut yes = |t: &Isometry| {
        asked += 1;
        Some(*t)
    };
    let group = point_group(&given, within(&space), &mut yes).expect("a group");
    // One radian is 7 in 44 of a turn, to the tolerance.
    assert_eq!(group.name, Name::Cv(44));
    assert!(asked < 2000, "{asked}");
}

#[test]
fn each_isometry_is_asked_for_once() {
    let mut rng = rng(43);
    let space = space_at(Vector::zeros(), &mut rng);
    let truth = c4v(Vector::zeros());
    let given = [truth[2], truth[1], truth[4], truth[2]];
    let mut asked: Vec<Isometry> = Vec::new();
    let mut answers = |t: &Isometry| {
        asked.push(*t);
        truth
            .iter()
            .find(|s| space.distance(s, t) < TOLERANCE)
            .copied()
    };
    let group = point_group(&given, within(&space), &mut answers).expect("a group");
    assert_eq!(group.name, Name::Cv(4));
    assert!(asked.len() < truth.len());
    for (i, t) in asked.iter().enumerate() {
        assert!(asked[..i].iter().all(|s| space.distance(s, t) > TOLERANCE));
    }
}

#[test]
fn groups_with_different_centres_are_not_mixed() {
    let mut rng = rng(44);
    let space = space_at(Vector::zeros(), &mut rng);
    let (a, b) = (Vector::new(0.8, 0.0, 0.0), Vector::new(-0.8, 0.0, 0.0));
    let both = [c4v(a), c4v(b)];
    // 0, 1: of a; 2, 3: of b; 4: the mirror that holds both axes; 5: a screw of neither.
    let screw = Isometry {
        translation: Vector::z() * 0.5,
        ..rotation(Vector::z(), 1.0)
    };
    let given = [
        both[0][2],
        both[0][1],
        both[1][2],
        both[1][1],
        mirror(Vector::y()),
        screw,
    ];
    let given = given.map(|t| noisy(&t, &space, &mut rng));
    let sets = fixed_together(&given, within(&space));
    assert_eq!(sets, [vec![0, 1, 4], vec![2, 3, 4]]);
    assert!(point_group(&given, within(&space), &mut |_| None).is_none());
    for (set, (truth, centre)) in sets.iter().zip(both.iter().zip([a, b])) {
        let own: Vec<Isometry> = set.iter().map(|&i| given[i]).collect();
        let mut answers = shape(truth, &space, &mut rng);
        let group = point_group(&own, within(&space), &mut answers).expect("a group");
        assert_eq!(group.name, Name::Cv(4));
        let across = group.centre.coords - centre;
        assert!(across.xy().norm() < 3.0 * NOISE, "{across}");
    }
}

#[test]
fn what_fixes_no_point_is_no_point_groups() {
    let mut rng = rng(45);
    let space = space_at(Vector::zeros(), &mut rng);
    let near = mirror(Vector::x());
    let parallel = seen_from(&shift(Vector::x() * 0.3), &near);
    let yes = &mut |t: &Isometry| Some(*t);
    for given in [vec![shift(Vector::x())], vec![near, parallel]] {
        assert!(point_group(&given, within(&space), yes).is_none());
    }
    assert!(fixed_together(&[shift(Vector::x())], within(&space)).is_empty());
    assert_eq!(fixed_together(&[near, parallel], within(&space)).len(), 2);
}
