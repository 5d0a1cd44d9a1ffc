//! The working surface: triangles in normalised coordinates, with the map back to the document.
//!
//! Every stage runs here. The area centroid is the origin and the rotation-invariant scale
//! L = 4 x area-weighted rms radius is 1, so that all lengths inside are fractions of L and nothing
//! depends on the units, the place or the bounding box of the file.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::shape::mesh::Mesh;

/// A point on a surface: a triangle and barycentric coordinates (sum 1) of its three corners.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct SurfacePoint {
    /// Index of the triangle.
    pub face: u32,
    /// Weights of the triangle's corners.
    pub bary: [f64; 3],
}

/// The similarity between document coordinates and working coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Normalization {
    /// Area centroid in document coordinates.
    pub center: Point,
    /// The scale L in document units.
    pub scale: f64,
}

impl Normalization {
    /// Document -> working coordinates.
    pub fn to_working(&self, p: &Point) -> Point {
        Point::from((p - self.center) / self.scale)
    }

    /// Working -> document coordinates.
    pub fn to_document(&self, p: &Point) -> Point {
        self.center + p.coords * self.scale
    }
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

/// A surface to work on and its relation to the document it came from.
#[derive(Debug, Clone)]
pub struct Working {
    /// The rest surface: vertices in equal places welded, unused ones and degenerate faces left out.
    pub surface: Surface,
    /// The similarity to document coordinates.
    pub normalization: Normalization,
    /// The working vertex of each document vertex; `None` for vertices that no face uses.
    pub vertex_of_document: Vec<Option<u32>>,
    /// The document's polygon of each working triangle.
    pub polygon_of_face: Vec<u32>,
    /// The index, after fan triangulation of the document, of each working triangle.
    pub document_face: Vec<u32>,
}

impl Working {
    /// The working surface of a document mesh.
    ///
    /// # Errors
    /// [`Error::Input`] where [`Mesh::check`] fails or the surface has no area.
    pub fn new(mesh: &Mesh) -> Result<Self> {
        mesh.check()?;
        let (vertex_of_document, welded) = weld(mesh);
        let mut triangles = Vec::new();
        let mut polygon_of_face = Vec::new();
        let mut document_face = Vec::new();
        for (index, (corners, polygon)) in mesh.triangles().enumerate() {
            let [a, b, c] =
                corners.map(|v| vertex_of_document[v as usize].expect("used vertices are kept"));
            if a != b && b != c && c != a {
                triangles.push([a, b, c]);
                polygon_of_face.push(polygon);
                document_face.push(index as u32);
            }
        }
        let normalization = normalize(&welded, &triangles)?;
        let positions = welded.iter().map(|p| normalization.to_working(p)).collect();
        Ok(Self {
            surface: Surface::new(positions, triangles.into()),
            normalization,
            vertex_of_document,
            polygon_of_face,
            document_face,
        })
    }

    /// The document with its vertices moved as the working vertices were; a vertex that did not
    /// move, or that no face uses, keeps its coordinates to the last bit.
    pub fn moved_document(&self, mesh: &Mesh, positions: &[Point]) -> Mesh {
        let mut moved = mesh.clone();
        for (p, &v) in moved.positions.iter_mut().zip(&self.vertex_of_document) {
            if let Some(v) = v {
                let moved = positions[v as usize] - self.surface.positions[v as usize];
                // Adding zero would turn -0 into 0.
                if moved != Vector::zeros() {
                    *p += moved * self.normalization.scale;
                }
            }
        }
        moved
    }
}

/// Merges used vertices whose coordinates are equal; numbers them in file order.
fn weld(mesh: &Mesh) -> (Vec<Option<u32>>, Vec<Point>) {
    let mut used = vec![false; mesh.positions.len()];
    for &v in mesh.polygons.iter().flatten() {
        used[v as usize] = true;
    }
    let mut order: Vec<u32> = (0..mesh.positions.len() as u32)
        .filter(|&v| used[v as usize])
        .collect();
    // Adding 0.0 makes -0.0 and 0.0 one place.
    let key = |v: u32| mesh.positions[v as usize].coords.map(|c| c + 0.0);
    let compare = |a: &u32, b: &u32| {
        let (p, q) = (key(*a), key(*b));
        (p.x.total_cmp(&q.x))
            .then(p.y.total_cmp(&q.y))
            .then(p.z.total_cmp(&q.z))
    };
    order.sort_by(|a, b| compare(a, b).then(a.cmp(b)));
    let mut first_at_place = vec![u32::MAX; mesh.positions.len()];
    let mut leader = None;
    for &v in &order {
        if leader.is_none_or(|l| compare(&l, &v).is_ne()) {
            leader = Some(v);
        }
        first_at_place[v as usize] = leader.unwrap_or(v);
    }
    let mut map = vec![None; mesh.positions.len()];
    let mut welded = Vec::new();
    for v in 0..mesh.positions.len() {
        if !used[v] {
            continue;
        }
        let l = first_at_place[v] as usize;
        if map[l].is_none() {
            map[l] = Some(welded.len() as u32);
            welded.push(mesh.positions[l]);
        }
        map[v] = map[l];
    }
    (map, welded)
}

/// Area centroid and L = 4 x area-weighted rms radius, both exact integrals over the triangles.
fn normalize(positions: &[Point], triangles: &[[u32; 3]]) -> Result<Normalization> {
    let no_area = || {
        Error::input(
            "the faces have no area",
            "all of them are degenerate: check the file's coordinates",
        )
    };
    // A first origin near the shape keeps far-away coordinates from cancelling.
    let origin = positions.first().copied().ok_or_else(no_area)?;
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize] - origin);
    let area = |[a, b, c]: &[Vector; 3]| 0.5 * (b - a).cross(&(c - a)).norm();
    let mut total = 0.0;
    let mut moment = Vector::zeros();
    for t in triangles {
        let x = corners(t);
        let w = area(&x);
        total += w;
        moment += (x[0] + x[1] + x[2]) * (w / 3.0);
    }
    if !(total > 0.0 && total.is_finite()) {
        return Err(no_area());
    }
    let mean = moment / total;
    let mut second = 0.0;
    for t in triangles {
        let x = corners(t).map(|v| v - mean);
        // Exact integral of |x|^2 over a triangle: (|a|^2 + |b|^2 + |c|^2 + |a+b+c|^2) / 12.
        let sum: f64 = x.iter().map(|v| v.norm_squared()).sum();
        second += area(&x) * (sum + (x[0] + x[1] + x[2]).norm_squared()) / 12.0;
    }
    let scale = 4.0 * (second / total).sqrt();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(no_area());
    }
    Ok(Normalization {
        center: origin + mean,
        scale,
    })
}

fn unit_or_zero(v: Vector) -> Vector {
    let norm = v.norm();
    if norm > 0.0 { v / norm } else { v }
}
