//! Moments of points in a disc: what a polynomial is fitted from. Their number does not grow with the points: 45 sums stand for the
//! 120 products of 15 monomials, as x^i y^j times x^k y^l is x^(i + k) y^(j + l).

use nalgebra::SMatrix;

/// Degree of the polynomials.
pub const ORDERS: usize = 4;
/// Monomials up to it.
pub const UNKNOWNS: usize = 15;

/// The row of x^i y^j among the monomials.
pub fn monomial(i: usize, j: usize) -> usize {
    let n = i + j;
    n * (n + 1) / 2 + j
}

/// Weighted sums of x^p y^q over points, p + q up to twice the degree, and of h x^i y^j: all that a fit of a polynomial needs.
pub struct Moments {
    of: [[f64; 2 * ORDERS + 1]; 2 * ORDERS + 1],
    /// Of the height times each monomial.
    pub height: [f64; UNKNOWNS],
}

impl Moments {
    /// Of no points.
    pub fn new() -> Self {
        Self {
            of: [[0.0; 2 * ORDERS + 1]; 2 * ORDERS + 1],
            height: [0.0; UNKNOWNS],
        }
    }

    /// Adds a point of the unit disc with its height.
    pub fn add(&mut self, [x, y]: [f64; 2], h: f64, weight: f64) {
        let mut powers = [1.0; 2 * ORDERS + 1];
        for k in 1..powers.len() {
            powers[k] = powers[k - 1] * x;
        }
        let mut w = weight;
        for (j, row) in self.of.iter_mut().enumerate() {
            let count = powers.len() - j;
            for (sum, x) in row[..count].iter_mut().zip(&powers) {
                *sum += w * x;
            }
            if j <= ORDERS {
                for (i, x) in powers[..=ORDERS - j].iter().enumerate() {
                    self.height[monomial(i, j)] += w * h * x;
                }
            }
            w *= y;
        }
    }

    /// The matrix of the sums of products of monomials.
    pub fn matrix(&self) -> SMatrix<f64, UNKNOWNS, UNKNOWNS> {
        let all = || (0..=ORDERS).flat_map(|n| (0..=n).map(move |j| (n - j, j)));
        let mut matrix = SMatrix::zeros();
        for (a, (i, j)) in all().enumerate() {
            for (b, (k, l)) in all().enumerate() {
                matrix[(a, b)] = self.of[j + l][i + k];
            }
        }
        matrix
    }
}

impl Default for Moments {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sums are those of the products of monomials, point by point.
    #[test]
    fn moments_stand_for_all_products() {
        let powers = || (0..=ORDERS).flat_map(|n| (0..=n).map(move |j| (n - j, j)));
        let mut moments = Moments::new();
        let mut direct = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        let mut heights = [0.0; UNKNOWNS];
        for k in 0..40 {
            let t = f64::from(k);
            let (x, y, h, w) = (
                (1.3 * t).sin(),
                0.8 * (0.7 * t).cos(),
                t.sin(),
                1.0 + t % 3.0,
            );
            moments.add([x, y], h, w);
            let row: Vec<f64> = powers()
                .map(|(i, j)| x.powi(i as i32) * y.powi(j as i32))
                .collect();
            for a in 0..UNKNOWNS {
                heights[a] += w * h * row[a];
                for b in 0..UNKNOWNS {
                    direct[(a, b)] += w * row[a] * row[b];
                }
            }
        }
        assert!((moments.matrix() - direct).norm() < 1e-10);
        let off = moments
            .height
            .iter()
            .zip(heights)
            .map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-11);
    }
}
