//! Silhouettes in pictures.

use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage, Rgba, RgbaImage};
use symmetrizer::drawing::{self, Drawing, Format, Reading};

use crate::shared::{decoded, failure, text, warnings};

fn bytes(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
    bytes(picture, ImageFormat::Png)
}

/// How much of a pixel a disc of radius 30 about (50.3, 49.8) covers.
fn disc(x: u32, y: u32) -> f64 {
    let inside = |i: u32| {
        let (sx, sy) = (
            f64::from(i % 8) / 8.0 + 0.0625,
            f64::from(i / 8) / 8.0 + 0.0625,
        );
        (f64::from(x) + sx - 50.3).hypot(f64::from(y) + sy - 49.8) < 30.0
    };
    f64::from((0..64).map(|i| u32::from(inside(i))).sum::<u32>()) / 64.0
}

fn grey(dark: u8, light: u8) -> GrayImage {
    GrayImage::from_fn(100, 100, |x, y| {
        let shade = f64::from(light) + disc(x, y) * (f64::from(dark) - f64::from(light));
        Luma([shade.round() as u8])
    })
}

#[track_caller]
fn is_disc(drawing: &Drawing, tolerance: f64) {
    let outline = drawing.outline();
    assert_eq!(outline.rings.len(), 1);
    let worst = outline
        .points()
        .map(|p| ((p.x - 50.3).hypot(p.y + 49.8) - 30.0).abs())
        .fold(0.0, f64::max);
    assert!(worst < tolerance, "{worst} pixels off");
}

#[test]
fn outlines_are_exact_to_a_fraction_of_a_pixel() {
    is_disc(&decoded(&png(grey(0, 255)), Format::Png), 0.1);
    is_disc(&decoded(&png(grey(100, 180)), Format::Png), 0.1);
    // Light on dark.
    is_disc(&decoded(&png(grey(255, 0)), Format::Png), 0.1);
    // Bare steps.
    let steps = GrayImage::from_fn(100, 100, |x, y| {
        Luma([if disc(x, y) > 0.5 { 0 } else { 255 }])
    });
    is_disc(&decoded(&png(steps), Format::Png), 0.45);
}

#[test]
fn opacity_is_the_shape_where_there_is_any() {
    let cut = RgbaImage::from_fn(100, 100, |x, y| {
        Rgba([x as u8, 255, y as u8, (disc(x, y) * 255.0).round() as u8])
    });
    is_disc(&decoded(&png(cut), Format::Png), 0.1);
}

#[test]
fn jpeg_is_read_whatever_it_is_called() {
    let jpeg = bytes(grey(10, 240), ImageFormat::Jpeg);
    is_disc(&decoded(&jpeg, Format::Jpeg), 0.15);
    is_disc(&decoded(&jpeg, Format::Png), 0.15);
}

#[test]
fn shapes_may_touch_the_edge_and_have_holes() {
    let frame = GrayImage::from_fn(40, 30, |x, y| {
        let hole = (5..10).contains(&x) && (5..25).contains(&y);
        Luma([if x < 15 && !hole { 0 } else { 255 }])
    });
    let drawing = decoded(&png(frame), Format::Png);
    let areas: Vec<f64> = drawing.outline().rings.iter().map(|r| r.area()).collect();
    assert_eq!(areas.len(), 2, "{areas:?}");
    assert!((drawing.outline().area() - 350.0).abs() < 5.0, "{areas:?}");
    let (low, high) = drawing.outline().bounds();
    assert!(low.x.abs() < 1e-9 && high.y.abs() < 1e-9 && (low.y + 30.0).abs() < 1e-9);
}

#[test]
fn specks_are_left_out_and_counted() {
    let mut dirty = grey(0, 255);
    for (x, y) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        dirty.put_pixel(3 + x, 3 + y, Luma([0]));
        dirty.put_pixel(50 + x, 50 + y, Luma([255]));
    }
    let drawing = decoded(&png(dirty), Format::Png);
    assert_eq!(drawing.outline().rings.len(), 1);
    assert_eq!(warnings(&drawing), "2 specks left out");
}

#[test]
fn thresholds_may_be_given() {
    let at = |threshold| {
        let reading = Reading {
            threshold: Some(threshold),
        };
        drawing::decode(png(grey(50, 200)), Format::Png, &reading)
    };
    let area = |threshold: f64| at(threshold).unwrap().outline().area();
    assert!(area(0.3) < area(0.5) && area(0.5) < area(0.7));
    assert!(
        at(0.1)
            .unwrap_err()
            .to_string()
            .contains("one side of the threshold")
    );
    for bad in [0.0, 1.0, -3.0, f64::NAN] {
        let message = at(bad).unwrap_err().to_string();
        assert!(message.starts_with("parameter threshold"), "{message}");
    }
}

#[test]
fn pictures_of_one_colour_are_refused() {
    for size in [1, 50] {
        let message = failure(&png(GrayImage::new(size, size)), Format::Png);
        assert!(message.contains("one colour only"), "{message}");
    }
}

#[test]
fn photographs_are_doubted() {
    // A slope of colours: no threshold is better than another.
    let photo = RgbImage::from_fn(200, 150, |x, y| Rgb([x as u8, y as u8, (x + y) as u8]));
    let drawing = decoded(&png(photo), Format::Png);
    assert!(
        warnings(&drawing).contains("is this a silhouette?"),
        "{}",
        warnings(&drawing)
    );
    assert!(drawing.outline().area() > 0.0);
    assert_eq!(warnings(&decoded(&png(grey(0, 255)), Format::Png)), "");
}

#[test]
fn fresh_files_have_few_smooth_curves() {
    let drawing = decoded(&png(grey(0, 255)), Format::Png);
    let svg = drawing.svg();
    assert!(svg.len() < 500, "{svg}");
    is_disc(&text(&svg), 0.3);
    // A square has its corners.
    let square = GrayImage::from_fn(60, 60, |x, y| {
        Luma([if (10..50).contains(&x) && (10..50).contains(&y) {
            0
        } else {
            255
        }])
    });
    let drawing = decoded(&png(square), Format::Png);
    let again = text(&drawing.svg());
    let area = again.outline().area();
    assert!((area - 1600.0).abs() < 16.0, "{area}: {}", drawing.svg());
    assert!(drawing.svg().len() < 500, "{}", drawing.svg());
}
