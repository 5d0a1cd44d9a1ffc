//! A symmetric matrix put together entry by entry, then factorised.

use crate::deform::solver::{Cholesky, SolveError};

/// The entries of a symmetric matrix as they come; those of one place add up.
#[derive(Debug, Clone, Default)]
pub struct Entries {
    /// Row, column, value, row >= column.
    list: Vec<(u32, u32, f64)>,
}

/// A matrix with its factor.
pub struct Factorized {
    cholesky: Cholesky,
    values: Vec<f64>,
}

impl Entries {
    /// Adds `value` at row `i` and column `j`, and at row `j` and column `i`.
    pub fn add(&mut self, i: usize, j: usize, value: f64) {
        self.list.push((i.max(j) as u32, i.min(j) as u32, value));
    }

    /// Adds the square of sum a_k x_k, times `weight`.
    pub fn add_square(&mut self, terms: &[(usize, f64)], weight: f64) {
        for (k, &(i, a)) in terms.iter().enumerate() {
            self.add(i, i, weight * a * a);
            for &(j, b) in &terms[..k] {
                // Two terms of one unknown meet twice on the diagonal.
                let twice = if i == j { 2.0 } else { 1.0 };
                self.add(i, j, twice * weight * a * b);
            }
        }
    }

    /// The mean of the diagonal of a matrix of `n` rows.
    pub fn mean_diagonal(&self, n: usize) -> f64 {
        let diagonal = self.list.iter().filter(|(i, j, _)| i == j);
        diagonal.map(|(_, _, v)| v).sum::<f64>() / n.max(1) as f64
    }

    /// The matrix of `n` rows with its factor.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn factorized(mut self, n: usize) -> Result<Factorized, SolveError> {
        self.list.extend((0..n as u32).map(|i| (i, i, 0.0)));
        self.list.sort_by_key(|&(row, column, _)| (column, row));
        let (mut starts, mut rows, mut values) = (vec![0], Vec::new(), Vec::<f64>::new());
        let mut last = None;
        for (row, column, value) in self.list {
            if let (true, Some(sum)) = (last == Some((row, column)), values.last_mut()) {
                *sum += value;
                continue;
            }
            if starts.len() <= column as usize {
                starts.push(rows.len());
            }
            rows.push(row as usize);
            values.push(value);
            last = Some((row, column));
        }
        starts.push(rows.len());
        let mut cholesky = Cholesky::new(starts, rows)?;
        cholesky.factorize(&values)?;
        Ok(Factorized { cholesky, values })
    }
}

impl Factorized {
    /// Replaces `x` by the solution of A y = x.
    ///
    /// # Errors
    /// [`SolveError::Inaccurate`].
    pub fn solve(&self, x: &mut [f64]) -> Result<(), SolveError> {
        self.cholesky.solve(&self.values, x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_add_up() {
        // (x - 2 y)^2 + 3 (y + z)^2 + (z + z - x)^2 + x^2, its half gradient set to b.
        let mut entries = Entries::default();
        entries.add_square(&[(0, 1.0), (1, -2.0)], 1.0);
        entries.add_square(&[(1, 1.0), (2, 1.0)], 3.0);
        entries.add_square(&[(2, 1.0), (2, 1.0), (0, -1.0)], 1.0);
        entries.add(0, 0, 1.0);
        assert!((entries.mean_diagonal(3) - (3.0 + 7.0 + 7.0) / 3.0).abs() < 1e-15);
        let wanted: [f64; 3] = [0.3, -0.7, 1.1];
        let [x, y, z] = wanted;
        let mut b = [
            3.0 * x - 2.0 * y - 2.0 * z,
            -2.0 * x + 7.0 * y + 3.0 * z,
            -2.0 * x + 3.0 * y + 7.0 * z,
        ];
        let matrix = entries.factorized(3).expect("positive definite");
        matrix.solve(&mut b).expect("accurate");
        for (got, want) in b.iter().zip(wanted) {
            assert!((got - want).abs() < 1e-12, "{b:?}");
        }
    }
}
