//! Polylines in JSON, flat meshes, and files.

use symmetrizer::drawing::{self, Format, Reading};
use symmetrizer::geom::{Point, Vector};

use crate::common;
use crate::shared::{apart, decoded, failure, read};

const FRAME: &str =
    "{\"name\": \"frame\", \"rings\": [[[0,0],[4,0],[4,4],[0,4]],[[1,1],[1,3],[3,3],[3,1]]]}";

#[test]
fn rings_are_read_and_written() {
    let frame = decoded(FRAME.as_bytes(), Format::Json);
    assert_eq!(frame.outline().area(), 12.0);
    // By ring and point.
    let hole = frame
        .outline()
        .rings
        .iter()
        .find(|r| r.area() < 0.0)
        .unwrap();
    assert!(hole.sources.iter().all(|s| s.unwrap().path == 1));
    let mut json = Vec::new();
    frame.encode(Format::Json, &mut json).unwrap();
    let again = decoded(&json, Format::Json);
    assert_eq!(apart(again.outline(), frame.outline()), 0.0);
    assert!(frame.svg().contains("<path fill-rule=\"evenodd\" d=\"M"));
}

#[test]
fn flat_meshes_are_their_boundary() {
    let Some(mesh) = common::data("2d/woody_flat_mesh.obj") else {
        return;
    };
    let outline = common::data("2d/woody.svg").unwrap();
    let (mesh, outline) = (read(&mesh), read(&outline));
    assert!(apart(mesh.outline(), outline.outline()) < 1e-3);
    let moved = mesh
        .deformed(&|p| Point::new(p.x + 0.1 * p.y, p.y, 0.0))
        .unwrap();
    let mut obj = Vec::new();
    moved.encode(Format::Obj, &mut obj).unwrap();
    assert!(apart(decoded(&obj, Format::Obj).outline(), moved.outline()) < 1e-9);
}

#[test]
fn a_plane_may_be_tilted() {
    // The square over the diagonal of the cube's floor, upright.
    let upright = "v 0 0 0\nv 1 1 0\nv 1 1 2\nv 0 0 2\nf 1 2 3 4\n";
    let drawing = decoded(upright.as_bytes(), Format::Obj);
    assert!((drawing.outline().area() - 2.0 * 2_f64.sqrt()).abs() < 1e-9);
    let shift = |p: Point| p + Vector::new(0.0, 0.5, 0.0);
    let mut obj = Vec::new();
    drawing
        .deformed(&shift)
        .unwrap()
        .encode(Format::Obj, &mut obj)
        .unwrap();
    let again = decoded(&obj, Format::Obj);
    assert!((again.outline().area() - drawing.outline().area()).abs() < 1e-9);
}

#[test]
fn solid_and_broken_meshes_are_refused() {
    let cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
    assert!(failure(cube.as_bytes(), Format::Obj).contains("not flat"));
    assert!(failure(b"v 0 0 0\n", Format::Obj).contains("no faces"));
    assert!(failure(b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", Format::Obj).contains("boundary"));
}

#[test]
fn files_are_written_whole_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let frame = decoded(FRAME.as_bytes(), Format::Json);
    for name in ["a.svg", "a.json", "a.PNG"] {
        let path = folder.path().join(name);
        drawing::write(&frame, &path).unwrap();
        let again = read(&path);
        let (a, b) = (again.outline(), frame.outline());
        let fill = |o: &drawing::Outline| o.area() / o.diagonal().powi(2);
        assert!((fill(a) / fill(b) - 1.0).abs() < 0.01, "{name}");
    }
    for (name, part) in [
        ("a.jpg", "use .png"),
        ("a.obj", "did not come from a mesh"),
        ("a.pdf", "use one of .svg"),
        ("a", "use one of .svg"),
    ] {
        let path = folder.path().join(name);
        let message = drawing::write(&frame, &path).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
        assert!(!path.exists());
    }
    let missing = drawing::read(&folder.path().join("no.svg"), &Reading::default());
    assert!(missing.unwrap_err().to_string().contains("no.svg"));
}
