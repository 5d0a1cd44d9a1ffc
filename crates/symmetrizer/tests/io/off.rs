//! OFF: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::io::Format;

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
