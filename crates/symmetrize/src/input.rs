//! What a verb works on: a mesh file, or a shape that the program generates itself.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Args;
use symmetrizer::drawing::{self, Drawing, Reading};
use symmetrizer::shape::models::Creature;
use symmetrizer::shape::{Document, io};
use symmetrizer::{
    Context, Detected, Error, Measured, Mesh, Params, Result, detect_document, detect_drawing,
    measure_drawing, measure_in,
};

/// Help for inputs.
pub const HELP: &str = "Shape file (obj, ply, off, stl, gltf, glb, 3mf, xyz, txt), drawing (svg, png, jpg, json), or model:creature or model:creature-at-rest, which are generated";

/// What a file holds.
pub enum Subject {
    /// A shape of space.
    Shape(Document),
    /// A shape of the plane.
    Drawing(Drawing),
}

impl Subject {
    /// Finds its symmetries; with the mesh that the report is about.
    pub fn detect(&self, params: &Params, ctx: &mut Context<'_>) -> Result<(Mesh, Detected)> {
        match self {
            Self::Shape(document) => {
                let found = detect_document(document, params, ctx)?;
                Ok((document.mesh.clone(), found))
            }
            Self::Drawing(drawing) => detect_drawing(drawing, params, ctx),
        }
    }

    /// Measures it; with the mesh that the report is about.
    pub fn measure(
        &self,
        original: Option<&Self>,
        ctx: &mut Context<'_>,
    ) -> Result<(Mesh, Measured)> {
        match (self, original) {
            (Self::Shape(document), None | Some(Self::Shape(_))) => {
                let original = original.and_then(Self::mesh);
                let measured = measure_in(&document.mesh, original, ctx)?;
                Ok((document.mesh.clone(), measured))
            }
            (Self::Drawing(drawing), None) => measure_drawing(drawing, ctx),
            _ => Err(Error::params(
                "--against",
                "compares two meshes of space; drawings keep no vertices to compare",
            )),
        }
    }

    fn mesh(&self) -> Option<&Mesh> {
        match self {
            Self::Shape(document) => Some(&document.mesh),
            Self::Drawing(_) => None,
        }
    }
}

/// Whether the file's extension is that of a drawing and of nothing else.
pub fn is_drawing(path: &Path) -> bool {
    drawing::Format::of_path(path).is_ok_and(|format| format != drawing::Format::Obj)
}

/// The flag for pictures that are read.
#[derive(Args)]
pub struct Bitmaps {
    /// Of a bitmap (png, jpg), how dark the shape's border is, 0 (white or clear) to 1 (black) [default: the
    /// middle between its light and its dark]
    #[arg(long, value_name = "SHARE")]
    threshold: Option<f64>,
}

impl Bitmaps {
    /// Fails where the flag was given for what is no bitmap.
    fn check(&self) -> Result<()> {
        match self.threshold {
            Some(_) => Err(Error::params("--threshold", "is for bitmaps: png and jpg")),
            None => Ok(()),
        }
    }
}

/// The argument INPUT.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// A mesh file.
    File(PathBuf),
    /// The name of a generated shape.
    Model(String),
}

impl From<OsString> for Input {
    fn from(text: OsString) -> Self {
        match text.to_str().and_then(|t| t.strip_prefix("model:")) {
            Some(name) => Self::Model(name.to_owned()),
            None => Self::File(text.into()),
        }
    }
}

impl Input {
    /// Reads or generates the shape, as the stage `read` of `ctx`.
    pub fn read(&self, ctx: &mut Context<'_>) -> Result<Document> {
        self.read_with(io::read, ctx)
    }

    /// Reads or generates the shape, or the drawing that the file is, as the stage `read` of `ctx`.
    pub fn subject(&self, bitmaps: &Bitmaps, ctx: &mut Context<'_>) -> Result<Subject> {
        if let Some(path) = self.path().filter(|path| is_drawing(path)) {
            let reading = Reading {
                threshold: bitmaps.threshold,
            };
            let drawing = ctx.stage("read", |_| drawing::read(path, &reading))?;
            return Ok(Subject::Drawing(drawing));
        }
        bitmaps.check()?;
        let document = self.read(ctx)?;
        Ok(match Drawing::of_flat(&document) {
            Some(drawing) => Subject::Drawing(drawing),
            None => Subject::Shape(document),
        })
    }

    /// The same, with faces that cannot be used.
    pub fn examine(&self, ctx: &mut Context<'_>) -> Result<Document> {
        self.read_with(io::examine, ctx)
    }

    fn read_with(
        &self,
        read: fn(&Path) -> Result<Document>,
        ctx: &mut Context<'_>,
    ) -> Result<Document> {
        ctx.stage("read", |_| match self {
            Self::File(path) => read(path),
            Self::Model(name) => generate(name).map(Document::from),
        })
    }

    /// The file, if it is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Model(_) => None,
        }
    }

    /// The error, with the file's name where it is about the shape.
    pub fn blame(&self, error: Error) -> Error {
        error.in_file(self.name())
    }

    /// As the user named it.
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Model(name) => format!("model:{name}"),
        }
    }

    /// A short name for titles: without the folder.
    pub fn title(&self) -> String {
        let file = self.path().and_then(Path::file_name);
        file.map_or_else(|| self.name(), |f| f.to_string_lossy().into_owned())
    }
}

fn generate(name: &str) -> Result<Mesh> {
    let creature = match name {
        "creature" => Creature::default(),
        "creature-at-rest" => Creature::at_rest(),
        _ => {
            return Err(Error::input(
                format!("there is no generated shape model:{name}"),
                "there are model:creature and model:creature-at-rest",
            ));
        }
    };
    Ok(creature.mesh())
}
