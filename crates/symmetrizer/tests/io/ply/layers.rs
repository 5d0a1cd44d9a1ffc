//! PLY: what becomes of layers.

use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kind, Layer, NO_ROW, Numbers, On, PlyForm, Role, Values};
use symmetrizer::shape::io::{self, Format};

use super::{again, bytes_of, with_form};
use crate::shared::*;

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
    for part in ["'edge' (2 rows)", "'camera' (1 row)", "4 comment lines"] {
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
    let text = String::from_utf8(bytes_of(&read)).unwrap();
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
    assert!(
        lost.contains("which 3 faces have no value of 'mark'"),
        "{lost}"
    );
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
    let layer = |on, role, values| Layer {
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
        "which 1 corners have no texture coordinates",
        "which 1 vertices have no colour",
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
