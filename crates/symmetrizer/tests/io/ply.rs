//! PLY: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kept, Kind, NO_ROW, Numbers, On, PlyForm, Role, Values};
use symmetrizer::shape::io::{self, Format};

use crate::common;
use crate::shared::*;

const PLY: &str = "ply\nformat ascii 1.0\ncomment caf\u{e9}\nelement vertex 3\nproperty float x\n\
                   property double y\nproperty int z\nproperty uchar red\nelement edge 1\n\
                   property int a\nproperty list uchar int b\nelement face 1\n\
                   property float quality\nproperty list uchar uint vertex_index\nend_header\n";

/// Every property that has a meaning, and some that have none.
const RICH: &str = "ply\nformat ascii 1.0\nobj_info num_cols 512\nelement vertex 4\n\
    property float nx\nproperty float ny\nproperty float nz\nproperty double x\n\
    property double y\nproperty double z\ncomment between\nproperty uchar blue\n\
    property uchar green\nproperty uchar red\nproperty uchar alpha\nproperty float s\n\
    property float t\nproperty short confidence\nproperty list uchar ushort near\n\
    property uchar texture_u\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n\
    comment TextureFile a b.png\nelement camera 1\nproperty list int double matrix\n\
    element face 2\nproperty list ushort uint vertex_indices\n\
    property list uchar float texcoord\nproperty uchar red\nproperty uchar green\n\
    property uchar blue\nproperty float nx\nproperty float ny\nproperty float nz\n\
    property list char int tags\nproperty int material\ncomment material 0 Red wool\n\
    comment material 1 \ncomment the end\nend_header\n\
    0 0 1 0.1 0.2 0.3 3 2 1 255 0.5 0.25 -7 2 1 2 9\n0 0 1 1 0 0 3 2 1 255 0.5 0.25 -7 0 9\n\
    0 1 0 1 1 0 3 2 1 255 0.5 0.25 -7 1 65535 9\n1 0 0 0 1 0 6 5 4 0 0.5 0.25 -7 0 9\n\
    0 1\n1 2\n3 1 -0 1e-300\n\
    3 0 1 2 6 0 0 1 0 1 1 255 0 0 0 0 1 2 7 8 1\n3 0 2 3 6 0 0 0.1 0 1 1 0 255 0 0 0 1 0 -1\n";

fn again(document: &Document) -> Document {
    self::document(bytes_of(document, Format::Ply), Format::Ply)
}

fn bytes_of(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, format, &mut bytes).unwrap();
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
    assert_eq!(bytes_of(&read, Format::Ply), bytes, "the same file again");
    bytes.pop();
    let message = failure(Format::Ply, &bytes);
    assert!(
        message.contains("the file ends within or before face 0"),
        "{message}"
    );
}

#[test]
fn every_property_has_its_meaning() {
    let read = document(RICH.as_bytes().to_vec(), Format::Ply);
    let found = read.layers.iter().map(|l| (l.name.as_str(), l.on, l.role));
    let expected = [
        ("nx ny nz", On::Vertex, Role::Normal),
        ("red green blue alpha", On::Vertex, Role::Color(0)),
        ("s t", On::Vertex, Role::TexCoord(0)),
        ("confidence", On::Vertex, Role::Other),
        ("near", On::Vertex, Role::Other),
        ("texture_u", On::Vertex, Role::TexCoord(1)),
        ("texcoord", On::Corner, Role::TexCoord(0)),
        ("red green blue", On::Face, Role::Color(0)),
        ("nx ny nz", On::Face, Role::Normal),
        ("tags", On::Face, Role::Other),
        ("material", On::Face, Role::Material),
    ];
    assert_eq!(found.collect::<Vec<_>>(), expected);
    let values = |i: usize| &read.layers[i].values;
    let colours = vec![1, 2, 3, 255, 1, 2, 3, 255, 1, 2, 3, 255, 4, 5, 6, 0];
    let rows = |width, numbers| Values::Rows { width, numbers };
    assert_eq!(*values(1), rows(4, Numbers::U8(colours)));
    assert_eq!(values(3).get(2, 0), Some(-7.0));
    let near = Values::Lists {
        starts: vec![0, 2, 2, 3, 3],
        numbers: Numbers::U16(vec![1, 2, u16::MAX]),
    };
    assert_eq!(*values(4), near);
    assert_eq!(values(6).get(4, 0), Some(f64::from(0.1_f32)));
    let names = Values::Names {
        names: vec!["Red wool".into(), String::new()],
        of: vec![1, NO_ROW],
    };
    assert_eq!(*values(10), names);
    assert_eq!(io::losses(&read, Format::Ply), Vec::<String>::new());
    let lost = io::losses(&read, Format::Off).join("; ");
    for part in ["'edge' (2 rows)", "'camera' (1 rows)", "4 comment lines"] {
        assert!(lost.contains(part), "{lost}");
    }
}

#[test]
fn every_form_keeps_everything() {
    let read = document(RICH.as_bytes().to_vec(), Format::Ply);
    for form in [PlyForm::Text, PlyForm::Little, PlyForm::Big] {
        let document = with_form(read.clone(), form);
        assert_eq!(again(&document), document, "{form:?}");
    }
    let text = String::from_utf8(bytes_of(&read, Format::Ply)).unwrap();
    let order = [
        "obj_info",
        "float nx",
        "double x",
        "between",
        "uchar blue",
        "TextureFile",
    ];
    let places: Vec<_> = order.iter().map(|o| text.find(o).unwrap()).collect();
    assert!(places.is_sorted(), "{text}");
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
    let written = bytes_of(&read, Format::Ply);
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
fn coordinates_keep_their_type_until_they_move() {
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
        let unmoved = String::from_utf8(bytes_of(&read, Format::Ply)).unwrap();
        assert!(unmoved.contains("property float x"), "{unmoved}");
        assert_eq!(again(&read), read);
        for form in [PlyForm::Text, PlyForm::Big] {
            read = with_form(read, form);
            read.mesh.positions[0].x = 1.0 / 3.0;
            assert_eq!(again(&read).mesh, read.mesh);
            let moved = bytes_of(&read, Format::Ply);
            assert!(String::from_utf8_lossy(&moved).contains("property double x"));
        }
    }
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
fn strips_become_faces() {
    let strips = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n\
                  property float z\nelement tristrips 1\n\
                  property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n\
                  0 2 0\n1 2 0\n10 0 1 2 3 3 5 -1 0 1 2\n";
    let read = document(strips.into(), Format::Ply);
    let triangles: [&[u32]; 4] = [&[0, 1, 2], &[2, 1, 3], &[0, 1, 2], &[]];
    assert_eq!(faces(&read.mesh), triangles[..3]);
    assert_eq!(again(&read), read);
    let both = strips.replace(
        "end_header\n",
        "element face 1\nproperty list uchar int vertex_indices\nproperty uchar mark\nend_header\n",
    ) + "4 0 1 3 2 9\n";
    let read = document(both.into_bytes(), Format::Ply);
    assert_eq!(faces(&read.mesh)[0], [0, 1, 3, 2]);
    assert_eq!(read.mesh.polygons.len(), 4);
    let lost = io::losses(&read, Format::Ply).join("; ");
    assert!(lost.contains("3 of the values per face"), "{lost}");
    assert_eq!(again(&read).mesh, read.mesh);
}

#[test]
fn layers_of_other_formats() {
    let mut document = Document::from(mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        &[&[0, 1, 2], &[0, 2, 3]],
    ));
    let pool = |width, numbers, rows: &[u32]| Values::Pool {
        width,
        numbers: Numbers::F64(numbers),
        rows: rows.to_vec(),
    };
    let layer = |on, role, values| symmetrizer::shape::document::Layer {
        name: String::new(),
        on,
        role,
        values,
    };
    let uv = vec![0.0, 0.0, 0.0, 0.1, 0.5, 0.0];
    let grey = vec![0.0, 128.0 / 255.0, 1.0, 0.502, 0.0, 0.0];
    document.layers = vec![
        layer(
            On::Corner,
            Role::TexCoord(0),
            pool(3, uv, &[0, 1, 0, NO_ROW, 1, 0]),
        ),
        layer(
            On::Corner,
            Role::Normal,
            pool(3, vec![0.0, 0.0, 1.0], &[0; 6]),
        ),
        layer(
            On::Vertex,
            Role::Color(0),
            pool(3, grey, &[0, 1, 0, NO_ROW]),
        ),
        layer(On::Corner, Role::Other, pool(1, vec![1.0], &[0; 6])),
    ];
    let read = again(&document);
    let found: Vec<_> = read
        .layers
        .iter()
        .map(|l| (l.name.as_str(), l.role))
        .collect();
    let expected = [
        ("nx ny nz", Role::Normal),
        ("red green blue", Role::Color(0)),
        ("texcoord", Role::TexCoord(0)),
    ];
    assert_eq!(found, expected);
    let colours = Numbers::U8(vec![0, 128, 255, 128, 0, 0, 0, 128, 255, 0, 0, 0]);
    assert_eq!(read.layers[1].values.numbers(), Some(&colours));
    let texture = read.layers[2].values.numbers().unwrap();
    assert_eq!(
        (texture.kind(), texture.get(2)),
        (Kind::F32, f64::from(0.1_f32))
    );
    let lost = io::losses(&document, Format::Ply).join("; ");
    for part in [
        "the property '' (per corner)",
        "1 of the values per corner",
        "1 of the values per vertex",
        "digits of the texture",
    ] {
        assert!(lost.contains(part), "{lost}");
    }
    assert!(!lost.contains("normals"), "{lost}");
    // Two rows at one vertex: no value per vertex says that.
    if let Values::Pool { numbers, rows, .. } = &mut document.layers[1].values {
        *numbers = Numbers::F64(vec![0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
        rows[3] = 1;
    }
    let lost = io::losses(&document, Format::Ply).join("; ");
    assert!(lost.contains("normals (per corner)"), "{lost}");
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
            let written = bytes_of(&read, Format::Ply);
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

#[test]
fn ply_messages() {
    let ply = |text: &str, parts: &[&str]| fails_with(Format::Ply, text, parts);
    ply("OFF\n", &["byte 0", "'ply'"]);
    ply("plywood\n", &["byte 0", "'ply'"]);
    ply("ply\nformat ascii 1.0\n", &["end_header"]);
    ply("ply\nend_header\n", &["line 2", "'format'"]);
    ply("ply\nformat utf 1.0\n", &["line 2", "'utf'"]);
    ply(
        "ply\nformat ascii 1.0\nproperty int x\n",
        &["line 3", "'x'"],
    );
    ply(
        "ply\nformat ascii 1.0\nelements 5\n",
        &["line 3", "'elements 5'"],
    );
    ply(
        "ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
        &["line 3", "many"],
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
    ply(&PLY.replace("_index", "_colors"), &["vertex_indices"]);
    ply(&PLY.replace("uchar red", "byte red"), &["line 8", "'byte'"]);
    ply(
        &PLY.replace("uchar red", "double y"),
        &["line 8", "'y'", "'vertex'", "second time"],
    );
    ply(
        &PLY.replace("edge", "vertex"),
        &["line 9", "'vertex'", "second time"],
    );
    ply(
        &PLY.replace("list uchar int", "list float int"),
        &["line 11", "'b'"],
    );
    ply(
        &PLY.replace("list uchar uint", "list uchar float"),
        &["vertex_indices"],
    );
    let endless = "element nothing 4000000000\nend_header";
    ply(&PLY.replace("end_header", endless), &["'nothing'"]);
}

#[test]
fn ply_binary_messages() {
    let head = PLY
        .replace("ascii", "binary_little_endian")
        .replace("uchar int b", "char int b");
    let start = head.len();
    let rows = [0; 3 * 17];
    let ends = [head.as_bytes(), &rows[..20]].concat();
    let message = failure(Format::Ply, &ends);
    let place = format!("byte {}: ", start + 17);
    assert!(
        message.contains(&place) && message.contains("vertex 1"),
        "{message}"
    );
    let negative = [head.as_bytes(), &rows, &[0, 0, 0, 0, 0xff]].concat();
    let message = failure(Format::Ply, &negative);
    let place = format!("byte {}: the list 'b' of edge 0", start + 51);
    assert!(
        message.contains(&place) && message.contains("-1"),
        "{message}"
    );
    let many = head.replace("face 1", "face 99999999999");
    let message = failure(Format::Ply, &[many.as_bytes(), &rows, &[0; 5]].concat());
    assert!(message.contains("face 0"), "{message}");
}
