//! What has changed at the vertices of a block, in the coordinates of its mesh.

use super::accessor::Accessor;
use super::attribute::{Attribute, direction};
use super::container::File;
use super::read::{Block, Shape, row};
use super::writer::single;
use crate::error::Result;
use crate::geom::Point;
use crate::shape::document::{Document, Layer};

/// New values of an attribute at some vertices of a part of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// The part, by its number in the mesh.
    pub part: usize,
    pub attribute: Attribute,
    pub accessor: usize,
    /// Vertices, counted in the part, with their new values.
    pub rows: Vec<(usize, [f32; 4])>,
}

/// The changes of `document`, which was read as `shape`, at one of its blocks.
pub(super) fn patches(
    document: &Document,
    file: &File,
    shape: &Shape,
    block: &Block,
) -> Result<Vec<Patch>> {
    let attributes = &shape.parts[&block.mesh].parts[block.part].attributes;
    let mut patches = Vec::new();
    for (attribute, accessor) in attributes {
        let rows = match shape.layer_of.get(attribute) {
            _ if attribute.is_position() => positions(document, file, shape, block, *accessor)?,
            Some(&l) => directions(&document.layers[l], &shape.layers[l], block),
            None => Vec::new(),
        };
        if !rows.is_empty() {
            patches.push(Patch {
                part: block.part,
                attribute: attribute.clone(),
                accessor: *accessor,
                rows,
            });
        }
    }
    Ok(patches)
}

fn positions(
    document: &Document,
    file: &File,
    shape: &Shape,
    block: &Block,
    accessor: usize,
) -> Result<Vec<(usize, [f32; 4])>> {
    let bits = |p: &Point| [p.x, p.y, p.z].map(f64::to_bits);
    let (new, old) = (&document.mesh.positions, &shape.mesh.positions);
    let differs = |v: &usize| bits(&new[block.first + v]) != bits(&old[block.first + v]);
    let moved: Vec<usize> = (0..block.count).filter(differs).collect();
    if moved.is_empty() {
        return Ok(Vec::new());
    }
    let local = Accessor::new(file, accessor, "a mesh")?.floats(file)?;
    let back = |v: usize| {
        let rest = Point::from_slice(&local[3 * v..3 * v + 3]);
        let p = block
            .place
            .frame(v)
            .position_back(new[block.first + v], rest);
        let [x, y, z] = single(p, block.first + v)?;
        Ok((v, [x, y, z, 0.0]))
    };
    moved.into_iter().map(back).collect()
}

fn directions(layer: &Layer, old: &Layer, block: &Block) -> Vec<(usize, [f32; 4])> {
    let what = direction(layer.role);
    let all = what.zip(layer.values.numbers()).zip(old.values.numbers());
    let (Some(((what, numbers), old)), Some(width)) = (all, layer.values.width()) else {
        return Vec::new();
    };
    let new = |v: usize| {
        let after = row(numbers, block.first + v, width);
        let before = row(old, block.first + v, width);
        if after.map(f64::to_bits) == before.map(f64::to_bits) {
            return None;
        }
        let local = block.place.frame(v).direction_back(what, after);
        Some((v, what.of_unit_length(local).map(|c| c as f32)))
    };
    (0..block.count).filter_map(new).collect()
}
