//! OFF: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::io::{self, Format};

use symmetrizer::shape::document::{NO_ROW, Numbers, On, Role, Values};

use crate::shared::*;

#[test]
fn off_features() {
    for text in [
        "OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2",
        "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1 0 0 # red",
        "# first\n OFF\n#\n3\n1 \n0 0 0 0\r\n1 0 0\t\n0 1\n0\n\n3 0\n1 2 255 0 0\n",
        "3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
        "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n",
    ] {
        let triangle = decoded(text.as_bytes().to_vec(), Format::Off);
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
        "NCOFF\n1 0 0\n0 0 0 0 0 1 255 0\n",
        &["line 3", "vertex 0", "5 values"],
    );
    off(
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0",
        &["line 7", "counts"],
    );
    off("4OFF\n3 1 0\n", &["'4OFF'"]);
    off("OFF BINARY\n", &["BINARY"]);
    off("ply\n", &["'ply'"]);
}

#[test]
fn off_layers_come_out_as_they_went_in() {
    let text = "STCNOFF # all of it\n3 2 0\n0 0 0 0 0 1 255 0 7 0.5 0.25 # first\n\
                1 0 0 0 0 1 0 255 0 1 0\n0 1 0 0 0 1 0 0 1 0 1\n3 0 1 2 1 0.5 0 1\n3 2 1 0\n";
    let read = document(text.into(), Format::Off);
    let color = &read.layer(On::Vertex, Role::Color(0)).unwrap().values;
    let whole = Numbers::U8(vec![255, 0, 7, 0, 255, 0, 0, 0, 1]);
    assert_eq!(color.numbers(), Some(&whole));
    let textures = &read.layer(On::Vertex, Role::TexCoord(0)).unwrap().values;
    assert_eq!(textures.get(0, 1), Some(0.25));
    assert_eq!(
        read.layer(On::Vertex, Role::Normal)
            .unwrap()
            .values
            .get(2, 2),
        Some(1.0)
    );
    let of_faces = Values::Pool {
        width: 4,
        numbers: Numbers::F64(vec![1.0, 0.5, 0.0, 1.0]),
        rows: vec![0, NO_ROW],
    };
    assert_eq!(
        read.layer(On::Face, Role::Color(0)).unwrap().values,
        of_faces
    );
    let mut bytes = Vec::new();
    io::encode(&read, Format::Off, &mut bytes).unwrap();
    assert_eq!(document(bytes, Format::Off), read);
    assert!(io::losses(&read, Format::Off).is_empty());
}
