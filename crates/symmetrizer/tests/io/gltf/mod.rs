//! glTF: what scenes, accessors and meshes may be, and that everything else stays as it came.

mod damage;
mod fresh;
mod kept;
mod scenes;

use crate::shared::{document, failure, mesh};
use base64::Engine;
use serde_json::{Value, json};
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{Kept, Layer, MorphPart, NO_ROW, Numbers, On, Role, Values};
use symmetrizer::shape::io::{self, Format};

pub(super) const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

pub(super) fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// A file with one buffer; the members given are put over those of a single triangle.
pub(super) fn file(bytes: &[u8], members: Value) -> Vec<u8> {
    let data = base64::engine::general_purpose::STANDARD.encode(bytes);
    let uri = format!("data:application/octet-stream;base64,{data}");
    let mut root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [vectors(0, 0, 3)],
        "bufferViews": [{ "buffer": 0, "byteLength": bytes.len() }],
        "buffers": [{ "byteLength": bytes.len(), "uri": uri }],
    });
    for (key, value) in members.as_object().unwrap() {
        root[key] = value.clone();
    }
    root.to_string().into_bytes()
}

/// An accessor of vectors in single precision.
pub(super) fn vectors(view: usize, offset: usize, count: usize) -> Value {
    json!({ "bufferView": view, "byteOffset": offset, "componentType": 5126, "count": count, "type": "VEC3" })
}

pub(super) fn triangle(members: Value) -> Vec<u8> {
    file(&bytes_of(&TRIANGLE), members)
}

pub(super) fn read(bytes: Vec<u8>) -> Document {
    document(bytes, Format::Gltf)
}

pub(super) fn written(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, format, &mut bytes).unwrap();
    bytes
}

pub(super) fn json_of(document: &Document) -> &Value {
    match &document.kept {
        Kept::Gltf(kept) => &kept.json,
        _ => panic!("not of a glTF file"),
    }
}

#[track_caller]
pub(super) fn fails(bytes: &[u8], parts: &[&str]) {
    let message = failure(Format::Gltf, bytes);
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

pub(super) fn layer(on: On, role: Role, name: &str, values: Values) -> Layer {
    Layer {
        name: name.into(),
        on,
        role,
        values,
    }
}

pub(super) fn rows(role: Role, name: &str, width: usize, numbers: Numbers) -> Layer {
    layer(On::Vertex, role, name, Values::Rows { width, numbers })
}

pub(super) fn names(role: Role, names: &[&str], of: &[u32]) -> Layer {
    let names = names.iter().map(|&n| n.to_owned()).collect();
    let of = of.to_vec();
    layer(On::Face, role, "", Values::Names { names, of })
}

/// Two triangles with every layer that a file holds.
pub(super) fn rich() -> Document {
    let position = |i: u32| {
        [
            f64::from(i) * 0.5,
            f64::from(i % 2),
            f64::from(i * i) * 0.125,
        ]
    };
    let positions: Vec<[f64; 3]> = (0..6).map(position).collect();
    let singles = |count: usize| Numbers::F32((0..count).map(|i| i as f32 * 0.1).collect());
    let units = |width: usize| {
        Numbers::F32(
            (0..6 * width)
                .map(|i| f32::from(u8::from(i % width == 0)))
                .collect(),
        )
    };
    Document {
        mesh: mesh(&positions, &[&[0, 1, 2], &[5, 4, 3]]),
        layers: vec![
            rows(Role::Color(0), "", 3, Numbers::U8((0..18).collect())),
            rows(Role::Color(1), "", 4, singles(24)),
            rows(Role::Normal, "", 3, units(3)),
            rows(Role::Tangent, "", 4, units(4)),
            rows(Role::TexCoord(0), "", 2, singles(12)),
            rows(Role::Joints(0), "", 4, Numbers::U8(vec![0; 24])),
            rows(Role::Weights(0), "", 4, Numbers::U16(vec![16384; 24])),
            rows(Role::Other, "_HEAT", 1, singles(6)),
            rows(Role::Other, "_step", 2, Numbers::I16((-6..6).collect())),
            rows(Role::Morph(0, MorphPart::Position), "", 3, singles(18)),
            rows(Role::Morph(0, MorphPart::Normal), "", 3, singles(18)),
            rows(Role::Morph(1, MorphPart::Position), "", 3, singles(18)),
            names(Role::Material, &["red", "blue"], &[1, NO_ROW]),
            names(Role::Object, &["left", "right"], &[0, 1]),
        ],
        kept: Kept::Nothing,
    }
}
