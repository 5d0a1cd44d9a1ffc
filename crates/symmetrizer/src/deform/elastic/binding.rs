//! How a surface hangs on the elements: each vertex moves as a blend of those near it.

use rayon::prelude::*;

use crate::deform::elastic::motion::Motion;
use crate::deform::elastic::sites::{Sites, balance, face_centers};
use crate::geom::{Point, Vector};
use crate::shape::{ClosestPoint, Surface};

/// For each vertex its elements with weights that sum to 1.
pub struct Binding {
    /// The elements of vertex v lie at `starts[v]..starts[v + 1]` of `shares`.
    starts: Vec<usize>,
    shares: Vec<(u32, f64)>,
}

/// A vertex of a fine surface belongs to the control face that is closest among those that face its way to
/// within this cosine, at most so far away (fraction of L): a finger does not hang on the next one.
const FACING: (f64, f64) = (0.2, 0.2);

impl Binding {
    /// Binds a surface to prisms over its own faces: each vertex to its incident ones, the nearer their
    /// centres the more, balanced. By area alone, uneven triangles would tear at the lengths of edges
    /// (99 % of a bent bar's stretched by up to .41 instead of .31).
    pub fn incident(surface: &Surface) -> Self {
        let centers = face_centers(surface);
        let mut weights: Vec<Vec<(u32, f64)>> = vec![Vec::new(); surface.positions.len()];
        for (f, corners) in surface.triangles.iter().enumerate() {
            for &v in corners {
                let away = (centers[f] - surface.positions[v as usize]).norm_squared();
                weights[v as usize].push((f as u32, 1.0 / away.max(1e-18)));
            }
        }
        for (x, list) in surface.positions.iter().zip(&mut weights) {
            balance(x, &centers, list);
        }
        Self::of_lists(weights)
    }

    /// Binds each vertex to the element of its own.
    pub fn own(surface: &Surface) -> Self {
        let count = surface.positions.len() as u32;
        Self::of_lists((0..count).map(|v| vec![(v, 1.0)]).collect())
    }

    /// Binds `fine` to elements over `control`: each vertex to the sites that reach it.
    pub fn within_reach(fine: &Surface, control: &Surface, sites: &Sites) -> Self {
        let closest = ClosestPoint::new(control);
        let (min_cos, far) = FACING;
        let weights = (0..fine.positions.len())
            .into_par_iter()
            .map(|v| {
                let x = &fine.positions[v];
                let facing = closest.nearest_facing(x, &fine.vertex_normals[v], min_cos, far);
                let hit = facing.or_else(|| closest.nearest(x, f64::INFINITY));
                sites.blend(x, hit.map_or(0, |hit| hit.at.face))
            })
            .collect();
        Self::of_lists(weights)
    }

    fn of_lists(lists: Vec<Vec<(u32, f64)>>) -> Self {
        let mut starts = Vec::with_capacity(lists.len() + 1);
        let mut shares = Vec::with_capacity(lists.iter().map(Vec::len).sum());
        starts.push(0);
        for list in lists {
            let total: f64 = list.iter().map(|(_, w)| w).sum();
            shares.extend(list.iter().map(|&(e, w)| (e, w / total)));
            starts.push(shares.len());
        }
        Self { starts, shares }
    }

    /// The present position of vertex `v` with rest position `rest`.
    pub fn place(&self, v: usize, rest: &Point, motions: &[Motion]) -> Point {
        let carried = |&(e, w): &(u32, f64)| motions[e as usize].apply(rest).coords * w;
        Point::from(self.of(v).iter().map(carried).sum::<Vector>())
    }

    /// The present positions of all vertices with these rest positions.
    pub fn places(&self, rest: &[Point], motions: &[Motion]) -> Vec<Point> {
        rest.par_iter()
            .enumerate()
            .map(|(v, x)| self.place(v, x, motions))
            .collect()
    }

    /// The elements that vertex `v` hangs on, with their weights.
    pub fn of(&self, v: usize) -> &[(u32, f64)] {
        &self.shares[self.starts[v]..self.starts[v + 1]]
    }
}
