//! All kinds of symmetry on shapes that were built with them, wherever they are put.
#![allow(clippy::print_stdout)]
mod common;

use common::{data, load, placed};
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::Mesh;
use symmetrizer::slip::Slip;
use symmetrizer::transform::Class;
use symmetrizer::{Context, Detected, Params, detect_in};

/// Rotation vector, scale and shift under which a shape is looked at, each with its own seed.
fn placements() -> [(Vector, f64, Vector); 2] {
    [
        (Vector::zeros(), 1.0, Vector::zeros()),
        (
            Vector::new(-2.1, 0.3, 1.1),
            1e3,
            Vector::new(-5e4, 1e4, 3e4),
        ),
    ]
}

fn detected(mesh: &Mesh, seed: u64) -> Detected {
    detect_in(mesh, &Params::default(), &mut Context::new(seed)).expect("detection")
}

fn truth(name: &str) -> serde_json::Value {
    let path = data(name).expect("beside the model");
    let path = path.with_extension("truth.json");
    serde_json::from_str(&std::fs::read_to_string(path).expect("a truth file")).expect("JSON")
}

fn number(v: &serde_json::Value) -> f64 {
    v.as_f64().expect("a number")
}

/// A direction of the truth's rest coordinates in those of the file.
fn in_file(truth: &serde_json::Value, axis: usize) -> Vector {
    Vector::from_fn(|r, _| number(&truth["placement"][r][axis])).normalize()
}

fn degrees(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}

#[test]
fn a_chiral_flower_is_c5_and_has_no_mirror() {
    let name = "truth/rot5_chiral.ply";
    let Some(path) = data(name) else { return };
    let axis = in_file(&truth(name), 2);
    for (seed, (omega, scale, shift)) in (1..).zip(placements()) {
        let found = detected(&placed(&load(&path), omega, scale, shift), seed);
        let group = &found.detection.groups[0];
        assert_eq!((group.name.as_str(), group.order), ("C5", 5));
        let error = degrees(
            &group.axis.expect("an axis"),
            &(exp_rotation(&omega) * axis),
        );
        println!("seed {seed}: axis {error:.3} degrees");
        assert!(error < 0.5, "{error}");
        assert!(found.symmetries().iter().all(|s| s.class == Class::Proper));
    }
}

#[test]
fn five_pieces_are_one_row() {
    let name = "truth/row5_translation.ply";
    let Some(path) = data(name) else { return };
    let truth = truth(name);
    let step = Vector::from_fn(|r, _| 1.35 * number(&truth["placement"][r][0]));
    for (seed, (omega, scale, shift)) in (1..).zip(placements()) {
        let found = detected(&placed(&load(&path), omega, scale, shift), seed);
        let groups = &found.detection.groups;
        assert_eq!(groups.len(), 1);
        assert_eq!(
            (groups[0].name.as_str(), groups[0].orbit.len()),
            ("row 5", 5)
        );
        let moved = groups[0].step.expect("a step").translation;
        let moved = moved * found.working.normalization.scale;
        let wanted = exp_rotation(&omega) * step * scale;
        let error = (moved - wanted).norm().min((moved + wanted).norm()) / wanted.norm();
        println!("seed {seed}: step off by {error:.4} of itself");
        assert!(error < 0.01, "{error}");
    }
}

#[test]
fn three_planes_are_the_group_of_a_box() {
    let name = "truth/three_planes_superellipsoid.ply";
    let Some(path) = data(name) else { return };
    let truth = truth(name);
    for (seed, (omega, scale, shift)) in (1..).zip(placements()) {
        let found = detected(&placed(&load(&path), omega, scale, shift), seed);
        let group = &found.detection.groups[0];
        assert_eq!((group.name.as_str(), group.order), ("D2h", 8));
        let mirrors: Vec<_> = found
            .symmetries()
            .iter()
            .filter(|s| s.class == Class::Mirror)
            .collect();
        assert_eq!(mirrors.len(), 3);
        for axis in 0..3 {
            let normal = exp_rotation(&omega) * in_file(&truth, axis);
            let errors = mirrors.iter().map(|s| degrees(&s.plane().normal, &normal));
            let error = errors.fold(90.0, f64::min);
            assert!(error < 0.2, "plane {axis}: {error} degrees");
        }
    }
}

#[test]
fn a_vase_has_one_axis_and_no_planes() {
    let name = "truth/vase_continuous.ply";
    let Some(path) = data(name) else { return };
    let axis = in_file(&truth(name), 2);
    for (seed, (omega, scale, shift)) in (1..).zip(placements()) {
        let found = detected(&placed(&load(&path), omega, scale, shift), seed);
        let continuous = &found.detection.continuous;
        assert_eq!(continuous.len(), 1);
        assert_eq!(continuous[0].slip, Slip::Revolution);
        let error = degrees(&continuous[0].axis.unwrap(), &(exp_rotation(&omega) * axis));
        assert!(error < 0.3, "{error} degrees");
        assert!(found.symmetries().is_empty(), "a swarm of planes");
    }
}

#[test]
fn six_copies_on_a_plate_are_found_with_all_their_motions() {
    let name = "truth/design_six_samemesh.obj";
    let Some(path) = data(name) else { return };
    let truth = truth(name);
    let mesh = load(&path);
    let found = detected(&mesh, 0);
    let group = &found.detection.groups[0];
    assert_eq!((group.name.as_str(), group.orbit.len()), ("6 copies", 6));
    let element: Vec<i64> = truth["vertex_element"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|v| v.as_i64().expect("an index"))
        .collect();
    let normalization = &found.working.normalization;
    for pair in truth["pairwise"].as_array().expect("a list") {
        let (a, b) = (&pair["a"], &pair["b"]);
        let at = |r: usize, c: usize| number(&pair["transform_a_to_b"][r][c]);
        let image = |p: &Point| {
            let row = |r: usize| at(r, 0) * p.x + at(r, 1) * p.y + at(r, 2) * p.z + at(r, 3);
            normalization.to_working(&Point::new(row(0), row(1), row(2)))
        };
        let corners: Vec<(Point, Point)> = mesh
            .positions
            .iter()
            .zip(&element)
            .filter(|(_, e)| Some(**e) == a.as_i64())
            .map(|(p, _)| (normalization.to_working(p), image(p)))
            .collect();
        let best = found
            .symmetries()
            .iter()
            .flat_map(|s| [s.q_from_p, s.q_from_p.inverse()])
            .map(|t| {
                let squares = corners.iter().map(|(p, q)| (t.apply(p) - q).norm_squared());
                (squares.sum::<f64>() / corners.len() as f64).sqrt()
            })
            .fold(f64::INFINITY, f64::min);
        assert!(best < 0.008, "{a} to {b}: {best} of L");
    }
}

#[test]
fn a_bumpy_cube_has_the_whole_group_of_the_cube() {
    let Some(path) = data("3d/bumpy_cube.obj") else {
        return;
    };
    let found = detected(&load(&path), 0);
    let group = &found.detection.groups[0];
    assert_eq!((group.name.as_str(), group.order), ("Oh", 48));
}

#[test]
fn a_shape_without_symmetry_has_none_of_any_kind() {
    let Some(path) = data("truth/control_asymmetric_blob.ply") else {
        return;
    };
    let mesh = load(&path);
    for (seed, (omega, scale, shift)) in (1..).zip(placements()) {
        let found = detected(&placed(&mesh, omega, scale, shift), seed);
        assert!(found.symmetries().is_empty(), "seed {seed}");
        assert!(found.detection.continuous.is_empty() && found.detection.groups.is_empty());
    }
}
