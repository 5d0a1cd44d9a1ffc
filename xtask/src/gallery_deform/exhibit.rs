//! What is deformed, and by what.

use symmetrizer::Result;
use symmetrizer::geom::Point;
use symmetrizer::picture::View;
use symmetrizer::shape::{Mesh, Surface, Working};

use super::center_line::CenterLine;
use super::motion::Motion;
use crate::constraints::Target;

/// The handles' motion is made in so many parts, so that no step has to turn anything by much.
pub const PARTS: usize = 9;

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
    /// What to look at.
    pub look: &'static str,
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

    /// Where held and moved vertices are to be in the end.
    pub fn targets(&self) -> Vec<Target> {
        self.part(PARTS)
    }

    /// Where they are to be after so many of the [`PARTS`] of the motion.
    pub fn part(&self, part: usize) -> Vec<Target> {
        let t = part as f64 / PARTS as f64;
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

/// The surface of a mesh in working coordinates, its vertices as they are: programs that take manifolds only need
/// those apart that lie in one place.
///
/// # Errors
/// A mesh that cannot be worked on.
pub fn surface(mesh: &Mesh) -> Result<Surface> {
    let to_working = Working::new(mesh)?.normalization;
    let positions = mesh.positions.iter().map(|p| to_working.to_working(p));
    let triangles = mesh.triangles().map(|(corners, _)| corners).collect();
    Ok(Surface::new(positions.collect(), triangles))
}
