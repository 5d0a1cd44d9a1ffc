//! How the samples carry the vertices.

use std::iter::Sum;
use std::ops::Mul;

use rayon::prelude::*;

use crate::deform::elastic::Motion;
use crate::geom::{Matrix3, Point, PointIndex, Vector, nearest_orthogonal};
use crate::sample::Samples;
use crate::shape::Surface;

/// Samples that carry a vertex at the most.
const BLENDED: usize = 8;

/// The samples that carry each vertex: the nearest that face its way, with weights of sum 1.
pub struct Blend(Vec<Vec<(u32, f64)>>);

impl Blend {
    /// Of `samples` over the vertices of `surface`.
    pub fn new(surface: &Surface, samples: &Samples) -> Self {
        let places: Vec<[f64; 3]> = samples
            .list
            .iter()
            .map(|s| s.position.coords.into())
            .collect();
        let index = PointIndex::new(&places);
        let vertices = (0..surface.positions.len()).into_par_iter();
        Self(
            vertices
                .map(|v| {
                    let (x, n) = (&surface.positions[v], &surface.vertex_normals[v]);
                    let near = index.nearest_n(&x.coords.into(), 2 * BLENDED);
                    weights(near, |s| samples.list[s as usize].normal.dot(n) > 0.0)
                })
                .collect(),
        )
    }

    /// The samples' rotations at each vertex.
    pub fn rotations(&self, of: &[Matrix3]) -> Vec<Matrix3> {
        let at = |carriers: &Vec<(u32, f64)>| {
            let sum: Matrix3 = carriers.iter().map(|&(s, w)| w * of[s as usize]).sum();
            nearest_orthogonal(&sum, false)
        };
        self.0.par_iter().map(at).collect()
    }

    /// The mean of what the samples at each vertex have.
    pub fn means<T>(&self, of: &[T]) -> Vec<T>
    where
        T: Copy + Mul<f64, Output = T> + Sum + Send + Sync,
    {
        let at =
            |carriers: &Vec<(u32, f64)>| carriers.iter().map(|&(s, w)| of[s as usize] * w).sum();
        self.0.par_iter().map(at).collect()
    }

    /// Where the samples' motions carry each vertex of `surface`.
    pub fn positions(&self, surface: &Surface, motions: &[Motion]) -> Vec<Point> {
        let at = |(carriers, x): (&Vec<(u32, f64)>, &Point)| {
            let ends = carriers
                .iter()
                .map(|&(s, w)| w * motions[s as usize].apply(x).coords);
            Point::from(ends.sum::<Vector>())
        };
        self.0.par_iter().zip(&surface.positions).map(at).collect()
    }
}

/// Weights that fall to nothing at the last of the carriers.
fn weights(near: Vec<(u32, f64)>, faces: impl Fn(u32) -> bool) -> Vec<(u32, f64)> {
    let mut carriers: Vec<(u32, f64)> = near.iter().copied().filter(|c| faces(c.0)).collect();
    if carriers.is_empty() {
        carriers = near;
    }
    carriers.truncate(BLENDED);
    let rim = carriers.last().map_or(1.0, |c| c.1) * 1.000_001 + 1e-12;
    carriers
        .iter_mut()
        .for_each(|c| c.1 = (1.0 - c.1 / rim).powi(2));
    let sum: f64 = carriers.iter().map(|c| c.1).sum();
    carriers.iter_mut().for_each(|c| c.1 /= sum);
    carriers
}
