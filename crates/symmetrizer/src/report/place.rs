//! From working coordinates and indices to those of the document.

use crate::geom::{Point, Vector};
use crate::shape::working::Working;
use crate::transform::Isometry;

/// Rows of a homogeneous 4x4 matrix.
pub type Matrix = [[f64; 4]; 4];

/// Where a working surface lies in its document.
pub struct Place<'a>(pub &'a Working);

impl Place<'_> {
    /// The isometry in document coordinates.
    pub fn matrix(&self, t: &Isometry) -> Matrix {
        let normalization = &self.0.normalization;
        // x_d = c + L x_w on both sides.
        let c = normalization.center.coords;
        let translation = c - t.linear * c + t.translation * normalization.scale;
        std::array::from_fn(|r| {
            std::array::from_fn(|c| match (r, c) {
                (3, 3) => 1.0,
                (3, _) => 0.0,
                (_, 3) => translation[r],
                _ => t.linear[(r, c)],
            })
        })
    }

    /// A point in document coordinates.
    pub fn point(&self, x: &Point) -> [f64; 3] {
        self.0.normalization.to_document(x).coords.into()
    }

    /// A displacement in document units.
    pub fn shift(&self, v: &Vector) -> [f64; 3] {
        (v * self.0.normalization.scale).into()
    }

    /// Working triangles as the document numbers them after fan triangulation.
    pub fn faces(&self, faces: Vec<u32>) -> Vec<u32> {
        let number = |f: u32| self.0.document_face[f as usize];
        faces.into_iter().map(number).collect()
    }
}
