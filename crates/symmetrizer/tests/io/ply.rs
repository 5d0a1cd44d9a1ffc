//! PLY: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::io::Format;

use crate::shared::*;

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
    let read = decoded(bytes.clone(), Format::Ply);
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
    assert_eq!(decoded(encoded(&disk, Format::Ply), Format::Ply), disk);
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
