//! A file made anew, for a document from another format or with other faces than its file.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use serde_json::{Map, Value, json};

use super::attribute::Attribute;
use super::columns::{Column, columns, members, set_bounds};
use super::container::Contents;
use super::kept::lost_elsewhere;
use super::objects::{Object, are_nodes, objects, starts};
use super::seams::Seams;
use super::writer::{Target, Writer, bytes_of, single};
use crate::error::Result;
use crate::shape::document::{Document, Kept, Kind, Layer, NO_ROW, On, Role, Values};
use crate::shape::io::losses::{numbered, of_layers, of_polygons, of_precision, of_unplaced};

/// What a fresh file does not hold of `document`.
pub(super) fn losses(document: &Document) -> Vec<String> {
    let columns = columns(document);
    let nodes = are_nodes(document);
    let holds = |layer: &Layer| match (layer.on, layer.role) {
        (On::Face, Role::Material) => matches!(layer.values, Values::Names { .. }),
        (On::Face, Role::Object) => nodes,
        _ => columns.iter().any(|c| std::ptr::eq(c.layer, layer)),
    };
    let mut lost = match &document.kept {
        Kept::Gltf(kept) => lost_elsewhere(kept),
        _ => Vec::new(),
    };
    lost.extend(of_layers(document, holds));
    lost.extend(columns.iter().filter_map(Column::loss));
    lost.extend(of_polygons(document));
    let split = seams(document, &columns).split;
    lost.extend(numbered(
        split,
        "shared vertex at a texture seam or crease, split",
        "shared vertices at texture seams or creases, split",
    ));
    lost.extend(is_mixed(document).then(|| "the order of faces, grouped by material".into()));
    lost.extend(of_unplaced(document));
    lost.extend(of_precision(document));
    lost
}

/// Whether faces of one material stand apart, with those of others between.
fn is_mixed(document: &Document) -> bool {
    let layer = document.layer(On::Face, Role::Material);
    let Some(Values::Names { of, .. }) = layer.map(|l| &l.values) else {
        return false;
    };
    let mut begun = BTreeSet::new();
    let mut runs = of.chunk_by(|a, b| a == b);
    !runs.all(|run| begun.insert(run[0]))
}

/// The file for `document`.
pub(super) fn contents(document: &Document) -> Result<Contents> {
    let columns = columns(document);
    let seams = seams(document, &columns);
    let mut fresh = Fresh {
        document,
        columns,
        writer: Writer {
            json: json!({ "asset": { "version": "2.0", "generator": "symmetrizer" } }),
            buffers: Vec::new(),
        },
        starts: starts(&document.mesh),
        seams,
    };
    fresh.materials();
    let objects = objects(document, &fresh.seams.corners, fresh.seams.source.len());
    let mut nodes = Vec::new();
    for object in objects.iter().filter(|o| !o.vertices.is_empty()) {
        nodes.push(fresh.node(object)?);
    }
    let json = &mut fresh.writer.json;
    json["scene"] = json!(0);
    json["scenes"] = match nodes.is_empty() {
        true => json!([{}]),
        false => json!([{ "nodes": nodes }]),
    };
    Ok(fresh.writer.finish())
}

fn seams(document: &Document, columns: &[Column]) -> Seams {
    let corner = columns
        .iter()
        .map(|c| c.layer)
        .filter(|l| l.on == On::Corner);
    Seams::new(&document.mesh, &corner.collect::<Vec<_>>())
}

struct Fresh<'a> {
    document: &'a Document,
    columns: Vec<Column<'a>>,
    seams: Seams,
    /// The first corner of each face, and the number of all corners.
    starts: Vec<usize>,
    writer: Writer,
}

impl Fresh<'_> {
    fn materials(&mut self) {
        let layer = self.document.layer(On::Face, Role::Material);
        if let Some(Values::Names { names, .. }) = layer.map(|l| &l.values) {
            let materials = names.iter().map(|name| json!({ "name": name }));
            self.writer.json["materials"] = materials.collect();
        }
    }

    /// Adds a node with its mesh.
    fn node(&mut self, object: &Object) -> Result<usize> {
        let (attributes, targets) = self.attributes(object.vertices.clone())?;
        let mut primitives = Vec::new();
        for (material, corners) in self.faces_by_material(object) {
            let indices = self.indices(&corners, object.vertices.len());
            let mut primitive = json!({ "attributes": attributes, "indices": indices, "mode": 4 });
            if material != NO_ROW {
                primitive["material"] = json!(material);
            }
            primitives.push(primitive);
        }
        if primitives.is_empty() {
            primitives.push(json!({ "attributes": attributes, "mode": 0 }));
        }
        if !targets.is_empty() {
            primitives
                .iter_mut()
                .for_each(|p| p["targets"] = json!(targets));
        }
        let json = &mut self.writer.json;
        let mesh = super::json::append(json, "meshes", json!({ "primitives": primitives }));
        let mut node = json!({ "mesh": mesh });
        if let Some(name) = &object.name {
            node["name"] = json!(name);
        }
        Ok(super::json::append(json, "nodes", node))
    }

    /// The attributes of some vertices, and of their morph targets.
    fn attributes(&mut self, vertices: Range<usize>) -> Result<(Value, Vec<Value>)> {
        let positions = self.positions(vertices.clone())?;
        let mut attributes = json!({ "POSITION": positions });
        let mut targets: BTreeMap<u32, Map<String, Value>> = BTreeMap::new();
        for column in &self.columns {
            let accessor = column.write(&mut self.writer, &self.seams, vertices.clone());
            match &column.attribute {
                Attribute::Base(name) => attributes[name] = json!(accessor),
                Attribute::Target(k, name) => {
                    let target = targets.entry(*k).or_default();
                    target.insert(name.clone(), json!(accessor));
                }
            }
        }
        let targets = targets.into_values().map(Value::Object);
        Ok((attributes, targets.collect()))
    }

    fn positions(&mut self, vertices: Range<usize>) -> Result<usize> {
        let mut numbers = Vec::with_capacity(3 * vertices.len());
        for &v in &self.seams.source[vertices.clone()] {
            numbers.extend(single(
                self.document.mesh.positions[v as usize],
                v as usize,
            )?);
        }
        let view = self
            .writer
            .view(&bytes_of(&numbers), Target::Vertices(None));
        let mut members = members(view, Kind::F32, 3, vertices.len());
        set_bounds(&mut members, &numbers, 3);
        Ok(self.writer.accessor(members))
    }

    /// The corners of an object's triangles, counted in it, by material in order of appearance.
    fn faces_by_material(&self, object: &Object) -> Vec<(u32, Vec<u32>)> {
        let layer = self.document.layer(On::Face, Role::Material);
        let of = match layer.map(|l| &l.values) {
            Some(Values::Names { of, .. }) => of.as_slice(),
            _ => &[],
        };
        let mut groups: Vec<(u32, Vec<u32>)> = Vec::new();
        let mut known = BTreeMap::new();
        for f in object.faces.clone() {
            let material = of.get(f).copied().unwrap_or(NO_ROW);
            let group = *known.entry(material).or_insert_with(|| {
                groups.push((material, Vec::new()));
                groups.len() - 1
            });
            let corners = &self.seams.corners[self.starts[f]..self.starts[f + 1]];
            for triangle in self.document.mesh.cut(f) {
                let triangle = triangle.map(|k| corners[k as usize]);
                let first = object.vertices.start as u32;
                groups[group].1.extend(triangle.map(|v| v - first));
            }
        }
        groups
    }

    /// Adds the corners of triangles among `count` vertices.
    fn indices(&mut self, corners: &[u32], count: usize) -> usize {
        // The largest index of a type is not allowed.
        let kind = if count <= usize::from(u16::MAX) {
            Kind::U16
        } else {
            Kind::U32
        };
        let bytes: Vec<u8> = match kind {
            Kind::U16 => corners
                .iter()
                .flat_map(|&v| (v as u16).to_le_bytes())
                .collect(),
            _ => corners.iter().flat_map(|v| v.to_le_bytes()).collect(),
        };
        let view = self.writer.view(&bytes, Target::Corners);
        self.writer.accessor(members(view, kind, 1, corners.len()))
    }
}
