//! Continuous symmetries of shapes that slide in known ways, and of shapes that do not slide.
#![allow(clippy::print_stdout)]
mod common;

use std::f64::consts::{PI, TAU};

use common::{data, load, noisy, placed, sphere, union};
use symmetrizer::Context;
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::sample::{SampleParams, Samples, sample};
use symmetrizer::shape::Mesh;
use symmetrizer::shape::working::Working;
use symmetrizer::slip::{Continuous, Slip, SlipParams, continuous};
use symmetrizer::transform::{Isometry, Plane};

/// The parts found, lengths in working units, and what they were found with.
struct Slides {
    working: Working,
    samples: Samples,
    parts: Vec<Continuous>,
    diagonal: f64,
}

fn slides(mesh: &Mesh, seed: u64) -> Slides {
    let (working, diagonal) = common::working(mesh);
    let mut ctx = Context::new(seed);
    let samples = sample(&working.surface, &SampleParams::default(), &mut ctx).expect("samples");
    let parts = continuous(&samples, &SlipParams::default());
    for c in &parts {
        println!("{:?} {:.3} rms {:.4}", c.slip, c.area_fraction, c.rms);
    }
    Slides {
        working,
        samples,
        parts,
        diagonal,
    }
}

impl Slides {
    /// Angle (degrees) to `axis` and distance (% of D) of the axis of part `k` from `point`, both given in
    /// the mesh's coordinates.
    fn error(&self, k: usize, axis: &Vector, point: &Point) -> (f64, f64) {
        let found = &self.parts[k];
        let direction = found.axis.expect("an axis");
        let angle = direction
            .cross(axis)
            .norm()
            .atan2(direction.dot(axis).abs());
        let at = self.working.normalization.to_working(point);
        let away = (at - found.point).cross(&direction).norm();
        (angle.to_degrees(), 100.0 * away / self.diagonal)
    }
}

/// A grid of `rows` x `columns` quads over x(u, v), u and v from 0 to 1; closed in v where the ends
/// meet.
fn grid(rows: u32, columns: u32, x: impl Fn(f64, f64) -> Vector) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=rows {
        for j in 0..=columns {
            let (u, v) = (
                f64::from(i) / f64::from(rows),
                f64::from(j) / f64::from(columns),
            );
            mesh.positions.push(Point::from(x(u, v)));
        }
    }
    let at = |i: u32, j: u32| i * (columns + 1) + j;
    for i in 0..rows {
        for j in 0..columns {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.polygons.push(&quad);
        }
    }
    mesh
}

/// The profile (r, z) turned about the z axis, each of its straight pieces cut into `rows`.
fn turned(profile: &[[f64; 2]], rows: u32) -> Mesh {
    let pieces = profile.windows(2).map(|ends| {
        let [a, b] = [ends[0], ends[1]];
        grid(rows, 72, |u, v| {
            let (r, z) = (a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]));
            let (sin, cos) = (TAU * v).sin_cos();
            Vector::new(r * cos, r * sin, z)
        })
    });
    pieces.reduce(|a, b| union(&a, &b)).expect("two points")
}

/// The profile (x, y), a loop, drawn along z from 0 to `height`, without lids.
fn drawn(profile: &[[f64; 2]], height: f64) -> Mesh {
    let sides = (0..profile.len()).map(|k| {
        let (a, b) = (profile[k], profile[(k + 1) % profile.len()]);
        grid(10, 20, |u, v| {
            Vector::new(
                a[0] + u * (b[0] - a[0]),
                a[1] + u * (b[1] - a[1]),
                v * height,
            )
        })
    });
    sides.reduce(|a, b| union(&a, &b)).expect("a profile")
}

fn rectangle(x: [f64; 2], y: [f64; 2], z: f64) -> Mesh {
    grid(14, 14, |u, v| {
        Vector::new(x[0] + u * (x[1] - x[0]), y[0] + v * (y[1] - y[0]), z)
    })
}

/// A tube of radius `r` about the curve.
fn tube(r: f64, rows: u32, curve: impl Fn(f64) -> Vector) -> Mesh {
    grid(rows, 20, |u, v| {
        let along = (curve(u + 1e-5) - curve(u - 1e-5)).normalize();
        let side = along.cross(&Vector::z()).normalize();
        let (sin, cos) = (TAU * v).sin_cos();
        curve(u) + r * (cos * side + sin * side.cross(&along))
    })
}

fn stretched(mesh: &Mesh, by: [f64; 3]) -> Mesh {
    let mut other = mesh.clone();
    for p in &mut other.positions {
        *p = Point::new(p.x * by[0], p.y * by[1], p.z * by[2]);
    }
    other
}

fn tin(radius: f64, height: f64) -> Mesh {
    turned(
        &[[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]],
        12,
    )
}

/// The one part found, of a kind and a least share of the area.
fn assert_one(name: &str, mesh: &Mesh, slip: Slip, share: f64) -> Slides {
    println!("{name}");
    let found = slides(mesh, 3);
    assert_eq!(found.parts.len(), 1, "{name}: {:?}", kinds(&found));
    assert_eq!(found.parts[0].slip, slip, "{name}");
    let area = found.parts[0].area_fraction;
    assert!(area >= share, "{name}: {area}");
    found
}

fn kinds(found: &Slides) -> Vec<(Slip, f64)> {
    found
        .parts
        .iter()
        .map(|c| (c.slip, c.area_fraction))
        .collect()
}

fn assert_axis(found: &Slides, k: usize, axis: Vector, point: Point) {
    let (angle, away) = found.error(k, &axis, &point);
    println!("    {angle:.3} degrees, {away:.3} % of D");
    assert!(angle <= 0.3 && away <= 0.2, "{angle} degrees, {away} %");
}

#[test]
fn turned_shapes_turn() {
    let torus = grid(36, 80, |u, v| {
        let (tube, ring) = (TAU * u, TAU * v);
        let r = 1.0 + 0.35 * tube.cos();
        Vector::new(r * ring.cos(), r * ring.sin(), 0.35 * tube.sin())
    });
    let cone = turned(&[[0.0, 1.8], [1.0, 0.0], [0.0, 0.0]], 24);
    let ring: Vec<[f64; 2]> = (0..=24)
        .map(|k| {
            let (sin, cos) = (PI * f64::from(k) / 48.0).sin_cos();
            [cos, sin]
        })
        .collect();
    let lid = turned(&[[0.0, 0.0], [1.0, 0.0]], 16);
    let half_ball = union(&turned(&ring, 1), &lid);
    let shaft = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 0.4],
        [0.5, 0.4],
        [0.5, 2.0],
        [0.3, 2.2],
        [0.0, 2.2],
    ];
    let shaft = turned(&shaft, 8);
    for (name, mesh, slip) in [
        ("torus", torus, Slip::Revolution),
        ("cone", cone, Slip::Revolution),
        ("half a ball with its lid", half_ball, Slip::Revolution),
        ("tin", tin(1.0, 1.5), Slip::Revolution),
        ("shaft", shaft, Slip::Revolution),
        (
            "pipe",
            turned(&[[0.5, 0.0], [0.5, 2.0]], 30),
            Slip::Cylinder,
        ),
        (
            "spheroid",
            stretched(&sphere(5), [1.0, 1.0, 1.03]),
            Slip::Revolution,
        ),
    ] {
        let found = assert_one(name, &mesh, slip, 0.97);
        if name == "spheroid" {
            // A turn about a wrong axis moves it off itself by a thousandth only.
            assert!(found.error(0, &Vector::z(), &Point::origin()).0 < 8.0);
        } else {
            assert_axis(&found, 0, Vector::z(), Point::origin());
        }
    }
}

#[test]
fn a_ball_turns_about_its_middle() {
    let found = assert_one("ball", &sphere(5), Slip::Sphere, 0.99);
    let middle = found.working.normalization.to_working(&Point::origin());
    assert!((found.parts[0].point - middle).norm() < 1e-3);
}

/// The handle, a fifth of the surface, neither hides nor joins what turns.
#[test]
fn a_handle_does_not_hide_the_mug() {
    let mug = turned(
        &[
            [0.0, 0.1],
            [0.9, 0.1],
            [0.9, 2.0],
            [1.0, 2.0],
            [1.0, 0.0],
            [0.0, 0.0],
        ],
        14,
    );
    let handle = tube(0.12, 40, |u| {
        let (sin, cos) = (PI * (u - 0.5)).sin_cos();
        Vector::new(0.98 + 0.8 * cos, 0.0, 1.0 + 0.7 * sin)
    });
    let found = slides(&union(&mug, &handle), 3);
    assert_eq!(found.parts[0].slip, Slip::Revolution, "{:?}", kinds(&found));
    assert!(found.parts[0].area_fraction > 0.85);
    assert_axis(&found, 0, Vector::z(), Point::origin());
}

#[test]
fn an_l_shaped_bar_is_drawn() {
    let l = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 0.3],
        [0.3, 0.3],
        [0.3, 1.2],
        [0.0, 1.2],
    ];
    let lids = [0.0, 3.0].map(|z| {
        union(
            &rectangle([0.0, 1.0], [0.0, 0.3], z),
            &rectangle([0.0, 0.3], [0.3, 1.2], z),
        )
    });
    let bar = union(&drawn(&l, 3.0), &union(&lids[0], &lids[1]));
    let found = assert_one("bar", &bar, Slip::Extrusion, 0.85);
    let (angle, _) = found.error(0, &Vector::z(), &Point::origin());
    assert!(angle < 0.3, "{angle}");
    assert!(found.parts[0].area_fraction < 0.95, "the lids do not slide");
}

#[test]
fn a_spring_is_screwed() {
    let spring = tube(0.12, 240, |u| {
        let (sin, cos) = (3.0 * TAU * u).sin_cos();
        Vector::new(cos, sin, 1.5 * u)
    });
    let found = assert_one("spring", &spring, Slip::Helix, 0.95);
    assert_axis(&found, 0, Vector::z(), Point::origin());
    let axis = found.parts[0].axis.expect("an axis");
    let pitch = found.parts[0].pitch * found.working.normalization.scale;
    // A facet's half width is seen as some hundredths of a degree of slope.
    assert!((pitch - 0.5 / TAU).abs() < 0.004, "{pitch} along {axis:?}");
}

/// A box: its sides are drawn and its lids flat, or all are flat; nothing else.
#[test]
fn a_box_is_flat_or_drawn() {
    let sides = drawn(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.2], [0.0, 1.2]], 1.5);
    let lids = [0.0, 1.5].map(|z| rectangle([0.0, 1.0], [0.0, 1.2], z));
    let found = slides(&union(&sides, &union(&lids[0], &lids[1])), 3);
    assert!(!found.parts.is_empty());
    for c in &found.parts {
        assert!(
            matches!(c.slip, Slip::Plane | Slip::Extrusion),
            "{:?}",
            kinds(&found)
        );
    }
    let area: f64 = found.parts.iter().map(|c| c.area_fraction).sum();
    assert!(area > 0.95, "{area}");
}

/// A plate with a hole is flat, above and below, not turned.
#[test]
fn a_hole_does_not_make_a_plate_turn() {
    let plate = [
        rectangle([1.0, -1.0], [-1.0, 1.0], 0.0),
        rectangle([-1.0, 1.0], [-1.0, 1.0], 0.1),
    ];
    let hole = turned(&[[0.2, 0.0], [0.2, 0.1]], 4);
    let found = slides(&union(&union(&plate[0], &plate[1]), &hole), 3);
    assert_eq!(found.parts.len(), 2, "{:?}", kinds(&found));
    assert!(found.parts.iter().all(|c| c.slip == Slip::Plane));
}

#[test]
fn ellipsoids_with_three_axes_do_not_slide() {
    for by in [[1.0, 1.03, 1.06], [1.0, 1.2, 1.5], [1.0, 1.1, 2.5]] {
        let found = slides(&stretched(&sphere(5), by), 3);
        assert!(found.parts.is_empty(), "{by:?}: {:?}", kinds(&found));
    }
}

#[test]
fn shapes_that_do_not_slide() {
    for name in [
        "truth/control_asymmetric_blob.ply",
        "truth/rot5_chiral.ply",
        "truth/three_planes_superellipsoid.ply",
        "truth/spot_exact.obj",
        "truth/spot_noise.ply",
        "truth/human_rest_arm_spine.ply",
        "3d/bunny.obj",
        "3d/armadillo.ply",
        "3d/cow.obj",
        "3d/face_igea.ply",
        "3d/homer.obj",
        "3d/dragon.ply",
    ] {
        let Some(path) = data(name) else { return };
        for seed in 1..=3 {
            let found = slides(&load(&path), seed);
            assert!(found.parts.is_empty(), "{name}: {:?}", kinds(&found));
        }
    }
}

/// The vase's axis and a point of it, in the coordinates of its file.
fn axis_of_vase() -> Option<(Mesh, Vector, Point)> {
    let path = data("truth/vase_continuous.ply")?;
    let text = std::fs::read_to_string(path.with_extension("truth.json")).expect("a truth file");
    let json: serde_json::Value = serde_json::from_str(&text).expect("valid JSON");
    let number = |v: &serde_json::Value| v.as_f64().expect("a number");
    let vector = |v: &serde_json::Value| Vector::from_fn(|i, _| number(&v[i]));
    let rows = &json["placement"];
    let linear = |x: Vector| Vector::from_fn(|i, _| vector(&rows[i]).dot(&x));
    let shift = Vector::from_fn(|i, _| number(&rows[i][3]));
    let axis = linear(vector(&json["axis"])).normalize();
    let point = Point::from(linear(vector(&json["point"])) + shift);
    Some((load(&path), axis, point))
}

#[test]
fn the_vase_turns_about_its_axis_in_any_pose_and_with_noise() {
    let Some((vase, axis, point)) = axis_of_vase() else {
        return;
    };
    let poses = [
        (Vector::zeros(), 1.0, Vector::zeros()),
        (
            Vector::new(0.4, -1.3, 0.8),
            1e-3,
            Vector::new(0.1, 2.0, -1.0),
        ),
        (
            Vector::new(-2.1, 0.3, 1.1),
            1e3,
            Vector::new(-5e4, 1e4, 3e4),
        ),
    ];
    for (noise, share, angle, away) in [
        (0.0, 0.97, 0.3, 0.2),
        (0.0005, 0.97, 0.3, 0.2),
        (0.001, 0.97, 0.3, 0.2),
        (0.002, 0.97, 0.3, 0.2),
        (0.005, 0.95, 0.4, 0.2),
        (0.01, 0.9, 0.9, 0.3),
    ] {
        for (seed, (omega, scale, shift)) in (1..).zip(poses) {
            let moved = placed(
                &noisy(&vase, noise * vase.diagonal(), seed),
                omega,
                scale,
                shift,
            );
            let r = exp_rotation(&omega);
            let found = slides(&moved, seed);
            assert!(!found.parts.is_empty(), "noise {noise}");
            let on = Point::from(r * point.coords * scale + shift);
            let (a, d) = found.error(0, &(r * axis), &on);
            println!("noise {noise}: {a:.3} degrees, {d:.3} % of D");
            assert_eq!(found.parts[0].slip, Slip::Revolution, "{:?}", kinds(&found));
            assert!(found.parts[0].area_fraction >= share, "{:?}", kinds(&found));
            assert!(a <= angle && d <= away, "noise {noise}: {a} degrees, {d} %");
        }
    }
}

/// The coupling's axis is the largest part's; what else is found turns about an axis along it or
/// is flat.
#[test]
fn a_coupling_turns_about_its_axis() {
    let Some(path) = data("3d/coupling_cad.off") else {
        return;
    };
    let found = slides(&load(&path), 3);
    assert_eq!(found.parts[0].slip, Slip::Revolution);
    assert!(found.parts[0].area_fraction > 0.5, "{:?}", kinds(&found));
    let axis = found.parts[0].axis.expect("an axis");
    for c in &found.parts {
        let other = c.axis.expect("an axis");
        assert!(other.cross(&axis).norm() < 0.01 || c.slip == Slip::Plane);
    }
}

/// The same samples give the same parts to the last bit.
#[test]
fn parts_are_deterministic() {
    let mesh = tin(1.0, 1.5);
    let (a, b) = (slides(&mesh, 5), slides(&mesh, 5));
    assert_eq!(format!("{:?}", a.parts), format!("{:?}", b.parts));
}

/// Turns about `axis` through `point`, or the mirror across it.
fn about(axis: Vector, point: Point, angle: f64) -> Isometry {
    let linear = exp_rotation(&(axis * angle));
    Isometry {
        linear,
        translation: point.coords - linear * point.coords,
    }
}

fn shift(by: Vector) -> Isometry {
    Isometry {
        translation: by,
        ..Isometry::identity()
    }
}

/// What a slide implies, and what it does not.
#[test]
fn slides_imply_their_own_isometries() {
    let z = Vector::z();
    let tin = slides(&tin(1.0, 1.5), 3);
    let pipe = slides(&turned(&[[0.5, 0.0], [0.5, 2.0]], 30), 3);
    let ball = slides(&sphere(5), 3);
    let implied = |s: &Slides, t: &Isometry| s.parts[0].implies(t, &s.samples, 0.005);
    let middle = tin.parts[0].point;
    let along = Isometry::mirror(&Plane::through(&middle, Vector::new(0.6, 0.8, 0.0)));
    let across = Isometry::mirror(&Plane::through(&middle, z));
    let half_turn = about(Vector::x(), middle, PI);
    for (name, t, of_tin, of_pipe) in [
        ("turn", about(z, middle, 1.1), true, true),
        ("mirror along", along, true, true),
        ("mirror across", across, false, true),
        ("half-turn", half_turn, false, true),
        ("shift", shift(z * 0.2), false, true),
        ("shift aside", shift(Vector::x() * 0.05), false, false),
        ("tilt", about(Vector::x(), middle, 0.1), false, false),
    ] {
        assert_eq!(implied(&tin, &t), of_tin, "tin: {name}");
        assert_eq!(implied(&pipe, &t), of_pipe, "pipe: {name}");
    }
    let middle = ball.parts[0].point;
    assert!(implied(
        &ball,
        &about(Vector::new(0.6, 0.0, 0.8), middle, 2.0)
    ));
    assert!(!implied(&ball, &shift(z * 0.05)));
}
