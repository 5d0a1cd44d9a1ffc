//! Clouds that are no surface, too large or damaged: errors, no panics, no hanging.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::drawn::{Sampled, judged, sphere};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::cloud::Discs;
use symmetrizer::{Context, Mesh, Params, detect_in};

#[track_caller]
fn refused(points: Vec<Point>, part: &str) {
    let mesh = Mesh {
        positions: points,
        ..Mesh::default()
    };
    let error = detect_in(&mesh, &Params::default(), &mut Context::new(0)).err();
    let text = error.expect("a refusal").to_string();
    assert!(text.contains(part), "{text}");
}

#[test]
fn what_shows_no_surface_is_refused() {
    let at = |i: usize| i as f64;
    refused(Vec::new(), "0 points in different places");
    let three = (0..3).map(|i| Point::new(at(i), at(i * i), 1.0)).collect();
    refused(three, "3 points in different places");
    refused(
        vec![Point::new(1.0, 2.0, 3.0); 1_000_000],
        "1 points in different places",
    );
    let line = (0..500)
        .map(|i| Point::new(at(i), 2.0 * at(i), 7.0))
        .collect();
    refused(line, "on a line");
    refused(
        vec![Point::new(f64::NAN, 0.0, f64::INFINITY); 500],
        "0 points",
    );
    let far = (0..500)
        .map(|i| Point::new(1e300 * at(i), 1e300 * at(i * i), 0.0))
        .collect();
    refused(far, "arithmetic");
}

#[test]
fn points_without_a_place_and_doubled_ones_are_left_out() {
    let clean = Sampled::new(800, 0.0, false, sphere);
    let mut points = clean.points.clone();
    points.insert(3, Point::new(f64::NAN, 0.0, 0.0));
    points.extend_from_slice(&clean.points[..400]);
    let discs = Discs::new(&points, None).unwrap();
    assert_eq!(discs.points.len(), 800);
    assert_eq!(discs.disc_of_document[3], None);
    assert_eq!(discs.disc_of_document[801], Some(0));
    assert_eq!(discs.document[3], 4);
    let same = Discs::new(&clean.points, None).unwrap();
    assert_eq!(discs.normals, same.normals);
}

#[test]
fn strange_clouds_do_not_panic() {
    let mut rng = Pcg64::seed_from_u64(5);
    let mut cube = || Point::from(Vector::from_fn(|_, _| rng.random::<f64>()));
    let solid: Vec<Point> = (0..3000).map(|_| cube()).collect();
    let flat = solid.iter().map(|p| Point::new(p.x, p.y, 0.0)).collect();
    let grid = (0..3600)
        .map(|i| Point::new(f64::from(i % 60), f64::from(i / 60), 0.0))
        .collect();
    // A scanner's lines, ten times closer along than across.
    let lines = (0..4000).map(|i| Point::new(0.1 * f64::from(i % 200), f64::from(i / 200), 0.0));
    let mut stray = Sampled::new(2000, 0.0, false, sphere).points;
    stray.extend([[1e6, 0.0, 0.0], [0.0, -3e3, 10.0]].map(Point::from));
    let far = solid
        .iter()
        .map(|p| p + Vector::new(1e7, -1e7, 1e7))
        .collect();
    let tiny = solid.iter().map(|p| p * 1e-30).collect();
    for points in [solid, flat, grid, lines.collect(), stray, far, tiny] {
        let mesh = Mesh {
            positions: points,
            ..Mesh::default()
        };
        let found = detect_in(&mesh, &Params::default(), &mut Context::new(0));
        assert!(found.is_ok(), "{:?}", found.err());
    }
}

#[test]
fn scan_lines_get_the_normal_of_their_plane() {
    let lines = (0..4000).map(|i| Point::new(0.02 * f64::from(i % 200), f64::from(i / 200), 0.0));
    let discs = Discs::new(&lines.collect::<Vec<_>>(), None).unwrap();
    assert!(discs.normals.iter().all(|n| n.z.abs() > 0.999));
}

#[test]
fn large_clouds_are_thinned_evenly() {
    let drawn = Sampled::new(100_000, 0.005, false, sphere);
    let discs = Discs::new(&drawn.points, None).unwrap();
    assert!(
        (5_000..=20_000).contains(&discs.points.len()),
        "{}",
        discs.points.len()
    );
    let [right, median, _] = judged(&discs, &drawn.normals);
    assert!(right > 0.999 && median < 9.0, "{right} {median}");
    let area: f64 = discs.areas.iter().sum();
    assert!(
        (area / (4.0 * std::f64::consts::PI) - 1.0).abs() < 0.05,
        "{area}"
    );
    for (x, disc) in drawn.points.iter().zip(&discs.disc_of_document) {
        let y = discs.points[disc.unwrap() as usize];
        assert!((x - y).norm() < 0.15);
    }
}
