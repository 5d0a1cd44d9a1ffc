//! Rows, rings, helices and grids, whole and with missing ends.

use super::*;
use crate::group::{Pattern, Row, patterns, row};
use crate::transform::Kind;
use std::f64::consts::TAU;

fn powers(step: &Isometry, count: u32) -> Vec<Isometry> {
    let mut all = vec![*step];
    for _ in 2..count {
        all.push(step.after(&all[all.len() - 1]));
    }
    all
}

/// The row of a shape with `count` copies, from its noisy step.
fn found(step: &Isometry, count: u32, seed: u64) -> (Row, TransformSpace) {
    let mut rng = rng(seed);
    let space = space_at(vector(&mut rng, 0.3), &mut rng);
    let truth = powers(step, count);
    let given = noisy(step, &space, &mut rng);
    let mut answers = shape(&truth, &space, &mut rng);
    let row = row(&given, within(&space), &mut answers).expect("a row");
    drop(answers);
    (row, space)
}

fn glide(by: Vector) -> Isometry {
    shift(by).after(&mirror(Vector::z()))
}

#[test]
fn rows_of_every_kind_have_their_count_and_name() {
    let ring = |n: f64| {
        seen_from(
            &shift(Vector::new(0.5, 0.2, 0.0)),
            &rotation(Vector::z(), TAU / n),
        )
    };
    let screw = shift(Vector::z() * 0.3).after(&ring(5.0));
    let cases = [
        (
            shift(Vector::new(0.4, 0.1, 0.0)),
            5,
            "row 5",
            Kind::Translation,
        ),
        (
            shift(Vector::new(0.4, 0.1, 0.0)),
            2,
            "row 2",
            Kind::Translation,
        ),
        (screw, 6, "helix 6", Kind::Screw),
        (ring(7.0), 4, "ring 4 of 7", Kind::Rotation),
        (ring(12.0), 3, "ring 3 of 12", Kind::Rotation),
        (ring(5.6), 4, "arc 4", Kind::Rotation),
        (glide(Vector::x() * 0.4), 6, "glide row 6", Kind::Glide),
    ];
    for (seed, (step, count, name, kind)) in cases.into_iter().enumerate() {
        let (row, space) = found(&step, count, 50 + seed as u64);
        assert_eq!(row.to_string(), name);
        assert_eq!((row.count, row.kind), (count as usize, kind));
        assert!(!row.is_closed());
        assert!(space.distance(&row.step, &step) < 3.0 * NOISE, "{name}");
    }
}

/// A ring without gaps stops where it began, however far the shape would go on agreeing.
#[test]
fn a_whole_ring_is_closed() {
    let mut rng = rng(60);
    let space = space_at(Vector::zeros(), &mut rng);
    let step = rotation(Vector::y(), TAU / 9.0);
    let truth = powers(&step, 30);
    let given = noisy(&step, &space, &mut rng);
    let mut answers = shape(&truth, &space, &mut rng);
    let ring = row(&given, within(&space), &mut answers).expect("a ring");
    assert_eq!((ring.to_string().as_str(), ring.count), ("ring 9", 9));
    assert!(ring.is_closed());
    drop(answers);
    let mut answers = shape(&truth, &space, &mut rng);
    assert!(patterns(&[given], within(&space), &mut answers).is_empty());
}

/// The step of all powers is nearer to the truth than the one it began with, and the more the
/// longer the row.
#[test]
fn all_powers_make_the_step_better() {
    let step = shift(Vector::new(0.2, 0.0, 0.05)).after(&rotation(Vector::new(1.0, 0.2, 0.1), 0.3));
    let error = |count: u32| -> f64 {
        (0..20)
            .map(|seed| {
                let (row, space) = found(&step, count, 100 + seed);
                space.distance(&row.step, &step)
            })
            .sum::<f64>()
            / 20.0
    };
    let (two, ten) = (error(2), error(10));
    assert!(ten < 0.25 * two, "{two} {ten}");
}

#[test]
fn mirrors_and_half_turns_make_no_rows() {
    let mut rng = rng(61);
    let space = space_at(Vector::zeros(), &mut rng);
    let yes = &mut |t: &Isometry| Some(*t);
    let half = rotation(Vector::x(), TAU / 2.0);
    for t in [
        mirror(Vector::x()),
        half,
        Isometry::identity(),
        half.after(&mirror(Vector::x())),
    ] {
        assert!(row(&noisy(&t, &space, &mut rng), within(&space), yes).is_none());
    }
}

fn block(n: i32, m: i32, missing: &[(i32, i32)]) -> Vec<Isometry> {
    let (a, b) = (Vector::new(0.3, 0.0, 0.1), Vector::new(0.05, 0.5, 0.0));
    let places = (1 - n..n).flat_map(|i| (1 - m..m).map(move |j| (i, j)));
    places
        .filter(|at| *at != (0, 0) && !missing.contains(at))
        .map(|(i, j)| shift(a * f64::from(i) + b * f64::from(j)))
        .collect()
}

#[test]
fn two_rows_make_a_grid_that_explains_its_diagonals() {
    let mut rng = rng(62);
    let space = space_at(Vector::zeros(), &mut rng);
    let truth = block(3, 4, &[]);
    // Given in any order, with diagonals and inverses.
    let given: Vec<Isometry> = truth
        .iter()
        .rev()
        .step_by(2)
        .chain(&block(2, 2, &[]))
        .map(|t| noisy(t, &space, &mut rng))
        .collect();
    let mut answers = shape(&truth, &space, &mut rng);
    let all = patterns(&given, within(&space), &mut answers);
    let names: Vec<String> = all.iter().map(Pattern::to_string).collect();
    assert_eq!(names, ["grid 3x4"]);
    let Pattern::Grid(grid) = &all[0] else {
        panic!("a grid");
    };
    let a = Vector::new(0.3, 0.0, 0.1);
    let step = grid.steps[0].translation;
    assert!((step - a).norm().min((step + a).norm()) < NOISE, "{step}");
}

/// Of a block whose far corner is missing the largest full one is the grid.
#[test]
fn missing_copies_make_a_smaller_grid() {
    let mut rng = rng(63);
    let space = space_at(Vector::zeros(), &mut rng);
    let truth = block(3, 4, &[(2, 3), (2, 2)]);
    let (a, b) = (Vector::new(0.3, 0.0, 0.1), Vector::new(0.05, 0.5, 0.0));
    let given = [a, b].map(|s| noisy(&shift(s), &space, &mut rng));
    let mut answers = shape(&truth, &space, &mut rng);
    let all = patterns(&given, within(&space), &mut answers);
    let names: Vec<String> = all.iter().map(Pattern::to_string).collect();
    assert_eq!(names, ["grid 2x4"]);
    drop(answers);
    // Rows whose products do not hold stay two rows.
    let truth: Vec<Isometry> = [powers(&shift(a), 3), powers(&shift(b), 4)].concat();
    let mut answers = shape(&truth, &space, &mut rng);
    let all = patterns(&given, within(&space), &mut answers);
    let names: Vec<String> = all.iter().map(Pattern::to_string).collect();
    assert_eq!(names, ["row 3", "row 4"]);
}
