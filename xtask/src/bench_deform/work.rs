//! What is deformed, and by what.

use std::path::{Path, PathBuf};

use rand::SeedableRng;
use rand::seq::index;
use rand_pcg::Pcg64;
use symmetrizer::Result;
use symmetrizer::deform::{DeformParams, Pull, control_mesh};
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{Mesh, Surface};

use crate::constraints;

/// The longest way of a held vertex, as a share of the bounding box's diagonal.
const LONGEST: f64 = 0.01;

/// A surface and where some of its vertices are to go.
pub struct Work {
    /// The surface, working coordinates.
    pub surface: Surface,
    /// Vertices with their targets.
    pub targets: Vec<(u32, Point)>,
    /// The same as soft constraints.
    pub pulls: Vec<Pull>,
}

impl Work {
    /// `mesh` with about `triangles` triangles, 0 for all, held at `held` vertices.
    ///
    /// # Errors
    /// A mesh that cannot be worked on.
    pub fn new(mesh: &Mesh, triangles: usize, held: usize) -> Result<Self> {
        let mut surface = Working::new(mesh)?.surface;
        if triangles > 0 {
            surface = control_mesh(&surface, triangles)?;
        }
        let targets = bent(&surface, held);
        let length = DeformParams::default().length;
        let pulls = constraints::pulls(&surface, &targets, length);
        Ok(Self {
            surface,
            targets,
            pulls,
        })
    }

    /// The work's name.
    pub fn name(&self) -> String {
        format!("bunny{}", self.surface.triangles.len())
    }

    /// Writes the mesh as OFF, and each held vertex with its target as a line of text.
    ///
    /// # Errors
    /// [`symmetrizer::Error::Io`].
    pub fn write(&self, folder: &Path) -> Result<[PathBuf; 2]> {
        constraints::write(folder, &self.name(), &self.surface, &[&self.targets])
    }
}

/// Scattered vertices under a bend about x that grows with the square of the height above the middle.
fn bent(surface: &Surface, held: usize) -> Vec<(u32, Point)> {
    let x = &surface.positions;
    let low = x
        .iter()
        .fold(x[0], |a, b| Point::from(a.coords.inf(&b.coords)));
    let high = x
        .iter()
        .fold(x[0], |a, b| Point::from(a.coords.sup(&b.coords)));
    let (middle, diagonal) = (nalgebra::center(&low, &high), (high - low).norm());
    let height = |x: &Point| {
        ((x.y - middle.y) / (high.y - middle.y))
            .clamp(0.0, 1.0)
            .powi(2)
    };
    let at = |x: &Point, angle: f64| {
        middle + exp_rotation(&Vector::new(angle * height(x), 0.0, 0.0)) * (x - middle)
    };
    let longest = |angle| {
        x.iter()
            .map(|x| (at(x, angle) - x).norm())
            .fold(0.0, f64::max)
    };
    let (mut small, mut large) = (0.0, 1.0);
    for _ in 0..50 {
        let angle = 0.5 * (small + large);
        if longest(angle) < LONGEST * diagonal {
            small = angle;
        } else {
            large = angle;
        }
    }
    let mut rng = Pcg64::seed_from_u64(7);
    let mut chosen = index::sample(&mut rng, x.len(), held.min(x.len())).into_vec();
    chosen.sort_unstable();
    chosen
        .into_iter()
        .map(|v| (v as u32, at(&x[v], small)))
        .collect()
}
