//! What a verb works on: a mesh file, or a shape that the program generates itself.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use symmetrizer::shape::io;
use symmetrizer::shape::models::Creature;
use symmetrizer::{Context, Mesh, Result};

/// Help for inputs.
pub const HELP: &str = "Mesh file (obj, ply, off, stl), or model:creature or model:creature-at-rest, which are generated";

/// The argument INPUT.
#[derive(Debug, Clone, PartialEq)]
pub enum Input {
    /// A mesh file.
    File(PathBuf),
    /// A generated shape, and what it was called.
    Model(String, Creature),
}

impl FromStr for Input {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let Some(name) = text.strip_prefix("model:") else {
            return Ok(Self::File(text.into()));
        };
        let creature = match name {
            "creature" => Creature::default(),
            "creature-at-rest" => Creature::at_rest(),
            _ => return Err("the models are model:creature and model:creature-at-rest".into()),
        };
        Ok(Self::Model(text.to_owned(), creature))
    }
}

impl Input {
    /// Reads or generates the mesh, as the stage `read` of `ctx`.
    pub fn read(&self, ctx: &mut Context<'_>) -> Result<Mesh> {
        ctx.stage("read", |_| match self {
            Self::File(path) => io::read(path),
            Self::Model(_, creature) => Ok(creature.mesh()),
        })
    }

    /// The file, if it is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Model(..) => None,
        }
    }

    /// As the user named it.
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => path.display().to_string(),
            Self::Model(name, _) => name.clone(),
        }
    }

    /// A short name for titles: without the folder.
    pub fn title(&self) -> String {
        let file = self.path().and_then(Path::file_name);
        file.map_or_else(|| self.name(), |f| f.to_string_lossy().into_owned())
    }
}
