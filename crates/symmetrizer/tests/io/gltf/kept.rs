//! What comes from glTF goes back as it came.

use crate::common;
use crate::shared::document;
use serde_json::json;
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kept, MorphPart, On, Role, Values};
use symmetrizer::shape::io::{self, Format};

use super::*;

#[test]
fn only_what_moved_changes() {
    // NaN bits and unknown keys must stay.
    let mut numbers = TRIANGLE;
    numbers[8] = f32::from_bits(0x7FC0_1234);
    let members =
        json!({ "extras": { "b": 1.0, "a": [0.1, 1e-7] }, "cameras": [{ "type": "perspective" }] });
    let mut document = read(file(&bytes_of(&numbers), members));
    let (Kept::Gltf(before), moved) = (document.kept.clone(), &mut document.mesh.positions[0])
    else {
        panic!("not of a glTF file");
    };
    moved.x = -0.5;
    let Kept::Gltf(after) = read(written(&document, Format::Glb)).kept else {
        panic!("not of a glTF file");
    };
    assert_eq!(after.buffers[0][..4], (-0.5f32).to_le_bytes());
    assert_eq!(after.buffers[0][4..], before.buffers[0][4..]);
    assert_eq!(after.json["accessors"][0]["min"], json!([-0.5, 0.0, 0.0]));
    assert_eq!(
        after.json["extras"].to_string(),
        r#"{"b":1.0,"a":[0.1,1e-7]}"#
    );
    assert_eq!(after.json["cameras"], before.json["cameras"]);
}

#[test]
fn instances_that_differ_get_meshes_of_their_own() {
    let mut document = read(triangle(json!({
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [{ "mesh": 0 }, { "mesh": 0, "translation": [5, 0, 0] }],
    })));
    document.mesh.positions[4].y = 0.5;
    let one = read(written(&document, Format::Gltf));
    assert_eq!(one.mesh, document.mesh);
    assert_eq!(json_of(&one)["nodes"][0]["mesh"], 0);
    assert_eq!(json_of(&one)["nodes"][1]["mesh"], 1);
    // Both in the same way: one mesh still.
    document.mesh.positions[1].y = 0.5;
    let both = read(written(&document, Format::Gltf));
    assert_eq!(both.mesh, document.mesh);
    assert_eq!(json_of(&both)["meshes"].as_array().unwrap().len(), 1);
    assert_eq!(json_of(&both)["accessors"].as_array().unwrap().len(), 1);
}

#[test]
fn shared_bytes_are_not_overwritten() {
    let mut document = read(triangle(json!({
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "_REST": 1 } }] }],
        "accessors": [vectors(0, 0, 3), vectors(0, 0, 3)],
    })));
    document.mesh.positions[0].x = 7.0;
    let again = read(written(&document, Format::Gltf));
    assert_eq!(
        (&again.mesh, &again.layers),
        (&document.mesh, &document.layers)
    );
}

#[test]
fn directions_turn_with_their_node() {
    let numbers = [TRIANGLE, TRIANGLE].concat();
    let mut document = read(file(
        &bytes_of(&numbers),
        json!({
            "nodes": [{ "mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 1, 0] }],
            "meshes": [{ "primitives": [{
                "attributes": { "POSITION": 0, "NORMAL": 1 },
                "targets": [{ "POSITION": 0 }],
            }] }],
            "accessors": [vectors(0, 0, 3), vectors(0, 36, 3)],
        }),
    ));
    let values = |d: &Document, role| d.layer(On::Vertex, role).unwrap().values.clone();
    let morph = Role::Morph(0, MorphPart::Position);
    assert_eq!(values(&document, Role::Normal).get(1, 0), Some(-1.0));
    assert_eq!(values(&document, morph).get(1, 0), Some(-2.0));
    for layer in &mut document.layers {
        let Values::Rows { numbers, .. } = &mut layer.values else {
            continue;
        };
        [0.0, -3.0, 0.0]
            .iter()
            .enumerate()
            .for_each(|(k, &n)| numbers.set(3 + k, n));
    }
    let again = read(written(&document, Format::Gltf));
    assert_eq!(values(&again, Role::Normal).get(1, 1), Some(-1.0));
    assert_eq!(values(&again, morph).get(1, 1), Some(-3.0));
    assert_eq!(again.mesh, document.mesh);
}

#[test]
fn other_faces_make_a_fresh_file() {
    let mut document = read(triangle(
        json!({ "animations": [{ "channels": [], "samplers": [] }] }),
    ));
    assert!(io::losses(&document, Format::Glb).is_empty());
    document.mesh.polygons.push(&[2, 1, 0]);
    assert_eq!(io::losses(&document, Format::Glb), ["1 animation"]);
    let again = read(written(&document, Format::Gltf));
    assert_eq!(again.mesh, document.mesh);
    assert!(json_of(&again).get("animations").is_none());
}

#[test]
fn real_files_come_out_as_they_came() {
    let Some(folder) = common::data("formats") else {
        return;
    };
    let text = io::read(&folder.join("spot.gltf")).unwrap();
    let binary = io::read(&folder.join("spot.glb")).unwrap();
    assert_eq!(text.mesh, binary.mesh);
    assert_eq!(
        (text.mesh.positions.len(), text.mesh.polygons.len()),
        (2930, 5856)
    );
    let man = io::read(&folder.join("cesium_man_skinned.glb")).unwrap();
    assert_eq!(document(written(&man, Format::Gltf), Format::Gltf), man);
    let mut moved = man.clone();
    moved.mesh.positions.iter_mut().for_each(|p| p.x *= 1.1);
    let again = document(written(&moved, Format::Glb), Format::Glb);
    let pairs = again.mesh.positions.iter().zip(&moved.mesh.positions);
    assert!(pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max) < 1e-6);
    assert_eq!(again.layers, man.layers);
    for key in [
        "animations",
        "skins",
        "meshes",
        "materials",
        "images",
        "nodes",
    ] {
        assert_eq!(json_of(&again)[key], json_of(&man)[key]);
    }
}
