//! What is deformed, and by what.

use std::fmt::Write as _;
use std::path::Path;

use rand::SeedableRng;
use rand::seq::index;
use rand_pcg::Pcg64;
use symmetrizer::deform::{DeformParams, Pull, control_mesh};
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{Mesh, Surface, SurfacePoint};
use symmetrizer::{Error, Result};

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
        let pulls = pulls(&surface, &targets);
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
    /// [`Error::Io`].
    pub fn write(&self, folder: &Path) -> Result<[std::path::PathBuf; 2]> {
        let s = &self.surface;
        let mut off = format!("OFF\n{} {} 0\n", s.positions.len(), s.triangles.len());
        for x in &s.positions {
            let _ = writeln!(off, "{} {} {}", x.x, x.y, x.z);
        }
        for [a, b, c] in s.triangles.iter() {
            let _ = writeln!(off, "3 {a} {b} {c}");
        }
        let mut lines = format!("{}\n", self.targets.len());
        for (v, x) in &self.targets {
            let _ = writeln!(lines, "{v} {} {} {}", x.x, x.y, x.z);
        }
        let paths = ["off", "txt"].map(|e| folder.join(self.name()).with_extension(e));
        std::fs::create_dir_all(folder).map_err(|e| Error::io(folder, e))?;
        for (path, text) in paths.iter().zip([off, lines]) {
            std::fs::write(path, text).map_err(|e| Error::io(path, e))?;
        }
        Ok(paths)
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

/// Each target as a soft constraint with the weight of its share of the surface.
fn pulls(surface: &Surface, targets: &[(u32, Point)]) -> Vec<Pull> {
    let mut corner = vec![None; surface.positions.len()];
    for (face, corners) in (0..).zip(surface.triangles.iter()) {
        for (k, &v) in corners.iter().enumerate() {
            corner[v as usize].get_or_insert((face, k));
        }
    }
    let length = DeformParams::default().length;
    let weight = surface.area() / targets.len() as f64 / (length * length);
    targets
        .iter()
        .filter_map(|&(v, target)| {
            let (face, k) = corner[v as usize]?;
            let bary = std::array::from_fn(|i| f64::from(u8::from(i == k)));
            let at = SurfacePoint { face, bary };
            Some(Pull { at, target, weight })
        })
        .collect()
}
