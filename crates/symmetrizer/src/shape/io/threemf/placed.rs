//! The build: every mesh object where the build items and components put it.

use std::collections::BTreeMap;

use super::model::{Object, Placed};
use super::names::Names;
use super::package::{Package, bound};
use super::parts::{Part, parts};
use super::transform::Transform;
use super::xml::shown;
use crate::error::{Error, Result};
use crate::shape::document::{Layer, NO_ROW, Role};
use crate::shape::mesh::Mesh;

/// Components within components, at most.
const DEPTH: usize = 32;

/// What each placement counts for, in bytes, besides its vertices and triangles.
const PLACEMENT: u64 = 128;

/// A mesh object at one of its places: a run of the document's vertices.
pub(super) struct Block {
    /// The part that has the object.
    pub part: usize,
    /// The object's id.
    pub object: u32,
    /// The build item of the first part; `None` where there is no build.
    pub item: Option<usize>,
    /// Whether the item names the object itself and not a composition.
    pub direct: bool,
    /// From the object's coordinates to those of the document; `None` where they are the same.
    pub transform: Option<Transform>,
    /// The name that it has from a composition around it, for want of its own.
    pub name: Option<String>,
    /// Its first vertex in the document.
    pub first: usize,
    /// Its vertices.
    pub count: usize,
}

/// The content of a package.
pub(super) struct Build {
    /// The model parts, first the one that the package starts with.
    pub parts: Vec<Part>,
    /// The runs of the document's vertices.
    pub blocks: Vec<Block>,
    /// Their shapes together, document coordinates.
    pub mesh: Mesh,
    /// Names of objects and materials.
    pub layers: Vec<Layer>,
}

impl Build {
    /// The build in a package that comes from a file of `size` bytes.
    pub fn read(package: &mut Package<'_>, size: usize) -> Result<Self> {
        let parts = parts(package)?;
        let mut builder = Builder {
            parts: &parts,
            mesh: Mesh::default(),
            blocks: Vec::new(),
            objects: Names::default(),
            materials: Names::default(),
            groups: BTreeMap::new(),
            inside: Vec::new(),
            left: bound(size),
        };
        builder.all()?;
        let (mesh, blocks) = (builder.mesh, builder.blocks);
        let layers = [
            builder.objects.layer(Role::Object),
            builder.materials.layer(Role::Material),
        ];
        Ok(Self {
            layers: layers.into_iter().flatten().collect(),
            parts,
            blocks,
            mesh,
        })
    }
}

struct Builder<'a> {
    parts: &'a [Part],
    mesh: Mesh,
    blocks: Vec<Block>,
    objects: Names,
    materials: Names,
    /// The material names of a group of a part.
    groups: BTreeMap<(usize, u32), Vec<u32>>,
    /// The objects around the one that is being placed.
    inside: Vec<(usize, u32)>,
    /// Bytes that the document may still take.
    left: u64,
}

/// Where an object goes.
#[derive(Clone, Copy)]
struct Spot<'a> {
    item: Option<usize>,
    transform: Option<&'a Transform>,
    name: Option<&'a str>,
}

impl<'a> Builder<'a> {
    fn all(&mut self) -> Result<()> {
        for (p, part) in self.parts.iter().enumerate() {
            for (&group, names) in &part.model.materials {
                let rows = names.iter().map(|n| self.materials.row(n)).collect();
                self.groups.insert((p, group), rows);
            }
        }
        let model = &self.parts[0].model;
        for (i, item) in model.items.iter().enumerate() {
            let spot = Spot {
                item: Some(i),
                transform: None,
                name: None,
            };
            self.put(0, item, spot)?;
        }
        if model.items.is_empty() {
            for &id in &model.order {
                let spot = Spot {
                    item: None,
                    transform: None,
                    name: None,
                };
                self.mesh_of((0, id), &model.objects[&id], spot)?;
            }
        }
        Ok(())
    }

    /// Puts what an item or component of part `from` names at a spot.
    fn put(&mut self, from: usize, placed: &'a Placed, spot: Spot<'_>) -> Result<()> {
        let at = (placed.part, placed.object);
        let object = self.object(from, at)?;
        let transform = Transform::chain(spot.transform, placed.transform.as_ref());
        let spot = Spot {
            item: spot.item,
            transform: transform.as_ref(),
            name: object.name.as_deref().or(spot.name),
        };
        self.mesh_of(at, object, spot)?;
        self.inside.push(at);
        for component in &object.components {
            self.put(at.0, component, spot)?;
        }
        self.inside.pop();
        Ok(())
    }

    fn object(&self, from: usize, at: (usize, u32)) -> Result<&'a Object> {
        let (part, id) = at;
        let name = shown(&self.parts[part].name);
        if self.inside.contains(&at) {
            return Err(Error::input(
                format!("{name}: the object {id} is a component of itself"),
                "the file is damaged; export it again",
            ));
        }
        if self.inside.len() >= DEPTH {
            return Err(Error::input(
                format!("{name}: the object {id} is nested in more than {DEPTH} others"),
                "join the components into one object first",
            ));
        }
        self.parts[part].model.objects.get(&id).ok_or_else(|| {
            let from = shown(&self.parts[from].name);
            Error::input(
                format!("{from} names the object {id}, which {name} does not have"),
                "the file is cut off or damaged; export it again",
            )
        })
    }

    /// The object's own triangles at a spot.
    fn mesh_of(&mut self, at: (usize, u32), object: &Object, spot: Spot<'_>) -> Result<()> {
        let name = object.name.as_deref().or(spot.name);
        self.charge(at, object, name)?;
        if object.positions.is_empty() && object.triangles.is_empty() {
            return Ok(());
        }
        let first = self.mesh.positions.len();
        let moved = object.positions.iter();
        let moved = moved.map(|p| spot.transform.map_or(*p, |t| t.apply(p)));
        self.mesh.positions.extend(moved);
        let mirrored = spot.transform.is_some_and(Transform::mirrors);
        for (t, &[a, b, c]) in object.triangles.iter().enumerate() {
            let count = object.positions.len();
            if let Some(v) = [a, b, c].into_iter().find(|&v| v as usize >= count) {
                return Err(self.no_vertex(at, t, v, count));
            }
            // A mirror turns a solid's triangles inside out.
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            let corners = [a, b, c].map(|v| v + first as u32);
            self.mesh.polygons.push(&corners);
            let property = object.property(t);
            let material = property.and_then(|(group, index)| {
                let rows = self.groups.get(&(at.0, group))?;
                rows.get(index as usize).copied()
            });
            self.materials.of.push(material.unwrap_or(NO_ROW));
        }
        let named = name.map_or(NO_ROW, |name| self.objects.row(name));
        self.objects.of.resize(self.mesh.polygons.len(), named);
        self.blocks.push(Block {
            part: at.0,
            object: at.1,
            item: spot.item,
            direct: self.inside.is_empty(),
            transform: spot.transform.cloned(),
            name: name.filter(|_| object.name.is_none()).map(str::to_owned),
            first,
            count: object.positions.len(),
        });
        Ok(())
    }

    /// A few bytes can place the same object thousands of times, and those again.
    fn charge(
        &mut self,
        (part, id): (usize, u32),
        object: &Object,
        name: Option<&str>,
    ) -> Result<()> {
        let (vertices, triangles) = (object.positions.len(), object.triangles.len());
        let name = name.map_or(0, str::len) as u64;
        let bytes = PLACEMENT + name + 24 * vertices as u64 + 24 * triangles as u64;
        let corners = 3 * (self.mesh.polygons.len() as u64 + triangles as u64);
        let all = corners.max(self.mesh.positions.len() as u64 + vertices as u64);
        if bytes > self.left || all >= u64::from(u32::MAX) {
            let part = shown(&self.parts[part].name);
            return Err(Error::input(
                format!(
                    "{part}: with the object {id} put at all its places, the shape is too large \
                     for a file of this size"
                ),
                "build fewer copies",
            ));
        }
        self.left -= bytes;
        Ok(())
    }

    fn no_vertex(&self, (part, id): (usize, u32), t: usize, v: u32, count: usize) -> Error {
        let part = shown(&self.parts[part].name);
        Error::input(
            format!(
                "{part}: triangle {t} of object {id} (counted from 0) names vertex {v}, but the \
                 object has only {count} vertices"
            ),
            "the file is cut off or its triangle list is damaged",
        )
    }
}
