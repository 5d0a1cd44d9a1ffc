//! Positions for given rotations, one constant matrix for all three axes.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::deform::Pull;
use crate::deform::solver::{Cholesky, SolveError};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;

/// Share of the mean diagonal that is added to it: parts that nothing holds stay where they are.
const RIDGE: f64 = 1e-9;

/// The edges of a surface with their weights, and the factorised system of its vertices.
pub struct EdgeSystem {
    /// Edges (i, j), i < j, increasing.
    edges: Vec<[u32; 2]>,
    /// k_ij.
    weights: Vec<f64>,
    /// For each vertex its edges: edge and the other vertex.
    around: Vec<Vec<(u32, u32)>>,
    fixed: Vec<bool>,
    cholesky: Cholesky,
    /// Place of each vertex's diagonal value; its edges to later vertices follow, increasing.
    diagonal: Vec<usize>,
    values: Vec<f64>,
    /// The weights of the pulls that `values` were made with.
    pulled: Vec<(u32, [f64; 3], f64)>,
    factorized: bool,
}

impl EdgeSystem {
    /// The system of `surface` with these edge weights.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(surface: &Surface, weights: &BTreeMap<(u32, u32), f64>) -> Result<Self, SolveError> {
        let n = surface.positions.len();
        let mut around = vec![Vec::new(); n];
        let (mut edges, mut values) = (Vec::new(), Vec::new());
        for (e, (&(u, v), &k)) in (0..).zip(weights) {
            around[u as usize].push((e, v));
            around[v as usize].push((e, u));
            edges.push([u, v]);
            values.push(k);
        }
        let (mut starts, mut rows, mut diagonal) = (vec![0], Vec::new(), Vec::new());
        let mut edge = edges.iter().peekable();
        for v in 0..n as u32 {
            diagonal.push(rows.len());
            rows.push(v as usize);
            while let Some(&[_, j]) = edge.next_if(|e| e[0] == v) {
                rows.push(j as usize);
            }
            starts.push(rows.len());
        }
        Ok(Self {
            values: vec![0.0; rows.len()],
            cholesky: Cholesky::new(starts, rows)?,
            fixed: vec![false; n],
            edges,
            weights: values,
            around,
            diagonal,
            pulled: Vec::new(),
            factorized: false,
        })
    }

    /// Takes other weights of the same edges.
    pub fn set_weights(&mut self, weights: &BTreeMap<(u32, u32), f64>) {
        for (w, e) in self.weights.iter_mut().zip(&self.edges) {
            *w = weights.get(&(e[0], e[1])).copied().unwrap_or(*w);
        }
        self.factorized = false;
    }

    /// Vertices that do not move.
    pub fn set_fixed(&mut self, fixed: Vec<bool>) {
        self.fixed = fixed;
        self.factorized = false;
    }

    /// The edges.
    pub fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    /// The edges' weights k_ij.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The edges of a vertex: edge and the other vertex.
    pub fn around(&self, v: usize) -> &[(u32, u32)] {
        &self.around[v]
    }

    /// The way from the positions `x` to those that minimise sum over edges of
    /// k_ij |(x_i - x_j) - (R_i + R_j) (p_i - p_j) / 2|^2 plus the pulls, each w / `unit` of the squared distance.
    ///
    /// As ways, not as positions: what is in balance gives exact zeros, whatever holds it.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn ways(
        &mut self,
        surface: &Surface,
        rotations: &[Matrix3],
        pulls: &[Pull],
        unit: f64,
        x: &[Point],
    ) -> Result<Vec<Vector>, SolveError> {
        let rest = &surface.positions;
        let turned = |_, i: usize, j: usize| -> Vector {
            0.5 * ((rotations[i] + rotations[j]) * (rest[i] - rest[j]))
        };
        self.ways_for(surface, turned, pulls, unit, x)
    }

    /// [`EdgeSystem::ways`] where x_i - x_j is to be `wanted` of the edge and its vertices i and j, whichever comes
    /// first.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn ways_for(
        &mut self,
        surface: &Surface,
        wanted: impl Fn(usize, usize, usize) -> Vector + Sync,
        pulls: &[Pull],
        unit: f64,
        x: &[Point],
    ) -> Result<Vec<Vector>, SolveError> {
        let n = x.len();
        let mut b: Vec<Vector> = (0..n)
            .into_par_iter()
            .with_min_len(512)
            .map(|i| {
                let drawn = self.around[i].iter().map(|&(e, j)| {
                    let (e, j) = (e as usize, j as usize);
                    self.weights[e] * (wanted(e, i, j) - (x[i] - x[j]))
                });
                drawn.sum()
            })
            .collect();
        for pull in pulls {
            let corners = surface.triangles[pull.at.face as usize].map(|v| v as usize);
            let carried = corners.iter().zip(pull.at.bary);
            let place: Vector = carried.clone().map(|(&v, t)| x[v].coords * t).sum();
            let force = (pull.weight / unit) * (pull.target.coords - place);
            for (&v, t) in carried {
                b[v] += t * force;
            }
        }
        let mut ways = vec![0.0; 3 * n];
        for (i, b) in b.iter().enumerate().filter(|(i, _)| !self.fixed[*i]) {
            for axis in 0..3 {
                ways[axis * n + i] = b[axis];
            }
        }
        if ways.iter().all(|b| *b == 0.0) {
            return Ok(vec![Vector::zeros(); n]);
        }
        self.factorize(surface, pulls, unit)?;
        self.cholesky.solve(&self.values, &mut ways)?;
        let way = |i| Vector::new(ways[i], ways[n + i], ways[2 * n + i]);
        Ok((0..n).map(way).collect())
    }

    fn ridge(&self) -> f64 {
        let mean = 2.0 * self.weights.iter().sum::<f64>() / self.around.len().max(1) as f64;
        RIDGE * mean
    }

    /// Factorises where weights, fixed vertices or the pulls' places have changed; targets may.
    fn factorize(
        &mut self,
        surface: &Surface,
        pulls: &[Pull],
        unit: f64,
    ) -> Result<(), SolveError> {
        let same = |(p, (face, bary, w)): (&Pull, &(u32, [f64; 3], f64))| {
            p.at.face == *face && p.at.bary == *bary && p.weight / unit == *w
        };
        if self.factorized
            && pulls.len() == self.pulled.len()
            && pulls.iter().zip(&self.pulled).all(same)
        {
            return Ok(());
        }
        self.values.fill(0.0);
        let ridge = self.ridge();
        for &d in &self.diagonal {
            self.values[d] = ridge;
        }
        for k in 0..self.edges.len() {
            let (edge, w) = (self.edges[k], self.weights[k]);
            self.add(edge, [1.0, -1.0], w);
        }
        for pull in pulls {
            let [a, b, c] = surface.triangles[pull.at.face as usize];
            let [u, v, w] = pull.at.bary;
            let s = pull.weight / unit;
            for (i, t) in [(a, u), (b, v), (c, w)] {
                self.values[self.diagonal[i as usize]] += s * t * t;
            }
            for (i, j, t) in [(a, b, u * v), (b, c, v * w), (c, a, w * u)] {
                self.add_between(i, j, s * t);
            }
        }
        for v in (0..self.fixed.len()).filter(|&v| self.fixed[v]) {
            self.values[self.diagonal[v]] = 1.0;
        }
        self.cholesky.factorize(&self.values)?;
        self.pulled = pulls
            .iter()
            .map(|p| (p.at.face, p.at.bary, p.weight / unit))
            .collect();
        self.factorized = true;
        Ok(())
    }

    /// Adds w (t_0 x_i + t_1 x_j)^2 of an edge.
    fn add(&mut self, [i, j]: [u32; 2], [s, t]: [f64; 2], w: f64) {
        self.values[self.diagonal[i as usize]] += w * s * s;
        self.values[self.diagonal[j as usize]] += w * t * t;
        self.add_between(i, j, w * s * t);
    }

    /// Adds to the value of two different vertices that an edge joins.
    fn add_between(&mut self, i: u32, j: u32, value: f64) {
        if self.fixed[i as usize] || self.fixed[j as usize] || i == j {
            return;
        }
        let (column, row) = (i.min(j), i.max(j));
        let first = self.edges.partition_point(|e| e[0] < column);
        let later = &self.edges[first..];
        let count = later.partition_point(|e| e[0] == column);
        if let Ok(slot) = later[..count].binary_search(&[column, row]) {
            self.values[self.diagonal[column as usize] + 1 + slot] += value;
        }
    }
}
