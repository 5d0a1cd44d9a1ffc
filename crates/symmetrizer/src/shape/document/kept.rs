//! What a file holds that only its own format can hold again. Plain data: the format's reader
//! makes it, its writer uses it.

use std::sync::Arc;

/// The rest of a file, by its format.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Kept {
    /// Nothing besides mesh and layers.
    #[default]
    Nothing,
    /// Of an OBJ file.
    Obj(ObjKept),
    /// Of a PLY file.
    Ply(PlyKept),
    /// Of an STL file.
    Stl(StlKept),
    /// Of a glTF file.
    Gltf(GltfKept),
    /// Of a 3MF file.
    ThreeMf(ThreeMfKept),
}

/// The rest of an OBJ file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjKept {
    /// What the `mtllib` lines name, in order.
    pub libraries: Vec<String>,
    /// Lines and points (`l`, `p`) as they stand in the file, vertices counted from 1.
    pub elements: Vec<String>,
}

/// The rest of a PLY file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlyKept {}

/// The rest of an STL file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StlKept {
    /// Whether it is the text form.
    pub text: bool,
    /// The 80 bytes before the count of a binary file; empty for text.
    pub header: Vec<u8>,
}

/// A glTF file as it came: mesh and layers are read from it again when it is written, so that only
/// what has changed since is replaced.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GltfKept {
    /// The JSON, without the `uri` of the buffers.
    pub json: serde_json::Value,
    /// The bytes of each buffer that the JSON lists.
    pub buffers: Vec<Arc<Vec<u8>>>,
}

/// The rest of a 3MF file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ThreeMfKept {}
