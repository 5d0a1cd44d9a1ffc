//! Triangle surfaces and the points on them.

use std::sync::Arc;

use crate::geom::{Point, Vector};

/// A point on a surface: a triangle and barycentric coordinates (sum 1) of its three corners.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SurfacePoint {
    /// Index of the triangle.
    pub face: u32,
    /// Weights of the triangle's corners.
    pub bary: [f64; 3],
}

/// A triangle surface with its areas and normals; deformed copies share the triangles.
#[derive(Debug, Clone)]
pub struct Surface {
    /// Vertex positions, working coordinates (L = 1).
    pub positions: Vec<Point>,
    /// Corners of each triangle; none is degenerate by index.
    pub triangles: Arc<[[u32; 3]]>,
    /// Area of each triangle.
    pub face_areas: Vec<f64>,
    /// Unit normal of each triangle, right-handed; zero for a triangle without area.
    pub face_normals: Vec<Vector>,
    /// Unit area-weighted normal of each vertex; zero where the incident areas cancel.
    pub vertex_normals: Vec<Vector>,
    /// A third of the area of the incident triangles.
    pub vertex_areas: Vec<f64>,
}

impl Surface {
    /// The surface of `triangles` over `positions`, with areas and normals computed.
    pub fn new(positions: Vec<Point>, triangles: Arc<[[u32; 3]]>) -> Self {
        let mut face_areas = Vec::with_capacity(triangles.len());
        let mut face_normals = Vec::with_capacity(triangles.len());
        let mut vertex_normals = vec![Vector::zeros(); positions.len()];
        let mut vertex_areas = vec![0.0; positions.len()];
        for corners in triangles.iter() {
            let [a, b, c] = corners.map(|v| positions[v as usize]);
            let doubled = (b - a).cross(&(c - a));
            let area = 0.5 * doubled.norm();
            face_areas.push(area);
            face_normals.push(unit_or_zero(doubled));
            for &v in corners {
                vertex_normals[v as usize] += doubled;
                vertex_areas[v as usize] += area / 3.0;
            }
        }
        for n in &mut vertex_normals {
            *n = unit_or_zero(*n);
        }
        Self {
            positions,
            triangles,
            face_areas,
            face_normals,
            vertex_normals,
            vertex_areas,
        }
    }

    /// The same triangles over other positions.
    pub fn with_positions(&self, positions: Vec<Point>) -> Self {
        debug_assert_eq!(positions.len(), self.positions.len());
        Self::new(positions, Arc::clone(&self.triangles))
    }

    /// The area-weighted mean of its vertices.
    pub fn centroid(&self) -> Point {
        let weighted = self.positions.iter().zip(&self.vertex_areas);
        let sum: Vector = weighted.map(|(x, a)| x.coords * *a).sum();
        Point::from(sum / self.area())
    }

    /// For each vertex whether the normals of all faces at it lean from its own by no more than the angle of this cosine.
    pub fn smooth_vertices(&self, min_cos: f64) -> Vec<bool> {
        let mut smooth = vec![true; self.positions.len()];
        for (corners, face) in self.triangles.iter().zip(&self.face_normals) {
            for &v in corners {
                smooth[v as usize] &= self.vertex_normals[v as usize].dot(face) >= min_cos;
            }
        }
        smooth
    }

    /// Corner positions of triangle `face`.
    pub fn corners(&self, face: u32) -> [Point; 3] {
        self.triangles[face as usize].map(|v| self.positions[v as usize])
    }

    /// Where a surface point lies.
    pub fn point(&self, at: &SurfacePoint) -> Point {
        let [a, b, c] = self.corners(at.face);
        let [u, v, w] = at.bary;
        Point::from(a.coords * u + b.coords * v + c.coords * w)
    }

    /// The interpolated unit vertex normal at a surface point; the triangle's own where the
    /// interpolation cancels.
    pub fn normal(&self, at: &SurfacePoint) -> Vector {
        let n = self.triangles[at.face as usize]
            .iter()
            .zip(at.bary)
            .map(|(&v, b)| self.vertex_normals[v as usize] * b)
            .sum::<Vector>();
        if n.norm() > 1e-9 {
            n.normalize()
        } else {
            self.face_normals[at.face as usize]
        }
    }

    /// The total area, in units of L^2.
    pub fn area(&self) -> f64 {
        self.face_areas.iter().sum()
    }

    /// The sides of all triangles, each as vertices in increasing order, sorted: an inner edge stands
    /// twice, a boundary edge once.
    pub fn sides(&self) -> Vec<[u32; 2]> {
        let mut sides: Vec<[u32; 2]> = self
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[u, v]| [u.min(v), u.max(v)])
            .collect();
        sides.sort_unstable();
        sides
    }

    /// One of the faces at each vertex, where it has any.
    pub fn faces_at_vertices(&self) -> Vec<Option<u32>> {
        let mut at = vec![None; self.positions.len()];
        for (face, corners) in (0..).zip(self.triangles.iter()) {
            corners.iter().for_each(|&v| at[v as usize] = Some(face));
        }
        at
    }

    /// For each vertex those next to it.
    pub fn next_to_vertices(&self) -> Vec<Vec<u32>> {
        let mut next = vec![Vec::new(); self.positions.len()];
        for [u, v] in self.edges() {
            next[u as usize].push(v);
            next[v as usize].push(u);
        }
        next
    }

    /// Every edge once, as vertices in increasing order, sorted.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut edges = self.sides();
        edges.dedup();
        edges
    }

    /// Median length of the triangles' sides (inner edges count twice), in units of L: that of the
    /// detail, however large the triangles of a plain beside it are.
    pub fn median_edge(&self) -> f64 {
        let mut sides: Vec<f64> = (0..self.triangles.len() as u32)
            .flat_map(|f| {
                let [a, b, c] = self.corners(f);
                [(b - a).norm(), (c - b).norm(), (a - c).norm()]
            })
            .collect();
        let middle = sides.len() / 2;
        if sides.is_empty() {
            return 0.0;
        }
        *sides.select_nth_unstable_by(middle, f64::total_cmp).1
    }

    /// Mean edge length over the triangles' sides (inner edges count twice), in units of L.
    pub fn mean_edge(&self) -> f64 {
        let total: f64 = (0..self.triangles.len() as u32)
            .map(|f| {
                let [a, b, c] = self.corners(f);
                (b - a).norm() + (c - b).norm() + (a - c).norm()
            })
            .sum();
        total / (3 * self.triangles.len()).max(1) as f64
    }
}

fn unit_or_zero(v: Vector) -> Vector {
    let norm = v.norm();
    if norm > 0.0 { v / norm } else { v }
}
