//! Layers from the attributes of many meshes, each of which may have them in its own way.

use std::collections::BTreeMap;

use super::accessor::{Accessor, most};
use super::attribute::Attribute;
use super::container::File;
use crate::error::{Error, Result};
use crate::shape::document::{Kind, Layer, Numbers, On, Role, Values};

/// The values of one attribute at the vertices of one block.
pub(super) struct Chunk {
    /// The block's first vertex.
    pub first: usize,
    pub width: usize,
    pub numbers: Numbers,
}

impl Chunk {
    /// The values that `accessor` has for the vertices from `first` on.
    ///
    /// Colours and weights stay whole numbers where the file has them so; other whole numbers that
    /// stand for fractions become these.
    pub fn new(file: &File, accessor: &Accessor, role: Role, first: usize) -> Result<Self> {
        let stays = matches!(role, Role::Color(_) | Role::Weights(_));
        let numbers = if role.turns() || (accessor.normalized && !stays) {
            let floats = accessor.floats(file)?;
            Numbers::F32(floats.into_iter().map(|n| n as f32).collect())
        } else {
            accessor.numbers(file)?
        };
        Ok(Self {
            first,
            width: accessor.width,
            numbers,
        })
    }
}

/// The accessor of an attribute of the `count` vertices of `place`.
pub(super) fn of_vertices(
    file: &File,
    index: usize,
    count: usize,
    role: Role,
    place: &str,
) -> Result<Accessor> {
    let accessor = Accessor::new(file, index, place)?;
    check_width(role, &accessor)?;
    if accessor.count == count {
        return Ok(accessor);
    }
    let given = accessor.count;
    let what = format!("accessor {index} has {given} values for the {count} vertices of {place}");
    Err(Error::input(what, super::json::DAMAGED))
}

/// Fails where values of a role cannot have as many numbers as an accessor has.
fn check_width(role: Role, accessor: &Accessor) -> Result<()> {
    let width = accessor.width;
    let fits = match role {
        Role::Normal | Role::Morph(..) => width == 3,
        Role::Tangent | Role::Joints(_) | Role::Weights(_) => width == 4,
        Role::TexCoord(_) => width == 2,
        Role::Color(_) => width == 3 || width == 4,
        _ => true,
    };
    if fits {
        return Ok(());
    }
    Err(Error::input(
        format!(
            "accessor {} has {width} numbers per vertex, which does not fit its use",
            accessor.index
        ),
        super::json::DAMAGED,
    ))
}

/// Layers being collected.
#[derive(Default)]
pub(super) struct Tracks {
    tracks: Vec<(Role, String, Vec<Chunk>)>,
    known: BTreeMap<Attribute, usize>,
}

impl Tracks {
    /// Adds the values of an attribute at a block behind all others.
    pub fn add(&mut self, attribute: &Attribute, role: Role, name: String, chunk: Chunk) {
        let track = *self.known.entry(attribute.clone()).or_insert_with(|| {
            self.tracks.push((role, name, Vec::new()));
            self.tracks.len() - 1
        });
        self.tracks[track].2.push(chunk);
    }

    /// The layers for `count` vertices, and the layer of each attribute.
    pub fn layers(
        self,
        file: &File,
        count: usize,
    ) -> Result<(Vec<Layer>, BTreeMap<Attribute, usize>)> {
        let mut layers = Vec::new();
        for (role, name, chunks) in self.tracks {
            layers.push(Layer {
                name,
                on: On::Vertex,
                role,
                values: rows(file, role, chunks, count)?,
            });
        }
        Ok((layers, self.known))
    }
}

/// One type and width for all chunks; vertices without values get zeros, or white.
fn rows(file: &File, role: Role, mut chunks: Vec<Chunk>, count: usize) -> Result<Values> {
    let width = chunks.iter().map(|c| c.width).max().unwrap_or(1);
    if chunks.len() == 1 && chunks[0].numbers.len() == count * width {
        let numbers = chunks.remove(0).numbers;
        return Ok(Values::Rows { width, numbers });
    }
    file.charge(count.saturating_mul(width))?;
    let kinds = chunks.iter().map(|c| c.numbers.kind());
    let kind = kinds.reduce(|a, b| common(role, a, b)).unwrap_or(Kind::F32);
    let is_color = matches!(role, Role::Color(_));
    let white = if is_color {
        most(kind).unwrap_or(1.0)
    } else {
        0.0
    };
    let mut numbers = Numbers::with_capacity(kind, count * width);
    for chunk in &chunks {
        (numbers.len()..chunk.first * width).for_each(|_| numbers.push(white));
        let scale = scale(role, chunk.numbers.kind(), kind);
        for i in 0..chunk.numbers.len() / chunk.width {
            for k in 0..width {
                let has = (k < chunk.width).then(|| chunk.numbers.get(i * chunk.width + k));
                numbers.push(has.map_or(white, |n| n * scale));
            }
        }
    }
    (numbers.len()..count * width).for_each(|_| numbers.push(white));
    Ok(Values::Rows { width, numbers })
}

/// A type that holds the numbers of two others.
fn common(role: Role, a: Kind, b: Kind) -> Kind {
    let fractions = matches!(role, Role::Color(_) | Role::Weights(_) | Role::TexCoord(_));
    match (a, b) {
        (a, b) if a == b => a,
        _ if fractions => Kind::F32,
        (Kind::U8, Kind::U16) | (Kind::U16, Kind::U8) => Kind::U16,
        (Kind::U8 | Kind::U16, Kind::U32) | (Kind::U32, Kind::U8 | Kind::U16) => Kind::U32,
        (Kind::I8, Kind::I16) | (Kind::I16, Kind::I8) => Kind::I16,
        _ => Kind::F64,
    }
}

/// Whole colours and weights stand for fractions, also where fractions are what others have.
fn scale(role: Role, from: Kind, to: Kind) -> f64 {
    let fractions = matches!(role, Role::Color(_) | Role::Weights(_));
    match most(from) {
        Some(most) if fractions && to.is_float() => 1.0 / most,
        _ => 1.0,
    }
}
