//! What a whole run must reach on real models: symmetric, close to the input, whatever the pose.

mod common;

use common::{load, model, placed};
use symmetrizer::geom::Vector;
use symmetrizer::optimize::{Outcome, Step};
use symmetrizer::straighten::When;
use symmetrizer::transform::Kind;
use symmetrizer::{Context, Mesh, Params, Symmetrized, symmetrize};

fn run(mesh: &Mesh) -> Symmetrized {
    symmetrize(mesh, &Params::default(), &mut Context::new(0)).expect("a run")
}

/// rms distance of corresponding vertices, % of the diagonal.
fn rms(a: &Mesh, b: &Mesh) -> f64 {
    let pairs = a.positions.iter().zip(&b.positions);
    let sum: f64 = pairs.map(|(p, q)| (p - q).norm_squared()).sum();
    100.0 * (sum / a.positions.len() as f64).sqrt() / a.diagonal()
}

#[test]
fn the_bunny_looks_straight_ahead() {
    let Some(path) = model("3d/bunny.obj") else {
        return;
    };
    let mesh = load(&path);
    let straightened = run(&mesh);
    let steps = &straightened.report.steps;
    assert!(matches!(steps[0], Step::Straighten { .. }), "{steps:?}");
    check_bunny(&mesh, &straightened, 0.96);

    let mut params = Params::default();
    params.straighten.when = When::Never;
    let merged = symmetrize(&mesh, &params, &mut Context::new(0)).expect("a run");
    let merge = |s: &Step| matches!(s, Step::Merge { kept: true, .. });
    assert!(merged.report.steps.iter().any(merge), "body and head merge");
    check_bunny(&mesh, &merged, 0.92);
}

#[track_caller]
fn check_bunny(mesh: &Mesh, done: &Symmetrized, correlation: f64) {
    assert_eq!(done.outcome, Outcome::Converged);
    let mirrors = done.report.input.symmetries.iter();
    assert_eq!(mirrors.filter(|s| s.kind == Kind::Mirror).count(), 2);
    let before = done
        .report
        .input
        .shape
        .asymmetry
        .as_ref()
        .expect("measured");
    let result = done.report.result.as_ref().expect("a result");
    assert!(before.mean > 1.9, "{}", before.mean);
    assert!(result.asymmetry.mean <= 0.10, "{}", result.asymmetry.mean);
    let d = &result.distortion;
    assert!(1000 * d.new_crossings <= mesh.polygons.len());
    assert_eq!(d.inverted_faces, 0);
    assert!(d.curvature_correlation.expect("curved") >= correlation);
    assert_eq!(done.shape.polygons, mesh.polygons);
    assert_eq!(done.shape.positions.len(), mesh.positions.len());
}

#[test]
fn real_scans_and_sculptures_become_eight_times_more_symmetric() {
    for name in ["3d/face_igea.ply", "3d/lion_head.off", "3d/cheburashka.obj"] {
        let Some(path) = model(name) else { continue };
        let mesh = load(&path);
        let done = run(&mesh);
        let measured = done.report.input.shape.asymmetry.as_ref();
        let before = measured.expect("measured").mean;
        let result = done.report.result.as_ref().expect("a result");
        let after = result.asymmetry.mean;
        assert!(8.0 * after <= before, "{name}: {before} -> {after}");
        let d = &result.distortion;
        assert!(1000 * d.new_crossings <= mesh.polygons.len(), "{name}");
        let kept = d.curvature_correlation.expect("curved");
        assert!(kept >= 0.9, "{name}: {kept}");
    }
}

#[test]
fn what_is_symmetric_stays_where_it_is() {
    for name in ["truth/spot_exact.obj", "truth/spot_retess.obj"] {
        let Some(path) = model(name) else { continue };
        let mesh = load(&path);
        let moved = rms(&mesh, &run(&mesh).shape);
        assert!(moved <= 0.05, "{name}: {moved} % of D");
    }
}

#[test]
fn what_has_no_symmetry_is_left_alone() {
    let Some(path) = model("truth/control_asymmetric_blob.ply") else {
        return;
    };
    let mesh = load(&path);
    let done = run(&mesh);
    assert_eq!(done.outcome, Outcome::NoSymmetry);
    assert_eq!(done.shape, mesh);
}

#[test]
fn the_pose_and_the_scale_do_not_matter() {
    let Some(path) = model("truth/spot_headturn30.obj") else {
        return;
    };
    let mesh = load(&path);
    let straight = run(&mesh).shape;
    let omega = Vector::new(0.9, -1.7, 0.4);
    for scale in [1e-3, 1e3] {
        let far = Vector::new(600.0, -500.0, 620.0) * mesh.diagonal() * scale;
        let posed = run(&placed(&mesh, omega, scale, far)).shape;
        let expected = placed(&straight, omega, scale, far);
        let off = rms(&expected, &posed);
        assert!(off <= 0.1, "scale {scale}: {off} % of D");
    }
}

#[test]
fn the_dragon_is_not_left_tangled() {
    // A hind leg and the tail have no counterpart.
    let Some(path) = model("3d/dragon.ply") else {
        return;
    };
    let done = run(&load(&path));
    let result = done.report.result.as_ref().expect("a result");
    assert!(result.asymmetry.mean <= 0.6, "{}", result.asymmetry.mean);
    let d = &result.distortion;
    assert_eq!(d.inverted_faces, 0);
    assert!(d.new_crossings <= 64, "{}", d.new_crossings);
    assert!(d.curvature_correlation.expect("curved") >= 0.98);
    assert_eq!(done.report.warnings.len(), 1, "that a part is left");
}
