//! A system of rigid elements factorised as it is.

use nalgebra::Matrix6;

use crate::deform::solver::cholesky::Cholesky;
use crate::deform::solver::coupling::Twist;
use crate::deform::solver::system::System;
use crate::deform::solver::{SolveError, Solver};

/// Factorises each system that it is given.
pub struct Direct {
    pairs: Vec<[u32; 2]>,
    cholesky: Cholesky,
    layout: Layout,
    values: Vec<f64>,
}

impl Direct {
    /// For systems of `count` elements over these pairs.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(count: usize, pairs: &[[u32; 2]]) -> Result<Self, SolveError> {
        let layout = Layout::new(count, pairs);
        Ok(Self {
            pairs: pairs.to_vec(),
            cholesky: Cholesky::new(layout.starts.clone(), layout.rows.clone())?,
            values: vec![0.0; layout.rows.len()],
            layout,
        })
    }

    /// Factorises `system`.
    ///
    /// # Errors
    /// [`SolveError::NotPositiveDefinite`].
    pub fn factorize(&mut self, system: &System) -> Result<(), SolveError> {
        let fixed = &system.fixed;
        self.values.fill(0.0);
        for (&[i, j], block) in self.pairs.iter().zip(&system.between) {
            if !(fixed[i as usize] || fixed[j as usize]) {
                let pair = [i as usize, j as usize];
                self.layout
                    .add_pair(&mut self.values, pair, &block.matrix());
            }
        }
        let ridge = Matrix6::identity() * system.ridge;
        for (i, block) in system.diagonal.iter().enumerate() {
            let block = if fixed[i] {
                Matrix6::identity()
            } else {
                block.matrix() + ridge
            };
            self.layout.set_diagonal(&mut self.values, i, &block);
        }
        self.cholesky.factorize(&self.values)
    }

    /// Solves the system that was factorised last.
    ///
    /// # Errors
    /// [`SolveError::Inaccurate`].
    pub fn solve_factorized(&mut self, b: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        let mut x: Vec<f64> = b.iter().flat_map(|t| t.data.0[0]).collect();
        self.cholesky.solve(&self.values, &mut x)?;
        Ok(x.chunks_exact(6).map(Twist::from_column_slice).collect())
    }
}

impl Solver for Direct {
    fn solve(&mut self, system: &System, b: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        self.factorize(system)?;
        self.solve_factorized(b)
    }
}

/// Where the 6x6 blocks lie in the compressed lower triangle.
struct Layout {
    starts: Vec<usize>,
    rows: Vec<usize>,
    /// For block column i: the block rows below the diagonal, increasing.
    below: Vec<Vec<usize>>,
}

impl Layout {
    fn new(count: usize, pairs: &[[u32; 2]]) -> Self {
        let mut below = vec![Vec::new(); count];
        for &[i, j] in pairs {
            below[i.min(j) as usize].push(i.max(j) as usize);
        }
        let mut starts = vec![0];
        let mut rows = Vec::new();
        for (i, list) in below.iter_mut().enumerate() {
            list.sort_unstable();
            list.dedup();
            for c in 0..6 {
                rows.extend(6 * i + c..6 * i + 6);
                for &j in list.iter() {
                    rows.extend(6 * j..6 * j + 6);
                }
                starts.push(rows.len());
            }
        }
        Self {
            starts,
            rows,
            below,
        }
    }

    fn set_diagonal(&self, values: &mut [f64], i: usize, block: &Matrix6<f64>) {
        for c in 0..6 {
            let start = self.starts[6 * i + c];
            for r in c..6 {
                values[start + r - c] = block[(r, c)];
            }
        }
    }

    /// Adds the block of a pair, transposed where its second element comes first.
    fn add_pair(&self, values: &mut [f64], [i, j]: [usize; 2], block: &Matrix6<f64>) {
        let (column, row) = (i.min(j), i.max(j));
        let Ok(slot) = self.below[column].binary_search(&row) else {
            return;
        };
        for c in 0..6 {
            let start = self.starts[6 * column + c] + (6 - c) + 6 * slot;
            for r in 0..6 {
                // The block has rows of i; the stored one has rows of the later element.
                let value = if i < j { block[(c, r)] } else { block[(r, c)] };
                values[start + r] += value;
            }
        }
    }
}
