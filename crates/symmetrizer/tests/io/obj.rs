//! OBJ: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::io::{self, Format};

use symmetrizer::shape::document::{Kept, Layer, NO_ROW, Numbers, On, Role, Values};

use crate::shared::*;

#[test]
fn obj_features() {
    let text = "\u{feff}# comment\r\nmtllib a.mtl\r\nv 0 0 0 0.5 nan 0.5\r\nv 1 0 0\r\nv 1 1 0 1\r\n\
                vt 0 0\r\nvn 0 0 1\r\ng x\r\nf 1//1 2//1 3//1 # face\r\nv 0 1 \\\r\n 0\r\n\
                f 1/1 \\\n  -2/1/1 -1\nf -4 -3 -2 -1";
    let mesh = decoded(text.as_bytes().to_vec(), Format::Obj);
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
    obj("v 1 2,5 2\n", &["line 4", "'2,5'"]);
    obj("f\n", &["line 4", "without corners"]);
}

const FULL: &str = "\
# made by hand
mtllib my box.mtl
v 0 0 0 1 0 0.5
v 1 0 0 0 1 0.25
v 1 1 0 nan 0 0
v 0 1 0
vt 0 0
vt 0.1 0.30000000000000004
vt 5 5
vn 0 0 1
o one thing
usemtl #C0FFEE
s off
f 1/1/1 2/2/1 3//1
g left right
usemtl other
f 1 3/2 4
l -1 -2/-1 1
vp 0.5
";

fn layer(document: &symmetrizer::shape::Document, on: On, role: Role) -> &Layer {
    document.layer(on, role).expect("the layer")
}

#[test]
fn obj_layers() {
    let read = document(FULL.into(), Format::Obj);
    let Values::Pool { rows, numbers, .. } = &layer(&read, On::Vertex, Role::Color(0)).values
    else {
        panic!("one vertex has no colour");
    };
    assert_eq!(rows, &[0, 1, 2, NO_ROW]);
    assert!(numbers.get(6).is_nan() && numbers.get(5) == 0.25);
    let Values::Pool { rows, numbers, .. } = &layer(&read, On::Corner, Role::TexCoord(0)).values
    else {
        panic!("texture coordinates are a pool");
    };
    assert_eq!(rows, &[0, 1, NO_ROW, NO_ROW, 1, NO_ROW]);
    assert_eq!(
        numbers,
        &Numbers::F64(vec![0.0, 0.0, 0.1, 0.1 + 0.2, 5.0, 5.0])
    );
    let normals = &layer(&read, On::Corner, Role::Normal).values;
    assert_eq!([normals.row(2), normals.row(3)], [Some(0), None]);
    let name = |role, f| layer(&read, On::Face, role).values.name(f);
    assert_eq!(name(Role::Object, 1), Some("one thing"));
    assert_eq!(
        [name(Role::Group, 0), name(Role::Group, 1)],
        [None, Some("left right")]
    );
    assert_eq!(name(Role::Material, 0), Some("#C0FFEE"));
    assert_eq!(name(Role::Smoothing, 0), Some("off"));
    let Kept::Obj(kept) = &read.kept else {
        panic!("an OBJ file keeps its rest");
    };
    assert_eq!(kept.comments, ["# made by hand"]);
    assert_eq!(kept.libraries, ["my box.mtl"]);
    assert_eq!(kept.statements, ["l 4 3/3 1", "vp 0.5"]);
}

#[test]
fn obj_comes_out_as_it_went_in() {
    let read = document(FULL.into(), Format::Obj);
    let mut bytes = Vec::new();
    io::encode(&read, Format::Obj, &mut bytes).unwrap();
    let again = document(bytes, Format::Obj);
    // NaN is not equal to itself.
    assert_eq!(format!("{again:?}"), format!("{read:?}"));
}

#[test]
fn utf_16_of_both_orders() {
    let units = || "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".encode_utf16();
    let big: Vec<u8> = units().flat_map(u16::to_be_bytes).collect();
    let little: Vec<u8> = units().flat_map(u16::to_le_bytes).collect();
    for bytes in [big, little] {
        assert_eq!(faces(&decoded(bytes, Format::Obj)), [&[0, 1, 2]]);
    }
}

#[test]
fn a_row_that_is_not_there_is_no_row() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/7 3/-9\n";
    let read = document(text.into(), Format::Obj);
    let textures = &layer(&read, On::Corner, Role::TexCoord(0)).values;
    assert_eq!([0, 1, 2].map(|c| textures.row(c)), [Some(0), None, None]);
}
