//! Sparse symmetric positive definite systems: symbolic work once, numeric work as often as the
//! values change, the residual checked every time.
//!
//! faer's supernodal Cholesky, sequential: its parallel kernels have open reports of silently wrong
//! factors, and two threads gained nothing at these sizes.

use std::mem::MaybeUninit;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use crate::deform::solver::SolveError;

/// A lower-triangular pattern in compressed columns with its symbolic factorisation.
pub struct Cholesky {
    pattern: SymbolicSparseColMat<usize>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    scratch: Vec<MaybeUninit<u8>>,
}

/// Largest |A x - b| / |b| that passes for a solution.
const MAX_RESIDUAL: f64 = 1e-6;

impl Cholesky {
    /// Analyses the pattern with columns `column_starts[c]..column_starts[c + 1]` of `rows`, which
    /// are increasing and start with the diagonal.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(column_starts: Vec<usize>, rows: Vec<usize>) -> Result<Self, SolveError> {
        Self::ordered(column_starts, rows, SymmetricOrdering::Amd)
    }

    /// The same of a matrix of square blocks of `size`, ordered block by block: to look for the order among single
    /// rows takes longer than to factorise. `blocks` are the rows of each column's blocks, the diagonal first.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn of_blocks(
        blocks: &[Vec<usize>],
        size: usize,
        (column_starts, rows): (Vec<usize>, Vec<usize>),
    ) -> Result<Self, SolveError> {
        let order = order(blocks)?;
        let forward: Vec<usize> = order
            .iter()
            .flat_map(|b| size * b..size * (b + 1))
            .collect();
        let mut inverse = vec![0; forward.len()];
        for (to, &from) in forward.iter().enumerate() {
            inverse[from] = to;
        }
        let order = PermRef::new_checked(&forward, &inverse, forward.len());
        Self::ordered(column_starts, rows, SymmetricOrdering::Custom(order))
    }

    fn ordered(
        column_starts: Vec<usize>,
        rows: Vec<usize>,
        ordering: SymmetricOrdering<'_, usize>,
    ) -> Result<Self, SolveError> {
        let n = column_starts.len() - 1;
        let pattern = SymbolicSparseColMat::new_checked(n, n, column_starts, None, rows);
        let symbolic = factorize_symbolic_cholesky(
            pattern.as_ref(),
            Side::Lower,
            ordering,
            CholeskySymbolicParams::default(),
        )
        .map_err(|_| SolveError::Setup)?;
        let need = StackReq::or(
            symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default()),
            symbolic.solve_in_place_scratch::<f64>(3, Par::Seq),
        );
        let bytes = need.unaligned_bytes_required();
        Ok(Self {
            factor: vec![0.0; symbolic.len_val()],
            scratch: vec![MaybeUninit::uninit(); bytes],
            pattern,
            symbolic,
        })
    }

    /// The size of the system.
    pub fn size(&self) -> usize {
        self.pattern.ncols()
    }

    /// Factorises the matrix with the pattern's `values`.
    ///
    /// # Errors
    /// [`SolveError::NotPositiveDefinite`].
    pub fn factorize(&mut self, values: &[f64]) -> Result<(), SolveError> {
        let matrix = SparseColMatRef::new(self.pattern.as_ref(), values);
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                matrix,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.scratch),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|_| SolveError::NotPositiveDefinite)
    }

    /// Solves for `columns` right-hand sides, one after the other in `x`, with the last factor;
    /// `values` are those it was made from.
    ///
    /// # Errors
    /// [`SolveError::Inaccurate`] where the residual does not vanish.
    pub fn solve(&self, values: &[f64], x: &mut [f64]) -> Result<(), SolveError> {
        let n = self.size();
        let columns = x.len() / n;
        let b = x.to_vec();
        let llt = LltRef::new(&self.symbolic, &self.factor);
        let mut memory = MemBuffer::new(
            self.symbolic
                .solve_in_place_scratch::<f64>(columns, Par::Seq),
        );
        llt.solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, n, columns),
            Par::Seq,
            MemStack::new(&mut memory),
        );
        for (x, b) in x.chunks(n).zip(b.chunks(n)) {
            self.check(values, x, b)?;
        }
        Ok(())
    }

    fn check(&self, values: &[f64], x: &[f64], b: &[f64]) -> Result<(), SolveError> {
        let mut r: Vec<f64> = b.iter().map(|b| -b).collect();
        let starts = self.pattern.col_ptr();
        let rows = self.pattern.row_idx();
        for c in 0..self.size() {
            for k in starts[c]..starts[c + 1] {
                let row = rows[k];
                r[row] += values[k] * x[c];
                if row != c {
                    r[c] += values[k] * x[row];
                }
            }
        }
        let norm = |v: &[f64]| v.iter().map(|a| a * a).sum::<f64>().sqrt();
        if norm(&r) <= MAX_RESIDUAL * norm(b) {
            Ok(())
        } else {
            Err(SolveError::Inaccurate)
        }
    }
}

/// The order of elimination by least degree, of a matrix whose columns have entries in these rows.
fn order(columns: &[Vec<usize>]) -> Result<Vec<usize>, SolveError> {
    let mut starts = vec![0];
    let mut rows = Vec::new();
    for column in columns {
        rows.extend(column);
        starts.push(rows.len());
    }
    let n = columns.len();
    let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
    let need = amd::order_maybe_unsorted_scratch::<usize>(n, pattern.compute_nnz());
    let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
    amd::order_maybe_unsorted(
        &mut forward,
        &mut inverse,
        pattern.as_ref(),
        amd::Control::default(),
        MemStack::new(&mut MemBuffer::new(need)),
    )
    .map_err(|_| SolveError::Setup)?;
    Ok(forward)
}
