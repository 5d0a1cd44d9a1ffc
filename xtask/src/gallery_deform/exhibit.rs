//! What is deformed, and by what.

use symmetrizer::geom::Point;
use symmetrizer::picture::View;
use symmetrizer::shape::{Mesh, Surface, Working};
use symmetrizer::Result;

use super::center_line::CenterLine;
use super::motion::Motion;
use crate::constraints::Target;

/// What becomes of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It stays where it is.
    Held,
    /// The deformer places it.
    Free,
    /// It takes part in the handles' motion.
    Moved,
}

/// A surface, its handles, and how it is looked at.
pub struct Exhibit {
    /// The name in file names.
    pub name: &'static str,
    /// The heading.
    pub title: &'static str,
    /// What is held and what is moved, in words.
    pub handles: &'static str,
    /// The surface at rest, working coordinates.
    pub surface: Surface,
    /// The role of each vertex.
    pub roles: Vec<Role>,
    /// How the moved vertices move.
    pub motion: Motion,
    /// From where the whole is seen.
    pub view: View,
    /// From where the free part is seen close up.
    pub close: View,
    /// What is to become straight, if anything is.
    pub line: Option<CenterLine>,
}

impl Exhibit {
    /// The bounding box's diagonal.
    pub fn diagonal(&self) -> f64 {
        let all = self.surface.positions.iter();
        let low = all.clone().fold(self.surface.positions[0], |a, b| a.inf(b));
        let high = all.fold(self.surface.positions[0], |a, b| a.sup(b));
        (high - low).norm()
    }

    /// Where held and moved vertices are to be after the share `t` of the motion.
    pub fn targets(&self, t: f64) -> Vec<Target> {
        let target = |(v, (x, role)): (u32, (&Point, &Role))| match role {
            Role::Held => Some((v, *x)),
            Role::Free => None,
            Role::Moved => Some((v, self.motion.after(t, x))),
        };
        let vertices = self.surface.positions.iter().zip(&self.roles);
        (0..).zip(vertices).filter_map(target).collect()
    }

    /// The number of vertices in a role.
    pub fn count(&self, role: Role) -> usize {
        self.roles.iter().filter(|&&r| r == role).count()
    }
}

/// The working surface of a mesh.
///
/// # Errors
/// A mesh that cannot be worked on.
pub fn surface(mesh: &Mesh) -> Result<Surface> {
    Ok(Working::new(mesh)?.surface)
}
