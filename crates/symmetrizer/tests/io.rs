//! Mesh files: round trips, the features of each format, messages for damaged files.

mod common;

use std::path::Path;

use proptest::prelude::*;
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::mesh::{Mesh, Polygons};
use symmetrizer::{Error, geom::Point};

fn mesh(positions: &[[f64; 3]], faces: &[&[u32]]) -> Mesh {
    let mut polygons = Polygons::default();
    for face in faces {
        polygons.push(face);
    }
    Mesh {
        positions: positions.iter().map(|&p| Point::from(p)).collect(),
        polygons,
    }
}

/// A pyramid over a square, with an awkward number and a vertex that no face uses.
fn pyramid() -> Mesh {
    mesh(
        &[
            [0.0, 0.0, 0.1 + 0.2],
            [1.0, 0.0, -1e-300],
            [1.0, 1.0, 1.0 / 3.0],
            [0.0, 1.0, 500_000.125],
            [9.0, 9.0, 9.0],
            [0.5, 0.5, 1.0],
        ],
        &[
            &[0, 3, 2, 1],
            &[0, 1, 5],
            &[1, 2, 5],
            &[2, 3, 5],
            &[3, 0, 5],
        ],
    )
}

fn encoded(mesh: &Mesh, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(mesh, format, &mut bytes).unwrap();
    bytes
}

fn faces(mesh: &Mesh) -> Vec<&[u32]> {
    mesh.polygons.iter().collect()
}

fn failure(format: Format, bytes: &[u8]) -> String {
    io::decode(bytes.to_vec(), format).unwrap_err().to_string()
}

#[track_caller]
fn fails_with(format: Format, text: &str, parts: &[&str]) {
    let message = failure(format, text.as_bytes());
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

#[test]
fn exact_formats_keep_everything() {
    for format in [Format::Obj, Format::Off, Format::Ply] {
        let again = io::decode(encoded(&pyramid(), format), format).unwrap();
        assert_eq!(again, pyramid(), "{format:?}");
    }
}

#[test]
fn stl_keeps_the_fans_in_single_precision() {
    let again = io::decode(encoded(&pyramid(), Format::Stl), Format::Stl).unwrap();
    let corners = |m: &Mesh| -> Vec<Point> {
        let triangles = m.triangles().flat_map(|(t, _)| t);
        triangles.map(|v| m.positions[v as usize]).collect()
    };
    assert_eq!(again.polygons.len(), 6);
    assert_eq!(again.positions.len(), 5);
    for (a, b) in corners(&again).iter().zip(corners(&pyramid())) {
        assert!((a - b).norm() <= 1e-7 * (1.0 + b.coords.norm()));
    }
}

#[test]
fn files_round_trip_by_extension() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.OBJ", "b.Ply", "c.off"] {
        let path = folder.path().join(name);
        io::write(&pyramid(), &path).unwrap();
        assert_eq!(io::read(&path).unwrap(), pyramid());
    }
}

#[test]
fn one_shape_in_every_format() {
    let Some(folder) = common::data("formats") else {
        return;
    };
    let reference = io::read(&folder.join("spot.obj")).unwrap();
    for name in [
        "spot.off",
        "spot_ascii.ply",
        "spot_binary_le.ply",
        "spot_binary_be_double.ply",
    ] {
        let other = io::read(&folder.join(name)).unwrap();
        assert_eq!(other.polygons, reference.polygons, "{name}");
        for (a, b) in other.positions.iter().zip(&reference.positions) {
            assert!((a - b).norm() < 1e-6, "{name}");
        }
    }
    for name in ["spot_ascii.stl", "spot_binary.stl"] {
        let other = io::read(&folder.join(name)).unwrap();
        assert_eq!(other.positions.len(), reference.positions.len(), "{name}");
        for ((t, _), (r, _)) in other.triangles().zip(reference.triangles()) {
            for (v, w) in t.into_iter().zip(r) {
                let (a, b) = (other.positions[v as usize], reference.positions[w as usize]);
                assert!((a - b).norm() < 1e-6, "{name}");
            }
        }
    }
}

#[test]
fn obj_features() {
    let text = "\u{feff}# comment\r\nmtllib a.mtl\r\nv 0 0 0 0.5 nan 0.5\r\nv 1 0 0\r\nv 1 1 0 1\r\n\
                vt 0 0\r\nvn 0 0 1\r\ng x\r\nf 1//1 2//1 3//1 # face\r\nv 0 1 \\\r\n 0\r\n\
                f 1/1 \\\n  -2/1/1 -1\nf -4 -3 -2 -1";
    let mesh = io::decode(text.as_bytes().to_vec(), Format::Obj).unwrap();
    assert_eq!(mesh.positions[3], Point::new(0.0, 1.0, 0.0));
    let expected: [&[u32]; 3] = [&[0, 1, 2], &[0, 2, 3], &[0, 1, 2, 3]];
    assert_eq!(faces(&mesh), expected);
}

#[test]
fn obj_messages_name_the_line() {
    let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let obj = |tail: &str, parts: &[&str]| fails_with(Format::Obj, &format!("{head}{tail}"), parts);
    obj("f 1 2 9\n", &["line 4", "vertex 9", "only 3"]);
    obj("f 1 2 0\n", &["line 4", "'0'"]);
    obj("f 1 2 -4\n", &["line 4", "'-4'"]);
    obj("f 1 two 3\n", &["line 4", "'two'"]);
    obj("f 1 2 99999999999999999999\n", &["line 4"]);
    obj("f 1 2\n", &["line 4", "2 corners"]);
    obj("v 1 2\n", &["line 4", "2 coordinates"]);
    obj("v 1 nan 2\n", &["line 4", "'nan'", "finite"]);
    obj("v 1 2,5 2\n", &["line 4", "'2,5'"]);
    obj("", &["no faces"]);
}

#[test]
fn off_features() {
    for text in [
        "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2",
        "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0 0 # red",
        "# first\n OFF\n#\n3\n1 \n0 0 0 0\r\n1 0 0\t\n0 1\n0\n\n3 0\n1 2 255 0 0\n",
        "3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n",
    ] {
        let triangle = io::decode(text.as_bytes().to_vec(), Format::Off).unwrap();
        assert_eq!(triangle.positions[1], Point::new(1.0, 0.0, 0.0), "{text}");
        assert_eq!(triangle.positions[2], Point::new(0.0, 1.0, 0.0), "{text}");
        assert_eq!(faces(&triangle), [&[0, 1, 2]], "{text}");
    }
}

#[test]
fn off_messages_name_the_line() {
    let off = |text: &str, parts: &[&str]| fails_with(Format::Off, text, parts);
    off(
        "OFF\n4000000000 1 0\n0 0 0",
        &["line 2", "4000000000 vertices"],
    );
    off("OFF\n1 x 0\n0 0 0", &["line 2", "'x'", "faces"]);
    off("OFF\n3 1 0\n0 0 0\n1 0 0\n", &["the file ends", "vertex 2"]);
    off(
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -2",
        &["line 6", "'-2'"],
    );
    off(
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3",
        &["face 0", "vertex 3"],
    );
    off(
        "OFF\n3 1 0\n0 0 0\n1 0 inf\n0 1 0\n3 0 1 2",
        &["line 4", "'inf'"],
    );
    off(
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0",
        &["line 7", "counts"],
    );
    off("4OFF\n3 1 0\n", &["'4OFF'"]);
    off("OFF BINARY\n", &["BINARY"]);
    off("ply\n", &["'ply'"]);
}

const PLY: &str = "ply\nformat ascii 1.0\ncomment caf\u{e9}\nelement vertex 3\nproperty float x\n\
                   property double y\nproperty int z\nproperty uchar red\nelement edge 1\n\
                   property int a\nproperty list uchar int b\nelement face 1\n\
                   property float quality\nproperty list uchar uint vertex_index\nend_header\n";

#[test]
fn ply_text_features() {
    let body = "0. .5 0 7\n1 0 0 8 extra\n\n0 1\n2 9\n5 2 6 7\n0.5 3 0 1 2";
    for text in [
        format!("{PLY}{body}"),
        format!("{PLY}{body}").replace('\n', "\r\n"),
    ] {
        let read = io::decode(text.into_bytes(), Format::Ply).unwrap();
        assert_eq!(read.positions[0], Point::new(0.0, 0.5, 0.0));
        assert_eq!(read.positions[2], Point::new(0.0, 1.0, 2.0));
        assert_eq!(faces(&read), [&[0, 1, 2]]);
    }
}

#[test]
fn ply_binary_of_other_types() {
    let head = PLY.replace("ascii", "binary_big_endian");
    let head = head.replace("uint vertex", "short vertex");
    let mut bytes = head.into_bytes();
    for v in 0..3_i32 {
        bytes.extend(f32::to_be_bytes(v as f32));
        bytes.extend(f64::to_be_bytes(0.5));
        bytes.extend((v * v).to_be_bytes());
        bytes.push(7);
    }
    bytes.extend([0, 0, 0, 1, 1, 0, 0, 0, 2]);
    bytes.extend([0, 0, 0, 0, 3, 0, 0, 0, 1, 0, 2]);
    let read = io::decode(bytes.clone(), Format::Ply).unwrap();
    assert_eq!(read.positions[2], Point::new(2.0, 0.5, 4.0));
    assert_eq!(faces(&read), [&[0, 1, 2]]);
    bytes.pop();
    let message = failure(Format::Ply, &bytes);
    assert!(
        message.contains("the file ends within or before face 0"),
        "{message}"
    );
}

#[test]
fn ply_faces_of_more_than_255_corners() {
    let ring: Vec<[f64; 3]> = (0..300)
        .map(|i| [f64::from(i).cos(), f64::from(i), 0.0])
        .collect();
    let corners: Vec<u32> = (0..300).collect();
    let disk = mesh(&ring, &[&corners]);
    assert_eq!(
        io::decode(encoded(&disk, Format::Ply), Format::Ply).unwrap(),
        disk
    );
}

#[test]
fn ply_messages() {
    let ply = |text: &str, parts: &[&str]| fails_with(Format::Ply, text, parts);
    ply("OFF\n", &["byte 0", "'ply'"]);
    ply("ply\nformat ascii 1.0\n", &["end_header"]);
    ply(
        "ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
        &["Line 3", "many"],
    );
    ply(
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nend_header\n",
        &["'y'"],
    );
    ply(PLY, &["line 16", "vertex 0"]);
    ply(
        &format!("{PLY}0 0 0 7\n1 0 zero 8\n"),
        &["line 17", "'zero'"],
    );
    ply(&PLY.replace("vertex 3", "vertex 4000000000"), &["vertex 0"]);
    ply(
        &PLY.replace("element face 1", "element strip 1"),
        &["no element 'face'", "strip"],
    );
    ply(&PLY.replace("_index", "_colors"), &["vertex_indices"]);
    let endless = "element nothing 4000000000\nend_header";
    ply(&PLY.replace("end_header", endless), &["'nothing'"]);
}

#[test]
fn stl_text_of_several_solids() {
    let solid = "solid\n facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                 vertex 0 1 -0\nendloop\nendfacet\nendsolid no name\n";
    let text = format!("{solid}{}", solid.replace("vertex 1 0 0", "VERTEX 1 1 1e0"));
    let read = io::decode(text.into_bytes(), Format::Stl).unwrap();
    let expected: [&[u32]; 2] = [&[0, 1, 2], &[0, 3, 2]];
    assert_eq!(faces(&read), expected);
}

#[test]
fn stl_messages() {
    let stl = |text: &str, parts: &[&str]| fails_with(Format::Stl, text, parts);
    stl(
        "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0",
        &["triangle 0", "line 5"],
    );
    stl(
        "solid x\nfacet\nouter loop\nvertex 0 0 0\nendloop",
        &["line 5", "1 vertices"],
    );
    stl("solid x\nhello", &["line 2", "'hello'"]);
    stl("solid x\nendsolid x\n", &["no vertices"]);
    stl("short", &["byte 5"]);
    let mut far = pyramid();
    far.positions[0].x = 1e300;
    let error = io::encode(&far, Format::Stl, &mut Vec::new()).unwrap_err();
    assert!(error.to_string().contains("vertex 0"));
}

#[test]
fn binary_stl_that_says_solid() {
    let mut bytes = encoded(&pyramid(), Format::Stl);
    let plain = io::decode(bytes.clone(), Format::Stl).unwrap();
    bytes[..13].copy_from_slice(b"solid\nfacet x");
    bytes[13..80].fill(b' ');
    assert_eq!(io::decode(bytes.clone(), Format::Stl).unwrap(), plain);
    bytes.truncate(bytes.len() - 30);
    assert!(failure(Format::Stl, &bytes).contains("the file ends"));
}

#[test]
fn paths_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let missing = io::read(&folder.path().join("none.obj")).unwrap_err();
    assert!(matches!(&missing, Error::Io { path, .. } if path.ends_with("none.obj")));
    let directory = io::read(folder.path()).unwrap_err();
    assert!(directory.to_string().contains("directory"));
    for name in ["a.glb", "noextension"] {
        let error = io::read(Path::new(name)).unwrap_err();
        assert!(matches!(error, Error::Unsupported(_)));
        assert!(error.to_string().contains(".obj, .ply, .off, .stl"));
    }
    let empty = folder.path().join("empty.obj");
    std::fs::write(&empty, "").unwrap();
    let message = io::read(&empty).unwrap_err().to_string();
    assert!(
        message.contains("empty.obj: the file is empty"),
        "{message}"
    );
}

#[test]
fn damaged_meshes_are_not_written() {
    let mut bad = pyramid();
    bad.polygons.push(&[0, 1, 77]);
    for format in Format::ALL {
        assert!(io::encode(&bad, format, &mut Vec::new()).is_err());
    }
}

fn any_mesh() -> impl Strategy<Value = Mesh> {
    let coordinate = any::<f64>().prop_filter("finite", |c| c.is_finite());
    let positions = prop::collection::vec(prop::array::uniform3(coordinate), 3..40);
    positions.prop_flat_map(|positions| {
        let corner = 0..positions.len() as u32;
        let faces = prop::collection::vec(prop::collection::vec(corner, 3..7), 1..40);
        faces.prop_map(move |faces| {
            let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
            mesh(&positions, &faces)
        })
    })
}

/// Debug output tells -0 from 0.
fn bits(mesh: &Mesh) -> String {
    format!("{mesh:?}")
}

proptest! {
    #[test]
    fn any_mesh_round_trips(mesh in any_mesh()) {
        for format in [Format::Obj, Format::Off, Format::Ply] {
            let again = io::decode(encoded(&mesh, format), format).unwrap();
            prop_assert_eq!(bits(&again), bits(&mesh));
        }
    }

    #[test]
    fn a_cut_or_changed_file_never_panics(
        cut in 0.0..1.0_f64, place in 0.0..1.0_f64, byte in any::<u8>(),
    ) {
        for format in Format::ALL {
            let mut bytes = encoded(&pyramid(), format);
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = byte;
            let _ = io::decode(bytes.clone(), format);
            bytes.truncate((cut * bytes.len() as f64) as usize);
            let _ = io::decode(bytes, format);
        }
    }
}
