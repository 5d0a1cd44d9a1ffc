//! STL: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::Mesh;
use symmetrizer::shape::io::{self, Format};

use crate::shared::*;

#[test]
fn stl_keeps_the_fans_in_single_precision() {
    let again = decoded(encoded(&pyramid(), Format::Stl), Format::Stl);
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
fn stl_text_of_several_solids() {
    let solid = "solid\n facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                 vertex 0 1 -0\nendloop\nendfacet\nendsolid no name\n";
    let text = format!("{solid}{}", solid.replace("vertex 1 0 0", "VERTEX 1 1 1e0"));
    let read = decoded(text.into_bytes(), Format::Stl);
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
    let error = io::encode(&far.into(), Format::Stl, &mut Vec::new()).unwrap_err();
    assert!(error.to_string().contains("vertex 0"));
}

#[test]
fn binary_stl_that_says_solid() {
    let mut bytes = encoded(&pyramid(), Format::Stl);
    let plain = decoded(bytes.clone(), Format::Stl);
    bytes[..13].copy_from_slice(b"solid\nfacet x");
    bytes[13..80].fill(b' ');
    assert_eq!(decoded(bytes.clone(), Format::Stl), plain);
    bytes.truncate(bytes.len() - 30);
    assert!(failure(Format::Stl, &bytes).contains("the file ends"));
}
