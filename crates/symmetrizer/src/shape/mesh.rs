//! The document mesh: vertices and polygons in the file's order, nothing merged or dropped.

use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::triangulate::triangulate;

/// Polygons as one list of corners, `starts[f]..starts[f + 1]` for polygon f.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Polygons {
    starts: Vec<u32>,
    corners: Vec<u32>,
}

impl Default for Polygons {
    fn default() -> Self {
        Self {
            starts: vec![0],
            corners: Vec::new(),
        }
    }
}

impl Polygons {
    /// Polygons of which the corners of number f are `starts[f]..starts[f + 1]` of `corners`;
    /// `starts` begins with 0, never falls and ends with the number of corners.
    pub(crate) fn from_lists(starts: Vec<u32>, corners: Vec<u32>) -> Self {
        debug_assert!(starts.first() == Some(&0) && starts.is_sorted());
        debug_assert!(
            starts
                .last()
                .is_some_and(|&end| end as usize == corners.len())
        );
        Self { starts, corners }
    }

    /// Appends a polygon.
    pub fn push(&mut self, polygon: &[u32]) {
        self.corners.extend_from_slice(polygon);
        self.starts.push(self.corners.len() as u32);
    }

    /// The number of polygons.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertices of polygon `f`.
    pub fn get(&self, f: usize) -> &[u32] {
        &self.corners[self.starts[f] as usize..self.starts[f + 1] as usize]
    }

    /// All polygons in order.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        (0..self.len()).map(|f| self.get(f))
    }
}

impl FromIterator<[u32; 3]> for Polygons {
    fn from_iter<I: IntoIterator<Item = [u32; 3]>>(triangles: I) -> Self {
        let mut polygons = Self::default();
        for t in triangles {
            polygons.push(&t);
        }
        polygons
    }
}

/// A polygon mesh as its file has it: vertex and face order kept, loose vertices kept.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Vertex positions in model units, in file order.
    pub positions: Vec<Point>,
    /// The faces in file order; corners are 0-based vertex indices.
    pub polygons: Polygons,
}

impl Mesh {
    /// A mesh of triangles.
    pub fn from_triangles(positions: Vec<Point>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            positions,
            polygons: triangles.into_iter().collect(),
        }
    }

    /// Fails where the mesh cannot be worked on: empty, no faces, an index out of range, a face
    /// with fewer than three corners. Names the first such place.
    pub fn check(&self) -> Result<()> {
        if self.positions.is_empty() {
            return Err(Error::input(
                "the mesh has no vertices",
                "is this the right file?",
            ));
        }
        if self.polygons.is_empty() {
            return Err(Error::input(
                format!(
                    "the mesh has {} vertices but no faces",
                    self.positions.len()
                ),
                "symmetries of a point cloud can be detected only; for anything else, mesh it first",
            ));
        }
        self.check_corners()
    }

    /// Fails where a face has fewer than three corners or names a vertex that is not there. Names
    /// the first such face.
    pub fn check_corners(&self) -> Result<()> {
        let n = self.positions.len();
        for (f, polygon) in self.polygons.iter().enumerate() {
            if polygon.len() < 3 {
                return Err(Error::input(
                    format!("face {f} (counted from 0) has {} corners", polygon.len()),
                    "a face needs at least three",
                ));
            }
            if let Some(&v) = polygon.iter().find(|&&v| v as usize >= n) {
                return Err(Error::input(
                    format!(
                        "face {f} (counted from 0) names vertex {v}, but there are only {n} vertices"
                    ),
                    "the file is truncated or its face list is damaged",
                ));
            }
        }
        Ok(())
    }

    /// The triangles of all polygons, each with the index of its polygon: n - 2 for n corners (see
    /// [`triangulate()`]).
    pub fn triangles(&self) -> impl Iterator<Item = ([u32; 3], u32)> {
        (0..)
            .zip(self.polygons.iter())
            .flat_map(|(f, polygon): (u32, &[u32])| {
                let (first, rest) = match polygon.len() {
                    3 => (Some([0, 1, 2]), Vec::new()),
                    _ => (None, self.cut(f as usize)),
                };
                let triangles = first.into_iter().chain(rest);
                triangles.map(move |t| (t.map(|k| polygon[k as usize]), f))
            })
    }

    /// The triangles of polygon `f` by its corners, counted from its first.
    pub fn cut(&self, f: usize) -> Vec<[u32; 3]> {
        let corners = self.polygons.get(f).iter();
        let corners: Vec<Point> = corners.map(|&v| self.positions[v as usize]).collect();
        triangulate(&corners)
    }

    /// The bounding-box diagonal D of the finite vertices that faces use, or of all finite ones where there
    /// are no faces, model units; for reporting only, because it changes when the shape is rotated.
    pub fn diagonal(&self) -> f64 {
        let mut low = Point::from([f64::INFINITY; 3]);
        let mut high = Point::from([f64::NEG_INFINITY; 3]);
        let mut extend = |p: &Point| {
            if is_finite(p) {
                low = low.inf(p);
                high = high.sup(p);
            }
        };
        if self.polygons.is_empty() {
            self.positions.iter().for_each(&mut extend);
        }
        let used = self.polygons.iter().flatten();
        used.filter_map(|&v| self.positions.get(v as usize))
            .for_each(&mut extend);
        if low.x > high.x {
            0.0
        } else {
            (high - low).norm()
        }
    }
}

/// Whether all three coordinates are finite.
pub fn is_finite(p: &Point) -> bool {
    p.iter().all(|c| c.is_finite())
}
