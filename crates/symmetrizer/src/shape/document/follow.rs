//! What follows a deformation: positions, and the directions that turn with the surface.

use nalgebra::Matrix3;

use super::layer::{Layer, NO_ROW, On, Role, Values};
use super::{Document, Numbers};
use crate::geom::{Point, Vector, nearest_orthogonal};
use crate::shape::mesh::Mesh;
use crate::shape::working::Working;

impl Document {
    /// The document with its shape deformed as `working`, its working surface, was: `positions` are
    /// the vertices of that surface afterwards, working coordinates.
    ///
    /// Normals, tangents and morph targets turn with the surface around them: by the rotation that
    /// best fits (least squares) the edges at their vertex, or those of their face where they belong
    /// to it, as in flat shading. Where nothing moved, every value keeps its bits; all other layers are
    /// as they were.
    pub fn deformed(&self, working: &Working, positions: &[Point]) -> Self {
        let mut document = self.clone();
        document.mesh = working.moved_document(&self.mesh, positions);
        if document.layers.iter().any(|l| l.role.turns()) {
            let turns = Turns {
                of_working: turns(working, positions),
                working,
                rest: &self.mesh,
                moved: &document.mesh,
            };
            for layer in document.layers.iter_mut().filter(|l| l.role.turns()) {
                let places = places(&self.mesh, layer);
                turn(layer, &places, |place| turns.at(place));
            }
        }
        document
    }
}

/// What an element of a layer turns with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Vertex(u32),
    Face(u32),
}

/// The rotations of a deformation.
struct Turns<'a> {
    of_working: Vec<Option<Matrix3<f64>>>,
    working: &'a Working,
    rest: &'a Mesh,
    moved: &'a Mesh,
}

impl Turns<'_> {
    /// The rotation at a place; `None` where nothing around it moved.
    fn at(&self, place: Place) -> Option<Matrix3<f64>> {
        match place {
            Place::Vertex(v) => {
                let vertex = self.working.vertex_of_document[v as usize];
                vertex.and_then(|v| self.of_working[v as usize])
            }
            Place::Face(f) => self.of_face(f as usize),
        }
    }

    fn of_face(&self, f: usize) -> Option<Matrix3<f64>> {
        let polygon = self.rest.polygons.get(f);
        let at = |mesh: &Mesh, v: u32| mesh.positions[v as usize];
        if polygon
            .iter()
            .all(|&v| at(self.rest, v) == at(self.moved, v))
        {
            return None;
        }
        let next = polygon.iter().cycle().skip(1);
        let edges = polygon.iter().zip(next).map(|(&u, &v)| {
            let [before, after] = [self.rest, self.moved].map(|m| at(m, v) - at(m, u));
            after * before.transpose()
        });
        let covariance: Matrix3<f64> = edges.sum();
        covariance
            .iter()
            .all(|c| c.is_finite())
            .then(|| nearest_orthogonal(&covariance, false))
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
    fitted
        .map(|(c, m)| m.then(|| nearest_orthogonal(c, false)))
        .collect()
}

/// A normal no further than this from its face's own belongs to the face, cosine.
const FLAT: f64 = 0.999_998;

/// What each element of a layer turns with: corners with their vertex, unless their normal is that of
/// the face.
fn places(rest: &Mesh, layer: &Layer) -> Vec<Place> {
    match layer.on {
        On::Vertex => (0..rest.positions.len() as u32)
            .map(Place::Vertex)
            .collect(),
        On::Face => (0..rest.polygons.len() as u32).map(Place::Face).collect(),
        On::Corner => {
            let mut places = Vec::new();
            for (f, polygon) in (0..).zip(rest.polygons.iter()) {
                let of_face = face_normal(rest, polygon);
                for &v in polygon {
                    let own = normal_of(layer, places.len());
                    let flat = own.is_some_and(|n| n.dot(&of_face) > FLAT);
                    places.push(if flat {
                        Place::Face(f)
                    } else {
                        Place::Vertex(v)
                    });
                }
            }
            places
        }
    }
}

/// The unit normal of a polygon (Newell), or zero.
fn face_normal(mesh: &Mesh, polygon: &[u32]) -> Vector {
    let at = |v: u32| mesh.positions[v as usize] - mesh.positions[polygon[0] as usize];
    let next = polygon.iter().cycle().skip(1);
    let doubled: Vector = polygon
        .iter()
        .zip(next)
        .map(|(&u, &v)| at(u).cross(&at(v)))
        .sum();
    doubled.try_normalize(0.0).unwrap_or_else(Vector::zeros)
}

/// The unit normal of an element, where the layer has normals.
fn normal_of(layer: &Layer, element: usize) -> Option<Vector> {
    let number = |k| layer.values.get(element, k);
    let is_normal = layer.role == Role::Normal && layer.values.width() == Some(3);
    let n = is_normal.then(|| Some(Vector::new(number(0)?, number(1)?, number(2)?)))??;
    n.try_normalize(0.0)
}

fn turn(layer: &mut Layer, places: &[Place], turn: impl Fn(Place) -> Option<Matrix3<f64>>) {
    match &mut layer.values {
        Values::Rows { width, numbers } if *width >= 3 => {
            for (i, &place) in places.iter().enumerate() {
                if let Some(r) = turn(place) {
                    turn_row(numbers, i * *width, &r);
                }
            }
        }
        Values::Pool {
            width,
            numbers,
            rows,
        } if *width >= 3 => turn_pool(*width, numbers, rows, places, turn),
        _ => {}
    }
}

/// A row that several places share turns differently at each: the first place keeps the row, the
/// others get rows of their own at the end.
fn turn_pool(
    width: usize,
    numbers: &mut Numbers,
    rows: &mut [u32],
    places: &[Place],
    turn: impl Fn(Place) -> Option<Matrix3<f64>>,
) {
    let rest = numbers.clone();
    let mut users: Vec<(u32, Place, usize)> = rows
        .iter()
        .zip(places)
        .enumerate()
        .filter(|(_, (row, _))| **row != NO_ROW)
        .map(|(i, (&row, &place))| (row, place, i))
        .collect();
    users.sort_unstable();
    for of_row in users.chunk_by(|a, b| a.0 == b.0) {
        for (k, of_place) in of_row.chunk_by(|a, b| a.1 == b.1).enumerate() {
            let (row, place, _) = of_place[0];
            let rotation = turn(place);
            let start = row as usize * width;
            let mut to = row;
            if k > 0 && rotation.is_some() {
                to = (numbers.len() / width) as u32;
                (0..width).for_each(|c| numbers.push(rest.get(start + c)));
            }
            if let Some(r) = rotation {
                turn_row(numbers, to as usize * width, &r);
            }
            of_place.iter().for_each(|&(_, _, i)| rows[i] = to);
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
