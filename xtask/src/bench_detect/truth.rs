//! The shapes whose symmetries are known, in the coordinates of their files.

use std::path::Path;

use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::io;
use symmetrizer::{Mesh, Result};

use super::place::{Axis, Motion, Plane};
use super::truth_file::known;
use crate::data;

/// A shape and what is known of it.
pub struct Shape {
    /// The file's name without its extension.
    pub name: String,
    /// The shape as its file has it.
    pub mesh: Mesh,
    /// Its bounding-box diagonal D, file units.
    pub diagonal: f64,
    /// Its symmetries.
    pub truth: Truth,
}

/// The symmetries of a shape.
pub enum Truth {
    /// Mirrors of the whole or of parts; noise along the normals, fraction of D, is in the file.
    Mirrors { clusters: Vec<Cluster>, noise: f64 },
    /// An n-fold axis and nothing else.
    Rotation { axis: Axis, order: u32 },
    /// A row of equal parts.
    Row { step: Vector, count: u32 },
    /// Mirrors of the whole shape, at right angles.
    Planes(Vec<Cluster>),
    /// A surface of revolution.
    Revolution(Axis),
    /// None at all.
    None,
    /// Copies of one element, turned, moved and mirrored.
    Repeats(Repeats),
}

/// A true mirror.
#[derive(Debug, Clone, Copy)]
pub struct Cluster {
    /// Its plane.
    pub plane: Plane,
    /// Where its offset is compared.
    pub point: Point,
    /// Share of the vertices that it holds for.
    pub fraction: f64,
    /// How well it holds, rms over D.
    pub rms: f64,
}

/// Copies of one element.
pub struct Repeats {
    /// What carries copy a onto copy b, for all a < b.
    pub pairs: Vec<RepeatPair>,
    /// The copy of each triangle, -1 for none.
    pub face_element: Vec<i64>,
    /// The copy of each vertex, -1 for none.
    pub vertex_element: Vec<i64>,
}

/// Two copies and what carries one onto the other.
pub struct RepeatPair {
    /// The first copy.
    pub a: i64,
    /// The second.
    pub b: i64,
    /// From the first to the second.
    pub motion: Motion,
    /// Whether that is a mirror image.
    pub improper: bool,
}

impl Cluster {
    /// Whether it is held to: it holds for a tenth of the shape, which moved as one piece.
    pub fn is_rigid(&self) -> bool {
        self.fraction >= 0.1 && self.rms <= 0.002
    }
}

/// The 3D shapes of `folder` whose names contain `only`, by name.
///
/// # Errors
/// Files that are missing or damaged.
pub fn read_all(folder: &Path, only: &str) -> Result<Vec<Shape>> {
    let entries = std::fs::read_dir(folder).map_err(|e| symmetrizer::Error::io(folder, e))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|name| Some(name.strip_suffix(".truth.json")?.to_owned()))
        .filter(|name| name.contains(only))
        .collect();
    names.sort();
    let shapes = names.into_iter().map(|name| read(folder, name));
    shapes.filter_map(Result::transpose).collect()
}

/// The shape `name`; none where it is flat.
fn read(folder: &Path, name: String) -> Result<Option<Shape>> {
    let path = folder.join(format!("{name}.truth.json"));
    let Some((file, truth)) = known(data::json(&path)?) else {
        return Ok(None);
    };
    let mesh = io::read(&folder.join(file))?.mesh;
    if let Truth::Repeats(repeats) = &truth {
        let sizes = [repeats.face_element.len(), repeats.vertex_element.len()];
        if sizes != [mesh.triangles().count(), mesh.positions.len()] {
            return Err(data::damaged(
                &path,
                "it has other faces or vertices than its shape",
            ));
        }
    }
    let diagonal = mesh.diagonal();
    Ok(Some(Shape {
        name,
        mesh,
        diagonal,
        truth,
    }))
}
