//! The document: a mesh with everything else its file holds, so that what came in comes out.
//!
//! The stages see the [`Mesh`] only. [`Layer`]s are values per vertex, corner or face that several
//! formats know; [`Kept`] is what belongs to one format alone and is written to that format again.

mod fold;
mod follow;
mod kept;
mod layer;
mod names;
mod numbers;

pub use kept::{
    GltfKept, Kept, ObjKept, PlyElement, PlyForm, PlyKept, PlyProperty, PlyRemark, StlKept,
    ThreeMfBlock, ThreeMfKept,
};
pub use layer::{Layer, MorphPart, NO_ROW, On, Role, Values};
pub use names::NameList;
pub use numbers::{Kind, Numbers};

use crate::geom::Vector;
use crate::shape::mesh::Mesh;

/// A mesh and what its file says about it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Document {
    /// Vertices and polygons in file order.
    pub mesh: Mesh,
    /// Values per vertex, corner or face, in file order.
    pub layers: Vec<Layer>,
    /// What only the file's own format can hold.
    pub kept: Kept,
}

impl From<Mesh> for Document {
    fn from(mesh: Mesh) -> Self {
        Self {
            mesh,
            ..Self::default()
        }
    }
}

impl Document {
    /// The first layer of a role.
    pub fn layer(&self, on: On, role: Role) -> Option<&Layer> {
        self.layers.iter().find(|l| l.on == on && l.role == role)
    }

    /// The normals of the vertices, as the file has them; none unless every vertex has one.
    pub fn vertex_normals(&self) -> Option<Vec<Vector>> {
        let values = &self.layer(On::Vertex, Role::Normal)?.values;
        let normal = |v: usize| {
            let component = |k: usize| values.get(v, k);
            Some(Vector::new(component(0)?, component(1)?, component(2)?))
        };
        (0..self.mesh.positions.len()).map(normal).collect()
    }
}
