//! Mesh files: read, write, and the formats by extension.
//!
//! Files carry geometry as they have it: vertex order, face order and n-gons are kept both ways.

mod obj;
mod off;
mod ply;
mod ply_elements;
mod stl;
mod text;
mod whole;

use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result};
use crate::shape::mesh::Mesh;

pub use whole::Output;

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ, text.
    Obj,
    /// Stanford PLY: reads text and both binary forms, writes binary little endian.
    Ply,
    /// Geomview OFF, text.
    Off,
    /// STL: reads text and binary, writes binary; single precision, triangles only.
    Stl,
}

impl Format {
    /// Every format, in the order of the documentation.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Ply, Self::Off, Self::Stl];

    /// The extension of the format's files, lower case, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Off => "off",
            Self::Stl => "stl",
        }
    }

    /// The format that the extension of `path` names, in upper or lower case.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for any other extension or none; it lists the supported ones.
    pub fn of_path(path: &Path) -> Result<Self> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
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

/// Reads the mesh file `path`, in the format that its extension names.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read; [`Error::Unsupported`] for an unknown extension;
/// [`Error::Input`] with the place in the file where its content is damaged, or where
/// [`Mesh::check`] finds nothing to work on.
pub fn read(path: &Path) -> Result<Mesh> {
    if path.is_dir() {
        return Err(Error::input("this is a directory", "name a mesh file in it").in_file(path));
    }
    let format = Format::of_path(path)?;
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    decode(bytes, format).map_err(|e| e.in_file(path))
}

/// The mesh in the bytes of a file.
///
/// # Errors
/// [`Error::Input`], as for [`read`] but without the file's name.
pub fn decode(bytes: Vec<u8>, format: Format) -> Result<Mesh> {
    if bytes.is_empty() {
        return Err(Error::input(
            "the file is empty",
            "export it again; it may have been cut off",
        ));
    }
    // A face corner takes at least a byte, so that below this limit every index fits in 32 bits.
    if u32::try_from(bytes.len()).is_err() {
        return Err(Error::input(
            "the file is larger than 4 GiB",
            "simplify the mesh first",
        ));
    }
    let mesh = match format {
        Format::Obj => obj::decode(&bytes),
        Format::Ply => ply::decode(&bytes),
        Format::Off => off::decode(&bytes),
        Format::Stl => stl::decode(bytes),
    }?;
    mesh.check()?;
    Ok(mesh)
}

/// Writes the mesh file `path`, in the format that its extension names; the file appears whole or
/// not at all.
///
/// # Errors
/// [`Error::Unsupported`] for an unknown extension; otherwise as for [`encode`] and [`Output`].
pub fn write(mesh: &Mesh, path: &Path) -> Result<()> {
    let format = Format::of_path(path)?;
    let mut output = Output::create(path)?;
    output.write(|w| encode(mesh, format, w))?;
    output.commit()
}

/// Writes the bytes of a file in `format`. Text and PLY keep every coordinate to the last bit; STL
/// rounds to single precision and cuts polygons into fans.
///
/// # Errors
/// [`Error::Input`] where [`Mesh::check`] fails or the format cannot hold the mesh;
/// [`Error::Io`] without a path where `w` fails (add it with [`Error::in_file`]).
pub fn encode(mesh: &Mesh, format: Format, w: &mut dyn Write) -> Result<()> {
    mesh.check()?;
    match format {
        Format::Obj => obj::encode(mesh, w),
        Format::Ply => ply::encode(mesh, w),
        Format::Off => off::encode(mesh, w),
        Format::Stl => stl::encode(mesh, w),
    }
}
