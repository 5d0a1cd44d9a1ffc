//! Flat meshes: their boundary is the outline.

use std::collections::BTreeMap;

use super::outline::Outline;
use super::region;
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector, sorted_eigen};
use crate::shape::document::Document;
use crate::shape::io;

/// Of the diagonal: how far vertices may lie from their plane.
const THICKNESS: f64 = 1e-6;

/// A flat mesh and its plane.
#[derive(Debug, Clone)]
pub(super) struct Flat {
    document: Document,
    /// Turns the mesh's coordinates so that its plane is level.
    level: Matrix3,
}

/// Reads the bytes of an OBJ file.
///
/// # Errors
/// [`Error::Input`] as for meshes, and where the mesh is not flat or has no boundary.
pub(super) fn read(bytes: Vec<u8>) -> Result<(Flat, Outline)> {
    of_document(io::decode(bytes, io::Format::Obj)?)
}

/// The outline of a document's mesh.
///
/// # Errors
/// As [`read`].
pub(super) fn of_document(document: Document) -> Result<(Flat, Outline)> {
    document.mesh.check()?;
    let level = plane(&document.mesh.positions)?;
    let flat = Flat { document, level };
    let outline = region::of_rings(&flat.boundary()?)?;
    if outline.is_empty() {
        let what = "the flat mesh has no boundary around an area";
        return Err(Error::input(what, "is this the right file?"));
    }
    Ok((flat, outline))
}

/// The rotation that levels the plane of some points; coordinates stay as they are where it is
/// level already.
fn plane(positions: &[Point]) -> Result<Matrix3> {
    let count = positions.len() as f64;
    let mean = positions.iter().map(|p| p.coords).sum::<Vector>() / count;
    let offsets = positions.iter().map(|p| p.coords - mean);
    let size = offsets.clone().map(|d| d.norm()).fold(0.0, f64::max);
    let flat = |normal: &Vector| {
        offsets
            .clone()
            .all(|d| d.dot(normal).abs() <= THICKNESS * size)
    };
    if flat(&Vector::z()) {
        return Ok(Matrix3::identity());
    }
    let (_, axes) = sorted_eigen(&offsets.clone().map(|d| d * d.transpose()).sum());
    let normal: Vector = axes.column(0).into();
    if !(size > 0.0 && flat(&normal)) {
        let what = "the mesh is not flat";
        return Err(Error::input(
            what,
            "as a drawing a mesh must lie in a plane",
        ));
    }
    let normal = if normal.z < 0.0 { -normal } else { normal };
    let turn = nalgebra::Rotation3::rotation_between(&normal, &Vector::z());
    Ok(turn.map_or_else(Matrix3::identity, nalgebra::Rotation3::into_inner))
}

impl Flat {
    /// The mesh, as a document of its file.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Where its vertices are, levelled.
    pub fn vertices(&self) -> Vec<Point> {
        let all: Vec<u32> = (0..self.document.mesh.positions.len() as u32).collect();
        self.levelled(&all)
    }

    /// The mesh with its vertices moved in their plane.
    ///
    /// # Errors
    /// [`Error::Numerical`] where `map` leads to what is no number.
    pub fn deformed(&self, map: &dyn Fn(Point) -> Point) -> Result<Self> {
        let mut flat = self.clone();
        for (number, p) in flat.document.mesh.positions.iter_mut().enumerate() {
            let before = self.level * p.coords;
            let at = Point::new(before.x, before.y, 0.0);
            let to = map(at);
            if !(to.x.is_finite() && to.y.is_finite()) {
                return Err(Error::Numerical {
                    stage: "drawing",
                    step: number,
                    what: "the deformation leads to points that are no numbers".into(),
                });
            }
            if to != at {
                let lifted = Vector::new(to.x, to.y, before.z);
                *p = Point::from(self.level.transpose() * lifted);
            }
        }
        Ok(flat)
    }

    /// The loops of edges that one face only has, levelled.
    fn boundary(&self) -> Result<Vec<Vec<Point>>> {
        let mut faces: BTreeMap<(u32, u32), i32> = BTreeMap::new();
        for polygon in self.document.mesh.polygons.iter() {
            let ends = polygon.iter().zip(polygon.iter().cycle().skip(1));
            for (&a, &b) in ends {
                *faces.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
        let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (&(a, b), _) in faces.iter().filter(|(_, count)| **count == 1) {
            around.entry(a).or_default().push(b);
            around.entry(b).or_default().push(a);
        }
        if let Some((v, _)) = around.iter().find(|(_, to)| to.len() % 2 == 1) {
            let what = format!("the boundary at vertex {v} (counted from 0) leads nowhere");
            return Err(Error::input(what, "repair the mesh first"));
        }
        Ok(loops(around).iter().map(|l| self.levelled(l)).collect())
    }

    fn levelled(&self, vertices: &[u32]) -> Vec<Point> {
        let place = |v: &u32| {
            let p = self.level * self.document.mesh.positions[*v as usize].coords;
            Point::new(p.x, p.y, 0.0)
        };
        vertices.iter().map(place).collect()
    }
}

/// Closed walks that take every edge once.
fn loops(mut around: BTreeMap<u32, Vec<u32>>) -> Vec<Vec<u32>> {
    let mut found = Vec::new();
    while let Some((&start, _)) = around.iter().find(|(_, to)| !to.is_empty()) {
        let mut walk = vec![start];
        let mut at = start;
        while let Some(to) = around.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = around.get_mut(&to) {
                let used = back.iter().position(|v| *v == at);
                used.map(|i| back.swap_remove(i));
            }
            if to == start {
                break;
            }
            walk.push(to);
            at = to;
        }
        // What is done with is not looked at again.
        around.retain(|_, to| !to.is_empty());
        found.push(walk);
    }
    found
}
