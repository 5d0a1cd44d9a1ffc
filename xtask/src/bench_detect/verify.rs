//! Whether a find that no truth knows of holds all the same.

use symmetrizer::sample::uniform::uniform;
use symmetrizer::shape::{ClosestPoint, Surface};
use symmetrizer::{Context, Mesh};

use super::found::Symmetry;
use super::truth::Shape;

/// Residual up to which a find holds, fraction of D.
const RESIDUAL: f64 = 0.005;

/// Patch and image must be at least this share of the area.
const AREA: f64 = 0.02;

/// A find must move its patch by at least this much, rms over D: what moves nothing holds always.
const MOVED: f64 = 0.01;

/// Samples of a patch.
const SAMPLES: usize = 2000;

/// Checks finds against the shape itself, in the coordinates of its file.
pub struct Verifier<'a> {
    mesh: &'a Mesh,
    triangles: Vec<[u32; 3]>,
    closest: ClosestPoint,
    area: f64,
    diagonal: f64,
}

/// How well a find holds.
#[derive(Debug, Clone, Copy)]
pub struct Check {
    /// rms distance of the moved patch from the surface, fraction of D.
    pub residual: f64,
    /// rms way of the patch, fraction of D.
    pub moved: f64,
    /// Patch and image, as a share of the area.
    pub area: f64,
}

impl<'a> Verifier<'a> {
    /// A verifier of finds in `shape`.
    pub fn new(shape: &'a Shape) -> Self {
        let triangles: Vec<[u32; 3]> = shape.mesh.triangles().map(|(t, _)| t).collect();
        let surface = Surface::new(shape.mesh.positions.clone(), triangles.clone().into());
        Self {
            mesh: &shape.mesh,
            triangles,
            closest: ClosestPoint::new(&surface),
            area: surface.area(),
            diagonal: shape.diagonal,
        }
    }

    /// How well `find` holds; none where its patch has no area.
    pub fn check(&self, find: &Symmetry) -> Option<Check> {
        let patch = self.part(&find.patch_faces);
        let samples = uniform(&patch, SAMPLES, &mut Context::new(0).rng("verify"));
        let (mut residual, mut moved) = (0.0, 0.0);
        for at in &samples {
            let x = patch.point(at);
            let y = find.motion.apply(&x);
            let gap = self.closest.nearest(&y, f64::MAX)?.distance;
            residual += gap * gap;
            moved += (y - x).norm_squared();
        }
        let rms = |sum: f64| (sum / samples.len() as f64).sqrt() / self.diagonal;
        let mut both = [find.patch_faces.as_slice(), &find.image_faces].concat();
        both.sort_unstable();
        both.dedup();
        (!samples.is_empty()).then(|| Check {
            residual: rms(residual),
            moved: rms(moved),
            area: self.part(&both).area() / self.area,
        })
    }

    fn part(&self, faces: &[u32]) -> Surface {
        let known = faces.iter().filter_map(|&f| self.triangles.get(f as usize));
        let triangles: Vec<[u32; 3]> = known.copied().collect();
        Surface::new(self.mesh.positions.clone(), triangles.into())
    }
}

impl Check {
    /// Whether the find holds.
    pub fn holds(&self) -> bool {
        self.residual <= RESIDUAL && self.area >= AREA && self.moved >= MOVED
    }
}
