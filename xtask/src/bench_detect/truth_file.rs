//! The files of truth: most are in rest coordinates, with the placement that leads to the shape's file.

use nalgebra::Matrix4;
use serde::Deserialize;
use symmetrizer::geom::{Point, Vector};

use super::place::{Axis, Motion, Plane};
use super::truth::{Cluster, RepeatPair, Repeats, Truth};

/// A file of truth, by its kind.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Raw {
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
    /// A kind that is not for detection in space.
    #[serde(other)]
    Other,
}

#[derive(Deserialize)]
pub struct RawCluster {
    normal: [f64; 3],
    offset: f64,
    point: [f64; 3],
    vertex_fraction: f64,
    rms_rel_diag: f64,
}

#[derive(Deserialize)]
pub struct RawPlane {
    normal: [f64; 3],
    offset: f64,
}

#[derive(Deserialize)]
pub struct RawPair {
    a: i64,
    b: i64,
    improper: bool,
    transform_a_to_b: [[f64; 4]; 4],
}

/// The file of a shape and its symmetries in that file's coordinates; none for kinds that are not asked for.
pub fn known(raw: Raw) -> Option<(String, Truth)> {
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
