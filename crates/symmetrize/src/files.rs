//! Output files: reserved before the slow work, each written whole, then renamed one after the other.

use std::path::{Path, PathBuf};

use symmetrizer::drawing;
use symmetrizer::picture::Canvas;
use symmetrizer::report::to_json;
use symmetrizer::shape::Document;
use symmetrizer::shape::io::{Format, Output, companions, encode, losses};
use symmetrizer::{Error, Result};

use crate::input::{Subject, is_drawing};

/// How a picture is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PictureFormat {
    Png,
    Svg,
}

/// A reserved file for a shape of space or of the plane.
pub struct ShapeFile(Output);

/// A reserved picture file.
pub struct PictureFile(Output, PictureFormat);

/// A reserved report file.
pub struct ReportFile(Output);

impl ShapeFile {
    /// Reserves `path`; its extension is the format.
    pub fn reserve(path: &Path) -> Result<Self> {
        if !is_drawing(path) {
            Format::of_path(path)?;
        }
        Ok(Self(Output::create(path)?))
    }

    /// Fails where the format is one of the other kind.
    pub fn check(&self, subject: &Subject) -> Result<()> {
        let path = self.0.target();
        match subject {
            Subject::Drawing(drawing) if is_drawing(path) || drawing.document().is_none() => {
                drawing::Format::of_path(path).map(|_| ())
            }
            _ => Format::of_path(path).map(|_| ()),
        }
    }

    /// What of `document` the file does not hold, and which files it needs beside it.
    pub fn warnings(&self, subject: &Subject) -> Vec<String> {
        match subject {
            Subject::Shape(document) => self.warnings_of(document),
            Subject::Drawing(drawing) => match drawing.document() {
                Some(document) if !is_drawing(self.0.target()) => self.warnings_of(document),
                _ => Vec::new(),
            },
        }
    }

    fn warnings_of(&self, document: &Document) -> Vec<String> {
        let file = self.0.target();
        let Ok(format) = Format::of_path(file) else {
            return Vec::new();
        };
        let name = file.file_name().unwrap_or(file.as_os_str());
        let name = name.to_string_lossy();
        let lost = losses(document, format).into_iter();
        let lost = lost.map(|lost| format!("{name} does not hold {lost}"));
        let folder = file.parent().unwrap_or(Path::new("."));
        // One line of an OBJ file may name several.
        let is_there = |name: &String| {
            let all = || name.split_whitespace().all(|n| folder.join(n).exists());
            folder.join(name).exists() || all()
        };
        let needed = companions(document, format).into_iter();
        let missing = needed.filter(|needed| !is_there(needed));
        let missing = missing.map(|m| format!("{name} names the file {m}: copy it beside it"));
        lost.chain(missing).collect()
    }

    /// Writes the shape; the file appears with [`commit`].
    pub fn write(mut self, subject: &Subject) -> Result<Output> {
        let path = self.0.target().to_owned();
        let mesh = match subject {
            Subject::Shape(document) => Some(document),
            // A flat mesh is written as one where that is asked for.
            Subject::Drawing(drawing) => drawing.document().filter(|_| !is_drawing(&path)),
        };
        match (mesh, subject) {
            (None, Subject::Drawing(drawing)) => {
                let format = drawing::Format::of_path(&path)?;
                self.0.write(|w| drawing.encode(format, w))?;
            }
            (Some(document), _) | (None, Subject::Shape(document)) => {
                let format = Format::of_path(&path)?;
                self.0.write(|w| encode(document, format, w))?;
            }
        }
        Ok(self.0)
    }
}

impl PictureFile {
    /// Reserves `path`, which ends in .png or .svg.
    pub fn reserve(path: &Path) -> Result<Self> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        let format = match extension.to_ascii_lowercase().as_str() {
            "png" => PictureFormat::Png,
            "svg" => PictureFormat::Svg,
            _ => return Err(unknown_picture(path)),
        };
        Ok(Self(Output::create(path)?, format))
    }

    /// Writes the picture; the file appears with [`commit`].
    pub fn write(mut self, canvas: &Canvas) -> Result<Output> {
        let bytes = match self.1 {
            PictureFormat::Png => canvas.to_png()?,
            PictureFormat::Svg => canvas.to_svg()?.into_bytes(),
        };
        write_bytes(&mut self.0, &bytes)?;
        Ok(self.0)
    }
}

impl ReportFile {
    /// Reserves `path`.
    pub fn reserve(path: &Path) -> Result<Self> {
        Ok(Self(Output::create(path)?))
    }

    /// Writes the report; the file appears with [`commit`].
    pub fn write(mut self, report: &impl serde::Serialize) -> Result<Output> {
        write_bytes(&mut self.0, to_json(report)?.as_bytes())?;
        Ok(self.0)
    }
}

/// Lets complete files appear.
pub fn commit(files: impl IntoIterator<Item = Output>) -> Result<()> {
    files.into_iter().try_for_each(Output::commit)
}

/// Fails where two outputs are one file, or where one that is no mesh would replace the input.
pub fn check_distinct(input: Option<&Path>, meshes: &[&Path], others: &[&Path]) -> Result<()> {
    let real = |p: &Path| -> PathBuf {
        let folder = p.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new(".")).canonicalize();
        let joined = folder.ok().zip(p.file_name()).map(|(f, n)| f.join(n));
        let whole = p.canonicalize().ok();
        whole.or(joined).unwrap_or_else(|| p.to_owned())
    };
    let mut seen: Vec<PathBuf> = Vec::new();
    for path in meshes.iter().chain(others) {
        if seen.contains(&real(path)) {
            let what = "two outputs cannot be the same file";
            return Err(Error::input(what, "name another file").in_file(*path));
        }
        seen.push(real(path));
    }
    let input = input.map(real);
    for path in others {
        if Some(real(path)) == input {
            let what = "this would replace the input";
            return Err(Error::input(what, "name another file").in_file(*path));
        }
    }
    Ok(())
}

fn write_bytes(output: &mut Output, bytes: &[u8]) -> Result<()> {
    output.write(|w| w.write_all(bytes).map_err(|e| Error::io("", e)))
}

fn unknown_picture(path: &Path) -> Error {
    let path = path.display();
    Error::Unsupported(format!("{path}: pictures are written as .png or .svg"))
}
