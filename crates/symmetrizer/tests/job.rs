//! The whole job on a generated shape: what the report says is true of the document.

mod common;

use symmetrizer::geom::{Matrix3, Point, Vector};
use symmetrizer::report::{SymmetryReport, to_json};
use symmetrizer::shape::models::Creature;
use symmetrizer::{Context, Mesh, Outcome, Params, Symmetrized, detect_in, symmetrize};

fn fast() -> Params {
    let mut params = Params::default();
    params.set("sample.count", "800").unwrap();
    params.set("deform.control_faces", "1000").unwrap();
    params
}

fn creature() -> (Mesh, Symmetrized) {
    let mesh = common::placed(
        &Creature::default().mesh(),
        Vector::new(0.3, -0.2, 0.5),
        100.0,
        Vector::new(1000.0, -500.0, 20.0),
    );
    let job = symmetrize(&mesh, &fast(), &mut Context::new(3)).unwrap();
    (mesh, job)
}

#[test]
fn the_report_speaks_of_the_document() {
    let (mesh, job) = creature();
    assert_eq!(job.outcome, Outcome::Converged);
    assert_eq!(job.shape.polygons, mesh.polygons);
    let (input, result) = (&job.report.input, job.report.result.as_ref().unwrap());
    assert!((input.shape.diagonal - mesh.diagonal()).abs() < 1e-9 * mesh.diagonal());
    for s in &input.symmetries {
        check(s, &mesh, 0.1 * input.shape.diagonal);
    }
    check(
        &result.symmetries[0],
        &job.shape,
        0.03 * input.shape.diagonal,
    );
    assert!(result.symmetries[0].area_fraction > 0.9);
    // Found again, the body keeps its id, as it does where the library hands it out.
    assert_eq!(result.symmetries[0].id, input.symmetries[0].id);
    assert_eq!(job.symmetries()[0].id, result.symmetries[0].id);
    let text = to_json(&job.report).unwrap();
    let read: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(read["seed"], 3);
    assert!(read.get("run").is_none());
}

/// The matrix is the reflection in the plane and carries the patch's vertices onto their partners
/// within `tolerance`; patch and image lie on their sides.
#[track_caller]
fn check(s: &SymmetryReport, mesh: &Mesh, tolerance: f64) {
    let linear = Matrix3::from_fn(|r, c| s.matrix[r][c]);
    let shift = Vector::from_fn(|r, _| s.matrix[r][3]);
    assert_eq!(s.matrix[3], [0.0, 0.0, 0.0, 1.0]);
    assert!((linear * linear - Matrix3::identity()).norm() < 1e-12);
    let plane = s.plane.expect("a mirror has a plane");
    let normal = Vector::from(plane.normal);
    assert!(normal[normal.iamax()] > 0.0);
    assert!((linear * normal + normal).norm() < 1e-12);
    let position = |v: u32| mesh.positions[v as usize];
    let far = |&&[i, j]: &&[u32; 2]| {
        let image = Point::from(linear * position(i).coords + shift);
        (image - position(j)).norm() > tolerance
    };
    assert!(s.pairs.len() > 20);
    let wrong = s.pairs.iter().filter(far).count();
    assert!(wrong * 50 <= s.pairs.len(), "{wrong} of {}", s.pairs.len());
    let triangles: Vec<[u32; 3]> = mesh.triangles().map(|t| t.0).collect();
    let side = |&f: &u32| {
        let middle: Vector = triangles[f as usize]
            .iter()
            .map(|&v| position(v).coords / 3.0)
            .sum();
        normal.dot(&middle) - plane.offset
    };
    assert!(s.patch_faces.iter().all(|f| side(f) < 1e-6));
    assert!(s.image_faces.iter().all(|f| side(f) > -1e-6));
    let (patch, image) = (s.patch_faces.len() as f64, s.image_faces.len() as f64);
    assert!(
        (patch / image).ln().abs() < 0.2,
        "{patch} and {image} faces"
    );
}

#[test]
fn seams_and_loose_vertices_move_along_or_stay() {
    let mut mesh = Creature::at_rest().mesh();
    let rest = symmetrize(&mesh, &fast(), &mut Context::default()).unwrap();
    // A loose vertex, and a first triangle cut free at its corners.
    mesh.positions.push(Point::new(9.0, 9.0, 9.0));
    let loose = mesh.positions.len() - 1;
    let corners: Vec<u32> = mesh.polygons.get(0).to_vec();
    let base = mesh.positions.len() as u32;
    for &v in &corners {
        mesh.positions.push(mesh.positions[v as usize]);
    }
    let mut triangles: Vec<[u32; 3]> = mesh.triangles().map(|t| t.0).collect();
    triangles[0] = [base, base + 1, base + 2];
    let cut = Mesh::from_triangles(mesh.positions, triangles);
    let job = symmetrize(&cut, &fast(), &mut Context::default()).unwrap();
    let validate = job.report.input.shape.validate;
    assert_eq!((validate.unused_vertices, validate.welded_vertices), (1, 3));
    assert_eq!(job.shape.positions[loose], Point::new(9.0, 9.0, 9.0));
    for (k, &v) in corners.iter().enumerate() {
        let copy = job.shape.positions[base as usize + k];
        assert_eq!(copy, job.shape.positions[v as usize]);
    }
    let plain = &rest.shape.positions[corners[0] as usize];
    assert!((job.shape.positions[corners[0] as usize] - plain).norm() < 0.05);
}

#[test]
fn detection_alone_finds_what_the_job_finds() {
    let (mesh, job) = creature();
    let mut params = fast();
    params.set("detect.kinds", "[\"mirror\"]").unwrap();
    let found = detect_in(&mesh, &params, &mut Context::new(3)).unwrap();
    let pairs = found.symmetries().iter().zip(job.before.symmetries());
    assert_eq!(found.symmetries().len(), job.before.symmetries().len());
    // A job's patches reach further, and where parts are told apart their mirrors are fitted to them.
    for (alone, before) in pairs {
        assert_eq!(
            (alone.id, alone.height.to_bits()),
            (before.id, before.height.to_bits())
        );
        let (a, b) = (alone.plane(), before.plane());
        let apart = (a.normal - b.normal).norm() + (a.offset - b.offset).abs();
        assert!(apart < 1e-4, "{a:?} and {b:?}");
    }
}

#[test]
fn a_cancelled_job_stops_before_its_first_stage() {
    let cancel = symmetrizer::CancelToken::default();
    cancel.cancel();
    let mut stages = 0;
    let mut ctx = Context::with_sink(0, cancel, |_| stages += 1);
    let result = symmetrize(&Creature::default().mesh(), &fast(), &mut ctx);
    assert!(matches!(result, Err(symmetrizer::Error::Cancelled)));
    drop(ctx);
    assert_eq!(stages, 0);
}
