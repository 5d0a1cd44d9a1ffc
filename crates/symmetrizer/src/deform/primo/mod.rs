//! PriMo (Botsch, Pauly, Gross, Kobbelt 2006): rigid prisms over the faces of a surface, or of a control
//! mesh that carries it, with elastic joints.

pub mod joint;

use std::collections::BTreeMap;

use crate::deform::bridges::bridges;
use crate::deform::control::control_mesh;
use crate::deform::elastic::{Binding, Body, Elements, Sites};
use crate::deform::failure;
use crate::deform::params::DeformParams;
use crate::deform::solver::SolveError;
use crate::error::Result;
use crate::geom::Point;
use crate::shape::Surface;
use joint::{Joint, gauss_points};

/// The PriMo deformer.
pub type Primo = Body<Joint>;

/// Pair weights |e|^2 / (A_i + A_j) are clamped to this range: slivers would else lock or tear
/// (ours).
const WEIGHT_RANGE: (f64, f64) = (1e-3, 50.0);

/// Weight of the joint that ties a separate component to its nearest neighbour, beside 1 to 3 for
/// an ordinary edge.
const BRIDGE_WEIGHT: f64 = 0.1;

impl Primo {
    /// Prisms over a control mesh of `rest`.
    ///
    /// # Errors
    /// [`crate::Error::Params`] for lengths that are not positive, [`crate::Error::Numerical`].
    pub fn new(rest: &Surface, params: &DeformParams) -> Result<Self> {
        params.check()?;
        let control = control_mesh(rest, params.control_faces)?;
        let binding = if control.triangles.len() == rest.triangles.len() {
            Binding::incident(rest)
        } else {
            Binding::within_reach(rest, &control, &Sites::faces(&control))
        };
        let prisms = prisms(&control, params.half_height).map_err(|e| failure(e, 0))?;
        Ok(Self::over(rest, binding, prisms))
    }
}

/// Prisms of half height `h` (fraction of L) over the faces of `surface`.
///
/// # Errors
/// [`SolveError::Setup`].
pub fn prisms(surface: &Surface, h: f64) -> std::result::Result<Elements<Joint>, SolveError> {
    let mut joints = edge_joints(surface, h);
    let centers: Vec<Point> = (0..surface.triangles.len() as u32)
        .map(|f| center(surface, f))
        .collect();
    let ties = bridges(&centers, joints.iter().map(|j| [j.i as u32, j.j as u32]));
    let ties = ties
        .iter()
        .map(|&[i, j]| tie(surface, &centers, i as usize, j as usize));
    joints.extend(ties);
    Elements::new(&centers, joints)
}

/// A joint for each pair of faces along an edge; where more than two meet, the first with each.
fn edge_joints(surface: &Surface, h: f64) -> Vec<Joint> {
    let mut faces_of_edge: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (f, &[a, b, c]) in surface.triangles.iter().enumerate() {
        for (u, v) in [(a, b), (b, c), (c, a)] {
            faces_of_edge
                .entry((u.min(v), u.max(v)))
                .or_default()
                .push(f);
        }
    }
    let mut joints = Vec::new();
    for ((u, v), faces) in faces_of_edge {
        let (a, b) = (u as usize, v as usize);
        let (x_a, x_b) = (surface.positions[a], surface.positions[b]);
        let (n_a, n_b) = (surface.vertex_normals[a], surface.vertex_normals[b]);
        for &j in &faces[1..] {
            let i = faces[0];
            let areas = surface.face_areas[i] + surface.face_areas[j];
            let w = ((x_b - x_a).norm_squared() / areas.max(f64::MIN_POSITIVE))
                .clamp(WEIGHT_RANGE.0, WEIGHT_RANGE.1);
            let points = gauss_points(&x_a, &x_b, &n_a, &n_b, h);
            joints.push(Joint::new(i, j, &points, w));
        }
    }
    joints
}

fn center(surface: &Surface, f: u32) -> Point {
    let [a, b, c] = surface.corners(f);
    Point::from((a.coords + b.coords + c.coords) / 3.0)
}

/// A soft joint between prisms of two components.
fn tie(surface: &Surface, centers: &[Point], i: usize, j: usize) -> Joint {
    let [a, b, c] = surface.corners(i as u32);
    let points = [a, b, c, nalgebra::center(&centers[i], &centers[j])];
    Joint::new(i, j, &points, BRIDGE_WEIGHT)
}
