//! Shape files: read, write, and the formats by extension.
//!
//! A file becomes a [`Document`]: vertex order, face order and n-gons as they are, and everything
//! else the file says. What a format cannot hold is named by [`losses`], never dropped in silence.

mod disguise;
mod gltf;
mod input;
mod losses;
mod obj;
mod off;
mod ply;
mod stl;
mod temporary;
mod text;
mod threemf;
mod whole;
mod xyz;

use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result};
use crate::shape::document::{Document, Kept};

pub(crate) use input::bytes as file_bytes;
pub use whole::Output;

/// A shape file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, text.
    Obj,
    /// Stanford PLY, text and both binary forms.
    Ply,
    /// Geomview OFF, text.
    Off,
    /// STL, text and binary; single precision, triangles only.
    Stl,
    /// glTF, text with its buffers outside or inside; single precision, triangles only.
    Gltf,
    /// glTF, binary.
    Glb,
    /// 3MF, a packed XML document; triangles only.
    ThreeMf,
    /// XYZ, text: a point per line.
    Xyz,
}

impl Format {
    /// Every format, in the order of the documentation.
    pub const ALL: [Self; 8] = [
        Self::Obj,
        Self::Ply,
        Self::Off,
        Self::Stl,
        Self::Gltf,
        Self::Glb,
        Self::ThreeMf,
        Self::Xyz,
    ];

    /// The extension of the format's files, lower case, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Off => "off",
            Self::Stl => "stl",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
            Self::ThreeMf => "3mf",
            Self::Xyz => "xyz",
        }
    }

    /// The format that the extension of `path` names, in upper or lower case; `txt` stands for XYZ.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for any other extension or none; it lists the supported ones.
    pub fn of_path(path: &Path) -> Result<Self> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        if extension.eq_ignore_ascii_case("txt") {
            return Ok(Self::Xyz);
        }
        Self::ALL
            .into_iter()
            .find(|format| format.extension().eq_ignore_ascii_case(extension))
            .ok_or_else(|| unknown_extension(path, extension))
    }
}

fn unknown_extension(path: &Path, extension: &str) -> Error {
    let known = Format::ALL
        .map(|f| format!(".{}", f.extension()))
        .join(", ");
    let what = match extension {
        "" => "the file name has no extension".to_owned(),
        other => format!("files of type .{other} are not supported"),
    };
    Error::Unsupported(format!("{}: {what}; use one of {known}", path.display()))
}

/// Reads the shape file `path`, in the format that its extension names.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read; [`Error::Unsupported`] for an unknown extension;
/// [`Error::Input`] with the place in the file where its content is damaged, and at once for what
/// is no regular file (a directory, pipe, socket or device) and for files from 4 GiB on.
pub fn read(path: &Path) -> Result<Document> {
    read_with(path, Strictness::Refuse)
}

/// Reads the shape file `path` as [`read`] does, but keeps faces that cannot be used: with fewer
/// than three corners, or with vertices that are not there. Only for finding out what is wrong.
///
/// # Errors
/// As for [`read`], for all other damage.
pub fn examine(path: &Path) -> Result<Document> {
    read_with(path, Strictness::Keep)
}

fn read_with(path: &Path, strictness: Strictness) -> Result<Document> {
    // Pipes and directories have no extension: what they are says more.
    let format = match input::check(path) {
        Err(error @ Error::Input { .. }) => return Err(error),
        _ => Format::of_path(path)?,
    };
    let bytes = input::bytes(path)?;
    decode_beside(bytes, format, path.parent(), strictness).map_err(|e| e.in_file(path))
}

/// The document in the bytes of a file that needs no other file.
///
/// # Errors
/// [`Error::Input`], as for [`read`] but without the file's name.
pub fn decode(bytes: Vec<u8>, format: Format) -> Result<Document> {
    decode_beside(bytes, format, None, Strictness::Refuse)
}

/// What reading does with faces that name vertices which are not there, or have fewer than three
/// corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Strictness {
    /// Fails, and names the first.
    Refuse,
    /// Keeps them.
    Keep,
}

impl Strictness {
    fn refuses(self) -> bool {
        self == Self::Refuse
    }
}

/// The document in the bytes of a file; the files it names are looked for in `folder`.
fn decode_beside(
    bytes: Vec<u8>,
    format: Format,
    folder: Option<&Path>,
    strictness: Strictness,
) -> Result<Document> {
    if bytes.is_empty() {
        return Err(Error::input(
            "the file is empty",
            "export it again; it may have been cut off",
        ));
    }
    // A face corner takes at least a byte, so that below this limit every index fits in 32 bits.
    input::check_size(bytes.len() as u64)?;
    disguise::check(&bytes, format == Format::ThreeMf)?;
    let document = match format {
        Format::Obj => obj::decode(&bytes, strictness),
        Format::Ply => ply::decode(&bytes),
        Format::Off => off::decode(&bytes),
        Format::Stl => stl::decode(&bytes),
        Format::Gltf | Format::Glb => gltf::decode(bytes, folder),
        Format::ThreeMf => threemf::decode(bytes),
        Format::Xyz => xyz::decode(&bytes),
    }?;
    if strictness.refuses() {
        document.mesh.check_corners()?;
    }
    Ok(document)
}

/// Writes the shape file `path`, in the format that its extension names; the file appears whole or
/// not at all.
///
/// # Errors
/// [`Error::Unsupported`] for an unknown extension; otherwise as for [`encode`] and [`Output`].
pub fn write(document: &Document, path: &Path) -> Result<()> {
    let format = Format::of_path(path)?;
    let mut output = Output::create(path)?;
    output.write(|w| encode(document, format, w))?;
    output.commit()
}

/// Writes the bytes of a file in `format`. What the format cannot hold is left out; [`losses`] says
/// what that is.
///
/// # Errors
/// [`Error::Input`] where [`crate::Mesh::check_corners`] fails or the format cannot hold the
/// mesh; [`Error::Io`] without a path where `w` fails (add it with [`Error::in_file`]).
pub fn encode(document: &Document, format: Format, w: &mut dyn Write) -> Result<()> {
    document.mesh.check_corners()?;
    match format {
        Format::Obj => obj::encode(document, w),
        Format::Ply => ply::encode(document, w),
        Format::Off => off::encode(document, w),
        Format::Stl => stl::encode(document, w),
        Format::Gltf => gltf::encode_text(document, w),
        Format::Glb => gltf::encode_binary(document, w),
        Format::ThreeMf => threemf::encode(document, w),
        Format::Xyz => xyz::encode(document, w),
    }
}

/// What is lost when `document` is written in `format`, each in a phrase such as "12 animations";
/// empty where the file says all that the document does.
pub fn losses(document: &Document, format: Format) -> Vec<String> {
    let mut lost = losses::of_kept(document, format);
    lost.extend(match format {
        Format::Obj => obj::losses(document),
        Format::Ply => ply::losses(document),
        Format::Off => off::losses(document),
        Format::Stl => stl::losses(document),
        Format::Gltf | Format::Glb => gltf::losses(document),
        Format::ThreeMf => threemf::losses(document),
        Format::Xyz => xyz::losses(document),
    });
    lost
}

/// The files that `document` names when it is written in `format`, such as material libraries;
/// relative to the file's folder.
pub fn companions(document: &Document, format: Format) -> Vec<String> {
    match (&document.kept, format) {
        (Kept::Obj(kept), Format::Obj) => kept.libraries.clone(),
        (Kept::Ply(kept), Format::Ply) => ply::companions(kept),
        (Kept::Gltf(kept), Format::Gltf | Format::Glb) => gltf::companions(kept),
        _ => Vec::new(),
    }
}
