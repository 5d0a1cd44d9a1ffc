//! `symmetrize convert`.

mod common;

use common::Desk;
use symmetrizer::shape::document::{On, Role};
use symmetrizer::shape::io;

const BOX: &str = "\
mtllib paint.mtl
v 0 0 0 1 0 0
v 2 0 0 0 1 0
v 2 3 0 0 0 1
v 0 3 1 1 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
o lid
usemtl red
f 1/1 2/2 3/3 4/4
f 4/2 3/1 2/3
l 1 3
";

fn said(desk: &Desk, args: &[&str]) -> String {
    let output = desk
        .symmetrize(args)
        .assert()
        .success()
        .get_output()
        .clone();
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn what_is_lost_is_named() {
    let desk = Desk::new();
    desk.write("box.obj", BOX);
    let stl = said(&desk, &["convert", "box.obj", "box.stl"]);
    for part in [
        "box.stl does not hold the material library paint.mtl",
        "box.stl does not hold 1 line, point or other statement",
        "colours (per vertex)",
        "texture coordinates (per corner)",
        "object names (per face)",
        "1 face of more than three corners, cut into triangles",
    ] {
        assert!(stl.contains(part), "{part:?} is not in {stl}");
    }
    let obj = said(&desk, &["convert", "box.obj", "copy.obj"]);
    assert!(!obj.contains("does not hold"), "{obj}");
    assert!(
        obj.contains("copy.obj names the file paint.mtl: copy it beside it"),
        "{obj}"
    );
    desk.write("paint.mtl", "newmtl red\n");
    let obj = said(&desk, &["convert", "box.obj", "copy.obj"]);
    assert!(!obj.contains("warning"), "{obj}");
}

#[test]
fn there_and_back() {
    let desk = Desk::new();
    desk.write("box.obj", BOX);
    let before = io::read(&desk.path("box.obj")).unwrap();
    for format in ["ply", "glb"] {
        let there = format!("box.{format}");
        said(&desk, &["convert", "box.obj", &there, "--quiet"]);
        said(&desk, &["convert", &there, "back.obj", "--quiet"]);
        let after = io::read(&desk.path("back.obj")).unwrap();
        // A corner of the result looks as it did: glTF splits vertices and cuts polygons.
        let area = |d: &symmetrizer::shape::Document| -> f64 {
            let corners = |t: [u32; 3]| t.map(|v| d.mesh.positions[v as usize]);
            let size = |[a, b, c]: [symmetrizer::geom::Point; 3]| (b - a).cross(&(c - a)).norm();
            d.mesh.triangles().map(|(t, _)| size(corners(t))).sum()
        };
        assert!((area(&before) - area(&after)).abs() < 1e-6, "{format}");
        let textures = after
            .layer(On::Corner, Role::TexCoord(0))
            .expect("texture coordinates");
        let first: Vec<_> = (0..2).map(|k| textures.values.get(1, k)).collect();
        assert_eq!(first, [Some(1.0), Some(0.0)], "{format}");
        let colors = after.layer(On::Vertex, Role::Color(0)).expect("colours");
        let first: Vec<_> = (0..3).map(|k| colors.values.get(0, k)).collect();
        assert_eq!(first, [Some(1.0), Some(0.0), Some(0.0)], "{format}");
        let material = after.layer(On::Face, Role::Material).expect("materials");
        assert_eq!(material.values.name(0), Some("red"), "{format}");
    }
}

#[test]
fn a_file_can_replace_itself() {
    let desk = Desk::new();
    desk.write("box.obj", BOX);
    let before = io::read(&desk.path("box.obj")).unwrap();
    said(&desk, &["convert", "box.obj", "box.obj"]);
    assert_eq!(io::read(&desk.path("box.obj")).unwrap(), before);
}

#[test]
fn bad_paths_are_refused_before_the_work() {
    let desk = Desk::new();
    desk.write("box.obj", BOX);
    for (args, part) in [
        (["box.obj", "box.fbx"], ".fbx"),
        (["none.obj", "box.ply"], "none.obj"),
        (["box.obj", "no/box.ply"], "no"),
    ] {
        let output = desk
            .symmetrize(&["convert", args[0], args[1]])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains(part), "{said}");
    }
    assert_eq!(desk.files(), ["box.obj"]);
}

#[test]
fn files_that_a_shape_names_are_missed() {
    let desk = Desk::new();
    let ply = "ply\nformat ascii 1.0\ncomment TextureFile skin one.png\nelement vertex 1\n\
               property float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
    desk.write("a.ply", ply);
    let gltf = r#"{"asset":{"version":"2.0"},"images":[{"uri":"skin%20two.png"}],"scenes":[]}"#;
    desk.write("a.gltf", gltf);
    desk.write("a.obj", "mtllib one.mtl two.mtl\nv 0 0 0\n");
    std::fs::create_dir(desk.path("there")).unwrap();
    for (from, to, missing) in [
        ("a.ply", "there/b.ply", "skin one.png"),
        ("a.gltf", "there/b.glb", "skin two.png"),
        ("a.obj", "there/b.obj", "one.mtl two.mtl"),
    ] {
        let text = said(&desk, &["convert", from, to]);
        assert!(
            text.contains(&format!("names the file {missing}: copy it")),
            "{text}"
        );
    }
    desk.write("there/one.mtl", "");
    desk.write("there/two.mtl", "");
    let text = said(&desk, &["convert", "a.obj", "there/b.obj"]);
    assert!(!text.contains("copy it"), "{text}");
}
