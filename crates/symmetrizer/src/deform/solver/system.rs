//! A symmetric system over rigid elements: one 6x6 block for each element and each joined pair.

use rayon::prelude::*;

use crate::deform::solver::coupling::{Coupling, Twist};
use crate::geom::Point;

/// The values of a system; the pairs are those its solver was made for.
#[derive(Debug, Clone)]
pub struct System {
    /// The present centre of each element, which its twist is about.
    pub centers: Vec<Point>,
    /// The element's own blocks.
    pub diagonal: Vec<Coupling>,
    /// What is added to the diagonal of the matrix.
    pub ridge: f64,
    /// For each pair its block, rows of the first.
    pub between: Vec<Coupling>,
    /// Elements that do not move: their unknowns are 0.
    pub fixed: Vec<bool>,
}

/// The pairs of each element.
#[derive(Debug, Clone)]
pub struct Rows {
    starts: Vec<u32>,
    /// Pair, the other element, and whether the row's element is the pair's first.
    links: Vec<(u32, u32, bool)>,
}

impl Rows {
    /// Rows of `count` elements.
    pub fn new(count: usize, pairs: &[[u32; 2]]) -> Self {
        let mut starts = vec![0_u32; count + 1];
        for &[i, j] in pairs {
            starts[i as usize + 1] += 1;
            starts[j as usize + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut links = vec![(0, 0, false); 2 * pairs.len()];
        for (k, &[i, j]) in (0..).zip(pairs) {
            for (row, other, first) in [(i, j, true), (j, i, false)] {
                links[next[row as usize] as usize] = (k, other, first);
                next[row as usize] += 1;
            }
        }
        Self { starts, links }
    }

    /// The pairs of an element: pair, the other element, whether this one is its first.
    pub fn of(&self, i: usize) -> &[(u32, u32, bool)] {
        &self.links[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}

impl System {
    /// A x.
    pub fn apply(&self, rows: &Rows, x: &[Twist]) -> Vec<Twist> {
        (0..x.len())
            .into_par_iter()
            .with_min_len(512)
            .map(|i| {
                if self.fixed[i] {
                    return x[i];
                }
                let mut y = self.diagonal[i].apply(&x[i]) + self.ridge * x[i];
                for &(pair, other, first) in rows.of(i) {
                    let other = other as usize;
                    if self.fixed[other] {
                        continue;
                    }
                    let block = &self.between[pair as usize];
                    y += if first {
                        block.apply(&x[other])
                    } else {
                        block.apply_transposed(&x[other])
                    };
                }
                y
            })
            .collect()
    }
}

/// The scalar product, summed in an order that does not depend on the number of threads.
pub fn dot(a: &[Twist], b: &[Twist]) -> f64 {
    const CHUNK: usize = 4096;
    let sums: Vec<f64> = a
        .par_chunks(CHUNK)
        .zip(b.par_chunks(CHUNK))
        .map(|(a, b)| a.iter().zip(b).map(|(x, y)| x.dot(y)).sum())
        .collect();
    sums.iter().sum()
}
