//! Normals, sides, areas and noise against shapes that know theirs.

use std::f64::consts::PI;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::common::data;
use crate::drawn::{Drawn, Sampled, cuboid, diagonal, judged, sphere, star, torus};
use symmetrizer::Mesh;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::cloud::Discs;
use symmetrizer::shape::curvature::Cloud;
use symmetrizer::shape::io;
use symmetrizer::shape::working::Working;

/// How far from the truth normals may be.
struct Bounds {
    /// Least share on the right side.
    right: f64,
    /// Largest median angle without noise and with 1 % of D, degrees.
    angles: [f64; 2],
    /// Largest error of the area.
    area: f64,
}

#[track_caller]
fn check(draw: impl Fn(&mut Pcg64) -> Drawn, count: usize, area: f64, bounds: &Bounds) {
    for noise in [0.0, 0.005, 0.01] {
        for uneven in [false, true] {
            let drawn = Sampled::new(count, noise, uneven, &draw);
            let discs = Discs::new(&drawn.points, None).unwrap();
            let [right, median, _] = judged(&discs, &drawn.normals);
            let case = format!("noise {noise}, uneven {uneven}");
            assert!(right >= bounds.right, "{case}: {right} on the right side");
            let [clean, noisy] = bounds.angles;
            let limit = clean + (noisy - clean) * (noise / 0.01_f64).sqrt();
            assert!(median <= limit, "{case}: median angle {median}");
            let total: f64 = discs.areas.iter().sum();
            let error = (total / area - 1.0).abs();
            assert!(error <= bounds.area, "{case}: area off by {error}");
            let found = discs.noise / diagonal(&drawn.points);
            assert!(
                found >= 0.7 * noise && found <= 1.3 * noise + 0.003,
                "{case}: {found}"
            );
        }
    }
}

#[test]
fn a_sphere() {
    let bounds = Bounds {
        right: 1.0,
        angles: [0.1, 9.0],
        area: 0.05,
    };
    check(sphere, 4000, 4.0 * PI, &bounds);
}

#[test]
fn a_torus() {
    let bounds = Bounds {
        right: 1.0,
        angles: [0.3, 10.0],
        area: 0.05,
    };
    check(torus, 4000, 1.6 * PI * PI, &bounds);
    let sparse = Bounds {
        right: 0.999,
        angles: [1.5, 10.0],
        area: 0.1,
    };
    check(torus, 1000, 1.6 * PI * PI, &sparse);
}

#[test]
fn a_box_with_sharp_edges() {
    let bounds = Bounds {
        right: 0.99,
        angles: [0.1, 10.0],
        area: 0.1,
    };
    check(cuboid(Vector::new(1.0, 0.7, 0.5)), 4000, 3.1, &bounds);
}

#[test]
fn a_thin_slab() {
    // With 1 % of noise the sides of the slab blur over a fifth of its thickness.
    let bounds = Bounds {
        right: 0.92,
        angles: [0.1, 16.0],
        area: 0.15,
    };
    check(cuboid(Vector::new(1.0, 1.0, 0.08)), 4000, 2.32, &bounds);
}

#[test]
fn a_star_with_grooves_and_sharp_rims() {
    let drawn = Sampled::new(4000, 0.01, false, star);
    let discs = Discs::new(&drawn.points, None).unwrap();
    let [right, median, _] = judged(&discs, &drawn.normals);
    assert!(right > 0.99 && median < 12.0, "{right} {median}");
}

/// Those of the style of a benchmark: prisms and tapers with noise, holes and few points. All are stars
/// about their centre, so that outward normals point away from it.
#[test]
fn benchmark_like_clouds_face_outwards() {
    for i in 0..24 {
        let Some(path) = data(&format!("truth/shrec_style/points{i}.txt")) else {
            return;
        };
        let points = io::read(&path).unwrap().mesh.positions;
        let truth = path.with_file_name(format!("points{i}_sym.txt"));
        let truth = std::fs::read_to_string(truth).unwrap();
        let plane: Vec<f64> = truth
            .lines()
            .nth(1)
            .unwrap()
            .split_whitespace()
            .map(|w| w.parse().unwrap())
            .collect();
        let center = Point::new(plane[3], plane[4], plane[5]);
        let discs = Discs::new(&points, None).unwrap();
        let pairs = discs.points.iter().zip(&discs.normals);
        let outward = pairs.filter(|(x, n)| (*x - center).dot(n) > 0.0).count();
        let share = outward as f64 / discs.points.len() as f64;
        assert!(share > 0.95, "points{i}: {share}");
    }
}

#[test]
fn curvature_of_a_torus_from_its_points() {
    let drawn = Sampled::new(6000, 0.0, false, torus);
    let mesh = Mesh {
        positions: drawn.points,
        ..Mesh::default()
    };
    let working = Working::of_cloud(&mesh, None).unwrap();
    let surface = &working.surface;
    let scale = working.normalization.scale;
    let radius = 0.05;
    let cloud = Cloud::new(surface, radius / 2.0);
    let mut errors = Vec::new();
    for (v, x) in mesh.positions.iter().enumerate().step_by(13) {
        let disc = working.vertex_of_document[v].unwrap() as usize;
        let at = working.normalization.to_working(x);
        let fit = cloud
            .fit(&at, &surface.vertex_normals[disc], radius)
            .unwrap();
        assert!(
            (fit.coverage - 1.0).abs() < 0.5,
            "coverage {}",
            fit.coverage
        );
        let r = x.x.hypot(x.y);
        errors.push((fit.k1 / scale - 2.5).abs());
        errors.push((fit.k2 / scale - (r - 1.0) / (0.4 * r)).abs());
    }
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[(share * errors.len() as f64) as usize];
    assert!(
        at(0.5) < 0.05 * 2.5 && at(0.95) < 0.2 * 2.5,
        "{} {}",
        at(0.5),
        at(0.95)
    );
}

#[test]
fn given_normals_are_used_and_turned_to_one_side_where_they_have_none() {
    let drawn = Sampled::new(1500, 0.0, false, cuboid(Vector::new(1.0, 0.7, 0.5)));
    let discs = Discs::new(&drawn.points, Some(&drawn.normals)).unwrap();
    assert_eq!(discs.normals, drawn.normals);
    // Of any length, and inside out if the file says so.
    let inside_out: Vec<Vector> = drawn.normals.iter().map(|n| n * -3.0).collect();
    let discs = Discs::new(&drawn.points, Some(&inside_out)).unwrap();
    assert_eq!(judged(&discs, &drawn.normals)[0], 0.0);
    let mut rng = Pcg64::seed_from_u64(1);
    let mut either = |n: &Vector| if rng.random() { *n } else { -n };
    let unsided: Vec<Vector> = drawn.normals.iter().map(&mut either).collect();
    let discs = Discs::new(&drawn.points, Some(&unsided)).unwrap();
    let [right, _, p90] = judged(&discs, &drawn.normals);
    assert!(right > 0.99 && p90 < 1e-6, "{right} {p90}");
    // One that is no direction, and all are estimated.
    let mut broken = drawn.normals.clone();
    broken[700] = Vector::zeros();
    let discs = Discs::new(&drawn.points, Some(&broken)).unwrap();
    let estimated = Discs::new(&drawn.points, None).unwrap();
    assert_eq!(discs.normals, estimated.normals);
}
