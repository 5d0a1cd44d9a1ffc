//! What a file holds that only its own format can hold again. Plain data: the format's reader
//! makes it, its writer uses it.

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
pub struct PlyKept {}

/// The rest of an STL file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StlKept {
    /// Whether it is the text form.
    pub text: bool,
    /// The 80 bytes before the count of a binary file; empty for text.
    pub header: Vec<u8>,
}

/// The rest of a glTF file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GltfKept {}

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
