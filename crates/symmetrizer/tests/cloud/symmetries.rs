//! Symmetries of clouds in the document's coordinates and indices, in every format that holds points.

use rand::SeedableRng;
use rand_pcg::Pcg64;

use crate::common::{data, load};
use crate::drawn::{Sampled, diagonal, star};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::report::DetectReport;
use symmetrizer::sample::uniform::uniform;
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{Document, io};
use symmetrizer::{Context, Mesh, Params, detect_document, detect_in, measure_in, symmetrize};

fn cloud(positions: Vec<Point>) -> Mesh {
    Mesh {
        positions,
        ..Mesh::default()
    }
}

fn report(mesh: &Mesh) -> DetectReport {
    let (params, mut ctx) = (Params::default(), Context::new(0));
    let found = detect_in(mesh, &params, &mut ctx).expect("a usable cloud");
    DetectReport::new(mesh, &found, &params, &ctx)
}

/// Angle in degrees between two lines.
fn degrees(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs()).to_degrees()
}

/// The highest symmetry found in `mesh` is the mirror that the truth of `model` has; its pairs are each
/// other's images.
#[track_caller]
fn mirrored(mesh: &Mesh, model: &std::path::Path) {
    let text = std::fs::read_to_string(model.with_extension("truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&text).unwrap();
    let read = |key: &str| {
        let value = &truth["clusters"][0][key];
        Vector::from_fn(|i, _| value[i].as_f64().expect("a number"))
    };
    let report = report(mesh);
    let first = &report.input.symmetries[0];
    let plane = first.plane.as_ref().expect("a mirror");
    let normal = Vector::from(plane.normal);
    let angle = degrees(&normal, &read("normal"));
    let d = diagonal(&mesh.positions);
    let away = (normal.dot(&read("point")) - plane.offset).abs() / d;
    assert!(angle <= 1.0 && away < 0.01, "{angle} degrees, {away} of D");
    assert!(first.area_fraction > 0.9, "{}", first.area_fraction);
    assert!(first.patch_faces.is_empty() && first.image_faces.is_empty());
    assert!(first.pairs.len() > 200);
    for [p, q] in &first.pairs {
        let [p, q] = [p, q].map(|v| mesh.positions[*v as usize].coords);
        let image = p - normal * (2.0 * (normal.dot(&p) - plane.offset));
        assert!(
            (image - q).norm() < 0.1 * d,
            "{} of D",
            (image - q).norm() / d
        );
    }
}

#[test]
fn a_model_is_mirrored_by_its_vertices_and_by_points_on_it() {
    for name in ["truth/spot_exact.obj", "truth/spot_retess.obj"] {
        let Some(path) = data(name) else { return };
        let mesh = load(&path);
        mirrored(&cloud(mesh.positions.clone()), &path);
        let working = Working::new(&mesh).unwrap();
        let mut rng = Pcg64::seed_from_u64(3);
        let surface = &working.surface;
        let points = uniform(surface, 3000, &mut rng).into_iter();
        let points = points.map(|at| working.normalization.to_document(&surface.point(&at)));
        mirrored(&cloud(points.collect()), &path);
    }
}

#[test]
fn every_format_that_holds_points_is_detected_on() {
    let folder = tempfile::tempdir().unwrap();
    let drawn = Sampled::new(1200, 0.0, false, star);
    let document = Document::from(cloud(drawn.points));
    for name in ["a.xyz", "a.txt", "a.TXT", "a.ply", "a.obj", "a.off"] {
        let path = folder.path().join(name);
        io::write(&document, &path).unwrap();
        let read = io::read(&path).unwrap();
        let found = detect_document(&read, &Params::default(), &mut Context::new(0)).unwrap();
        assert!(!found.symmetries().is_empty(), "{name}");
        let height = found.symmetries()[0].plane().normal.z.abs();
        assert!(!(0.02..=0.999).contains(&height), "{name}: {height}");
    }
}

#[test]
fn normals_of_the_document_are_seen() {
    let drawn = Sampled::new(1200, 0.0, false, star);
    let rows = drawn.points.iter().zip(&drawn.normals);
    let text: String = rows
        .map(|(p, n)| format!("{} {} {} {} {} {}\n", p.x, p.y, p.z, -n.x, -n.y, -n.z))
        .collect();
    let document = io::decode(text.into_bytes(), io::Format::Xyz).unwrap();
    let found = detect_document(&document, &Params::default(), &mut Context::new(0)).unwrap();
    // Estimated ones would point outwards.
    let disc = found.working.vertex_of_document[5].unwrap() as usize;
    let normal = found.working.surface.vertex_normals[disc];
    assert!(normal.dot(&drawn.normals[5]) < -0.99, "{normal}");
}

#[test]
fn clouds_are_detected_on_only() {
    let mesh = cloud(Sampled::new(500, 0.0, false, star).points);
    let mut ctx = Context::new(0);
    let refusals = [
        symmetrize(&mesh, &Params::default(), &mut ctx).err(),
        measure_in(&mesh, None, &mut ctx).err(),
    ];
    for error in refusals {
        let text = error.expect("a refusal").to_string();
        assert!(text.contains("point cloud can be detected only"), "{text}");
    }
}
