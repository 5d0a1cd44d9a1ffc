//! How a surface hangs on the elements: each vertex moves as a blend of those near it.

use rayon::prelude::*;

use crate::deform::elastic::motion::Motion;
use crate::geom::Point;
use crate::shape::{ClosestPoint, Surface};

/// Prisms blended at a vertex.
const BLENDED: usize = 8;

/// For each vertex its elements with weights that sum to 1.
pub struct Binding {
    weights: Vec<Vec<(u32, f64)>>,
}

impl Binding {
    /// Binds a surface to prisms over its own faces: each vertex to its incident ones by area.
    pub fn incident(surface: &Surface) -> Self {
        let mut weights: Vec<Vec<(u32, f64)>> = vec![Vec::new(); surface.positions.len()];
        for (f, corners) in surface.triangles.iter().enumerate() {
            for &v in corners {
                let w = surface.face_areas[f].max(1e-12);
                weights[v as usize].push((f as u32, w));
            }
        }
        for list in &mut weights {
            normalize(list);
        }
        Self { weights }
    }

    /// Binds each vertex to the element of its own.
    pub fn own(surface: &Surface) -> Self {
        let count = surface.positions.len() as u32;
        Self {
            weights: (0..count).map(|v| vec![(v, 1.0)]).collect(),
        }
    }

    /// Binds `fine` to prisms over `control`: at each vertex the nearest prisms among those within
    /// two rings of the closest control face, with modified Shepard weights (1 - d^2 / R^2)^2, R
    /// the distance of the first prism left out, so that the blend is smooth as prisms come and go.
    pub fn nearest(fine: &Surface, control: &Surface) -> Self {
        let rings = two_rings(control);
        let centers: Vec<Point> = (0..control.triangles.len() as u32)
            .map(|f| {
                let [a, b, c] = control.corners(f);
                Point::from((a.coords + b.coords + c.coords) / 3.0)
            })
            .collect();
        let closest = ClosestPoint::new(control);
        let weights = (0..fine.positions.len())
            .into_par_iter()
            .map(|v| {
                let x = &fine.positions[v];
                let facing = closest.nearest_facing(x, &fine.vertex_normals[v], 0.2, 0.2);
                let hit = facing.or_else(|| closest.nearest(x, f64::INFINITY));
                let face = hit.map_or(0, |hit| hit.at.face);
                shepard(x, &rings[face as usize], &centers)
            })
            .collect();
        Self { weights }
    }

    /// The present position of vertex `v` with rest position `rest`.
    pub fn place(&self, v: usize, rest: &Point, motions: &[Motion]) -> Point {
        let x = self.weights[v]
            .iter()
            .map(|&(f, w)| motions[f as usize].apply(rest).coords * w)
            .sum::<crate::geom::Vector>();
        Point::from(x)
    }

    /// The elements that vertex `v` hangs on, with their weights.
    pub fn of(&self, v: usize) -> &[(u32, f64)] {
        &self.weights[v]
    }
}

fn shepard(x: &Point, candidates: &[u32], centers: &[Point]) -> Vec<(u32, f64)> {
    let mut near: Vec<(u32, f64)> = candidates
        .iter()
        .map(|&f| (f, (centers[f as usize] - x).norm_squared()))
        .collect();
    near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    let rim = near.get(BLENDED).or(near.last()).map_or(1.0, |l| l.1) * (1.0 + 1e-6) + 1e-12;
    near.truncate(BLENDED);
    for (_, w) in &mut near {
        *w = (1.0 - *w / rim).powi(2);
    }
    normalize(&mut near);
    near
}

fn normalize(list: &mut [(u32, f64)]) {
    let total: f64 = list.iter().map(|(_, w)| w).sum();
    for (_, w) in list {
        *w /= total;
    }
}

/// For each face the faces that share a vertex with a face that shares a vertex with it.
fn two_rings(surface: &Surface) -> Vec<Vec<u32>> {
    let mut at_vertex: Vec<Vec<u32>> = vec![Vec::new(); surface.positions.len()];
    for (f, corners) in surface.triangles.iter().enumerate() {
        for &v in corners {
            at_vertex[v as usize].push(f as u32);
        }
    }
    let grow = |faces: &[u32]| {
        let mut out: Vec<u32> = faces
            .iter()
            .flat_map(|&f| surface.triangles[f as usize])
            .flat_map(|v| at_vertex[v as usize].iter().copied())
            .collect();
        out.sort_unstable();
        out.dedup();
        out
    };
    (0..surface.triangles.len() as u32)
        .into_par_iter()
        .map(|f| grow(&grow(&[f])))
        .collect()
}
