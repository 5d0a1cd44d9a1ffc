//! Where elements sit on a control mesh and how far each reaches.

use rayon::prelude::*;

use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;

/// The sites of elements over a control mesh.
///
/// Site s blends in at x with (1 - d^2 / rho_s^2)^3, d its distance from x and rho_s a reach of its own: a
/// twice differentiable partition of unity, so that a surface that hangs on coarse elements shows none of
/// their edges; the weights are then balanced about x.
pub struct Sites {
    centers: Vec<Point>,
    /// rho_s.
    reach: Vec<f64>,
    /// For each control face the sites of the two rings around it.
    near: Vec<Vec<u32>>,
}

/// The disk within a site's reach has the area of this many control faces; ours. Wider ones would blur what
/// the elements do, narrower ones leave vertices to a single one.
const FACES: f64 = 12.0;
/// ... and reaches beyond the corners of the site's own faces by at least this factor.
const BEYOND: f64 = 1.2;

impl Sites {
    /// A site at the centre of each face.
    pub fn faces(control: &Surface) -> Self {
        let near = two_rings(control);
        let centers = face_centers(control);
        let reach = |(f, c): (usize, &Point)| {
            let corners = control.corners(f as u32);
            let farthest = corners.iter().map(|x| (x - c).norm()).fold(0.0, f64::max);
            around(control, &near[f]).max(BEYOND * farthest)
        };
        let reach = centers.iter().enumerate().map(reach).collect();
        Self {
            centers,
            reach,
            near,
        }
    }

    /// A site at each vertex.
    pub fn vertices(control: &Surface) -> Self {
        let faces = two_rings(control);
        let mut reach = vec![0.0_f64; control.positions.len()];
        for (f, corners) in control.triangles.iter().enumerate() {
            let usual = around(control, &faces[f]);
            for &v in corners {
                let x = control.positions[v as usize];
                let farthest = control.corners(f as u32);
                let farthest = farthest.iter().map(|y| (y - x).norm()).fold(0.0, f64::max);
                // Half way along the longest edge its ends still have their say.
                let own = usual.max(0.5 * BEYOND * farthest);
                reach[v as usize] = reach[v as usize].max(own);
            }
        }
        Self {
            centers: control.positions.clone(),
            reach,
            near: faces.par_iter().map(|f| corners(control, f)).collect(),
        }
    }

    /// The sites that reach the point `x` beside control face `face`, with their weights; the nearest where
    /// none does.
    pub fn blend(&self, x: &Point, face: u32) -> Vec<(u32, f64)> {
        let near = &self.near[face as usize];
        let left = |s: u32| {
            let d = (self.centers[s as usize] - x).norm_squared();
            1.0 - d / self.reach[s as usize].powi(2)
        };
        let within = near.iter().map(|&s| (s, left(s))).filter(|(_, l)| *l > 0.0);
        let mut blended: Vec<(u32, f64)> = within.map(|(s, l)| (s, l.powi(3))).collect();
        if blended.is_empty() {
            let nearest = near.iter().max_by(|&&a, &&b| left(a).total_cmp(&left(b)));
            return vec![(nearest.copied().unwrap_or(0), 1.0)];
        }
        balance(x, &self.centers, &mut blended);
        blended
    }
}

/// Tilts the weights by 1 + b . d, d from `x` to a site, so that their mean lies below `x`: motions that
/// vary linearly over the sites are then met exactly, stretch among them (Belytschko et al. 1994, moving
/// least squares). At a rim, where all sites lie on one side, the tilt ends where weights would turn
/// negative.
pub(super) fn balance(x: &Point, centers: &[Point], weights: &mut [(u32, f64)]) {
    let (mut first, mut second, mut reach) = (Vector::zeros(), Matrix3::zeros(), 0.0_f64);
    for &(s, w) in weights.iter() {
        let d = centers[s as usize] - x;
        first += w * d;
        second += w * d * d.transpose();
        reach = reach.max(d.norm());
    }
    // Across the surface sites hardly differ: nothing is to be balanced that way.
    second += Matrix3::identity() * (ACROSS * second.trace() + f64::MIN_POSITIVE);
    let Some(inverse) = second.try_inverse() else {
        return;
    };
    let b: Vector = -inverse * first;
    let b = b / (1.0 + (b.norm() * reach).powi(4)).powf(0.25);
    for (s, w) in weights {
        *w *= 1.0 + b.dot(&(centers[*s as usize] - x));
    }
}

/// Share of the sites' spread below which a direction counts as across the surface.
const ACROSS: f64 = 0.01;

/// The centre of each face.
pub(super) fn face_centers(surface: &Surface) -> Vec<Point> {
    let center = |f: u32| {
        let [a, b, c] = surface.corners(f);
        Point::from((a.coords + b.coords + c.coords) / 3.0)
    };
    (0..surface.triangles.len() as u32).map(center).collect()
}

/// The usual reach among these faces.
fn around(control: &Surface, faces: &[u32]) -> f64 {
    let area: f64 = faces.iter().map(|&f| control.face_areas[f as usize]).sum();
    (FACES * area / faces.len().max(1) as f64 / std::f64::consts::PI).sqrt()
}

/// For each face the faces that share a vertex with a face that shares a vertex with it.
fn two_rings(surface: &Surface) -> Vec<Vec<u32>> {
    let mut at_vertex: Vec<Vec<u32>> = vec![Vec::new(); surface.positions.len()];
    for (f, corners) in surface.triangles.iter().enumerate() {
        for &v in corners {
            at_vertex[v as usize].push(f as u32);
        }
    }
    let faces_at = |vertices: &[u32]| -> Vec<u32> {
        let faces = vertices.iter().flat_map(|&v| &at_vertex[v as usize]);
        unique(faces.copied())
    };
    (0..surface.triangles.len())
        .into_par_iter()
        .map(|f| {
            let ring = faces_at(&surface.triangles[f]);
            faces_at(&corners(surface, &ring))
        })
        .collect()
}

/// The corners of these faces.
fn corners(surface: &Surface, faces: &[u32]) -> Vec<u32> {
    unique(faces.iter().flat_map(|&f| surface.triangles[f as usize]))
}

fn unique(of: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut list: Vec<u32> = of.collect();
    list.sort_unstable();
    list.dedup();
    list
}
