//! Writing a glTF file again: what it keeps, with what has changed since it was read.

use serde_json::Value;

use super::container::{Contents, File};
use super::json::list;
use super::read::{Shape, shape};
use super::unshared;
use crate::error::Result;
use crate::shape::document::{Document, GltfKept, Kept, Layer, Values};
use crate::shape::io::losses::{counted, of_precision};

/// The file that `document` was read from, with its changes; `None` where it was read from another
/// or its faces, or values that do not follow a deformation, are no longer those of the file.
pub(super) fn with_changes(document: &Document) -> Result<Option<Contents>> {
    match before(document) {
        Some((file, shape)) => unshared::changed(document, &file, &shape).map(Some),
        None => Ok(None),
    }
}

/// What is lost where the kept file can be written with its changes.
pub(super) fn losses(document: &Document) -> Option<Vec<String>> {
    let (_, shape) = before(document)?;
    let bits = |p: &crate::geom::Point| [p.x, p.y, p.z].map(f64::to_bits);
    let old = shape.mesh.positions.iter().map(bits);
    let moved = !old.eq(document.mesh.positions.iter().map(bits));
    Some(if moved {
        of_precision(document)
    } else {
        Vec::new()
    })
}

fn before(document: &Document) -> Option<(File, Shape)> {
    let Kept::Gltf(kept) = &document.kept else {
        return None;
    };
    let file = File::known(&kept.json, &kept.buffers);
    let shape = shape(&file).ok()?;
    is_deformed(document, &shape).then_some((file, shape))
}

/// Whether `document` differs from the file in what a deformation changes only.
fn is_deformed(document: &Document, shape: &Shape) -> bool {
    document.mesh.positions.len() == shape.mesh.positions.len()
        && document.mesh.polygons == shape.mesh.polygons
        && document.layers.len() == shape.layers.len()
        && document.layers.iter().zip(&shape.layers).all(follows)
}

fn follows((layer, old): (&Layer, &Layer)) -> bool {
    if (layer.on, layer.role, &layer.name) != (old.on, old.role, &old.name) {
        return false;
    }
    match (&layer.values, &old.values) {
        (
            Values::Rows { width, numbers },
            Values::Rows {
                width: old_width,
                numbers: old,
            },
        ) => {
            let bits = |n: f64| n.to_bits();
            let same = || numbers.iter().map(bits).eq(old.iter().map(bits));
            width == old_width
                && numbers.kind() == old.kind()
                && numbers.len() == old.len()
                && (layer.role.turns() || same())
        }
        (values, old) => values == old,
    }
}

/// What a file of another kind does not hold of a glTF file.
pub(in crate::shape::io) fn lost_elsewhere(kept: &GltfKept) -> Vec<String> {
    let json = &kept.json;
    let count = |key: &str| list(json, key).len();
    let looks = list(json, "materials")
        .iter()
        .filter(|m| has_look(m))
        .count();
    let looks = (looks > 0).then(|| format!("what materials look like, {looks} in all"));
    let lights = json.pointer("/extensions/KHR_lights_punctual");
    let lights = lights.map_or(0, |l| list(l, "lights").len());
    let lost = [
        counted(count("animations"), "animation"),
        counted(count("skins"), "skeleton"),
        counted(count("cameras"), "camera"),
        counted(lights, "light"),
        looks,
        counted(count("textures"), "texture"),
        counted(count("scenes").saturating_sub(1), "further scene"),
    ];
    lost.into_iter().flatten().collect()
}

/// The images that stand in files of their own.
pub(in crate::shape::io) fn companions(kept: &GltfKept) -> Vec<String> {
    let images = list(&kept.json, "images").iter();
    let uris = images.filter_map(|image| image.get("uri")?.as_str());
    let files = uris.filter(|uri| !uri.starts_with("data:") && !uri.contains("://"));
    files
        .map(|uri| super::buffers::unescaped(uri).unwrap_or_else(|| uri.to_owned()))
        .collect()
}

fn has_look(material: &Value) -> bool {
    let mut keys = material.as_object().into_iter().flat_map(|m| m.keys());
    keys.any(|key| key != "name")
}
