//! What a file holds that only its own format can hold again. Plain data: the format's reader
//! makes it, its writer uses it.

use std::sync::Arc;

use super::layer::Values;
use super::numbers::Kind;

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
    /// The comments at the head of the file.
    pub comments: Vec<String>,
    /// What the `mtllib` lines name, in order.
    pub libraries: Vec<String>,
    /// Lines and points (`l`, `p`, indices from 1), and statements that are not known, as they stand
    /// in the file.
    pub statements: Vec<String>,
}

/// The rest of a PLY file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlyKept {
    /// How its numbers are written.
    pub form: PlyForm,
    /// The elements in the order of the header.
    pub elements: Vec<PlyElement>,
    /// The lines `comment` and `obj_info`, in order.
    pub remarks: Vec<PlyRemark>,
}

/// How the numbers of a PLY file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PlyForm {
    /// As text.
    Text,
    /// Binary, the lowest byte first.
    #[default]
    Little,
    /// Binary, the highest byte first.
    Big,
}

/// An element of a PLY file: a kind of things, each with the same properties.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyElement {
    /// Its name, such as `edge`.
    pub name: String,
    /// What there is for each of these things.
    pub properties: Vec<PlyProperty>,
}

/// A property of a PLY element.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyProperty {
    /// Its name.
    pub name: String,
    /// The type of its numbers.
    pub kind: Kind,
    /// Of a list: the type of its length.
    pub count: Option<Kind>,
    /// Rows of one number, or lists; `None` of vertices and faces, whose values are the mesh and
    /// its layers.
    pub values: Option<Values>,
}

/// A line of a PLY header that says nothing to a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlyRemark {
    /// How many lines `format`, `element` and `property` stand before it.
    pub place: usize,
    /// The whole line, in whatever encoding it has.
    pub line: Vec<u8>,
}

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
pub struct ThreeMfKept {
    /// The whole file.
    pub package: Vec<u8>,
    /// Where the vertices come from, in their order.
    pub blocks: Vec<ThreeMfBlock>,
    /// What the file says besides shapes, names and materials, in phrases such as "3 metadata
    /// elements".
    pub besides: Vec<String>,
}

/// A run of vertices: an object of a 3MF file at one of its places.
#[derive(Debug, Clone, PartialEq)]
pub struct ThreeMfBlock {
    /// The part of the package that has the object.
    pub part: String,
    /// The object's id in that part.
    pub object: u32,
    /// From the object's coordinates to those of the document, as the `transform` attribute has
    /// it; `None` where they are the same.
    pub transform: Option<String>,
    /// How many vertices.
    pub vertices: usize,
}
