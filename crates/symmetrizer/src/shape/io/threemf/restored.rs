//! The package as it came, with the vertices that have moved.
//!
//! A coordinate that has not changed keeps its text. Where copies of one object have become
//! different, each further shape becomes an object of its own and its build item is led to it; an
//! item that is a composition then becomes a flat list of its objects.

use std::collections::{BTreeMap, BTreeSet};

use super::package::Package;
use super::parts::Part;
use super::placed::{Block, Build};
use super::sites::Sites;
use super::texts::{Texts, Variant};
use super::xml::Text;
use crate::error::Result;
use crate::geom::Point;
use crate::shape::document::{Document, ThreeMfKept};

/// The package in `kept` with the shape of `document`; `None` where that has other vertices or
/// faces than the package.
pub(super) fn restored(document: &Document, kept: &ThreeMfKept) -> Result<Option<Vec<u8>>> {
    let mut package = Package::open(&kept.package)?;
    let build = Build::read(&mut package, kept.package.len())?;
    if !fits(document, &build) {
        return Ok(None);
    }
    let shapes = shapes(&build, &document.mesh.positions);
    if shapes.iter().all(|s| s.moved.is_empty()) {
        return Ok(Some(kept.package.clone()));
    }
    let mut texts = Texts::new(&build, sites(&build, &shapes)?);
    let given = texts.objects(&shapes);
    texts.items(&given);
    package.with_texts(&texts.finish()).map(Some)
}

/// Whether a document has the vertices and faces of a build, wherever the vertices are.
pub(super) fn fits(document: &Document, build: &Build) -> bool {
    document.mesh.positions.len() == build.mesh.positions.len()
        && document.mesh.polygons == build.mesh.polygons
}

/// The shape of each block.
fn shapes(build: &Build, after: &[Point]) -> Vec<Variant> {
    let shape = |block: &Block| {
        let run = block.first..block.first + block.count;
        shape(block, &build.mesh.positions[run.clone()], &after[run])
    };
    build.blocks.iter().map(shape).collect()
}

/// The vertices that have moved, in the object's coordinates. Where the way back to those loses
/// digits, all vertices in the document's coordinates.
fn shape(block: &Block, before: &[Point], after: &[Point]) -> Variant {
    let pairs = before.iter().zip(after).enumerate();
    let moved = pairs
        .filter(|(_, (a, b))| !same(a, b))
        .map(|(v, (_, b))| (v, *b));
    let moved: Vec<(usize, Point)> = moved.collect();
    let Some(transform) = &block.transform else {
        return Variant {
            moved,
            placed: false,
        };
    };
    let inverse = transform.inverse();
    let back = |&(v, p): &(usize, Point)| Some((v, inverse.as_ref()?.apply(&p)?));
    match moved.iter().map(back).collect() {
        Some(moved) => Variant {
            moved,
            placed: false,
        },
        None => Variant {
            moved: after.iter().copied().enumerate().collect(),
            placed: true,
        },
    }
}

/// Equal bits: a zero that has changed its sign is written, too.
fn same(a: &Point, b: &Point) -> bool {
    a.iter()
        .zip(b.iter())
        .all(|(a, b)| a.to_bits() == b.to_bits())
}

/// The places in each part, with those of the vertices that have moved.
fn sites(build: &Build, shapes: &[Variant]) -> Result<Vec<Sites>> {
    let mut objects: BTreeMap<usize, BTreeSet<u32>> = BTreeMap::new();
    for (block, shape) in build.blocks.iter().zip(shapes) {
        if !shape.moved.is_empty() {
            objects.entry(block.part).or_default().insert(block.object);
        }
    }
    let find = |(p, part): (usize, &Part)| {
        let text = Text {
            part: &part.name,
            text: &part.text,
        };
        Sites::find(text, &objects.remove(&p).unwrap_or_default())
    };
    build.parts.iter().enumerate().map(find).collect()
}
