//! Normals that keep creases: interpolated among the triangles that meet smoothly.

use rayon::prelude::*;

use crate::geom::Vector;
use crate::shape::surface::{Surface, SurfacePoint};

/// Triangles meet smoothly whose normals differ by less than acos of this, 40 degrees; ours.
const SMOOTH: f64 = 0.766;

/// The normal of each triangle's corners, the mean over the smooth neighbourhood, weighted by the
/// angle at the vertex (Thuermer and Wuethrich 1998): on a turned part it points away from the axis
/// however the faces are cut into triangles.
pub struct Corners(Vec<[Vector; 3]>);

impl Corners {
    /// Those of `surface`.
    pub fn new(surface: &Surface) -> Self {
        let mut around = vec![Vec::new(); surface.positions.len()];
        for (f, corners) in surface.triangles.iter().enumerate() {
            for (k, &v) in corners.iter().enumerate() {
                around[v as usize].push((f as u32, angle(surface, f as u32, k)));
            }
        }
        let corner = |f: usize, v: u32| {
            let own = surface.face_normals[f];
            around[v as usize]
                .iter()
                .map(|&(g, angle)| (surface.face_normals[g as usize], angle))
                .filter(|(n, _)| n.dot(&own) > SMOOTH)
                .map(|(n, angle)| n * angle)
                .sum::<Vector>()
        };
        Self(
            (0..surface.triangles.len())
                .into_par_iter()
                .map(|f| surface.triangles[f].map(|v| corner(f, v)))
                .collect(),
        )
    }

    /// The unit normal at a surface point; that of its triangle where nothing can be interpolated.
    pub fn normal(&self, surface: &Surface, at: &SurfacePoint) -> Vector {
        let n: Vector = self.0[at.face as usize]
            .iter()
            .zip(at.bary)
            .map(|(n, b)| n.try_normalize(1e-12).unwrap_or_default() * b)
            .sum();
        n.try_normalize(1e-9)
            .unwrap_or(surface.face_normals[at.face as usize])
    }
}

/// The angle of triangle `f` at its corner `k`, radians.
fn angle(surface: &Surface, f: u32, k: usize) -> f64 {
    let x = surface.corners(f);
    let (a, b) = (x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]);
    a.cross(&b).norm().atan2(a.dot(&b))
}
