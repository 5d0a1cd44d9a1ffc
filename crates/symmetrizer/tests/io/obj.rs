//! OBJ: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::io::Format;

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
    obj("v 1 nan 2\n", &["line 4", "'nan'", "finite"]);
    obj("v 1 2,5 2\n", &["line 4", "'2,5'"]);
    obj("", &["no faces"]);
}
