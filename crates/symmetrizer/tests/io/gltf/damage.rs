//! Damaged and hostile files.

use serde_json::{Value, json};
use symmetrizer::shape::io::{self, Format};

use super::*;

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
