//! One vertex for the corners in one place.

use std::collections::HashMap;

use crate::geom::Point;
use crate::shape::mesh::Mesh;

/// Vertices by their coordinates, numbered as they appear.
#[derive(Default)]
pub(super) struct Welder {
    pub mesh: Mesh,
    known: HashMap<[u64; 3], u32>,
}

impl Welder {
    pub fn triangle(&mut self, corners: [Point; 3]) {
        let corners = corners.map(|p| self.vertex(p));
        self.mesh.polygons.push(&corners);
    }

    fn vertex(&mut self, p: Point) -> u32 {
        // Adding zero makes -0 into 0: they are one place.
        let key = [p.x, p.y, p.z].map(|c| (c + 0.0).to_bits());
        let positions = &mut self.mesh.positions;
        *self.known.entry(key).or_insert_with(|| {
            positions.push(p);
            (positions.len() - 1) as u32
        })
    }
}
