//! Nodes, primitives and accessors of all kinds.

use crate::shared::faces;
use serde_json::json;
use symmetrizer::geom::Point;
use symmetrizer::shape::document::{On, Role};
use symmetrizer::shape::io::Format;

use super::*;

#[test]
fn nodes_place_meshes_and_mirrors_turn_faces() {
    let read = read(triangle(json!({
        "scenes": [{ "nodes": [0, 2] }],
        "nodes": [
            { "children": [1], "translation": [1, 2, 3] },
            { "mesh": 0, "scale": [-2, 1, 1] },
            { "mesh": 0, "rotation": [0, 0, 1, 1] },
        ],
    })));
    assert_eq!(faces(&read.mesh), [[0, 2, 1], [3, 4, 5]]);
    assert_eq!(read.mesh.positions[1], Point::new(-1.0, 2.0, 3.0));
    let turned = read.mesh.positions[4] - Point::new(0.0, 1.0, 0.0);
    assert!(turned.norm() < 1e-15);
}

#[test]
fn strips_fans_and_points_are_read() {
    let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let with_mode = |mode: u32| {
        let members = json!({
            "accessors": [vectors(0, 0, 4)],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "mode": mode }] }],
        });
        read(file(&bytes_of(&square), members)).mesh
    };
    assert_eq!(faces(&with_mode(5)), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(faces(&with_mode(6)), [[1, 2, 0], [2, 3, 0]]);
    for mode in 0..4 {
        assert_eq!(with_mode(mode).positions.len(), 4);
        assert!(with_mode(mode).polygons.is_empty());
    }
}

#[test]
fn primitives_share_vertices_and_lack_attributes() {
    let read = read(file(
        &bytes_of(&[TRIANGLE, TRIANGLE].concat()),
        json!({
            "accessors": [vectors(0, 0, 3), vectors(0, 36, 3)],
            "materials": [{ "name": "skin" }, {}],
            "meshes": [{ "primitives": [
                { "attributes": { "POSITION": 0 }, "material": 1 },
                { "attributes": { "POSITION": 0 } },
                { "attributes": { "POSITION": 1, "COLOR_0": 0 }, "material": 0 },
            ] }],
        }),
    ));
    assert_eq!(faces(&read.mesh), [[0, 1, 2], [0, 1, 2], [3, 4, 5]]);
    let materials = &read.layer(On::Face, Role::Material).unwrap().values;
    let of = |f| materials.name(f);
    assert_eq!(
        [of(0), of(1), of(2)],
        [Some("material 1"), None, Some("skin")]
    );
    // What has no colour is white, as it is drawn.
    let colors = &read.layer(On::Vertex, Role::Color(0)).unwrap().values;
    assert_eq!([colors.get(0, 0), colors.get(3, 0)], [Some(1.0), Some(0.0)]);
}

/// Normalised bytes, four apart.
fn quantised() -> Vec<u8> {
    let accessor = json!({ "bufferView": 0, "componentType": 5120, "normalized": true, "count": 3, "type": "VEC3" });
    let bytes = [0, 0, 0, 9, 127, 0, 0, 9, 0, 129, 0, 9];
    let members = json!({
        "accessors": [accessor],
        "bufferViews": [{ "buffer": 0, "byteLength": 12, "byteStride": 4 }],
    });
    file(&bytes, members)
}

/// Zeros, of which one is replaced.
fn sparse() -> Vec<u8> {
    let bytes = [&[2, 0, 0, 0][..], &bytes_of(&[1.0, 2.0, 3.0])].concat();
    let accessor = json!({
        "componentType": 5126, "count": 3, "type": "VEC3",
        "sparse": {
            "count": 1,
            "indices": { "bufferView": 0, "componentType": 5121 },
            "values": { "bufferView": 0, "byteOffset": 4 },
        },
    });
    file(&bytes, json!({ "accessors": [accessor] }))
}

#[test]
fn quantised_and_sparse_positions_are_read_and_moved() {
    for (bytes, last) in [(quantised(), [0.0, -1.0, 0.0]), (sparse(), [1.0, 2.0, 3.0])] {
        let mut document = read(bytes);
        assert_eq!(document.mesh.positions[2], Point::from(last));
        document.mesh.positions[1].z = 0.25;
        let again = read(written(&document, Format::Gltf));
        assert_eq!(again.mesh, document.mesh);
        assert_eq!(json_of(&again)["accessors"].as_array().unwrap().len(), 2);
        assert_eq!(
            json_of(&again)["accessors"][0],
            json_of(&document)["accessors"][0]
        );
    }
}
