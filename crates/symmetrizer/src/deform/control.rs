//! The control mesh: a few thousand faces under the elements that carry a fine surface.

use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, sorted_eigen};
use crate::shape::{ClosestPoint, Surface};

/// A decimated copy of `surface` with about `faces` triangles, its vertices among the surface's
/// own; the surface itself where it has no more than that.
///
/// # Errors
/// [`Error::Numerical`] where decimation leaves nothing.
pub fn control_mesh(surface: &Surface, faces: usize) -> Result<Surface> {
    Ok(decimated(surface, faces)?.map_or_else(|| surface.clone(), |d| d.surface))
}

/// A surface of fewer faces.
pub struct Decimated {
    /// The surface.
    pub surface: Surface,
    /// Which vertex of the finer surface each of its vertices is.
    pub vertices: Vec<u32>,
}

impl Decimated {
    /// What the finer surface's vertices have at these.
    pub fn of_vertices(&self, finer: &[f64]) -> Vec<f64> {
        self.vertices.iter().map(|&v| finer[v as usize]).collect()
    }

    /// The same faces over the vertices of the finer surface where they are in `finer`.
    pub fn following(&self, finer: &Surface) -> Surface {
        let at = |&v: &u32| finer.positions[v as usize];
        self.surface
            .with_positions(self.vertices.iter().map(at).collect())
    }
}

/// [`control_mesh`]; `None` where the surface is to be its own.
///
/// # Errors
/// [`Error::Numerical`] where decimation leaves nothing.
pub fn decimated(surface: &Surface, faces: usize) -> Result<Option<Decimated>> {
    if surface.triangles.len() <= faces + faces / 2 {
        return Ok(None);
    }
    // The decimator works in single precision: in the shape's own axes it rounds alike however the
    // shape is turned.
    let axes = principal_axes(surface);
    let positions: Vec<[f32; 3]> = surface
        .positions
        .iter()
        .map(|p| (axes.transpose() * p.coords).map(|c| c as f32).into())
        .collect();
    let indices: Vec<u32> = surface.triangles.iter().flatten().copied().collect();
    let kept = meshopt::simplify_decoder(
        &indices,
        &positions,
        3 * faces,
        f32::MAX,
        meshopt::SimplifyOptions::None,
        None,
    );
    let mut map = vec![u32::MAX; surface.positions.len()];
    let mut vertices: Vec<u32> = Vec::new();
    let mut triangles = Vec::with_capacity(kept.len() / 3);
    for corner in kept.chunks_exact(3) {
        let t: [u32; 3] = std::array::from_fn(|k| {
            let v = corner[k] as usize;
            if map[v] == u32::MAX {
                map[v] = vertices.len() as u32;
                vertices.push(v as u32);
            }
            map[v]
        });
        triangles.push(t);
    }
    if triangles.is_empty() {
        return Err(Error::Numerical {
            stage: "control mesh",
            step: 0,
            what: "decimation left no faces".into(),
        });
    }
    let positions: Vec<Point> = vertices
        .iter()
        .map(|&v| surface.positions[v as usize])
        .collect();
    Ok(Some(Decimated {
        surface: Surface::new(positions, triangles.into()),
        vertices,
    }))
}

/// The stiffness of the nearest face of `surface` at each face of `control`.
pub fn stiffness_on(control: &Surface, surface: &Surface, stiffness: &[f64]) -> Vec<f64> {
    if control.triangles.len() == surface.triangles.len() {
        return stiffness.to_vec();
    }
    let closest = ClosestPoint::new(surface);
    let at = |f: u32| {
        let [a, b, c] = control.corners(f);
        let center = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let hit = closest.nearest_facing(&center, &control.face_normals[f as usize], 0.0, 1.0);
        hit.map_or(1.0, |hit| stiffness[hit.at.face as usize])
    };
    (0..control.triangles.len() as u32).map(at).collect()
}

/// The principal axes of the surface's area as orthonormal columns; their signs go by the third
/// moments, so that they turn with the shape.
fn principal_axes(surface: &Surface) -> Matrix3 {
    let weighted = || surface.positions.iter().zip(&surface.vertex_areas);
    let covariance = weighted()
        .map(|(x, a)| x.coords * x.coords.transpose() * *a)
        .sum::<Matrix3>();
    let (_, mut axes) = sorted_eigen(&covariance);
    for mut axis in axes.column_iter_mut() {
        let skew: f64 = weighted()
            .map(|(x, a)| a * axis.dot(&x.coords).powi(3))
            .sum();
        if skew < 0.0 {
            axis.neg_mut();
        }
    }
    axes
}
