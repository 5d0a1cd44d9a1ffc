//! The faces of primitives, with their materials and the objects they belong to.

use serde_json::Value;

use super::accessor::Accessor;
use super::container::File;
use super::json::{DAMAGED, list, name, whole};
use super::read::Block;
use crate::error::{Error, Result};
use crate::shape::document::{Kind, Layer, NO_ROW, On, Role, Values};
use crate::shape::mesh::Polygons;

/// Faces being collected.
#[derive(Default)]
pub(super) struct Faces {
    polygons: Polygons,
    corners: usize,
    /// The material of each face.
    materials: Vec<u32>,
    /// The object of each face.
    of_object: Vec<u32>,
    objects: Vec<String>,
    /// Whether an object has a name in the file.
    named: bool,
}

impl Faces {
    /// What follows belongs to `node`, called `given`.
    pub fn object(&mut self, node: usize, given: Option<&str>) {
        self.named |= given.is_some();
        let name = given.map_or_else(|| format!("node {node}"), str::to_owned);
        self.objects.push(name);
    }

    /// Adds the faces of a primitive of `block`; points and lines have none.
    pub fn primitive(
        &mut self,
        file: &File,
        primitive: &Value,
        block: &Block,
        place: &str,
    ) -> Result<()> {
        let mode = whole(primitive, "mode", place)?.unwrap_or(4);
        if mode > 6 {
            let what = format!("{place} has the unknown mode {mode}");
            return Err(Error::input(what, DAMAGED));
        }
        let indices = indices(file, primitive, block.count, place)?;
        let count = match mode {
            4 if indices.len() % 3 != 0 => {
                let what = format!(
                    "{place} has {} corners, which do not make whole triangles",
                    indices.len()
                );
                return Err(Error::input(what, DAMAGED));
            }
            4 => indices.len() / 3,
            5 | 6 => indices.len().saturating_sub(2),
            _ => return Ok(()),
        };
        let material = material(file, primitive, place)?;
        file.charge(count.saturating_mul(4))?;
        let mirrored = block.place.mirrors();
        for i in 0..count {
            let [a, b, c] = triangle(mode, i).map(|k| indices[k]);
            // Strips are joined by triangles without area.
            if mode != 4 && (a == b || b == c || c == a) {
                continue;
            }
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            self.push(corners.map(|v| block.first as u32 + v), material)?;
        }
        Ok(())
    }

    fn push(&mut self, corners: [u32; 3], material: u32) -> Result<()> {
        self.corners += 3;
        if u32::try_from(self.corners).is_err() {
            let what = "the scene has more faces than fit in 32 bits";
            return Err(Error::input(what, "simplify the meshes first"));
        }
        self.polygons.push(&corners);
        self.materials.push(material);
        self.of_object.push(self.objects.len() as u32 - 1);
        Ok(())
    }

    /// The faces and their layers.
    pub fn finish(self, json: &Value) -> (Polygons, Vec<Layer>) {
        let mut layers = Vec::new();
        let mut add = |role, names, of| {
            layers.push(Layer {
                name: String::new(),
                on: On::Face,
                role,
                values: Values::Names { names, of },
            });
        };
        let materials = list(json, "materials").iter().enumerate();
        let called = |(i, m)| name(m).map_or_else(|| format!("material {i}"), str::to_owned);
        let materials: Vec<String> = materials.map(called).collect();
        if !materials.is_empty() && !self.polygons.is_empty() {
            add(Role::Material, materials, self.materials);
        }
        if self.named && !self.polygons.is_empty() {
            add(Role::Object, self.objects, self.of_object);
        }
        (self.polygons, layers)
    }
}

/// The indices of the corners of triangle `i`.
fn triangle(mode: usize, i: usize) -> [usize; 3] {
    match mode {
        5 => [i, i + 1 + i % 2, i + 2 - i % 2],
        6 => [i + 1, i + 2, 0],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    }
}

/// The vertices of a primitive in its order, counted in the block.
fn indices(file: &File, primitive: &Value, count: usize, place: &str) -> Result<Vec<u32>> {
    let Some(accessor) = whole(primitive, "indices", place)? else {
        file.charge(count)?;
        return Ok((0..count as u32).collect());
    };
    let accessor = Accessor::new(file, accessor, place)?;
    if accessor.width != 1 || !matches!(accessor.kind, Kind::U8 | Kind::U16 | Kind::U32) {
        let what = format!("the indices of {place} are not unsigned whole numbers");
        return Err(Error::input(what, DAMAGED));
    }
    let numbers = accessor.numbers(file)?;
    let vertex = |(i, v): (usize, f64)| {
        if v < count as f64 {
            return Ok(v as u32);
        }
        let what = format!("index {i} of {place} names vertex {v}, but there are only {count}");
        Err(Error::input(what, DAMAGED))
    };
    numbers.iter().enumerate().map(vertex).collect()
}

fn material(file: &File, primitive: &Value, place: &str) -> Result<u32> {
    let count = list(&file.contents.json, "materials").len();
    match whole(primitive, "material", place)? {
        None => Ok(NO_ROW),
        Some(material) if material < count => Ok(material as u32),
        Some(material) => {
            let what = format!("{place} names material {material}, but there are only {count}");
            Err(Error::input(what, DAMAGED))
        }
    }
}
