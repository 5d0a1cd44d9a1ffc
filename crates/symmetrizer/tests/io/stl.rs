//! STL: its features, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::Mesh;
use symmetrizer::shape::io::{self, Format};

use symmetrizer::shape::document::{Kept, On, Role};

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

#[test]
fn stl_text_comes_out_as_it_went_in() {
    let solid = "solid my part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n\
                 vertex 0 0.1 0\nendloop\nendfacet\nendsolid\n";
    let nameless = solid.replace(" my part", "").replace("0.1", "7");
    let read = document(format!("{solid}{nameless}").into_bytes(), Format::Stl);
    let groups = &read.layer(On::Face, Role::Group).unwrap().values;
    assert_eq!([groups.name(0), groups.name(1)], [Some("my part"), None]);
    let mut bytes = Vec::new();
    io::encode(&read, Format::Stl, &mut bytes).unwrap();
    assert!(bytes.starts_with(b"solid my part\n facet normal 0 0 1\n"));
    assert_eq!(document(bytes, Format::Stl), read);
}

#[test]
fn binary_stl_keeps_header_and_free_bytes() {
    let mut bytes = encoded(&pyramid(), Format::Stl);
    bytes[..5].copy_from_slice(b"COLOR");
    bytes[84 + 48] = 7;
    bytes[84 + 49] = 1;
    let read = document(bytes.clone(), Format::Stl);
    assert!(matches!(&read.kept, Kept::Stl(kept) if kept.header.starts_with(b"COLOR")));
    assert_eq!(
        read.layer(On::Face, Role::Other).unwrap().values.get(0, 0),
        Some(263.0)
    );
    let lost = io::losses(&read, Format::Ply);
    assert_eq!(lost, ["the header of the STL file"]);
    assert!(io::losses(&read, Format::Stl).is_empty());
    let mut again = Vec::new();
    io::encode(&read, Format::Stl, &mut again).unwrap();
    // Normals are computed again, from rounded corners.
    assert_eq!(again[..84], bytes[..84]);
    assert_eq!(again[84 + 48..84 + 50], [7, 1]);
    assert_eq!(document(again, Format::Stl), read);
}
