//! Real drawings: icons, clip art, silhouettes, and outlines whose truth is known.

use serde_json::Value;
use symmetrizer::drawing::{Drawing, Format, Outline};
use symmetrizer::geom::Point;

use crate::common;
use crate::shared::{apart, bend, centre, decoded, gap, read, real, text, turn};

#[track_caller]
fn check(name: &str, drawing: &Drawing) {
    let outline = drawing.outline();
    assert!(outline.area() > 0.0, "{name}");
    let outer: Vec<_> = outline.rings.iter().filter(|r| r.area() > 0.0).collect();
    for ring in &outline.rings {
        assert!(ring.points.len() > 2, "{name}");
        assert_eq!(ring.points.len(), ring.sources.len(), "{name}");
        assert!(
            ring.points
                .iter()
                .all(|p| p.z == 0.0 && p.x.is_finite() && p.y.is_finite())
        );
        if ring.area() < 0.0 {
            // Just outside a hole is inside the region, and a larger outer ring is around it.
            let around = outer
                .iter()
                .any(|o| o.area() > -ring.area() && holds(o, ring));
            assert!(around, "{name}: a hole of {} lies nowhere", ring.area());
        }
    }
}

fn holds(outer: &symmetrizer::drawing::Ring, hole: &symmetrizer::drawing::Ring) -> bool {
    let outer = Outline {
        rings: vec![outer.clone()],
    };
    // A hole may touch its ring, so that not every point need be inside.
    let inside = hole.points.iter().filter(|p| outer.contains(p)).count();
    2 * inside > hole.points.len()
}

#[test]
fn every_real_drawing_is_read_and_comes_back_byte_for_byte() {
    for path in real("svg") {
        let drawing = read(&path);
        check(&path.display().to_string(), &drawing);
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(drawing.svg().into_bytes(), bytes, "{}", path.display());
        let same = drawing.deformed(&|p| p).unwrap();
        assert_eq!(same.svg().into_bytes(), bytes, "{}", path.display());
        assert_eq!(same.outline(), drawing.outline());
    }
}

#[test]
fn every_real_bitmap_is_read() {
    for path in real("png") {
        check(&path.display().to_string(), &read(&path));
    }
}

/// The numbers of the view box.
fn view(drawing: &Drawing) -> Vec<f64> {
    let svg = drawing.svg();
    let start = svg.find("viewBox=\"").unwrap() + 9;
    let numbers = svg[start..].split('"').next().unwrap().split(' ');
    numbers.map(|n| n.parse().unwrap()).collect()
}

#[test]
fn drawings_and_their_bitmaps_agree_in_area() {
    let mut compared = 0;
    for path in real("svg") {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // The bitmap of one shows a frame of strokes, that of the other only strokes of some width.
        if name.starts_with("lizard_boitel") || name.starts_with("butterfly_outline") {
            continue;
        }
        let bitmap = path
            .with_file_name(name.replace(".traced", ""))
            .with_extension("png");
        if !bitmap.exists() {
            continue;
        }
        let (drawn, seen) = (read(&path), read(&bitmap));
        let (a, b) = if name.contains(".traced") {
            // Traces have only the outermost ring, in pixels.
            let largest = |o: &Outline| o.rings.iter().map(|r| r.area()).fold(0.0, f64::max);
            (largest(drawn.outline()), largest(seen.outline()))
        } else {
            let (width, _) = image::image_dimensions(&bitmap).unwrap();
            let scale = f64::from(width) / view(&drawn)[2];
            (
                drawn.outline().area() * scale * scale,
                seen.outline().area(),
            )
        };
        let off = (a / b - 1.0).abs();
        assert!(
            off < 0.01,
            "{name}: {a} and {b}, {:.2} % apart",
            100.0 * off
        );
        compared += 1;
    }
    assert!(compared == 0 || compared > 40, "{compared}");
}

#[test]
fn outlines_are_what_the_renderer_fills() {
    for path in real("svg") {
        let name = path.display().to_string();
        if name.contains("lizard_boitel") || name.contains("butterfly_outline") {
            continue; // strokes are drawn, too
        }
        let drawing = read(&path);
        let mut png = Vec::new();
        drawing.encode(Format::Png, &mut png).unwrap();
        let seen = decoded(&png, Format::Png);
        let view = view(&drawing);
        let page = image::load_from_memory(&png).unwrap();
        let (wide, high) = (f64::from(page.width()), f64::from(page.height()));
        let scale = (wide / view[2]).min(high / view[3]);
        let off = drawing.outline().area() * scale * scale / seen.outline().area() - 1.0;
        assert!(off.abs() < 0.005, "{name}: {:.2} %", 100.0 * off);
    }
}

#[test]
fn known_outlines_are_read_in_their_order() {
    for path in real("svg") {
        let truth = path.with_extension("truth.json");
        let Ok(truth) = std::fs::read(&truth) else {
            continue;
        };
        let truth: Value = serde_json::from_slice(&truth).unwrap();
        let drawing = read(&path);
        let outline = drawing.outline();
        let rings = truth["rings"].as_array().unwrap();
        assert_eq!(rings.len(), outline.rings.len(), "{}", path.display());
        let partners = rings[0]["partner"].as_array().unwrap();
        // Every point of the file, each at its own place on the path.
        let ring = &outline.rings[0];
        assert_eq!(partners.len(), ring.points.len());
        let mut numbers: Vec<u32> = ring.sources.iter().map(|s| s.unwrap().segment).collect();
        numbers.sort_unstable();
        assert!(numbers.iter().copied().eq(0..ring.points.len() as u32));
        // Partners lie on the outline, up to what is known of their accuracy.
        let distances: Vec<f64> = partners
            .iter()
            .map(|p| Point::new(p[0].as_f64().unwrap(), -p[1].as_f64().unwrap(), 0.0))
            .map(|p| gap(&p, outline) / outline.diagonal())
            .collect();
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        assert!(mean < 2e-3, "{}: {mean}", path.display());
    }
}

#[test]
fn a_turned_gecko_is_the_turned_outline_in_a_file_of_its_size() {
    let Some(path) = common::data("2d/gecko_gi.svg") else {
        return;
    };
    let gecko = read(&path);
    let diagonal = gecko.outline().diagonal();
    let map = turn(37.0, centre(gecko.outline()));
    let turned = gecko.deformed(&map).unwrap();
    let again = text(&turned.svg());
    assert!((again.outline().area() / gecko.outline().area() - 1.0).abs() < 1e-4);
    assert!(apart(again.outline(), turned.outline()) < 1e-4 * diagonal);
    // As many curves as before: every letter and number stands for as much.
    let numbers = |d: &Drawing| {
        let svg = d.svg();
        let data = svg.split(" d=\"").nth(1).unwrap();
        svgtypes::PathParser::from(data.split('"').next().unwrap()).count()
    };
    assert_eq!(numbers(&turned), numbers(&gecko));
    let (before, after) = (gecko.svg().len(), turned.svg().len());
    assert!(after < before * 12 / 10, "{before} -> {after} bytes");
}

#[test]
fn bent_drawings_lie_on_the_bent_outline() {
    for name in [
        "gecko_gi",
        "butterfly_outline",
        "lizard_boitel",
        "rust_si",
        "hand_print_right",
    ] {
        let Some(path) = common::data(&format!("2d/{name}.svg")) else {
            return;
        };
        let drawing = read(&path);
        let diagonal = drawing.outline().diagonal();
        let map = bend(centre(drawing.outline()), diagonal);
        let bent = drawing.deformed(&map).unwrap();
        let again = text(&bent.svg());
        let off = apart(again.outline(), bent.outline()) / diagonal;
        assert!(off < 2e-4, "{name}: {off:.1e}");
        let size = bent.svg().len() as f64 / drawing.svg().len() as f64;
        // Arcs take many more bytes as curves.
        assert!(size < 3.0, "{name}: {size:.2} times as large");
        // And back: nothing has been lost.
        let back = again
            .deformed(&unbent(centre(drawing.outline()), diagonal))
            .unwrap();
        let off = apart(back.outline(), drawing.outline()) / diagonal;
        assert!(off < 1e-3, "{name}: {off:.1e}");
    }
}

/// The inverse of [`bend`], by iteration.
fn unbent(about: Point, diagonal: f64) -> impl Fn(Point) -> Point {
    move |p| {
        let forward = bend(about, diagonal);
        let mut at = p;
        for _ in 0..60 {
            at += p - forward(at);
        }
        at
    }
}
