//! Everything that is told about a mesh.

use serde::Serialize;

use super::crossing;
use super::faces::Faces;
use super::finding::{Finding, Tally};
use super::joined::Joined;
use super::kind::{Kind, Severity};
use super::polygons;
use super::size::Size;
use crate::geom::{Point, Vector};
use crate::shape::mesh::Mesh;

/// What is found in a mesh, and what a run does about it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Findings {
    /// Vertices of the file.
    pub vertices: usize,
    /// Faces of the file, whatever their corners.
    pub faces: usize,
    /// Triangles that a run can work with.
    pub triangles: usize,
    /// Place and size; none where no vertex has a place.
    pub size: Option<Size>,
    /// What was found, that which matters most first.
    pub findings: Vec<Finding>,
}

impl Findings {
    /// What there is to be told about `mesh`, which may be damaged in any way. Faces are counted
    /// under one fault each; how they hang together is looked at with vertices in equal places as
    /// one, and without unusable and duplicate faces.
    pub fn of(mesh: &Mesh) -> Self {
        let faces = Faces::new(mesh);
        let size = Size::of(mesh, faces.used());
        let mut found = vec![surface(&faces)];
        found.extend(faces.findings());
        found.extend(polygons::findings(&faces));
        if !faces.triangles.is_empty() {
            found.extend(Joined::new(&faces).findings());
            found.push(crossing::finding(&faces, size.as_ref()));
        }
        if let Some(size) = &size {
            found.extend(size.findings(mesh.positions.len()));
        }
        let empty = |f: &Finding| f.count == 0 && f.kind != Kind::NoFaces;
        found.retain(|f| !empty(f));
        found.sort_by_key(|f| (f.severity, f.kind));
        Self {
            vertices: mesh.positions.len(),
            faces: mesh.polygons.len(),
            triangles: faces.triangles.len(),
            size,
            findings: found,
        }
    }

    /// The finding of a kind, if there is one.
    pub fn get(&self, kind: Kind) -> Option<&Finding> {
        self.findings.iter().find(|f| f.kind == kind)
    }

    /// Whether a run can work on the mesh.
    pub fn works(&self) -> bool {
        self.refusals().next().is_none()
    }

    /// What keeps a run from working on it.
    pub fn refusals(&self) -> impl Iterator<Item = &Finding> {
        let refused = |f: &&Finding| f.severity == Severity::Refused;
        self.findings.iter().filter(refused)
    }
}

/// Whether there is a surface to work on: [`Kind::NoFaces`] or [`Kind::NoSurface`] where there is
/// none, else nothing, which counts 0.
fn surface(faces: &Faces<'_>) -> Finding {
    let mesh = faces.mesh;
    if mesh.polygons.is_empty() {
        let none = Finding::new(Kind::NoFaces, Tally::of(mesh.positions.len()));
        if mesh.positions.is_empty() {
            return Finding {
                what: "There are no vertices either.".to_owned(),
                action: "refuses the file: check that it is the right one".to_owned(),
                ..none
            };
        }
        return none;
    }
    let count = if has_area(faces) {
        0
    } else {
        mesh.polygons.len()
    };
    Finding::new(Kind::NoSurface, Tally::of(count))
}

/// Whether area and extent of the triangles are numbers to work with.
fn has_area(faces: &Faces<'_>) -> bool {
    let at = |v: u32| &faces.mesh.positions[v as usize];
    let Some(&[first, ..]) = faces.triangles.first() else {
        return false;
    };
    let origin: Point = *at(first);
    let mut area = 0.0;
    let mut second = 0.0;
    for t in &faces.triangles {
        let [a, b, c]: [Vector; 3] = t.map(|v| at(v) - origin);
        let doubled = (b - a).cross(&(c - a)).norm();
        area += doubled;
        second += doubled * (a.norm_squared() + b.norm_squared() + c.norm_squared());
    }
    area > 0.0 && second > 0.0 && second.is_finite()
}
