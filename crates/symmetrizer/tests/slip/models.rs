//! Models from files: a vase, a turned part, and shapes that do not slide.

use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::Mesh;
use symmetrizer::slip::Slip;

use crate::common::{data, load, noisy, placed};
use crate::{kinds, slides};

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
