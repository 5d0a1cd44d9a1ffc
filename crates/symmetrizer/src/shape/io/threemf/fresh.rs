//! A new package for a document from another format.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::package::packed;
use super::xml::quoted;
use crate::error::Result;
use crate::shape::document::{Document, Layer, NO_ROW, On, Role, Values};
use crate::shape::mesh::Mesh;

const TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>
"#;

const RELATIONSHIPS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>
"#;

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
"#;

/// The id of the base materials; objects follow.
const MATERIALS_ID: usize = 1;

/// The bytes of a new package.
pub(super) fn package(document: &Document) -> Result<Vec<u8>> {
    packed(&[
        ("[Content_Types].xml", TYPES.to_owned()),
        ("_rels/.rels", RELATIONSHIPS.to_owned()),
        ("3D/3dmodel.model", model(document)),
    ])
}

/// The vertices that several objects use, which each of them gets as its own.
pub(super) fn shared_vertices(document: &Document) -> usize {
    let objects = Objects::of(document);
    let copies: usize = objects.vertices.iter().map(Vec::len).sum();
    copies - document.mesh.positions.len()
}

/// Whether a layer is written.
pub(super) fn holds(layer: &Layer) -> bool {
    let names = matches!(layer.values, Values::Names { .. });
    layer.on == On::Face && matches!(layer.role, Role::Object | Role::Material) && names
}

/// The names of the faces in a layer of names, and which each face has.
fn names(document: &Document, role: Role) -> (&[String], &[u32]) {
    match document.layer(On::Face, role).map(|l| &l.values) {
        Some(Values::Names { names, of }) => (names, of),
        _ => (&[], &[]),
    }
}

/// Faces and vertices by object.
struct Objects {
    /// The name rows of the objects, as they appear first.
    rows: Vec<u32>,
    /// The faces of each.
    faces: Vec<Vec<u32>>,
    /// The vertices of each, in increasing order.
    vertices: Vec<Vec<u32>>,
}

impl Objects {
    fn of(document: &Document) -> Self {
        let mesh = &document.mesh;
        let (_, of) = names(document, Role::Object);
        let mut known: BTreeMap<u32, usize> = BTreeMap::new();
        let mut objects = Self {
            rows: Vec::new(),
            faces: Vec::new(),
            vertices: Vec::new(),
        };
        for f in 0..mesh.polygons.len() {
            let row = of.get(f).copied().unwrap_or(NO_ROW);
            let k = *known.entry(row).or_insert_with(|| objects.add(row));
            objects.faces[k].push(f as u32);
            objects.vertices[k].extend(mesh.polygons.get(f));
        }
        if objects.rows.is_empty() {
            objects.add(NO_ROW);
        }
        objects.add_loose(mesh);
        for vertices in &mut objects.vertices {
            vertices.sort_unstable();
            vertices.dedup();
        }
        objects
    }

    fn add(&mut self, row: u32) -> usize {
        self.rows.push(row);
        self.faces.push(Vec::new());
        self.vertices.push(Vec::new());
        self.rows.len() - 1
    }

    /// A vertex that no face uses goes to the object of the vertex before it, so that objects
    /// which follow each other are read in the same order.
    fn add_loose(&mut self, mesh: &Mesh) {
        let mut object_of = vec![usize::MAX; mesh.positions.len()];
        for (k, vertices) in self.vertices.iter().enumerate() {
            vertices.iter().for_each(|&v| object_of[v as usize] = k);
        }
        let mut last = 0;
        for (v, k) in object_of.into_iter().enumerate() {
            if k == usize::MAX {
                self.vertices[last].push(v as u32);
            } else {
                last = k;
            }
        }
    }
}

fn model(document: &Document) -> String {
    let mut text = HEAD.to_owned();
    text += "<resources>\n";
    let (materials, _) = names(document, Role::Material);
    if !materials.is_empty() {
        text += &format!("<basematerials id=\"{MATERIALS_ID}\">\n");
        for name in materials {
            let name = quoted(name);
            // A colour must be given; the document does not say which.
            text += &format!("<base name=\"{name}\" displaycolor=\"#808080\"/>\n");
        }
        text += "</basematerials>\n";
    }
    let objects = Objects::of(document);
    for k in 0..objects.rows.len() {
        object(document, &objects, k, &mut text);
    }
    text += "</resources>\n<build>\n";
    for k in 0..objects.rows.len() {
        text += &format!("<item objectid=\"{}\"/>\n", object_id(k));
    }
    text + "</build>\n</model>\n"
}

fn object_id(k: usize) -> usize {
    MATERIALS_ID + 1 + k
}

fn object(document: &Document, objects: &Objects, k: usize, text: &mut String) {
    let (all, _) = names(document, Role::Object);
    *text += &format!("<object id=\"{}\" type=\"model\"", object_id(k));
    if let Some(name) = all.get(objects.rows[k] as usize) {
        *text += &format!(" name=\"{}\"", quoted(name));
    }
    let (_, materials) = names(document, Role::Material);
    let row = |f: u32| materials.get(f as usize).copied().unwrap_or(NO_ROW);
    let faces = &objects.faces[k];
    // The default is asked for where faces have their own, but would give one to those without.
    if !faces.is_empty() && faces.iter().all(|&f| row(f) != NO_ROW) {
        let first = row(faces[0]);
        *text += &format!(" pid=\"{MATERIALS_ID}\" pindex=\"{first}\"");
    }
    *text += "><mesh>\n<vertices>\n";
    let vertices = &objects.vertices[k];
    for &v in vertices {
        let p = &document.mesh.positions[v as usize];
        // Writing to a string does not fail.
        let _ = writeln!(text, "<vertex x=\"{}\" y=\"{}\" z=\"{}\"/>", p.x, p.y, p.z);
    }
    *text += "</vertices>\n<triangles>\n";
    for &f in faces {
        triangles(document, f as usize, vertices, row(f), text);
    }
    *text += "</triangles>\n</mesh></object>\n";
}

/// The triangles of a polygon, their corners counted within the object's vertices.
fn triangles(document: &Document, f: usize, vertices: &[u32], material: u32, text: &mut String) {
    let polygon = document.mesh.polygons.get(f);
    let local = |v: u32| vertices.partition_point(|&w| w < v);
    for triangle in document.mesh.cut(f) {
        let [a, b, c] = triangle.map(|k| local(polygon[k as usize]));
        let _ = write!(text, "<triangle v1=\"{a}\" v2=\"{b}\" v3=\"{c}\"");
        if material != NO_ROW {
            let _ = write!(text, " pid=\"{MATERIALS_ID}\" p1=\"{material}\"");
        }
        *text += "/>\n";
    }
}
