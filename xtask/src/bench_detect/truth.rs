//! The shapes whose symmetries are known, in the coordinates of their files.

use std::path::Path;

use nalgebra::Matrix4;
use serde::Deserialize;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::io;
use symmetrizer::{Mesh, Result};

use super::place::{Axis, Motion, Plane};
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

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Raw {
    Reflection {
        file: String,
        clusters: Vec<RawCluster>,
        noise_sigma_rel_diag: f64,
    },
    Rotation {
        file: String,
        placement: [[f64; 4]; 4],
        axis: [f64; 3],
        point: [f64; 3],
        order: u32,
    },
    Translation {
        file: String,
        placement: [[f64; 4]; 4],
        step: [f64; 3],
        count: u32,
    },
    Reflections {
        file: String,
        placement: [[f64; 4]; 4],
        planes: Vec<RawPlane>,
    },
    ContinuousRotation {
        file: String,
        placement: [[f64; 4]; 4],
        axis: [f64; 3],
        point: [f64; 3],
    },
    None {
        file: String,
    },
    RepeatedElement {
        file: String,
        pairwise: Vec<RawPair>,
        face_element: Vec<i64>,
        vertex_element: Vec<i64>,
    },
    #[serde(other)]
    Other,
}

#[derive(Deserialize)]
struct RawCluster {
    normal: [f64; 3],
    offset: f64,
    point: [f64; 3],
    vertex_fraction: f64,
    rms_rel_diag: f64,
}

#[derive(Deserialize)]
struct RawPlane {
    normal: [f64; 3],
    offset: f64,
}

#[derive(Deserialize)]
struct RawPair {
    a: i64,
    b: i64,
    improper: bool,
    transform_a_to_b: [[f64; 4]; 4],
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

/// The file of a shape and its symmetries in that file's coordinates.
fn known(raw: Raw) -> Option<(String, Truth)> {
    Some(match raw {
        Raw::Reflection {
            file,
            clusters,
            noise_sigma_rel_diag,
        } => {
            let clusters = clusters.iter().map(cluster).collect();
            let noise = noise_sigma_rel_diag;
            (file, Truth::Mirrors { clusters, noise })
        }
        Raw::Rotation {
            file,
            placement,
            axis,
            point,
            order,
        } => {
            let axis = axis_in_file(&placement, axis, point);
            (file, Truth::Rotation { axis, order })
        }
        Raw::Translation {
            file,
            placement,
            step,
            count,
        } => {
            let step = matrix(&placement).transform_vector(&step.into());
            (file, Truth::Row { step, count })
        }
        Raw::Reflections {
            file,
            placement,
            planes,
        } => {
            let planes = planes.iter().map(|p| plane_in_file(&placement, p));
            (file, Truth::Planes(planes.collect()))
        }
        Raw::ContinuousRotation {
            file,
            placement,
            axis,
            point,
        } => (
            file,
            Truth::Revolution(axis_in_file(&placement, axis, point)),
        ),
        Raw::None { file } => (file, Truth::None),
        Raw::RepeatedElement {
            file,
            pairwise,
            face_element,
            vertex_element,
        } => {
            let repeats = Repeats {
                pairs: pairwise.iter().map(repeat_pair).collect(),
                face_element,
                vertex_element,
            };
            (file, Truth::Repeats(repeats))
        }
        Raw::Other => return None,
    })
}

fn cluster(raw: &RawCluster) -> Cluster {
    Cluster {
        plane: Plane {
            normal: Vector::from(raw.normal).normalize(),
            offset: raw.offset,
        },
        point: raw.point.into(),
        fraction: raw.vertex_fraction,
        rms: raw.rms_rel_diag,
    }
}

fn repeat_pair(raw: &RawPair) -> RepeatPair {
    RepeatPair {
        a: raw.a,
        b: raw.b,
        motion: Motion::from_rows(&raw.transform_a_to_b),
        improper: raw.improper,
    }
}

/// The similarity from rest to file coordinates.
fn matrix(rows: &[[f64; 4]; 4]) -> Matrix4<f64> {
    Matrix4::from_fn(|r, c| rows[r][c])
}

fn axis_in_file(placement: &[[f64; 4]; 4], axis: [f64; 3], point: [f64; 3]) -> Axis {
    let place = matrix(placement);
    Axis {
        direction: place.transform_vector(&axis.into()).normalize(),
        point: place.transform_point(&point.into()),
    }
}

fn plane_in_file(placement: &[[f64; 4]; 4], raw: &RawPlane) -> Cluster {
    let place = matrix(placement);
    let normal = Vector::from(raw.normal);
    let point = place.transform_point(&Point::from(normal * raw.offset));
    let normal = place.transform_vector(&normal).normalize();
    Cluster {
        plane: Plane {
            normal,
            offset: normal.dot(&point.coords),
        },
        point,
        fraction: 1.0,
        rms: 0.0,
    }
}
