//! Short calls.

use std::path::PathBuf;

use symmetrizer::drawing::{self, Drawing, Format, Outline, Reading};
use symmetrizer::geom::Point;

use crate::common;

pub fn decoded(bytes: &[u8], format: Format) -> Drawing {
    drawing::decode(bytes.to_vec(), format, &Reading::default()).unwrap()
}

/// The drawing in the text of an SVG file.
pub fn text(svg: &str) -> Drawing {
    decoded(svg.as_bytes(), Format::Svg)
}

/// The drawing of some elements in a window of 100 x 100.
pub fn elements(content: &str) -> Drawing {
    text(&page(content))
}

pub fn page(content: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 100\">{content}</svg>")
}

/// What is wrong with the bytes of a file.
pub fn failure(bytes: &[u8], format: Format) -> String {
    let read = drawing::decode(bytes.to_vec(), format, &Reading::default());
    read.unwrap_err().to_string()
}

pub fn warnings(drawing: &Drawing) -> String {
    let texts: Vec<&str> = drawing.warnings().iter().map(|w| w.0.as_str()).collect();
    texts.join("; ")
}

pub fn read(path: &std::path::Path) -> Drawing {
    drawing::read(path, &Reading::default()).unwrap()
}

/// The real drawings with an extension, in order.
pub fn real(extension: &str) -> Vec<PathBuf> {
    let folders = ["2d", "truth"].map(common::data);
    let mut found = Vec::new();
    for folder in folders.into_iter().flatten() {
        let entries = std::fs::read_dir(folder).unwrap();
        found.extend(entries.map(|e| e.unwrap().path()));
    }
    found.retain(|p| p.extension().is_some_and(|e| e == extension));
    found.sort();
    found
}

/// Distance of a point from the edges of an outline.
pub fn gap(p: &Point, outline: &Outline) -> f64 {
    let edges = outline.rings.iter().flat_map(|r| r.edges());
    let distance = |(a, b): (&Point, &Point)| {
        let along = b - a;
        let t = (p - a).dot(&along) / along.norm_squared();
        (p - (a + along * t.clamp(0.0, 1.0))).norm()
    };
    edges.map(distance).fold(f64::INFINITY, f64::min)
}

/// The greatest distance of a point of one outline from the other, both ways.
pub fn apart(a: &Outline, b: &Outline) -> f64 {
    let one = a.points().map(|p| gap(p, b)).fold(0.0, f64::max);
    b.points().map(|p| gap(p, a)).fold(one, f64::max)
}

/// A turn about a point, degrees.
pub fn turn(degrees: f64, about: Point) -> impl Fn(Point) -> Point {
    let (sin, cos) = degrees.to_radians().sin_cos();
    move |p| {
        let v = p - about;
        Point::new(
            about.x + cos * v.x - sin * v.y,
            about.y + sin * v.x + cos * v.y,
            0.0,
        )
    }
}

/// A bend that grows with the height over a point, of a drawing of this size.
pub fn bend(about: Point, diagonal: f64) -> impl Fn(Point) -> Point {
    move |p| {
        let v = p - about;
        let angle = 0.9 * v.y / diagonal;
        turn(angle.to_degrees(), about)(about + v)
    }
}

pub fn centre(outline: &Outline) -> Point {
    let (low, high) = outline.bounds();
    nalgebra::center(&low, &high)
}
