//! The parts of a mesh: primitives that share their vertices.

use std::collections::BTreeMap;

use serde_json::Value;

use super::attribute::Attribute;
use super::container::File;
use super::json::{DAMAGED, as_whole, element, list, members};
use crate::error::{Error, Result};

/// Primitives with the same positions, whose other attributes do not contradict each other.
pub(super) struct Part {
    /// The primitives, by their number in the mesh.
    pub primitives: Vec<usize>,
    /// All attributes with their accessors, positions first.
    pub attributes: Vec<(Attribute, usize)>,
    known: BTreeMap<Attribute, usize>,
}

impl Part {
    /// The accessor of an attribute.
    pub fn accessor(&self, of: &Attribute) -> Option<usize> {
        self.known.get(of).copied()
    }

    fn takes(&self, attributes: &[(Attribute, usize)]) -> bool {
        let agrees = |(a, i): &(Attribute, usize)| self.known.get(a).is_none_or(|known| known == i);
        attributes.iter().all(agrees)
    }

    fn add(&mut self, primitive: usize, attributes: Vec<(Attribute, usize)>) {
        self.primitives.push(primitive);
        for (attribute, accessor) in attributes {
            if self.known.insert(attribute.clone(), accessor).is_none() {
                self.attributes.push((attribute, accessor));
            }
        }
    }
}

/// The parts of a mesh.
pub(super) struct Parts {
    pub parts: Vec<Part>,
    /// The part of each primitive; `None` for those without positions, which show nothing.
    pub of_primitive: Vec<Option<usize>>,
}

impl Parts {
    /// The parts of mesh `mesh`, which `place` names.
    pub fn new(file: &File, mesh: usize, place: &str) -> Result<Self> {
        let json = element(&file.contents.json, "meshes", mesh, place)?;
        let mut parts: Vec<Part> = Vec::new();
        let mut last: BTreeMap<usize, usize> = BTreeMap::new();
        let mut of_primitive = Vec::new();
        for (i, primitive) in list(json, "primitives").iter().enumerate() {
            let place = format!("primitive {i} of mesh {mesh}");
            let attributes = attributes(primitive, &place)?;
            let Some(positions) = attributes.first().filter(|(a, _)| a.is_position()) else {
                of_primitive.push(None);
                continue;
            };
            let positions = positions.1;
            let same = last.get(&positions).copied();
            let part = same.filter(|&p| parts[p].takes(&attributes));
            let part = part.unwrap_or_else(|| {
                parts.push(Part {
                    primitives: Vec::new(),
                    attributes: Vec::new(),
                    known: BTreeMap::new(),
                });
                parts.len() - 1
            });
            last.insert(positions, part);
            parts[part].add(i, attributes);
            of_primitive.push(Some(part));
        }
        Ok(Self {
            parts,
            of_primitive,
        })
    }
}

/// The attributes of a primitive with their accessors, positions first.
fn attributes(primitive: &Value, place: &str) -> Result<Vec<(Attribute, usize)>> {
    let mut attributes = Vec::new();
    for (name, value) in members(primitive, "attributes") {
        attributes.push((
            Attribute::Base(name.to_owned()),
            accessor(value, name, place)?,
        ));
    }
    for (k, target) in (0..).zip(list(primitive, "targets")) {
        for (name, value) in target.as_object().into_iter().flatten() {
            let attribute = Attribute::Target(k, name.clone());
            attributes.push((attribute, accessor(value, name, place)?));
        }
    }
    attributes.sort_by_key(|(a, _)| !a.is_position());
    Ok(attributes)
}

fn accessor(value: &Value, name: &str, place: &str) -> Result<usize> {
    as_whole(value).ok_or_else(|| {
        let what = format!("'{name}' of {place} is not the number of an accessor");
        Error::input(what, DAMAGED)
    })
}
