//! What follows a deformation: positions, and the directions that turn with the surface.

use nalgebra::Matrix3;

use super::layer::{Layer, NO_ROW, On, Values};
use super::{Document, Numbers};
use crate::geom::{Point, Vector};
use crate::shape::working::Working;

impl Document {
    /// The document with its shape deformed as `working`, its working surface, was: `positions` are
    /// the vertices of that surface afterwards, working coordinates.
    ///
    /// Normals, tangents and morph targets turn with the surface around them: by the rotation that
    /// best fits (least squares) the edges at their vertex. Where nothing moved, every value keeps
    /// its bits; all other layers are as they were.
    pub fn deformed(&self, working: &Working, positions: &[Point]) -> Self {
        let mut document = self.clone();
        document.mesh = working.moved_document(&self.mesh, positions);
        if document.layers.iter().any(|l| l.role.turns()) {
            let turns = turns(working, positions);
            let of_vertex = |v: u32| {
                let vertex = working.vertex_of_document[v as usize];
                vertex.and_then(|v| turns[v as usize])
            };
            for layer in document.layers.iter_mut().filter(|l| l.role.turns()) {
                let vertices = vertices_of(self, layer.on);
                turn(layer, &vertices, of_vertex);
            }
        }
        document
    }
}

/// The rotation of the surface at each working vertex; `None` where nothing around it moved.
fn turns(working: &Working, positions: &[Point]) -> Vec<Option<Matrix3<f64>>> {
    let rest = &working.surface;
    let count = rest.positions.len();
    let mut covariance = vec![Matrix3::zeros(); count];
    let mut moved = vec![false; count];
    for corners in rest.triangles.iter() {
        let stays = |v: &u32| positions[*v as usize] == rest.positions[*v as usize];
        let still = corners.iter().all(stays);
        for k in 0..3 {
            let [u, v] = [corners[k], corners[(k + 1) % 3]].map(|v| v as usize);
            let before = rest.positions[v] - rest.positions[u];
            let edge = (positions[v] - positions[u]) * before.transpose();
            covariance[u] += edge;
            covariance[v] += edge;
            moved[u] |= !still;
        }
    }
    let fitted = covariance.iter().zip(moved);
    fitted.map(|(c, m)| m.then(|| rotation(c))).collect()
}

/// The rotation R that maximises tr(R^T C): the polar factor with determinant 1.
fn rotation(covariance: &Matrix3<f64>) -> Matrix3<f64> {
    let svd = covariance.svd(true, true);
    let (Some(mut u), Some(v_t)) = (svd.u, svd.v_t) else {
        return Matrix3::identity();
    };
    if (u * v_t).determinant() < 0.0 {
        // The axis of least stretch: across the surface.
        let least = svd.singular_values.imin();
        u.column_mut(least).neg_mut();
    }
    u * v_t
}

/// The vertex whose rotation each element of a layer follows.
fn vertices_of(document: &Document, on: On) -> Vec<u32> {
    let polygons = &document.mesh.polygons;
    match on {
        On::Vertex => (0..document.mesh.positions.len() as u32).collect(),
        On::Corner => polygons.iter().flatten().copied().collect(),
        On::Face => polygons.iter().map(|p| p[0]).collect(),
    }
}

fn turn(layer: &mut Layer, vertices: &[u32], turn: impl Fn(u32) -> Option<Matrix3<f64>>) {
    match &mut layer.values {
        Values::Rows { width, numbers } if *width >= 3 => {
            for (i, &v) in vertices.iter().enumerate() {
                if let Some(r) = turn(v) {
                    turn_row(numbers, i * *width, &r);
                }
            }
        }
        Values::Pool {
            width,
            numbers,
            rows,
        } if *width >= 3 => turn_pool(*width, numbers, rows, vertices, turn),
        _ => {}
    }
}

/// A row that several vertices share turns differently at each: the first vertex keeps the row, the
/// others get rows of their own at the end.
fn turn_pool(
    width: usize,
    numbers: &mut Numbers,
    rows: &mut [u32],
    vertices: &[u32],
    turn: impl Fn(u32) -> Option<Matrix3<f64>>,
) {
    let rest = numbers.clone();
    let mut users: Vec<(u32, u32, usize)> = rows
        .iter()
        .zip(vertices)
        .enumerate()
        .filter(|(_, (row, _))| **row != NO_ROW)
        .map(|(i, (&row, &v))| (row, v, i))
        .collect();
    users.sort_unstable();
    for of_row in users.chunk_by(|a, b| a.0 == b.0) {
        for (k, of_vertex) in of_row.chunk_by(|a, b| a.1 == b.1).enumerate() {
            let (row, vertex, _) = of_vertex[0];
            let rotation = turn(vertex);
            let start = row as usize * width;
            let mut to = row;
            if k > 0 && rotation.is_some() {
                to = (numbers.len() / width) as u32;
                (0..width).for_each(|c| numbers.push(rest.get(start + c)));
            }
            if let Some(r) = rotation {
                turn_row(numbers, to as usize * width, &r);
            }
            of_vertex.iter().for_each(|&(_, _, i)| rows[i] = to);
        }
    }
}

fn turn_row(numbers: &mut Numbers, start: usize, rotation: &Matrix3<f64>) {
    let before = Vector::new(
        numbers.get(start),
        numbers.get(start + 1),
        numbers.get(start + 2),
    );
    let after = rotation * before;
    (0..3).for_each(|k| numbers.set(start + k, after[k]));
}
