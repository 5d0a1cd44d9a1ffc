//! Smooth displacement fields on a surface: a screened Laplace system, factorised once.
//!
//! min sum_v A_v c_v |u_v - t_v|^2 + lambda^2 sum_edges k_e |u_i - u_j|^2 with cotangent weights k_e,
//! clamped to stay positive on bad triangles.

use rayon::prelude::*;

use crate::deform::laplacian::edge_weights;
use crate::deform::solver::{Cholesky, SolveError};
use crate::geom::Vector;
use crate::shape::Surface;

/// The system of one surface; only lambda and the confidences c_v change between solves.
pub struct SmoothField {
    cholesky: Cholesky,
    /// The Laplacian's values with a zero screening term.
    laplacian: Vec<f64>,
    /// Index of each vertex's diagonal value.
    diagonal: Vec<usize>,
    areas: Vec<f64>,
}

/// Share of the screening that every vertex keeps towards "no displacement of its own": parts without
/// any target must not float.
const FLOOR: f64 = 1e-6;

impl SmoothField {
    /// The system of `surface`, its edges as much stiffer as the faces beside them where `stiffness` has
    /// a value for each face.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(surface: &Surface, stiffness: Option<&[f64]>) -> Result<Self, SolveError> {
        let n = surface.positions.len();
        let weights = edge_weights(surface, stiffness);
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
        let mut sums = vec![0.0; n];
        for (&(u, v), &k) in &weights {
            columns[u as usize].push((v as usize, -k));
            sums[u as usize] += k;
            sums[v as usize] += k;
        }
        let (mut starts, mut rows, mut laplacian, mut diagonal) =
            (vec![0], Vec::new(), Vec::new(), Vec::new());
        for (v, column) in columns.iter().enumerate() {
            diagonal.push(rows.len());
            rows.push(v);
            laplacian.push(sums[v]);
            for &(r, k) in column {
                rows.push(r);
                laplacian.push(k);
            }
            starts.push(rows.len());
        }
        Ok(Self {
            cholesky: Cholesky::new(starts, rows)?,
            laplacian,
            diagonal,
            areas: surface.vertex_areas.clone(),
        })
    }

    /// The field of smoothing length `lambda` (fraction of L) nearest to the targets: `confidence` c_v
    /// of each target t_v in 0..=1, 0 for none.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn solve(
        &mut self,
        targets: &[Vector],
        confidence: &[f64],
        lambda: f64,
    ) -> Result<Vec<Vector>, SolveError> {
        let n = self.areas.len();
        let mut values: Vec<f64> = self.laplacian.iter().map(|k| lambda * lambda * k).collect();
        let mut x = vec![0.0; 3 * n];
        let floor = FLOOR * self.areas.iter().sum::<f64>() / n as f64;
        for v in 0..n {
            let screen = self.areas[v] * confidence[v];
            values[self.diagonal[v]] += screen + floor;
            for axis in 0..3 {
                x[axis * n + v] = screen * targets[v][axis];
            }
        }
        if x.iter().all(|v| *v == 0.0) {
            return Ok(vec![Vector::zeros(); n]);
        }
        self.cholesky.factorize(&values)?;
        let cholesky = &self.cholesky;
        x.par_chunks_mut(n)
            .filter(|column| column.iter().any(|v| *v != 0.0))
            .try_for_each(|column| cholesky.solve(&values, column))?;
        Ok((0..n)
            .map(|v| Vector::new(x[v], x[n + v], x[2 * n + v]))
            .collect())
    }
}
