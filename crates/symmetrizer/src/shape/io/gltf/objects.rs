//! Objects as nodes: possible where each has faces and vertices of its own that follow each other.

use std::ops::Range;

use crate::shape::document::{Document, NO_ROW, On, Role, Values};
use crate::shape::mesh::Mesh;

/// Faces and vertices that become one node.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Object {
    pub name: Option<String>,
    pub vertices: Range<usize>,
    pub faces: Range<usize>,
}

/// Whether the objects of `document` can be nodes; splitting vertices does not change that.
pub(super) fn are_nodes(document: &Document) -> bool {
    let mesh = &document.mesh;
    let corners: Vec<u32> = mesh.polygons.iter().flatten().copied().collect();
    named(document, &corners, mesh.positions.len()).is_some()
}

/// The objects of a mesh with the given vertices at its corners; all in one where its objects
/// cannot be nodes.
pub(super) fn objects(document: &Document, corners: &[u32], vertices: usize) -> Vec<Object> {
    named(document, corners, vertices).unwrap_or_else(|| {
        vec![Object {
            name: None,
            vertices: 0..vertices,
            faces: 0..document.mesh.polygons.len(),
        }]
    })
}

fn named(document: &Document, corners: &[u32], vertices: usize) -> Option<Vec<Object>> {
    let layer = document.layer(On::Face, Role::Object)?;
    let Values::Names { names, of } = &layer.values else {
        return None;
    };
    let starts = starts(&document.mesh);
    let mut objects: Vec<Object> = Vec::new();
    let mut seen = vec![false; names.len()];
    let mut face = 0;
    // Vertices that no face uses go with the object before them.
    let mut highest = None;
    for same in of.chunk_by(|a, b| a == b) {
        let name = names.get(same[0] as usize).filter(|_| same[0] != NO_ROW)?;
        if std::mem::replace(&mut seen[same[0] as usize], true) {
            return None;
        }
        let faces = face..face + same.len();
        face = faces.end;
        let used = corners.get(starts[faces.start]..starts[faces.end])?;
        let (least, most) = (*used.iter().min()?, *used.iter().max()?);
        if highest.is_some_and(|h| least <= h) {
            return None;
        }
        highest = Some(most);
        if let Some(before) = objects.last_mut() {
            before.vertices.end = least as usize;
        }
        let first = objects.last().map_or(0, |o| o.vertices.end);
        objects.push(Object {
            name: Some(name.clone()),
            vertices: first..vertices,
            faces,
        });
    }
    (!objects.is_empty()).then_some(objects)
}

/// The first corner of each face, and the number of all corners.
pub(super) fn starts(mesh: &Mesh) -> Vec<usize> {
    let mut starts = vec![0];
    let mut end = 0;
    for polygon in mesh.polygons.iter() {
        end += polygon.len();
        starts.push(end);
    }
    starts
}
