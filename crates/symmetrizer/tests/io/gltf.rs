//! glTF: what scenes, accessors and meshes may be, and that everything else stays as it came.

use base64::Engine;
use serde_json::{Value, json};
use symmetrizer::geom::Point;
use symmetrizer::shape::document::{Kept, Layer, MorphPart, NO_ROW, Numbers, On, Role, Values};
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, mesh::Mesh};

use super::common;
use super::shared::{document, faces, failure, mesh, pyramid};

const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

fn bytes_of(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// A file with one buffer; the members given are put over those of a single triangle.
fn file(bytes: &[u8], members: Value) -> Vec<u8> {
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
fn vectors(view: usize, offset: usize, count: usize) -> Value {
    json!({ "bufferView": view, "byteOffset": offset, "componentType": 5126, "count": count, "type": "VEC3" })
}

fn triangle(members: Value) -> Vec<u8> {
    file(&bytes_of(&TRIANGLE), members)
}

fn read(bytes: Vec<u8>) -> Document {
    document(bytes, Format::Gltf)
}

fn written(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, format, &mut bytes).unwrap();
    bytes
}

fn json_of(document: &Document) -> &Value {
    match &document.kept {
        Kept::Gltf(kept) => &kept.json,
        _ => panic!("not of a glTF file"),
    }
}

#[track_caller]
fn fails(bytes: &[u8], parts: &[&str]) {
    let message = failure(Format::Gltf, bytes);
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

fn layer(on: On, role: Role, name: &str, values: Values) -> Layer {
    Layer {
        name: name.into(),
        on,
        role,
        values,
    }
}

fn rows(role: Role, name: &str, width: usize, numbers: Numbers) -> Layer {
    layer(On::Vertex, role, name, Values::Rows { width, numbers })
}

fn names(role: Role, names: &[&str], of: &[u32]) -> Layer {
    let names = names.iter().map(|&n| n.to_owned()).collect();
    let of = of.to_vec();
    layer(On::Face, role, "", Values::Names { names, of })
}

/// Two triangles with every layer that a file holds.
fn rich() -> Document {
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

#[test]
fn fresh_files_hold_every_layer() {
    for format in [Format::Glb, Format::Gltf] {
        let rich = rich();
        assert_eq!(io::losses(&rich, format), Vec::<String>::new());
        let read = document(written(&rich, format), format);
        assert_eq!(read.mesh, rich.mesh);
        for layer in &rich.layers {
            assert!(
                read.layers.contains(layer),
                "{:?} {:?}",
                layer.role,
                read.layers
            );
        }
        assert_eq!(read.layers.len(), rich.layers.len());
    }
}

#[test]
fn both_forms_keep_the_same() {
    let glb = document(written(&rich(), Format::Glb), Format::Glb);
    let text = document(written(&glb, Format::Gltf), Format::Gltf);
    assert_eq!(glb, text);
    assert_eq!(written(&glb, Format::Glb), written(&text, Format::Glb));
}

#[test]
fn polygons_are_cut_and_points_stay() {
    let document = Document::from(pyramid());
    let lost = io::losses(&document, Format::Glb);
    assert!(
        lost[0].contains("1 faces of more than three corners"),
        "{lost:?}"
    );
    let read = self::document(written(&document, Format::Glb), Format::Glb);
    let expected: Vec<[u32; 3]> = document.mesh.triangles().map(|t| t.0).collect();
    assert_eq!(faces(&read.mesh), expected);
    assert_eq!(read.mesh.positions.len(), 6);
    let cloud = Document::from(mesh(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], &[]));
    let read = self::document(written(&cloud, Format::Glb), Format::Glb);
    assert_eq!(read.mesh, cloud.mesh);
    assert_eq!(json_of(&read)["meshes"][0]["primitives"][0]["mode"], 0);
    let nothing = Document::default();
    let read = self::document(written(&nothing, Format::Gltf), Format::Gltf);
    assert_eq!(read.mesh, Mesh::default());
}

#[test]
fn vertices_are_split_where_their_corners_differ() {
    let square = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let pool = Values::Pool {
        width: 2,
        numbers: Numbers::F64(vec![0.0, 0.0, 0.5, 0.0, 0.5, 0.5, 0.0, 0.0]),
        // Row 3 equals row 0; vertex 2 has rows 2 and 1.
        rows: vec![0, 1, 2, 3, 1, NO_ROW],
    };
    let document = Document {
        mesh: mesh(&square, &[&[0, 1, 2], &[0, 2, 3]]),
        layers: vec![layer(On::Corner, Role::TexCoord(0), "", pool)],
        kept: Kept::Nothing,
    };
    let lost = io::losses(&document, Format::Glb);
    assert!(
        lost.iter().any(|l| l.starts_with("1 shared vertex")),
        "{lost:?}"
    );
    let read = self::document(written(&document, Format::Glb), Format::Glb);
    assert_eq!(read.mesh.positions.len(), 5);
    assert_eq!(read.mesh.positions[2], read.mesh.positions[3]);
    assert_eq!(faces(&read.mesh), [[0, 1, 3], [0, 2, 4]]);
    let coordinates = &read.layer(On::Vertex, Role::TexCoord(0)).unwrap().values;
    let at = |v: usize| [coordinates.get(v, 0), coordinates.get(v, 1)].map(Option::unwrap);
    assert_eq!([at(2), at(3), at(4)], [[0.5, 0.0], [0.5, 0.5], [0.0, 0.0]]);
}

#[test]
fn objects_that_mix_are_said_to_be_lost() {
    let mut rich = rich();
    rich.mesh = mesh(&[[0.0; 3]; 6], &[&[0, 1, 4], &[5, 2, 3]]);
    let lost = io::losses(&rich, Format::Glb);
    assert_eq!(lost, ["object names (per face)"]);
    let read = document(written(&rich, Format::Glb), Format::Glb);
    assert_eq!(read.mesh, rich.mesh);
}

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
fn damage_is_named() {
    let of = |members| triangle(members);
    fails(b"{", &["JSON", "line 1"]);
    fails(b"{}", &["asset.version"]);
    fails(b"glTF\x01\0\0\0\x14\0\0\0", &["binary glTF 1"]);
    fails(b"glTF\x02\0\0\0\xFF\0\0\0", &["255 bytes", "cut off"]);
    fails(&of(json!({ "asset": { "version": "1.0" } })), &["glTF 1.0"]);
    fails(
        &of(json!({ "accessors": [vectors(0, 4, 3)] })),
        &["accessor 0", "buffer view 0"],
    );
    fails(
        &of(json!({ "accessors": [vectors(0, 0, usize::MAX)] })),
        &["accessor 0"],
    );
    fails(
        &of(json!({ "accessors": [] })),
        &["number 0 of 'accessors'", "only 0"],
    );
    let zeros = json!({ "componentType": 5126, "count": 1_000_000_000, "type": "VEC3" });
    fails(
        &of(json!({ "accessors": [zeros] })),
        &["more data than it has bytes"],
    );
    fails(
        &of(json!({ "nodes": [{ "children": [0] }] })),
        &["below themselves"],
    );
    fails(
        &of(json!({ "nodes": [{ "children": [1] }, {}, { "children": [1] }] })),
        &["node 1", "node 0", "node 2"],
    );
    let view = json!([{ "buffer": 0, "byteLength": 36, "byteStride": 1 }]);
    fails(&of(json!({ "bufferViews": view })), &["overlap"]);
    let view = json!([{ "buffer": 0, "byteOffset": 8, "byteLength": 36 }]);
    fails(
        &of(json!({ "bufferViews": view })),
        &["buffer view 0", "ends after buffer 0"],
    );
    fails(
        &of(json!({ "extensionsRequired": ["KHR_draco_mesh_compression"] })),
        &["KHR_draco_mesh_compression", "without compression"],
    );
    let corners = json!({ "bufferView": 0, "byteOffset": 12, "componentType": 5121, "count": 3, "type": "SCALAR" });
    let primitive = json!({ "attributes": { "POSITION": 0 }, "indices": 1 });
    fails(
        &of(
            json!({ "accessors": [vectors(0, 0, 3), corners], "meshes": [{ "primitives": [primitive] }] }),
        ),
        &["index 2 of primitive 0 of mesh 0", "vertex 128", "only 3"],
    );
}

#[test]
fn buffers_lie_beside_the_file_only() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shape.gltf");
    let with_uri = |uri: &str| {
        let mut json: Value = serde_json::from_slice(&triangle(json!({}))).unwrap();
        json["buffers"][0]["uri"] = json!(uri);
        json.to_string()
    };
    std::fs::write(folder.path().join("my data.bin"), bytes_of(&TRIANGLE)).unwrap();
    std::fs::write(&path, with_uri("my%20data.bin")).unwrap();
    let read = io::read(&path).unwrap();
    assert_eq!(read.mesh.positions[1].x, 1.0);
    assert_eq!(read, self::read(triangle(json!({}))));
    fails(
        with_uri("my%20data.bin").as_bytes(),
        &["my%20data.bin", "another file"],
    );
    for (uri, part) in [
        ("gone.bin", "'gone.bin' of buffer 0 cannot be read"),
        ("../my data.bin", "outside"),
        ("%2E%2e/my data.bin", "outside"),
        ("/etc/passwd", "absolute"),
        ("https://example.org/a.bin", "address"),
        ("a%GG.bin", "cannot be read"),
    ] {
        std::fs::write(&path, with_uri(uri)).unwrap();
        let message = io::read(&path).unwrap_err().to_string();
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

#[test]
fn damaged_bytes_never_panic() {
    let whole = written(&rich(), Format::Glb);
    for end in (0..whole.len()).step_by(3) {
        let _ = io::decode(whole[..end].to_vec(), Format::Glb);
    }
    for at in (0..whole.len()).step_by(5) {
        for value in [0, b'-', b'9', 0xFF] {
            let mut bytes = whole.clone();
            bytes[at] = value;
            if let Ok(document) = io::decode(bytes, Format::Glb) {
                let _ = io::encode(&document, Format::Glb, &mut Vec::new());
            }
        }
    }
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
