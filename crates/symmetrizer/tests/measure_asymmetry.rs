//! Asymmetry: exact shapes, known planes, invariance, near-equal planes, threads.
#![allow(clippy::print_stdout)]
mod common;

use common::{load, model, placed, planar_grid, sphere, working};
use symmetrizer::Context;
use symmetrizer::apply::measure::{AsymmetryReport, Measure, asymmetry, per_vertex};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::Mesh;
use symmetrizer::shape::working::Working;
use symmetrizer::transform::isometry::Plane;

fn measured(mesh: &Mesh) -> AsymmetryReport {
    let (w, d) = working(mesh);
    Measure::of(&w.surface, &w.normalization, d, &[], &Context::new(7))
        .expect("a measurable shape")
        .asymmetry
}

/// The true plane of a model, in the file's coordinates.
fn truth(name: &str) -> Option<(Mesh, Plane)> {
    let (stem, _) = name.rsplit_once('.').expect("a file name");
    let text = std::fs::read_to_string(model(&format!("{stem}.truth.json"))?).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let number = |v: &serde_json::Value| v.as_f64().unwrap();
    let normal = &json["global"]["normal"];
    let normal = Vector::from_fn(|i, _| number(&normal[i]));
    // The file's own normal has six digits only, and the point fits it better than the offset.
    let point = &json["global"]["point"];
    let point = Point::from(Vector::from_fn(|i, _| number(&point[i])));
    let plane = Plane::through(&point, normal.normalize());
    Some((load(&model(name)?), plane))
}

fn angle_degrees(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}

#[test]
fn exact_shapes_are_at_the_tessellation_floor() {
    for (name, floor) in [
        ("truth/spot_exact.obj", 0.001),
        ("truth/suzanne_exact_open.off", 0.001),
        ("truth/spot_retess.obj", 0.02),
        ("3d/face_head.obj", 0.003),
    ] {
        let Some(path) = model(name) else { continue };
        let a = measured(&load(&path));
        assert!(a.mean < floor, "{name}: {a:?}");
        assert!(a.also_near.is_empty(), "{name}: {a:?}");
    }
}

#[test]
fn figures_of_the_models() {
    for (name, low, high) in [
        ("3d/bunny.obj", 2.00, 2.06),
        ("3d/homer.obj", 0.040, 0.045),
        ("3d/cheburashka.obj", 0.34, 0.38),
        ("3d/bull.off", 2.2, 2.3),
        ("3d/fertility.off", 0.24, 0.26),
    ] {
        let Some(path) = model(name) else { continue };
        let a = measured(&load(&path));
        assert!((low..high).contains(&a.mean), "{name}: {a:?}");
        assert!(a.mean <= a.rms && a.p95 <= a.p99 && a.p99 <= a.max, "{a:?}");
    }
}

#[test]
fn known_planes_are_found_wherever_the_shape_is_put() {
    let motions = [
        (Vector::zeros(), 1.0, Vector::zeros()),
        (
            Vector::new(0.3, -1.1, 2.0),
            1e-3,
            Vector::new(1.0, -2.0, 0.4),
        ),
        (
            Vector::new(-2.0, 0.7, 0.2),
            40.0,
            Vector::new(-0.2, 3.0, 1.0),
        ),
    ];
    for name in [
        "truth/spot_exact.obj",
        "truth/spot_retess.obj",
        "truth/suzanne_exact_open.off",
    ] {
        let Some((mesh, plane)) = truth(name) else {
            continue;
        };
        for (omega, scale, direction) in motions {
            let shift = direction.normalize_or_zero() * 1000.0 * mesh.diagonal() * scale;
            let moved = placed(&mesh, omega, scale, shift);
            let foot = Point::from(plane.normal * plane.offset);
            let ends = placed(
                &Mesh::from_triangles(vec![foot, foot + plane.normal], vec![[0, 1, 0]]),
                omega,
                scale,
                shift,
            );
            let (expected_foot, tip) = (ends.positions[0], ends.positions[1]);
            let expected = (tip - expected_foot).normalize();
            let a = measured(&moved);
            let found = Vector::from(a.plane.normal);
            let angle = angle_degrees(&expected, &found);
            assert!(angle < 0.2, "{name}: {angle} degrees off");
            // The planes must also agree where the shape is, not only in direction.
            let center = Working::new(&moved).unwrap().normalization.center;
            let off = found.dot(&center.coords) - a.plane.offset;
            let expected_off =
                (center - expected_foot).dot(&expected) * found.dot(&expected).signum();
            let error = (off - expected_off).abs() / moved.diagonal();
            assert!(error < 1e-3, "{name}: offset {error} of D off");
        }
    }
}

trait NormalizeOrZero {
    fn normalize_or_zero(&self) -> Self;
}

impl NormalizeOrZero for Vector {
    fn normalize_or_zero(&self) -> Self {
        self.try_normalize(0.0).unwrap_or_else(Vector::zeros)
    }
}

#[test]
fn the_measure_does_not_depend_on_place_turn_or_unit() {
    for name in ["3d/cheburashka.obj", "truth/cow_sbend_noise.obj"] {
        let Some(path) = model(name) else { continue };
        let mesh = load(&path);
        let still = measured(&mesh).mean * mesh.diagonal();
        for (omega, scale) in [
            (Vector::new(0.4, 0.1, -0.9), 0.01),
            (Vector::new(-1.0, 2.0, 0.3), 250.0),
        ] {
            let shift = Vector::new(3.0, -1.0, 2.0) * mesh.diagonal() * scale;
            let moved = placed(&mesh, omega, scale, shift);
            // D itself changes with a turn; the distances do not.
            let mean = measured(&moved).mean * moved.diagonal() / scale;
            assert!((mean / still - 1.0).abs() < 2e-3, "{name}: {still} {mean}");
        }
    }
}

#[test]
fn equal_planes_are_listed() {
    let mut cube = load_cube();
    let a = measured(&cube);
    assert!(a.mean < 1e-6, "{a:?}");
    assert_eq!(a.also_near.len(), 8, "a cube has nine mirror planes: {a:?}");
    // A box of three lengths has three.
    for p in &mut cube.positions {
        p.y *= 1.3;
        p.z *= 1.7;
    }
    let a = measured(&cube);
    assert!(a.mean < 1e-6, "{a:?}");
    assert_eq!(a.also_near.len(), 2, "{a:?}");
    assert!(!measured(&sphere(4)).also_near.is_empty());
}

/// A cube of side 2 with a fine grid on each side.
fn load_cube() -> Mesh {
    let (n, mut mesh) = (8_u32, Mesh::default());
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let base = mesh.positions.len() as u32;
            let flat = planar_grid(n);
            for p in &flat.positions {
                let mut x = Vector::zeros();
                x[axis] = side;
                x[(axis + 1) % 3] = p.x * 2.0 - 1.0;
                x[(axis + 2) % 3] = p.y * 2.0 - 1.0;
                mesh.positions.push(Point::from(x));
            }
            for polygon in flat.polygons.iter() {
                let mut corners: Vec<u32> = polygon.iter().map(|v| v + base).collect();
                if side < 0.0 {
                    corners.reverse();
                }
                mesh.polygons.push(&corners);
            }
        }
    }
    mesh
}

#[test]
fn a_better_candidate_is_used_and_a_worse_one_does_no_harm() {
    let Some(path) = model("truth/cow_sbend_noise.obj") else {
        return;
    };
    let (w, d) = working(&load(&path));
    let ctx = Context::new(7);
    let alone = asymmetry(&w.surface, d, &[], &ctx).unwrap();
    let nonsense = Plane {
        normal: Vector::new(0.6, 0.8, 0.0),
        offset: 5.0,
    };
    let helped = asymmetry(&w.surface, d, &[nonsense, alone.plane], &ctx).unwrap();
    assert!(helped.mean <= alone.mean * (1.0 + 1e-3));
}

#[test]
fn flat_and_unmeasurable_shapes() {
    // A planar sheet is its own mirror image in its plane, and in two more.
    let sheet = measured(&planar_grid(12));
    assert!(sheet.mean < 1e-9, "{sheet:?}");
    let (w, _) = working(&sphere(1));
    assert!(asymmetry(&w.surface, 0.0, &[], &Context::new(0)).is_err());
    let broken = vec![Point::new(f64::NAN, 0.0, 0.0); w.surface.positions.len()];
    let broken = w.surface.with_positions(broken);
    assert!(asymmetry(&broken, 1.0, &[], &Context::new(0)).is_err());
    let cancel = symmetrizer::CancelToken::default();
    cancel.cancel();
    let ctx = Context::with_sink(0, cancel, |_| {});
    assert!(matches!(
        asymmetry(&w.surface, 1.0, &[], &ctx),
        Err(symmetrizer::Error::Cancelled)
    ));
}

#[test]
fn the_same_bits_with_one_and_two_threads() {
    let Some(path) = model("3d/cheburashka.obj") else {
        return;
    };
    let mesh = load(&path);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| format!("{:?}", measured(&mesh)))
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn distances_per_vertex_agree_with_the_mean() {
    if let Some((mesh, plane)) = truth("truth/spot_exact.obj") {
        let (w, d) = working(&mesh);
        let plane = Plane::through(
            &w.normalization
                .to_working(&Point::from(plane.normal * plane.offset)),
            plane.normal,
        );
        let worst = per_vertex(&w.surface, d, &plane)
            .into_iter()
            .fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
    }
    let Some(path) = model("3d/cheburashka.obj") else {
        return;
    };
    let (w, d) = working(&load(&path));
    let a = asymmetry(&w.surface, d, &[], &Context::new(7)).unwrap();
    let distances = per_vertex(&w.surface, d, &a.plane);
    let sum: f64 = distances
        .iter()
        .zip(&w.surface.vertex_areas)
        .map(|(d, a)| d * a)
        .sum();
    assert!((sum / w.surface.area() / a.mean - 1.0).abs() < 0.03);
}
