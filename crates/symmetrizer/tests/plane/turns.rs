//! Turns, of a whole outline or of one of its rings.

use crate::shared::{drawing, own_copies, symmetrized};
use symmetrizer::Drawing;
use symmetrizer::drawing::{Format, Reading, decode};
use symmetrizer::optimize::Step;

/// A gear of so many teeth, each of them a little different, around a hole that has no symmetry.
fn gear(teeth: u32) -> String {
    let points = teeth * 40;
    let rim = (0..points).map(|k| {
        let angle = f64::from(k) / f64::from(points) * std::f64::consts::TAU;
        let wave = (f64::from(teeth) * angle).cos();
        let uneven = 0.25 * (3.0 * angle + 1.0).sin() * (7.0 * angle).cos();
        let r = 100.0 + 6.0 * wave + uneven;
        format!("{:.4},{:.4}", r * angle.cos(), r * angle.sin())
    });
    let rim: Vec<String> = rim.collect();
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg'><path fill-rule='evenodd' d='M{}Z \
         M-50,-50 L-20,-50 L-20,30 L45,40 L40,60 L-50,55 Z'/></svg>",
        rim.join(" L")
    )
}

#[test]
fn a_ring_turns_by_itself() {
    for teeth in [17, 33] {
        let drawing = decode(gear(teeth).into_bytes(), Format::Svg, &Reading::default());
        let drawing = drawing.expect("a drawing");
        let done = symmetrized(&drawing);
        let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
            panic!("{:?}", done.job.report.steps);
        };
        let [goal] = goals.as_slice() else {
            panic!("{goals:?}");
        };
        println!("{}: {:?}", goal.name, goal.residual);
        assert_eq!(goal.name, format!("D{teeth}"));
        assert!(goal.residual[1] <= 2e-4 && goal.residual[1] < 0.2 * goal.residual[0]);
        let hole = |d: &Drawing| {
            let holes = d.outline().rings.iter().filter(|r| r.area() < 0.0);
            holes.flat_map(|r| r.points.clone()).collect::<Vec<_>>()
        };
        let (was, now) = (hole(&drawing), hole(&done.drawing));
        assert_eq!(was.len(), now.len());
        let moved = was.iter().zip(&now).map(|(a, b)| (b - a).norm());
        assert!(moved.fold(0.0, f64::max) < 1e-9);
        assert!(done.exact().is_err(), "of a part there is no exact drawing");
    }
}

#[test]
fn the_rim_of_a_gear_around_a_letter_turns() {
    let Some(drawing) = drawing("2d/rust_si.svg") else {
        return;
    };
    let done = symmetrized(&drawing);
    let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
        panic!("{:?}", done.job.report.steps);
    };
    assert_eq!(goals[0].name, "D32");
    assert!(goals[0].residual[1] <= 2e-4, "{:?}", goals[0].residual);
}

#[test]
fn turns_are_found_and_made_exact() {
    for (name, group, lines) in [("2d/fan_fa.svg", "C4", 0), ("2d/snowflake_fa.svg", "D6", 1)] {
        let Some(drawing) = drawing(name) else {
            return;
        };
        let done = symmetrized(&drawing);
        let [Step::Orbits { goals, .. }] = done.job.report.steps.as_slice() else {
            panic!("{name}: {:?}", done.job.report.steps);
        };
        let [goal] = goals.as_slice() else {
            panic!("{name}: {goals:?}");
        };
        assert_eq!(goal.name, group, "{name}");
        assert!(goal.residual[1] <= 2e-4, "{name}: {:?}", goal.residual);
        let all = done.job.before.symmetries().iter();
        let mirrors = all.filter(|s| s.q_from_p.is_improper()).count();
        assert!((mirrors > 0) == (lines > 0), "{name}: {mirrors} lines");
        let exact = done.exact().expect(name);
        own_copies(&exact, if lines > 0 { 6 } else { 4 }, lines > 0, name);
        assert_eq!(
            exact.outline().rings.len(),
            drawing.outline().rings.len(),
            "{name}"
        );
        let lost = (exact.outline().area() / drawing.outline().area() - 1.0).abs();
        assert!(lost < 0.01, "{name}: {lost}");
    }
}
