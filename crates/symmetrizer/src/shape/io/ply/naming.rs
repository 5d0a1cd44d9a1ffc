//! The property names that layers are written under.

use std::collections::BTreeSet;

use super::{families, names};
use crate::shape::document::{Layer, On, PlyProperty, Role, Values};

/// The names of a layer's numbers, where the file had them.
pub(super) fn own_names(
    layer: &Layer,
    width: usize,
    properties: &[PlyProperty],
    used: &BTreeSet<String>,
) -> Option<Vec<String>> {
    let names: Vec<String> = layer.name.split(' ').map(str::to_owned).collect();
    let known = |n: &String| properties.iter().any(|p| p.name == *n) && !used.contains(n);
    (names.len() == width && names.iter().all(known)).then_some(names)
}

/// Names for a layer's numbers that its role or its own name suggests, none of them `used`.
pub(super) fn new_names(layer: &Layer, width: usize, used: &BTreeSet<String>) -> Vec<String> {
    let words: Vec<&str> = layer.name.split_ascii_whitespace().collect();
    let name = match words.join("_") {
        name if name.is_empty() => "value".to_owned(),
        name => name,
    };
    let role = match (layer.on, layer.role, &layer.values) {
        (On::Corner, Role::TexCoord(0), _) => Some(vec!["texcoord".to_owned()]),
        (On::Corner, Role::TexCoord(set), _) => Some(vec![format!("texcoord{set}")]),
        (_, role, Values::Names { .. }) => names::property(role).map(|p| vec![p.to_owned()]),
        (_, _, Values::Lists { .. }) => Some(vec![name.clone()]),
        (On::Face, Role::TexCoord(_), _) => None,
        (_, role, _) => families::default_names(role, width),
    };
    let stem = match layer.role {
        Role::Other => name,
        Role::Joints(set) => format!("joints_{set}"),
        Role::Weights(set) => format!("weights_{set}"),
        Role::Morph(k, part) => format!("morph_{k}_{part:?}").to_ascii_lowercase(),
        Role::Tangent => "tangent".into(),
        other => format!("{other:?}")
            .to_ascii_lowercase()
            .replace(['(', ')'], ""),
    };
    let mut names = role.unwrap_or_else(|| match words.len() == width {
        true if layer.role == Role::Other => words.iter().map(|&w| w.to_owned()).collect(),
        _ if width == 1 => vec![stem],
        _ => (0..width).map(|k| format!("{stem}_{k}")).collect(),
    });
    for i in 0..names.len() {
        let stem = names[i].clone();
        let mut number = 2;
        while used.contains(&names[i]) || names[..i].contains(&names[i]) {
            names[i] = format!("{stem}_{number}");
            number += 1;
        }
    }
    names
}
