//! The shape that a file shows, and where in the file each part of it comes from.

use std::collections::BTreeMap;
use std::rc::Rc;

use serde_json::Value;

use super::accessor::Accessor;
use super::attribute::{Attribute, direction};
use super::container::File;
use super::faces::Faces;
use super::json::{DAMAGED, list, name, whole};
use super::layers::{Chunk, Tracks, of_vertices};
use super::parts::Parts;
use super::place::{Frame, Place};
use super::scene::Scene;
use super::skin::Skins;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::document::{Document, GltfKept, Kept, Layer, NO_ROW, Numbers, Role};
use crate::shape::mesh::Mesh;

/// The vertices that one part of a mesh gives at one node.
pub(super) struct Block {
    pub node: usize,
    pub mesh: usize,
    /// By its number in the mesh.
    pub part: usize,
    /// First vertex in the document.
    pub first: usize,
    /// How many vertices there are.
    pub count: usize,
    pub place: Place,
}

/// What a file shows.
pub(super) struct Shape {
    pub mesh: Mesh,
    pub layers: Vec<Layer>,
    pub blocks: Vec<Block>,
    /// The parts of the meshes that are shown.
    pub parts: BTreeMap<usize, Rc<Parts>>,
    /// The layer of each attribute.
    pub layer_of: BTreeMap<Attribute, usize>,
}

impl Shape {
    /// The document, with `file`, which it was read from.
    pub fn document(self, file: File) -> Document {
        Document {
            mesh: self.mesh,
            layers: self.layers,
            kept: Kept::Gltf(GltfKept {
                json: file.contents.json,
                buffers: file.contents.buffers,
            }),
        }
    }
}

/// What `file` shows.
pub(super) fn shape(file: &File) -> Result<Shape> {
    let scene = Scene::new(&file.contents.json)?;
    let mut reader = Reader {
        file,
        scene: &scene,
        faces: Faces::default(),
        positions: Vec::new(),
        tracks: Tracks::default(),
        blocks: Vec::new(),
        parts: BTreeMap::new(),
        skins: Skins::default(),
    };
    for &node in &scene.shown {
        let object = &list(&file.contents.json, "nodes")[node];
        if let Some(mesh) = whole(object, "mesh", &format!("node {node}"))? {
            reader.node(node, mesh)?;
        }
    }
    reader.finish()
}

struct Reader<'a> {
    file: &'a File,
    scene: &'a Scene,
    faces: Faces,
    positions: Vec<Point>,
    tracks: Tracks,
    blocks: Vec<Block>,
    parts: BTreeMap<usize, Rc<Parts>>,
    skins: Skins,
}

impl<'a> Reader<'a> {
    fn json(&self) -> &'a Value {
        &self.file.contents.json
    }

    fn node(&mut self, node: usize, mesh: usize) -> Result<()> {
        let parts = match self.parts.get(&mesh) {
            Some(parts) => Rc::clone(parts),
            None => {
                let parts = Rc::new(Parts::new(self.file, mesh, &format!("node {node}"))?);
                self.parts.insert(mesh, Rc::clone(&parts));
                parts
            }
        };
        let first = self.blocks.len();
        for part in 0..parts.parts.len() {
            self.block(node, mesh, &parts, part)?;
        }
        let object = &list(self.json(), "meshes")[mesh];
        let given = name(&list(self.json(), "nodes")[node]).or_else(|| name(object));
        self.file.charge(given.map_or(0, str::len))?;
        self.faces.object(node, given);
        for (i, primitive) in list(object, "primitives").iter().enumerate() {
            // Also a primitive without vertices is work.
            self.file.charge(16)?;
            if let Some(part) = parts.of_primitive[i] {
                let block = &self.blocks[first + part];
                let place = format!("primitive {i} of mesh {mesh}");
                self.faces.primitive(self.file, primitive, block, &place)?;
            }
        }
        Ok(())
    }

    /// Reads the vertices of one part of a mesh.
    fn block(&mut self, node: usize, mesh: usize, parts: &Parts, part: usize) -> Result<()> {
        let attributes = &parts.parts[part].attributes;
        let place = format!("mesh {mesh}");
        let (_, positions) = &attributes[0];
        let accessor = Accessor::new(self.file, *positions, &place)?;
        if accessor.width != 3 {
            let what = format!("the positions of {place} have {} numbers", accessor.width);
            return Err(Error::input(what, DAMAGED));
        }
        let (first, count) = (self.positions.len(), accessor.count);
        if first.saturating_add(count) >= NO_ROW as usize {
            let what = "the scene has more vertices than fit in 32 bits";
            return Err(Error::input(what, "simplify the meshes first"));
        }
        let skinned = self.skins.place(
            self.file,
            &self.scene.worlds,
            node,
            &parts.parts[part],
            count,
        )?;
        let at = skinned.unwrap_or_else(|| Place::Fixed(Frame::new(&self.scene.worlds[node])));
        let local = accessor.floats(self.file)?;
        let points = local.chunks_exact(3).map(Point::from_slice).enumerate();
        self.positions
            .extend(points.map(|(v, p)| at.frame(v).position(p)));
        let block = Block {
            node,
            mesh,
            part,
            first,
            count,
            place: at,
        };
        self.attributes(&block, &attributes[1..], &place)?;
        self.blocks.push(block);
        Ok(())
    }

    /// Reads what the vertices of a block have besides their positions.
    fn attributes(
        &mut self,
        block: &Block,
        attributes: &[(Attribute, usize)],
        place: &str,
    ) -> Result<()> {
        for (attribute, accessor) in attributes {
            self.file.charge(16)?;
            if let Some((role, name)) = attribute.role() {
                let accessor = of_vertices(self.file, *accessor, block.count, role, place)?;
                let mut chunk = Chunk::new(self.file, &accessor, role, block.first)?;
                turn(role, &block.place, &mut chunk);
                self.tracks.add(attribute, role, name, chunk);
            }
        }
        Ok(())
    }

    fn finish(self) -> Result<Shape> {
        let (mut layers, layer_of) = self.tracks.layers(self.file, self.positions.len())?;
        let (polygons, of_faces) = self.faces.finish(&self.file.contents.json);
        layers.extend(of_faces);
        Ok(Shape {
            mesh: Mesh {
                positions: self.positions,
                polygons,
            },
            layers,
            blocks: self.blocks,
            parts: self.parts,
            layer_of,
        })
    }
}

/// Turns directions in mesh coordinates to the world.
fn turn(role: Role, place: &Place, chunk: &mut Chunk) {
    let (Some(what), width) = (direction(role), chunk.width) else {
        return;
    };
    for v in 0..chunk.numbers.len() / width {
        let before = row(&chunk.numbers, v, width);
        let after = place.frame(v).direction(what, before);
        if after != before {
            (0..width).for_each(|k| chunk.numbers.set(v * width + k, after[k]));
        }
    }
}

/// Row `i` of up to four numbers.
pub(super) fn row(numbers: &Numbers, i: usize, width: usize) -> [f64; 4] {
    let mut row = [0.0; 4];
    (0..width.min(4)).for_each(|k| row[k] = numbers.get(i * width + k));
    row
}
