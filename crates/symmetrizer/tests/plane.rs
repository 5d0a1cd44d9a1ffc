//! Shapes of the plane: the mirror lines of outlines that are known to have them.
#![allow(clippy::print_stdout)]
mod common;

use common::model;
use symmetrizer::Context;
use symmetrizer::detect::{DetectParams, Detection, detect_in_plane};
use symmetrizer::drawing::{Reading, read};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::wall::Wall;

/// The outline of a drawing, turned, scaled and moved, as a wall.
fn wall(name: &str, angle: f64, scale: f64) -> Option<Wall> {
    let drawing = read(&model(name)?, &Reading::default()).expect("a drawing");
    let (sin, cos) = angle.sin_cos();
    let place = |x: &Point| {
        Point::new(
            scale * (cos * x.x - sin * x.y) + 7.0,
            scale * (sin * x.x + cos * x.y) - 3.0,
            0.0,
        )
    };
    let rings = drawing.outline().rings.iter();
    let rings: Vec<Vec<Point>> = rings
        .map(|r| r.points.iter().map(place).collect())
        .collect();
    Some(Wall::new(&rings).expect("a wall"))
}

fn found(wall: &Wall) -> Detection {
    let params = DetectParams::default();
    detect_in_plane(wall, &params, &mut Context::new(0)).expect("a detection")
}

/// The lines that hold for nearly all of an outline, and their largest rms, fraction of L.
fn whole(found: &Detection) -> (usize, f64) {
    let all = found.symmetries.iter().filter(|s| s.area_fraction > 0.9);
    all.fold((0, 0.0), |(n, rms), s| (n + 1, f64::max(rms, s.rms)))
}

#[test]
fn drawings_have_the_lines_that_they_have() {
    // The snowflake has six, of which two are told by fewer votes than the others leave over.
    for (name, lines) in [
        ("truth/gecko_straight.svg", 1..=1),
        ("2d/snowflake_fa.svg", 4..=6),
        ("2d/fan_fa.svg", 0..=0),
        ("2d/cog_gi.svg", 8..=8),
    ] {
        for (angle, scale) in [(0.0, 1.0), (0.7, 13.0), (2.0, 0.01)] {
            let Some(wall) = wall(name, angle, scale) else {
                return;
            };
            let found = found(&wall);
            for s in &found.symmetries {
                let normal = s.plane().normal;
                assert!(normal.z.abs() < 1e-6, "{name}: {normal}");
            }
            let (count, rms) = whole(&found);
            println!("{name} turned by {angle}: {count} lines, rms {rms:.5} L");
            assert!(lines.contains(&count), "{name}: {count} lines");
            assert!(rms < 0.0015, "{name}: {rms}");
        }
    }
}

#[derive(serde::Deserialize)]
struct Truth {
    placement: Placement,
}

/// Of the rest shape, whose line is x = 0, in the file: y = matrix x + offset, y downwards.
#[derive(serde::Deserialize)]
struct Placement {
    matrix: [[f64; 2]; 2],
    offset: [f64; 2],
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
