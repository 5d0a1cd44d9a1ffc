//! Keeping displacements of orbits balanced: by equation 1 those of a place and its copies sum to zero.
//!
//! Found closest points do not quite say so. Faces cut below a curved surface where it is convex, what lifts them
//! ([`contact`](super::contact)) is off at creases and where normals are noisy, and the confidence of contacts differs; little by
//! little, round by round, all copies alike would be drawn in. What they have in common makes none of them more alike.

use rayon::prelude::*;

use crate::geom::Vector;
use crate::shape::{Surface, SurfacePoint};

/// Averages over the faces around a vertex that what is common is smoothed by: noise of single vertices is not common to copies,
/// but looks a little like it, because it is told from faces there.
const SMOOTHINGS: usize = 2;

/// A copy of a vertex: where it was found on the surface, and its weight beside that of the vertex itself, 1.
pub type Copy = (SurfacePoint, f64);

/// The `displacements` of the vertices of `surface` without what is common to each vertex and its `copies`, along the normals.
/// How far a vertex is sure of its copies its `confidence` says, 0 to 1; one without copies keeps its displacement, but for what its
/// neighbours have in common with theirs.
pub fn balanced(
    surface: &Surface,
    displacements: &[Vector],
    copies: &[Vec<Copy>],
    confidence: &[f64],
) -> Vec<Vector> {
    let normals = &surface.vertex_normals;
    let along = displacements.iter().zip(normals).map(|(u, n)| u.dot(n));
    let along: Vec<f64> = along.collect();
    // A moderate confidence is enough: what is left of the common part adds up over the rounds.
    let sure = |v: usize| 1.0 - (1.0 - confidence[v]).powi(4);
    let of_vertex = |v: usize| sure(v) * common(surface, &along, v, &copies[v]);
    let mut common: Vec<f64> = (0..along.len()).into_par_iter().map(of_vertex).collect();
    for _ in 0..SMOOTHINGS {
        common = averaged(surface, &common);
    }
    let all = displacements.iter().zip(normals).zip(common);
    all.map(|((u, n), common)| u - n * common).collect()
}

/// The mean of a vertex and its copies of what is given `along` the normals of the vertices.
fn common(surface: &Surface, along: &[f64], v: usize, copies: &[Copy]) -> f64 {
    let (mut sum, mut weights) = (along[v], 1.0);
    for (at, weight) in copies {
        let corners = surface.triangles[at.face as usize].iter().zip(at.bary);
        sum += weight * corners.map(|(&c, b)| along[c as usize] * b).sum::<f64>();
        weights += weight;
    }
    sum / weights
}

/// For each vertex the mean of the `values` of the corners of its faces, by their areas.
fn averaged(surface: &Surface, values: &[f64]) -> Vec<f64> {
    let mut sums = vec![[0.0; 2]; values.len()];
    for (corners, area) in surface.triangles.iter().zip(&surface.face_areas) {
        let mean = corners.iter().map(|&v| values[v as usize]).sum::<f64>() / 3.0;
        for &v in corners {
            let [sum, areas] = &mut sums[v as usize];
            *sum += area * mean;
            *areas += area;
        }
    }
    let means = sums
        .iter()
        .map(|[sum, areas]| sum / areas.max(f64::MIN_POSITIVE));
    means.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    const ROWS: u32 = 9;

    /// A flat square of vertices, numbered along x first, about the plane x = 0.
    fn square() -> Surface {
        let place = |k: u32| f64::from(k) - 0.5 * f64::from(ROWS - 1);
        let vertices = (0..ROWS * ROWS).map(|v| Point::new(place(v % ROWS), place(v / ROWS), 0.0));
        let corners = (0..ROWS * ROWS).filter(|v| v % ROWS + 1 < ROWS && v / ROWS + 1 < ROWS);
        let triangles =
            corners.flat_map(|v| [[v, v + 1, v + ROWS + 1], [v, v + ROWS + 1, v + ROWS]]);
        Surface::new(vertices.collect(), triangles.collect::<Vec<_>>().into())
    }

    /// For each vertex its copy under the mirror x = 0.
    fn copies(surface: &Surface) -> Vec<Vec<Copy>> {
        let corner = |v: u32| {
            let mut faces = surface.triangles.iter().enumerate();
            let at =
                faces.find_map(|(f, corners)| Some((f, corners.iter().position(|&c| c == v)?)));
            let (face, corner) = at.expect("a vertex of a face");
            SurfacePoint {
                face: face as u32,
                bary: std::array::from_fn(|c| if c == corner { 1.0 } else { 0.0 }),
            }
        };
        let image = |v: u32| v - v % ROWS + (ROWS - 1 - v % ROWS);
        (0..ROWS * ROWS)
            .map(|v| vec![(corner(image(v)), 1.0)])
            .collect()
    }

    fn largest(a: &[Vector], b: &[Vector]) -> f64 {
        a.iter()
            .zip(b)
            .map(|(a, b)| (a - b).norm())
            .fold(0.0, f64::max)
    }

    #[test]
    fn what_draws_copies_together_stays_and_what_they_share_goes() {
        let surface = square();
        let copies = copies(&surface);
        let sure = vec![1.0; copies.len()];
        let apart = |x: &Point| Vector::new(0.02, -0.01, 0.03 * x.x);
        let apart: Vec<Vector> = surface.positions.iter().map(apart).collect();
        let shared = Vector::new(0.0, 0.0, -0.05);
        let both: Vec<Vector> = apart.iter().map(|u| u + shared).collect();
        assert!(largest(&balanced(&surface, &apart, &copies, &sure), &apart) < 1e-12);
        assert!(largest(&balanced(&surface, &both, &copies, &sure), &apart) < 1e-12);
        // Where no copies are known there is nothing to be shared.
        let none = vec![0.0; copies.len()];
        assert!(largest(&balanced(&surface, &both, &copies, &none), &both) < 1e-12);
    }
}
