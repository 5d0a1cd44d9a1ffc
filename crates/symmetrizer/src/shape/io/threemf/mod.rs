//! 3MF: a zip package with an XML model; read in build coordinates, written back as it came.
//!
//! `zip` and `quick-xml` do the packing and the XML. The crate `threemf` is not used: it gives bare
//! triangles and drops names, materials, metadata and everything of the extensions.
//!
//! * [`package`]: the zip file and its parts, unpacked within a bound.
//! * [`xml`], [`tag`]: tags and attributes with their places in the text.
//! * [`model`], [`transform`], [`parts`]: what the model parts say.
//! * [`placed`], [`names`]: the document that the build makes of it.
//! * [`sites`], [`texts`], [`restored`]: the same package with the vertices that have moved.
//! * [`fresh`]: a new package.
//!
//! Data of extensions that follow from the shape, such as slices and thumbnails, stay as they are.

mod fresh;
mod model;
mod names;
mod package;
mod parts;
mod placed;
mod restored;
mod sites;
mod tag;
mod texts;
mod transform;
mod xml;

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use super::losses::{counted, numbered, of_layers, of_polygons, of_unplaced};
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kept, ThreeMfBlock, ThreeMfKept};
use package::Package;
use placed::Build;
use transform::Transform;

/// More packed files than these are only counted.
const FILES: usize = 3;

/// The document in the bytes of a 3MF file. Its vertices are in build coordinates, in the file's
/// unit.
pub(super) fn decode(bytes: Vec<u8>) -> Result<Document> {
    let mut package = Package::open(&bytes)?;
    let build = Build::read(&mut package, bytes.len())?;
    // What cannot be copied should be known before the work and not after it.
    package.with_texts(&BTreeMap::new())?;
    let besides = besides(&package, &build);
    let block = |b: &placed::Block| ThreeMfBlock {
        part: build.parts[b.part].name.clone(),
        object: b.object,
        transform: b.transform.as_ref().map(Transform::text),
        vertices: b.count,
    };
    let blocks = build.blocks.iter().map(block).collect();
    Ok(Document {
        mesh: build.mesh,
        layers: build.layers,
        kept: Kept::ThreeMf(ThreeMfKept {
            package: bytes,
            blocks,
            besides,
        }),
    })
}

/// Writes the package that the document came from with its moved vertices, or a new one.
pub(super) fn encode(document: &Document, w: &mut dyn Write) -> Result<()> {
    let restored = match &document.kept {
        Kept::ThreeMf(kept) => restored::restored(document, kept)?,
        _ => None,
    };
    let bytes = restored.map_or_else(|| fresh::package(document), Ok)?;
    w.write_all(&bytes).map_err(|e| Error::io("", e))
}

/// What is lost in the package that [`encode`] writes.
pub(super) fn losses(document: &Document) -> Vec<String> {
    let mut lost = of_layers(document, fresh::holds);
    match &document.kept {
        Kept::ThreeMf(kept) if fits(document, kept) => return lost,
        Kept::ThreeMf(kept) => lost.extend(kept.besides.iter().cloned()),
        _ => {}
    }
    lost.extend(of_polygons(document));
    lost.extend(of_unplaced(document));
    let shared = fresh::shared_vertices(document);
    lost.extend((shared > 0).then(|| format!("the seams of objects: {shared} vertices doubled")));
    lost
}

fn fits(document: &Document, kept: &ThreeMfKept) -> bool {
    let build = Package::open(&kept.package)
        .and_then(|mut package| Build::read(&mut package, kept.package.len()));
    build.is_ok_and(|build| restored::fits(document, &build))
}

/// What the package says that the document does not, in phrases.
fn besides(package: &Package<'_>, build: &Build) -> Vec<String> {
    let mut phrases = Vec::new();
    let unit = build.parts[0].model.unit.as_deref();
    phrases.extend(
        unit.filter(|u| *u != "millimeter")
            .map(|u| format!("the unit, {u}")),
    );
    let colors = build.parts.iter().map(|p| p.model.colors).sum();
    phrases.extend(numbered(colors, "material's colour", "materials' colours"));
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for part in &build.parts {
        for (name, count) in &part.model.besides {
            *counts.entry(name).or_default() += count;
        }
    }
    let phrase =
        |(name, count): (&str, usize)| counted(count, &format!("{} element", xml::shown(name)));
    phrases.extend(counts.into_iter().filter_map(phrase));
    let places = build.blocks.len();
    let objects: BTreeSet<_> = build.blocks.iter().map(|b| (b.part, b.object)).collect();
    if objects.len() < places {
        let objects = objects.len();
        phrases.push(format!(
            "that {places} placed shapes are copies of {objects}"
        ));
    }
    let others = package.names().iter().enumerate().filter(|(entry, name)| {
        let of_zip =
            name.ends_with('/') || name.ends_with(".rels") || *name == "[Content_Types].xml";
        !of_zip && build.parts.iter().all(|p| p.entry != *entry)
    });
    let others: Vec<&String> = others.map(|(_, name)| name).collect();
    match others.len() {
        0..=FILES => phrases.extend(
            others
                .iter()
                .map(|n| format!("the packed file {}", xml::shown(n))),
        ),
        n => phrases.push(format!(
            "{n} packed files, such as {}",
            xml::shown(others[0])
        )),
    }
    phrases
}
