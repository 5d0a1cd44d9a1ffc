//! What is unusual in a mesh: counts for the report of a run, and findings with their places for
//! those who ask what is wrong with a file.

mod crossing;
mod duplicates;
mod edges;
mod faces;
mod finding;
mod findings;
mod joined;
mod kind;
mod near;
mod places;
mod polygons;
mod sets;
mod size;

use serde::Serialize;

use crate::shape::Working;
use crate::shape::mesh::Mesh;

pub use finding::{FIRST, Finding, Place, grouped};
pub use findings::Findings;
pub use kind::{Kind, Severity};
pub use size::Size;

/// What the working surface had to leave out, and how it hangs together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Validation {
    /// Document vertices that no face uses.
    pub unused_vertices: usize,
    /// Document vertices in the same place as an earlier one, for which they count.
    pub welded_vertices: usize,
    /// Triangles of the document with two corners in one place, or without area.
    pub degenerate_faces: usize,
    /// Triangles of the document with the corners of an earlier one.
    pub duplicate_faces: usize,
    /// Triangles of the document with a corner that has no finite position.
    pub unplaced_faces: usize,
    /// Triangles turned to run the same way round as their neighbours.
    pub turned_faces: usize,
    /// Parts of the surface that share no vertex.
    pub components: usize,
    /// Edges with one triangle.
    pub boundary_edges: usize,
    /// Edges with more than two triangles.
    pub non_manifold_edges: usize,
}

impl Validation {
    /// The counts of `mesh`, of which `working` is the working surface.
    pub fn of(mesh: &Mesh, working: &Working) -> Self {
        if mesh.polygons.is_empty() {
            return Self::of_points(mesh, working);
        }
        let surface = &working.surface;
        let used = working.vertex_of_document.iter().flatten().count();
        let flat = surface.face_areas.iter().filter(|a| **a <= 0.0).count();
        let (boundary_edges, non_manifold_edges) =
            edges::odd_edges(&edges::sides(&surface.triangles));
        let components = edges::components(&surface.triangles, surface.positions.len());
        let components = components.into_iter().enumerate();
        Self {
            unused_vertices: mesh.positions.len() - used,
            welded_vertices: used - surface.positions.len(),
            degenerate_faces: working.mended.degenerate + flat,
            duplicate_faces: working.mended.duplicate,
            unplaced_faces: working.mended.unplaced,
            turned_faces: working.mended.turned,
            components: components
                .filter(|(t, first)| *t == *first as usize)
                .count(),
            boundary_edges,
            non_manifold_edges,
        }
    }

    /// The counts of a cloud or an outline: of its points alone, because the working triangles and edges are
    /// not the document's.
    fn of_points(mesh: &Mesh, working: &Working) -> Self {
        let used = working.vertex_of_document.iter().flatten().count();
        Self {
            unused_vertices: mesh.positions.len() - used,
            ..Self::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    #[test]
    fn counts_of_a_small_mess() {
        let at = |x: f64, y: f64| Point::new(x, y, 0.0);
        // Two triangles on edge 0-1, a third on it from above, one apart with a welded corner,
        // one with twice the same corner, one loose vertex.
        let mut positions = vec![at(0.0, 0.0), at(1.0, 0.0), at(0.5, 1.0), at(0.5, -1.0)];
        positions.push(Point::new(0.5, 0.0, 1.0));
        positions.extend([at(5.0, 0.0), at(6.0, 0.0), at(5.0, 1.0), at(5.0, 0.0)]);
        positions.push(at(9.0, 9.0));
        let triangles = vec![
            [0, 1, 2],
            [1, 0, 3],
            [0, 1, 4],
            [5, 6, 7],
            [8, 6, 7],
            [5, 8, 6],
        ];
        let mesh = Mesh::from_triangles(positions, triangles);
        let working = Working::new(&mesh).unwrap();
        let found = Validation::of(&mesh, &working);
        let expected = Validation {
            unused_vertices: 1,
            welded_vertices: 1,
            degenerate_faces: 1,
            duplicate_faces: 1,
            unplaced_faces: 0,
            turned_faces: 0,
            components: 2,
            boundary_edges: 9,
            non_manifold_edges: 1,
        };
        assert_eq!(found, expected);
    }
}
