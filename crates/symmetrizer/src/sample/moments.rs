//! Moments of points in a disc: what a polynomial is fitted from. Their number does not grow with the points: 45 sums stand for the
//! 120 products of 15 monomials, as x^i y^j times x^k y^l is x^(i + k) y^(j + l).

use nalgebra::{SMatrix, SVector};

/// Degree of the polynomials.
pub const ORDERS: usize = 4;
/// Monomials up to it.
pub const UNKNOWNS: usize = 15;

/// The row of x^i y^j among the monomials.
pub fn monomial(i: usize, j: usize) -> usize {
    let n = i + j;
    n * (n + 1) / 2 + j
}

/// Points that are summed side by side.
const LANES: usize = 4;
/// Powers of a coordinate, up to twice the degree.
const POWERS: usize = 2 * ORDERS + 1;

type Lanes = [f64; LANES];

/// Weighted sums of x^p y^q over points, p + q up to twice the degree, and of h x^i y^j: all that a fit of a polynomial needs.
pub struct Moments {
    of: [[Lanes; POWERS]; POWERS],
    /// Of the height times each monomial.
    height: [Lanes; UNKNOWNS],
    /// Points that wait until there are as many as lanes: x, y, height, weight.
    waiting: [Lanes; 4],
    count: usize,
}

impl Moments {
    /// Of no points.
    pub fn new() -> Self {
        Self {
            of: [[[0.0; LANES]; POWERS]; POWERS],
            height: [[0.0; LANES]; UNKNOWNS],
            waiting: [[0.0; LANES]; 4],
            count: 0,
        }
    }

    /// Adds a point of the unit disc with its height.
    pub fn add(&mut self, [x, y]: [f64; 2], h: f64, weight: f64) {
        for (lanes, value) in self.waiting.iter_mut().zip([x, y, h, weight]) {
            lanes[self.count] = value;
        }
        self.count += 1;
        if self.count == LANES {
            self.sum_up();
        }
    }

    /// Adds the points that wait; lanes without one have no weight.
    fn sum_up(&mut self) {
        let [x, y, h, mut w] = self.waiting;
        let mut powers = [[1.0; LANES]; POWERS];
        for k in 1..POWERS {
            powers[k] = product(&powers[k - 1], &x);
        }
        for (j, row) in self.of.iter_mut().enumerate() {
            for (sum, power) in row.iter_mut().zip(&powers[..POWERS - j]) {
                add(sum, &product(&w, power));
            }
            if j <= ORDERS {
                let wh = product(&w, &h);
                for (i, power) in powers[..=ORDERS - j].iter().enumerate() {
                    let sum = &mut self.height[monomial(i, j)];
                    add(sum, &product(&wh, power));
                }
            }
            w = product(&w, &y);
        }
        self.waiting[3] = [0.0; LANES];
        self.count = 0;
    }

    /// The matrix of the sums of products of monomials, and the sums of the height times each.
    pub fn equations(mut self) -> (SMatrix<f64, UNKNOWNS, UNKNOWNS>, SVector<f64, UNKNOWNS>) {
        self.sum_up();
        let all = || (0..=ORDERS).flat_map(|n| (0..=n).map(move |j| (n - j, j)));
        let mut matrix = SMatrix::zeros();
        for (a, (i, j)) in all().enumerate() {
            for (b, (k, l)) in all().enumerate() {
                matrix[(a, b)] = self.of[j + l][i + k].iter().sum();
            }
        }
        let heights = self.height.map(|lanes| lanes.iter().sum());
        (matrix, SVector::from(heights))
    }
}

fn product(a: &Lanes, b: &Lanes) -> Lanes {
    std::array::from_fn(|k| a[k] * b[k])
}

fn add(sum: &mut Lanes, term: &Lanes) {
    for (sum, term) in sum.iter_mut().zip(term) {
        *sum += term;
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
        for k in 0..41 {
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
        let (matrix, height) = moments.equations();
        assert!((matrix - direct).norm() < 1e-10);
        assert!((height - SVector::from(heights)).norm() < 1e-11);
    }
}
