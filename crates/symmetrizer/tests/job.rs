//! The whole job on a generated shape: what the report says is true of the document.

#![allow(clippy::print_stdout)]
mod common;

use symmetrizer::deform::Stiffness;
use symmetrizer::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use symmetrizer::report::{SymmetryReport, to_json};
use symmetrizer::shape::models::Creature;
use symmetrizer::transform::{Class, Kind};
use symmetrizer::{
    Context, Error, Mesh, Outcome, Params, Symmetrized, detect_in, symmetrize, symmetrize_with,
};

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
    let mirrors = input.symmetries.iter();
    for s in mirrors.filter(|s| s.kind == Kind::Mirror && s.area_fraction > 0.2) {
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
    // A job looks for all kinds.
    let mirrors = job.before.symmetries().iter();
    let mirrors: Vec<_> = mirrors.filter(|s| s.class == Class::Mirror).collect();
    assert!(found.symmetries().len() <= mirrors.len());
    let pairs = found.symmetries().iter().zip(mirrors);
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

/// rms distance of `moved` from the rigid motion that takes `rest` nearest to it.
fn bent(rest: &[Point], moved: &[Point]) -> f64 {
    let mean = |x: &[Point]| x.iter().map(|p| p.coords).sum::<Vector>() / x.len() as f64;
    let (a, b) = (mean(rest), mean(moved));
    let pairs = || {
        rest.iter()
            .zip(moved)
            .map(|(x, y)| (x.coords - a, y.coords - b))
    };
    let spread = pairs().map(|(x, y)| y * x.transpose()).sum::<Matrix3>();
    let turn = nearest_orthogonal(&spread, false);
    let away: f64 = pairs().map(|(x, y)| (y - turn * x).norm_squared()).sum();
    (away / rest.len() as f64).sqrt()
}

#[test]
fn a_stiff_region_is_left_in_shape() {
    let mesh = Creature::default().mesh();
    // The soft rest takes up what the back third would have had to give.
    let low = mesh.positions.iter().map(|x| x.x).fold(f64::MAX, f64::min);
    let third = low + 0.33 * (mesh.positions.iter().map(|x| x.x).fold(f64::MIN, f64::max) - low);
    let stiff: Vec<bool> = mesh.positions.iter().map(|x| x.x < third).collect();
    let field = |k: f64| {
        let values = stiff.iter().map(|s| if *s { k } else { 1.0 });
        Stiffness::Vertices(values.collect())
    };
    let bent = |stiffness: &Stiffness| {
        let job = symmetrize_with(&mesh, stiffness, &fast(), &mut Context::new(3)).unwrap();
        assert!(job.report.result.unwrap().asymmetry.mean < 0.2);
        let pick = |x: &[Point]| {
            let of = x.iter().zip(&stiff).filter(|(_, s)| **s);
            of.map(|(x, _)| *x).collect::<Vec<Point>>()
        };
        bent(&pick(&mesh.positions), &pick(&job.shape.positions)) / mesh.diagonal()
    };
    let (usual, firm) = (bent(&Stiffness::default()), bent(&field(100.0)));
    println!("bent by {usual:.5} of D, stiff {firm:.5}");
    assert!(firm < 0.5 * usual, "{usual} {firm}");
}

#[test]
fn a_stiffness_that_does_not_fit_is_refused() {
    let mesh = Creature::default().mesh();
    let n = mesh.positions.len();
    for bad in [
        Stiffness::Uniform(0.0),
        Stiffness::Uniform(f64::NAN),
        Stiffness::Vertices(vec![1.0; n - 1]),
        Stiffness::Polygons(vec![1.0; n]),
        Stiffness::Vertices(vec![-1.0; n]),
    ] {
        let result = symmetrize_with(&mesh, &bad, &fast(), &mut Context::default());
        assert!(matches!(result, Err(Error::Params { .. })));
    }
}

#[test]
fn stiffness_is_read_from_a_property_and_from_json() {
    let corners = "0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n";
    let text = format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         property float stiffness\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n\
         {corners}3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.ply");
    std::fs::write(&path, text).unwrap();
    let document = symmetrizer::shape::io::read(&path).unwrap();
    let field = Stiffness::of_document(&document);
    assert_eq!(field, Some(Stiffness::Vertices(vec![1.0, 2.0, 3.0, 4.0])));
    let working = symmetrizer::shape::Working::new(&document.mesh).unwrap();
    let per_face = field.unwrap().per_face(&working).unwrap();
    assert_eq!(per_face, [2.0, 7.0 / 3.0, 3.0, 8.0 / 3.0]);
    let json = r#"{"per": "face", "values": [1, 2, 3, 4]}"#;
    let faces = Stiffness::from_json(json).unwrap();
    assert_eq!(faces, Stiffness::Polygons(vec![1.0, 2.0, 3.0, 4.0]));
    assert!(Stiffness::from_json("[1]").is_err());
}
