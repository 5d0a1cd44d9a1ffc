//! PLY: its features.

mod layers;
mod messages;
mod properties;

use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kept, Numbers, On, PlyForm, Role, Values};
use symmetrizer::shape::io::{self, Format};

use crate::common;
use crate::shared::*;

const PLY: &str = "ply\nformat ascii 1.0\ncomment caf\u{e9}\nelement vertex 3\nproperty float x\n\
                   property double y\nproperty int z\nproperty uchar red\nelement edge 1\n\
                   property int a\nproperty list uchar int b\nelement face 1\n\
                   property float quality\nproperty list uchar uint vertex_index\nend_header\n";

fn again(document: &Document) -> Document {
    self::document(bytes_of(document), Format::Ply)
}

fn bytes_of(document: &Document) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, Format::Ply, &mut bytes).unwrap();
    bytes
}

fn with_form(mut document: Document, to: PlyForm) -> Document {
    let Kept::Ply(kept) = &mut document.kept else {
        panic!("not read from PLY: {:?}", document.kept);
    };
    kept.form = to;
    document
}

#[test]
fn ply_text_features() {
    let body = "0. .5 0 7\n1 0 0 8 extra\n\n0 1\n2 9\n5 2 6 7\n0.5 3 0 1 2";
    for text in [
        format!("{PLY}{body}"),
        format!("{PLY}{body}").replace('\n', "\r\n"),
    ] {
        let read = decoded(text.into_bytes(), Format::Ply);
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
    let read = document(bytes.clone(), Format::Ply);
    assert_eq!(read.mesh.positions[2], Point::new(2.0, 0.5, 4.0));
    assert_eq!(faces(&read.mesh), [&[0, 1, 2]]);
    assert_eq!(bytes_of(&read), bytes, "the same file again");
    bytes.pop();
    let message = failure(Format::Ply, &bytes);
    assert!(
        message.contains("the file ends within or before face 0"),
        "{message}"
    );
}

#[test]
fn comments_of_any_encoding_and_line_ends() {
    let text = "ply\rformat ascii 1.0\rcomment caf? \relement vertex 1\rproperty int x\r\
                property int y\rproperty int z\rend_header\r1 2 3\r";
    let mut bytes = text.as_bytes().to_vec();
    let at = text.find('?').unwrap();
    bytes[at] = 0xe9;
    let read = document(bytes, Format::Ply);
    assert_eq!(read.mesh.positions, [Point::new(1.0, 2.0, 3.0)]);
    let written = bytes_of(&read);
    assert!(written.windows(15).any(|w| w == b"comment caf\xe9 \ne"));
    assert_eq!(document(written, Format::Ply), read);
}

#[test]
fn lone_cr_ends_the_header_before_data() {
    let head = "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\r\
                property uchar y\rproperty uchar z\rend_header\r";
    let bytes = [head.as_bytes(), b"\n\r\0"].concat();
    let read = decoded(bytes, Format::Ply);
    assert_eq!(read.positions, [Point::new(10.0, 13.0, 0.0)]);
}

#[test]
fn coordinates_keep_their_type() {
    for (form, value) in [
        ("ascii", "0.1"),
        ("ascii", "-0.33333334"),
        ("ascii", "1e-30"),
    ] {
        let text = format!(
            "ply\nformat {form} 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
             property float z\nend_header\n{value} 0 5\n"
        );
        let mut read = document(text.into_bytes(), Format::Ply);
        let unmoved = String::from_utf8(bytes_of(&read)).unwrap();
        assert!(unmoved.contains("property float x"), "{unmoved}");
        assert_eq!(again(&read), read);
        for form in [PlyForm::Text, PlyForm::Big] {
            read = with_form(read, form);
            read.mesh.positions[0].x = 1.0 / 3.0;
            // Text has room for all digits, whatever the type is called.
            let kept = match form {
                PlyForm::Text => 1.0 / 3.0,
                _ => f64::from(1.0_f32 / 3.0),
            };
            assert_eq!(again(&read).mesh.positions[0].x, kept);
            let moved = bytes_of(&read);
            assert!(String::from_utf8_lossy(&moved).contains("property float x"));
        }
    }
}

#[test]
fn coordinates_of_other_documents_are_double_where_that_is_needed() {
    let head = |mesh: symmetrizer::Mesh| {
        let bytes = bytes_of(&mesh.into());
        String::from_utf8_lossy(&bytes[..120]).into_owned()
    };
    let mut mesh = pyramid();
    assert!(head(mesh.clone()).contains("property double x"));
    for p in &mut mesh.positions {
        *p = p.map(|c| f64::from(c as f32));
    }
    assert!(head(mesh).contains("property float x"));
}

#[test]
fn text_numbers_that_their_type_does_not_hold() {
    let text = PLY.replace("uint vertex_index", "char vertex_index");
    let read = document(
        format!("{text}0 0 0 0.5\n1 0 0 300\n0 1 0 1\n0 1 2\n1e200 3 0 1 2\n").into_bytes(),
        Format::Ply,
    );
    let red = Values::Rows {
        width: 1,
        numbers: Numbers::F64(vec![0.5, 300.0, 1.0]),
    };
    assert_eq!(read.layers[0].values, red);
    assert_eq!(read.layers[1].values.get(0, 0), Some(1e200));
    assert_eq!(again(&read), read);
}

#[test]
fn ply_faces_of_more_than_255_corners() {
    let ring: Vec<[f64; 3]> = (0..300)
        .map(|i| [f64::from(i).cos(), f64::from(i), 0.0])
        .collect();
    let corners: Vec<u32> = (0..300).collect();
    let disk = mesh(&ring, &[&corners]);
    assert_eq!(decoded(encoded(&disk, Format::Ply), Format::Ply), disk);
}

#[test]
fn files_of_the_collection_come_out_as_they_came_in() {
    for folder in ["formats", "dirty", "3d"] {
        let Some(folder) = common::data(folder) else {
            return;
        };
        let files = std::fs::read_dir(folder)
            .unwrap()
            .map(|f| f.unwrap().path());
        for path in files.filter(|p| p.extension().is_some_and(|e| e == "ply")) {
            let bytes = std::fs::read(&path).unwrap();
            let Ok(read) = io::decode(bytes.clone(), Format::Ply) else {
                continue;
            };
            let written = bytes_of(&read);
            let name = path.display();
            assert_eq!(
                io::losses(&read, Format::Ply),
                Vec::<String>::new(),
                "{name}"
            );
            assert!(document(written.clone(), Format::Ply) == read, "{name}");
            // The one has other spaces between its words, the header of the other CR LF.
            let other = ["spot_ascii.ply", "cube_binary_crlf.ply"];
            if !other.iter().any(|o| path.ends_with(o)) {
                assert!(written == bytes, "{name} is written differently");
            }
        }
    }
}

#[test]
fn point_clouds_have_no_polygons() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    let points = io::read(&folder.join("hippo1_points.ply")).unwrap();
    assert_eq!(points.mesh.positions.len(), 6104);
    assert!(points.mesh.polygons.is_empty());
    assert!(points.layer(On::Vertex, Role::Normal).is_some());
}
