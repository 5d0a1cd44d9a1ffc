//! XYZ: its columns, its messages.

use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kind, Layer, Numbers, On, Role, Values};
use symmetrizer::shape::io::{self, Format};

use crate::common;
use crate::shared::*;

fn read(text: &str) -> Document {
    document(text.as_bytes().to_vec(), Format::Xyz)
}

fn written(document: &Document) -> String {
    let mut bytes = Vec::new();
    io::encode(document, Format::Xyz, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

fn layer(name: &str, role: Role, width: usize, numbers: Numbers) -> Layer {
    Layer {
        name: name.into(),
        on: On::Vertex,
        role,
        values: Values::Rows { width, numbers },
    }
}

#[test]
fn separators_comments_and_counts() {
    for text in [
        "1 2 3\n4\t5 -6e-1\n",
        "\u{feff}# a\n\n2\r\n 1,2,3 // first\r\n4;5;-0.6\r\n// end",
        "X Y Z\n1, 2, 3#\n4  5 ; -.6",
        "2\nx;y;z\n1 2 3\n4 5 -0.6",
    ] {
        let points = read(text);
        let expected = [Point::new(1.0, 2.0, 3.0), Point::new(4.0, 5.0, -0.6)];
        assert_eq!(points.mesh.positions, expected, "{text:?}");
        assert!(points.layers.is_empty() && points.mesh.polygons.is_empty());
    }
    assert_eq!(read("# nothing\n"), Document::default());
    assert!(read("nan inf 0").mesh.positions[0].x.is_nan());
}

#[test]
fn six_columns_are_normals_or_colors() {
    let normals = read("0 0 0 0 0 1\n1 0 0 0.6 0 0.805\n");
    let expected = Numbers::F64(vec![0.0, 0.0, 1.0, 0.6, 0.0, 0.805]);
    assert_eq!(normals.layers, [layer("", Role::Normal, 3, expected)]);
    let colors = read("0 0 0 0 0 1\n1 0 0 255 128 0\n");
    let expected = Numbers::U8(vec![0, 0, 1, 255, 128, 0]);
    assert_eq!(colors.layers, [layer("", Role::Color(0), 3, expected)]);
    let shares = read("0 0 0 0 0 0.25\n");
    assert_eq!(shares.layers[0].role, Role::Color(0));
    assert_eq!(shares.layers[0].values.numbers().unwrap().kind(), Kind::F64);
    let neither = read("0 0 0 -3 0 1\n");
    let names: Vec<&str> = neither.layers.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["column 4", "column 5", "column 6"]);
    // One line in a hundred may be off.
    let mut text = "0 0 0 1 0 0\n".repeat(99) + "0 0 0 0 0 0\n";
    assert_eq!(read(&text).layers[0].role, Role::Normal);
    text += "0 0 0 0 0 0\n";
    assert_eq!(read(&text).layers[0].role, Role::Color(0));
}

#[test]
fn other_columns_and_names() {
    let one = read("0 0 0 7\n1 1 1 8\n");
    assert_eq!(
        one.layers,
        [layer(
            "column 4",
            Role::Other,
            1,
            Numbers::F64(vec![7.0, 8.0])
        )]
    );
    let named = read("x y z weight R G B NX NY NZ\n0 0 0 7 1 2 3 9 9 9\n");
    let roles: Vec<Role> = named.layers.iter().map(|l| l.role).collect();
    assert_eq!(roles, [Role::Other, Role::Color(0), Role::Normal]);
    assert_eq!(named.layers[0].name, "weight");
}

#[test]
fn everything_it_holds_comes_back() {
    let texts = [
        "0.30000000000000004 -0 1\n2 0 0\n",
        "0 0 0 0 0 1\n1 0 0 0 1 0\n",
        "0 0 0 0 0 2\n1 0 0 0 255 0\n",
        "0 0 0 0.5 NaN\n1 0 0 0 -1\n",
        "x y z weight\n1 2 3 4\n",
        "x y z a b c\n1 2 3 0 0 1\n",
        "x y z weight red green blue nx ny nz\n0 0 0 7 1 2 3 9 9 9\n",
    ];
    for text in texts {
        assert_eq!(written(&read(text)), text);
    }
    let mut document = read("0 0 0 5\n");
    document.layers[0].name = "1e5".into();
    document
        .layers
        .push(layer("a, b", Role::Other, 1, Numbers::F32(vec![0.5])));
    assert_eq!(written(&document), "x y z _1e5 a__b\n0 0 0 5 0.5\n");
}

#[test]
fn losses_are_named() {
    let mut document = Document::from(pyramid());
    let row = |width: usize| Numbers::F64(vec![0.5; 6 * width]);
    document.layers.push(layer("", Role::Normal, 3, row(3)));
    document.layers.push(layer("", Role::Color(0), 4, row(4)));
    document
        .layers
        .push(layer("", Role::TexCoord(0), 2, row(2)));
    let lost = io::losses(&document, Format::Xyz);
    let expected = [
        "5 faces",
        "colours (per vertex)",
        "texture coordinates (per vertex)",
    ];
    assert_eq!(lost, expected);
    let again = read(&written(&document));
    assert_eq!(again.mesh.positions, pyramid().positions);
    assert_eq!(again.layers.len(), 1);
}

#[test]
fn xyz_messages_name_the_line() {
    let xyz = |text: &str, parts: &[&str]| fails_with(Format::Xyz, text, parts);
    xyz("1 2 3\n\n1 2 3 4\n", &["line 3", "4 columns where 3"]);
    xyz("1 2\n", &["line 1", "2 columns"]);
    xyz("1 2 3\n4 5 six\n", &["line 2", "'six'"]);
    xyz("1 2 three\n", &["line 1", "'three'"]);
    xyz("hello\n", &["line 1", "count"]);
    xyz("3\n1 2 3\n", &["line 1", "3 points", "are 1"]);
    xyz("x y z\n1 2 3 4\n", &["line 2", "4 columns where 3"]);
    xyz("\0\0", &["not plain text"]);
}

#[test]
fn clouds_of_the_collection() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    let kitten = io::read(&folder.join("kitten_points.xyz")).unwrap();
    assert_eq!(kitten.mesh.positions.len(), 5210);
    assert_eq!(kitten.layers[0].role, Role::Normal);
    let spot = io::read(&folder.join("spot_points.xyz")).unwrap();
    assert_eq!((spot.mesh.positions.len(), spot.layers.len()), (8000, 0));
    for document in [kitten, spot] {
        assert_eq!(read(&written(&document)), document);
    }
}

#[test]
fn any_byte_at_any_place_is_read_or_explained() {
    let text = "2\nx,y z a nx ny nz\n# c\n1 2 3 4 0 0 1\n5 -6 7e1;8 1 0 0 // d\n";
    for at in 0..text.len() {
        for byte in 0..=255 {
            let mut bytes = text.as_bytes().to_vec();
            bytes[at] = byte;
            if let Ok(document) = io::decode(bytes, Format::Xyz) {
                let again = read(&written(&document));
                assert_eq!(again.mesh.positions.len(), document.mesh.positions.len());
                assert_eq!(again.layers.len(), document.layers.len(), "{at} {byte}");
            }
        }
    }
}
