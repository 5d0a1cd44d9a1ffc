//! The formats of drawings.

use std::path::Path;

use crate::error::{Error, Result};

/// A drawing file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable Vector Graphics, text.
    Svg,
    /// Portable Network Graphics; read as a silhouette, written as a picture.
    Png,
    /// JPEG; read only.
    Jpeg,
    /// Polylines: `{"rings": [[[x, y], ...], ...]}`, y upwards.
    Json,
    /// A flat mesh, Wavefront OBJ.
    Obj,
}

impl Format {
    /// Every format, in the order of the documentation.
    pub const ALL: [Self; 5] = [Self::Svg, Self::Png, Self::Jpeg, Self::Json, Self::Obj];

    /// The extension of the format's files, lower case, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Jpeg => "jpg",
            Self::Json => "json",
            Self::Obj => "obj",
        }
    }

    /// The format that the extension of `path` names, in upper or lower case; `jpeg` stands for JPEG.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for any other extension or none; it lists the supported ones.
    pub fn of_path(path: &Path) -> Result<Self> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        if extension.eq_ignore_ascii_case("jpeg") {
            return Ok(Self::Jpeg);
        }
        let mut all = Self::ALL.into_iter();
        all.find(|f| f.extension().eq_ignore_ascii_case(extension))
            .ok_or_else(|| {
                let known = Self::ALL.map(|f| format!(".{}", f.extension())).join(", ");
                let what = format!("{}: no drawing; use one of {known}", path.display());
                Error::Unsupported(what)
            })
    }

    /// The format of some bytes that are said to be of this one: pictures of either kind are often
    /// named after the other.
    pub(super) fn told_by(self, bytes: &[u8]) -> Self {
        match self {
            Self::Png | Self::Jpeg if bytes.starts_with(b"\x89PNG") => Self::Png,
            Self::Png | Self::Jpeg if bytes.starts_with(&[0xff, 0xd8]) => Self::Jpeg,
            other => other,
        }
    }
}
