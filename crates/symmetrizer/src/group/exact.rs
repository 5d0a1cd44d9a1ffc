//! Products of nearly a group: which element is which product, and the exact group closest by.

use crate::geom::Matrix3;
use crate::transform::space::Phi;
use crate::transform::{Isometry, TransformSpace};

/// The multiplication table of a finite group; element 0 is the identity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Table {
    size: usize,
    products: Vec<u32>,
}

impl Table {
    /// The table of nearly a group, each product being the nearest element; `None` where that is
    /// no group's: where an element stands twice in a row or column, or the first is not neutral.
    pub fn of(elements: &[Isometry], space: &TransformSpace) -> Option<Self> {
        let size = elements.len();
        let points: Vec<Phi> = elements.iter().map(|t| space.embed(t)).collect();
        let nearest = |t: &Isometry| {
            let at = space.embed(t);
            let distances = points.iter().map(|p| (p - at).norm_squared());
            distances
                .enumerate()
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map_or(0, |(i, _)| i as u32)
        };
        let pairs = elements
            .iter()
            .flat_map(|g| elements.iter().map(move |h| g.after(h)));
        let table = Self {
            size,
            products: pairs.map(|t| nearest(&t)).collect(),
        };
        table.is_latin().then_some(table)
    }

    /// The order of the group.
    pub fn order(&self) -> usize {
        self.size
    }

    /// The element that is first `h`, then `g`.
    pub fn product(&self, g: usize, h: usize) -> usize {
        self.products[g * self.size + h] as usize
    }

    /// How often `g` must be repeated to be the identity.
    pub fn order_of(&self, g: usize) -> usize {
        let mut power = g;
        let mut order = 1;
        while power != 0 && order < self.size {
            power = self.product(power, g);
            order += 1;
        }
        order
    }

    fn is_latin(&self) -> bool {
        let all = |indices: &mut dyn Iterator<Item = usize>| {
            let mut seen = vec![false; self.size];
            indices.for_each(|i| seen[i] = true);
            seen.iter().all(|s| *s)
        };
        self.size > 0
            && (0..self.size).all(|g| {
                self.product(0, g) == g
                    && all(&mut (0..self.size).map(|h| self.product(g, h)))
                    && all(&mut (0..self.size).map(|h| self.product(h, g)))
            })
    }
}

/// How well products must close, and in how many rounds: each squares the error.
const EXACT: f64 = 1e-13;
const ROUNDS: usize = 12;

/// The orthogonal matrices close to `turns` whose products are exactly those of `table`: the
/// averages polar(mean over h of rho(g h) rho(h)^-1), repeated. Each round squares the error (D.
/// Kazhdan, On epsilon-representations, Israel J. Math. 43, 1982). `None` where they do not
/// converge: then `table` is not their group.
pub fn exact_turns(turns: &[Matrix3], table: &Table) -> Option<Vec<Matrix3>> {
    let mut rho = turns.to_vec();
    for _ in 0..ROUNDS {
        let averaged = (0..rho.len()).map(|g| {
            let terms = (0..rho.len()).map(|h| rho[table.product(g, h)] * rho[h].transpose());
            polar(terms.sum::<Matrix3>() / rho.len() as f64)
        });
        rho = averaged.collect::<Option<Vec<Matrix3>>>()?;
        if opening(&rho, table) < EXACT {
            return Some(rho);
        }
    }
    None
}

/// The greatest difference between the product of two matrices and the one the table names.
fn opening(rho: &[Matrix3], table: &Table) -> f64 {
    let gap = |g: usize, h: usize| (rho[g] * rho[h] - rho[table.product(g, h)]).amax();
    (0..rho.len())
        .flat_map(|g| (0..rho.len()).map(move |h| (g, h)))
        .fold(0.0, |worst, (g, h)| f64::max(worst, gap(g, h)))
}

/// The orthogonal matrix nearest to `m`, by Newton's iteration X <- (X + X^-T) / 2; `None` where
/// `m` is singular.
fn polar(m: Matrix3) -> Option<Matrix3> {
    let mut x = m;
    for _ in 0..30 {
        let next = (x + x.try_inverse()?.transpose()) / 2.0;
        let change = (next - x).amax();
        x = next;
        if change < 1e-15 {
            break;
        }
    }
    Some(x)
}
