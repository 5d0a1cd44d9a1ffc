//! Mirror lines of outlines that are known to have them, and of some that have none.

use crate::common::model;
use crate::shared::{Truth, drawing, found, symmetrized, wall, whole};
use symmetrizer::Outcome;
use symmetrizer::field::trust::Verdict;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::Step;

#[test]
fn drawings_have_the_lines_that_they_have() {
    // Of many lines some are told by fewer votes than the others leave over; the group has them all.
    for (name, lines, group) in [
        ("truth/gecko_straight.svg", 1..=1, ""),
        ("2d/snowflake_fa.svg", 3..=6, "D6"),
        ("2d/fan_fa.svg", 0..=0, "C4"),
        ("2d/cog_gi.svg", 4..=8, "D8"),
    ] {
        for (angle, scale) in [(0.0, 1.0), (0.7, 13.0), (2.0, 0.01)] {
            let Some(wall) = wall(name, angle, scale) else {
                return;
            };
            let found = found(&wall);
            let mirrors = found.symmetries.iter().filter(|s| s.q_from_p.is_improper());
            for s in mirrors {
                let normal = s.plane().normal;
                assert!(normal.z.abs() < 1e-6, "{name}: {normal}");
            }
            let (count, rms) = whole(&found);
            println!("{name} turned by {angle}: {count} lines, rms {rms:.5} L");
            assert!(lines.contains(&count), "{name}: {count} lines");
            // Copies of toes and the like have no axis.
            let mut turns = found.groups.iter().filter(|g| g.axis.is_some());
            let named = turns.next().map_or("", |g| g.name.as_str());
            assert_eq!(named, group, "{name}");
            assert!(rms < 0.0015, "{name}: {rms}");
        }
    }
}

#[test]
fn the_straight_gecko_has_its_line_where_it_is_known_to_be() {
    let Some(path) = model("truth/gecko_straight.truth.json") else {
        return;
    };
    let text = std::fs::read_to_string(path).expect("a file");
    let Truth { placement } = serde_json::from_str(&text).expect("a truth");
    let wall = wall("truth/gecko_straight.svg", 0.0, 1.0).expect("a wall");
    let found = found(&wall);
    let plane = found.symmetries[0].plane();
    let known = Vector::new(placement.matrix[0][0], -placement.matrix[1][0], 0.0).normalize();
    let angle = plane.normal.cross(&known).norm().asin().to_degrees();
    let on = Point::new(placement.offset[0] + 7.0, -placement.offset[1] - 3.0, 0.0);
    let on = wall.normalization.to_working(&on);
    let away = (plane.normal.dot(&on.coords) - plane.offset).abs();
    println!("{angle:.4} degrees, {away:.6} L");
    assert!(angle < 0.1, "{angle} degrees");
    assert!(away < 0.001, "{away} L");
}

#[test]
fn what_has_no_line_is_left() {
    for name in [
        "2d/hand_fa.svg",
        "2d/sea_snake.traced.svg",
        "2d/spring.traced.svg",
        "2d/lizard_curl.traced.svg",
    ] {
        let Some(drawing) = drawing(name) else {
            return;
        };
        let done = symmetrized(&drawing);
        let bend = done
            .job
            .report
            .bend
            .as_ref()
            .expect("a bend that was looked at");
        println!(
            "{name}: score {:.2}, rival {:.2}",
            bend.score,
            bend.rival.unwrap_or(1.0)
        );
        assert_ne!(bend.verdict, Verdict::Accept, "{name}");
        // The fingers of the drawn hand are copies of each other, and exact ones.
        if name == "2d/hand_fa.svg" {
            let orbits = |s: &Step| matches!(s, Step::Orbits { .. });
            assert!(done.job.report.steps.iter().all(orbits), "{name}");
            let result = done.job.report.result.as_ref();
            let moved = result.map_or(0.0, |r| r.distortion.rms);
            assert!(moved < 0.01, "{name}: moved by {moved} % of D");
            continue;
        }
        assert_eq!(done.job.outcome, Outcome::NoSymmetry, "{name}");
        assert_eq!(done.drawing.svg(), drawing.svg(), "{name}");
    }
}
