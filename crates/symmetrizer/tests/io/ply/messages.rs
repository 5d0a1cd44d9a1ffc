//! PLY: messages for damaged files.

use symmetrizer::shape::io::Format;

use super::PLY;
use crate::shared::*;

#[test]
fn ply_messages() {
    let ply = |text: &str, parts: &[&str]| fails_with(Format::Ply, text, parts);
    ply("OFF\n", &["byte 0", "'ply'"]);
    ply("plywood\n", &["byte 0", "'ply'"]);
    ply("ply\nformat ascii 1.0\n", &["end_header"]);
    ply("ply\nend_header\n", &["line 2", "'format'"]);
    ply(
        "ply\nformat ascii 1.0\nformat ascii 1.0\n",
        &["line 3", "second time"],
    );
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
    let many: String = (0..5000).map(|i| format!("property int p{i}\n")).collect();
    ply(
        &PLY.replace("element edge", &(many + "element edge")),
        &["more than 4096"],
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
