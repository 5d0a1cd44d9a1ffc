//! The faces of a mesh, one by one: which can be used, and what is wrong with the others.

use std::borrow::Cow;

use rayon::prelude::*;

use super::finding::{Finding, Tally, grouped};
use super::kind::{Kind, Severity};
use super::places;
use crate::geom::Vector;
use crate::shape::mesh::{Mesh, Polygons, is_finite};

/// The faces of a mesh sorted by what is wrong with them, and the triangles of those that are
/// joined to a surface.
pub(super) struct Faces<'a> {
    pub mesh: &'a Mesh,
    /// All triangles of the faces whose corners are there, with their faces.
    pub cut: Vec<([u32; 3], u32)>,
    /// The kind of what is wrong with each face: the first in the order of [`FAULTS`].
    faults: Vec<Option<Kind>>,
    /// Whether a corner names the vertex.
    used: Vec<bool>,
    /// The vertex that each vertex counts for: the first of the used ones in its place.
    pub places: Vec<u32>,
    /// The surface as a run sees it, with its corners as places: no triangle has two in one place,
    /// none is there twice.
    pub triangles: Vec<[u32; 3]>,
    /// The same triangles with the vertices that the file names.
    pub as_filed: Vec<[u32; 3]>,
    /// The face that each triangle is cut from.
    pub face_of: Vec<u32>,
}

/// What can be wrong with a face; each face counts under the first that applies.
const FAULTS: [Kind; 7] = [
    Kind::OutOfRange,
    Kind::TooFewCorners,
    Kind::RepeatedCorner,
    Kind::Duplicate,
    Kind::FlippedDuplicate,
    Kind::Overlap,
    Kind::ZeroArea,
];

impl<'a> Faces<'a> {
    /// The faces of `mesh`.
    pub fn new(mesh: &'a Mesh) -> Self {
        let mut faces = Self {
            mesh,
            cut: Vec::new(),
            faults: mesh.polygons.iter().map(|p| unusable(mesh, p)).collect(),
            used: used(mesh),
            places: Vec::new(),
            triangles: Vec::new(),
            as_filed: Vec::new(),
            face_of: Vec::new(),
        };
        faces.places = places::first_in_place(&mesh.positions, &faces.used);
        faces.find_repeated_corners();
        for (face, kind) in super::duplicates::find(&faces) {
            faces.faults[face as usize] = Some(kind);
        }
        faces.cut();
        faces.find_flat();
        faces
    }

    /// Whether nothing is wrong with face `f`.
    pub fn is_sound(&self, f: usize) -> bool {
        self.faults[f].is_none()
    }

    /// Whether face `f` is sound but for a corner that it has twice.
    pub fn can_be_cut(&self, f: usize) -> bool {
        matches!(self.faults[f], None | Some(Kind::RepeatedCorner))
    }

    /// The vertices that faces name.
    pub fn used(&self) -> &[bool] {
        &self.used
    }

    fn find_repeated_corners(&mut self) {
        let mut seen = Vec::new();
        for (f, polygon) in self.mesh.polygons.iter().enumerate() {
            if self.faults[f].is_none() {
                seen.clear();
                seen.extend(polygon.iter().map(|&v| self.places[v as usize]));
                seen.sort_unstable();
                let repeated = seen.windows(2).any(|w| w[0] == w[1]);
                self.faults[f] = repeated.then_some(Kind::RepeatedCorner);
            }
        }
    }

    fn find_flat(&mut self) {
        let mesh = self.mesh;
        self.faults
            .par_iter_mut()
            .enumerate()
            .filter(|(_, fault)| fault.is_none())
            .for_each(|(f, fault)| {
                *fault = is_flat(mesh, mesh.polygons.get(f)).then_some(Kind::ZeroArea);
            });
    }

    /// Cuts the faces into triangles and keeps those that a run works on.
    fn cut(&mut self) {
        self.cut = self.with_corners().triangles().collect();
        let place = |v: u32| self.places[v as usize];
        let finite = |v: &u32| is_finite(&self.mesh.positions[*v as usize]);
        let mut kept = Vec::with_capacity(self.cut.len());
        for (i, (corners, _)) in (0_u32..).zip(&self.cut) {
            let [a, b, c] = corners.map(place);
            if corners.iter().all(finite) && a != b && b != c && c != a {
                let mut sorted = [a, b, c];
                sorted.sort_unstable();
                kept.push((sorted, i));
            }
        }
        kept.par_sort_unstable();
        for same in kept.chunk_by(|a, b| a.0 == b.0) {
            for (_, again) in &same[1..] {
                let face = self.cut[*again as usize].1;
                self.faults[face as usize].get_or_insert(Kind::Overlap);
            }
        }
        kept.dedup_by_key(|(corners, _)| *corners);
        kept.par_sort_unstable_by_key(|(_, i)| *i);
        for (_, i) in kept {
            let (corners, face) = self.cut[i as usize];
            self.triangles.push(corners.map(place));
            self.as_filed.push(corners);
            self.face_of.push(face);
        }
    }

    /// The mesh with faces emptied that cannot be cut: their corners are not there or too few.
    fn with_corners(&self) -> Cow<'a, Mesh> {
        let lacking = |f: usize| {
            let fault = self.faults[f];
            matches!(fault, Some(Kind::OutOfRange | Kind::TooFewCorners))
        };
        let polygons = self.mesh.polygons.iter().enumerate();
        if !(0..self.faults.len()).any(lacking) {
            return Cow::Borrowed(self.mesh);
        }
        let mut emptied = Polygons::default();
        polygons.for_each(|(f, p)| emptied.push(if lacking(f) { &[] } else { p }));
        Cow::Owned(Mesh {
            positions: self.mesh.positions.clone(),
            polygons: emptied,
        })
    }

    /// The findings on faces and vertices one by one.
    pub fn findings(&self) -> Vec<Finding> {
        let mut found: Vec<Finding> = FAULTS
            .into_iter()
            .map(|kind| Finding::new(kind, self.with_fault(kind)))
            .collect();
        found.push(self.non_finite());
        found.push(self.loose());
        found
    }

    fn with_fault(&self, kind: Kind) -> Tally {
        let faults = self.faults.iter().enumerate();
        let these = faults.filter(|(_, fault)| **fault == Some(kind));
        these.map(|(f, _)| f as u32).collect()
    }

    fn non_finite(&self) -> Finding {
        let positions = self.mesh.positions.iter().enumerate();
        let broken = positions.filter(|(_, p)| !is_finite(p));
        let found = Finding::new(Kind::NonFinite, broken.map(|(v, _)| v as u32).collect());
        match self.with_fault(Kind::NonFinite).count {
            0 if found.count == 0 => found,
            0 => Finding {
                severity: Severity::Note,
                action: Kind::Loose.action().to_owned(),
                ..found
            }
            .adding("No face touches such a vertex."),
            1 => found.adding("One face touches such a vertex."),
            n => found.adding(&format!("{} faces touch such a vertex.", grouped(n))),
        }
    }

    fn loose(&self) -> Finding {
        let unused = (0..self.used.len()).filter(|&v| !self.used[v]);
        // Where there is no face at all, that is said, and enough.
        let tally = if self.mesh.polygons.is_empty() {
            Tally::default()
        } else {
            unused.map(|v| v as u32).collect()
        };
        Finding::new(Kind::Loose, tally)
    }
}

/// What keeps a face from being looked at any further.
fn unusable(mesh: &Mesh, polygon: &[u32]) -> Option<Kind> {
    let position = |v: &u32| mesh.positions.get(*v as usize);
    if polygon.iter().any(|v| position(v).is_none()) {
        Some(Kind::OutOfRange)
    } else if polygon.len() < 3 {
        Some(Kind::TooFewCorners)
    } else if polygon.iter().filter_map(position).any(|p| !is_finite(p)) {
        Some(Kind::NonFinite)
    } else {
        None
    }
}

fn used(mesh: &Mesh) -> Vec<bool> {
    let mut used = vec![false; mesh.positions.len()];
    for &v in mesh.polygons.iter().flatten() {
        if let Some(used) = used.get_mut(v as usize) {
            *used = true;
        }
    }
    used
}

/// Whether all triangles of a polygon have no area, to the rounding of its coordinates.
fn is_flat(mesh: &Mesh, polygon: &[u32]) -> bool {
    let at = |v: u32| mesh.positions[v as usize];
    (1..polygon.len() - 1).all(|k| {
        let [a, b, c] = [polygon[0], polygon[k], polygon[k + 1]].map(at);
        let largest = [a, b, c]
            .iter()
            .map(|p| p.coords.amax())
            .fold(0.0, f64::max);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let rounding = f64::EPSILON * (2.0 * largest + 4.0 * longest);
        doubled_area(&(b - a), &(c - a)) <= rounding * longest
    })
}

fn doubled_area(u: &Vector, v: &Vector) -> f64 {
    u.cross(v).norm()
}
