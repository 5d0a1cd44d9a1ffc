//! What a verb works on: a mesh file, or a shape that the program generates itself.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use symmetrizer::shape::models::Creature;
use symmetrizer::shape::{Document, io};
use symmetrizer::{Context, Error, Mesh, Result};

/// Help for inputs.
pub const HELP: &str = "Shape file (obj, ply, off, stl, gltf, glb, 3mf, xyz, txt), or model:creature or model:creature-at-rest, which are generated";

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
