//! Relief: the shape of the surface around a sample as harmonics of its height over the tangent
//! plane, comparable under any turn about the normal and under mirroring.
//!
//! Over the disc of radius r the height is h = r sum Re(c_mj e^(-i m theta)) R_mj(rho): least squares
//! with the weight 1 - rho^2 in the polynomials up to degree 4. The R_mj are orthonormal under that
//! weight, so |c - c'| is the rms difference of two heights in units of r. Turning the frame by
//! alpha multiplies c_mj by e^(-i m alpha); mirroring conjugates it. Offset and tilt are left out: they are
//! the sample's place and normal. Ours; the harmonics are those of Zernike (1934) under another
//! weight.

use std::f64::consts::TAU;
use std::sync::LazyLock;

use nalgebra::{Complex, SMatrix, SVector};

use crate::geom::{Point, Vector};
use crate::sample::moments::{Moments, ORDERS, UNKNOWNS, monomial};
use crate::sample::signature::SCALES;
use crate::shape::curvature::Cloud;

/// A local frame: the normal and a direction in the tangent plane from which turns are counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Unit normal n.
    pub n: Vector,
    /// Unit tangent e1; e2 = n x e1.
    pub e1: Vector,
}

impl Frame {
    /// The second tangent, n x e1.
    pub fn e2(&self) -> Vector {
        self.n.cross(&self.e1)
    }

    /// The angle at which a direction, made tangent, stands against e1, radians.
    pub fn angle_of(&self, direction: &Vector) -> f64 {
        direction.dot(&self.e2()).atan2(direction.dot(&self.e1))
    }

    /// The frame turned about its normal by `alpha` radians.
    pub fn turned(&self, alpha: f64) -> Self {
        Self {
            n: self.n,
            e1: self.e1 * alpha.cos() + self.e2() * alpha.sin(),
        }
    }
}

/// Kept harmonics: (m, index among the radial polynomials of m).
pub const TERMS: [(usize, usize); 7] = [(0, 1), (0, 2), (1, 1), (2, 0), (2, 1), (3, 0), (4, 0)];
/// Points that a fit needs, somewhat more than unknowns.
const MIN_POINTS: usize = 22;

/// The coefficients of a height, one for each of [`TERMS`].
pub type Harmonic = [Complex<f64>; TERMS.len()];

/// The height around a sample at three radii, each as harmonics; a radius whose disc reaches over a
/// boundary or holds too few points is `None`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relief(pub [Option<Harmonic>; SCALES]);

/// How two reliefs lie best on each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Alignment {
    /// The turn of the second one's frame, radians: e1 of the first goes to its e1 turned by this.
    pub turn: f64,
    /// rms difference of the heights as a share of their own rms: 0 where they are alike, 1.4 for any two.
    pub gap: f64,
}

/// The 15 functions of the fit as polynomials: a row for each of x^(n - k) y^k, n up to 4.
pub struct Harmonics(SMatrix<f64, UNKNOWNS, UNKNOWNS>);

impl Default for Harmonics {
    fn default() -> Self {
        Self::new()
    }
}

/// For each m the radial polynomials, orthonormal under the weight, by powers of rho: Gram-Schmidt over rho^m, rho^(m+2),
/// .. up to degree 4.
fn radial() -> [Vec<Vec<(usize, f64)>>; ORDERS + 1] {
    std::array::from_fn(|m| {
        let mut basis: Vec<Vec<(usize, f64)>> = Vec::new();
        for power in (m..=ORDERS).step_by(2) {
            let mut new = vec![(power, 1.0)];
            for old in &basis {
                let along = inner(m, &new, old);
                new.extend(old.iter().map(|&(k, a)| (k, -along * a)));
            }
            let norm = inner(m, &new, &new).sqrt();
            new.iter_mut().for_each(|(_, a)| *a /= norm);
            basis.push(new);
        }
        basis
    })
}

/// rho^k e^(i m theta) by monomials: (x^2 + y^2)^((k - m) / 2) (x + i y)^m.
fn spread(k: usize, m: usize) -> [Complex<f64>; UNKNOWNS] {
    let mut all = [Complex::new(0.0, 0.0); UNKNOWNS];
    all[0] = Complex::new(1.0, 0.0);
    let times = |all: [Complex<f64>; UNKNOWNS], factor: &[(usize, usize, Complex<f64>)]| {
        let mut product = [Complex::new(0.0, 0.0); UNKNOWNS];
        for (i, j) in (0..=ORDERS).flat_map(|n| (0..=n).map(move |j| (n - j, j))) {
            for &(di, dj, c) in factor {
                let (i, j, from) = (i + di, j + dj, all[monomial(i, j)]);
                if i + j <= ORDERS {
                    product[monomial(i, j)] += from * c;
                }
            }
        }
        product
    };
    let (one, i) = (Complex::new(1.0, 0.0), Complex::new(0.0, 1.0));
    for _ in 0..m {
        all = times(all, &[(1, 0, one), (0, 1, i)]);
    }
    for _ in 0..(k - m) / 2 {
        all = times(all, &[(2, 0, one), (0, 2, one)]);
    }
    all
}

impl Harmonics {
    /// The functions, as the powers of e^(i theta) come: one for m = 0, the real and the imaginary part for others.
    pub fn new() -> Self {
        let mut rows = SMatrix::zeros();
        let mut at = 0;
        for (m, basis) in radial().iter().enumerate() {
            for function in basis {
                for &(k, a) in function {
                    for (row, c) in spread(k, m).iter().enumerate() {
                        rows[(row, at)] += a * c.re;
                        if m > 0 {
                            rows[(row, at + 1)] += a * c.im;
                        }
                    }
                }
                at += if m > 0 { 2 } else { 1 };
            }
        }
        Self(rows)
    }

    /// The relief at `x` in `frame` at the radii r0, 2 r0, 4 r0.
    pub fn relief(&self, cloud: &Cloud, x: &Point, frame: &Frame, r0: f64) -> Relief {
        Relief(std::array::from_fn(|s| {
            self.fit(cloud, x, frame, r0 * f64::from(1 << s))
        }))
    }

    fn fit(&self, cloud: &Cloud, x: &Point, frame: &Frame, radius: f64) -> Option<Harmonic> {
        let e2 = frame.e2();
        let mut moments = Moments::new();
        let (mut area, mut used) = (0.0, 0);
        cloud.each_facing(x, &frame.n, radius, |offset, weight| {
            let v = offset / radius;
            let w = weight * (1.0 - v.norm_squared()).max(0.0);
            moments.add([v.dot(&frame.e1), v.dot(&e2)], v.dot(&frame.n), w);
            area += weight;
            used += 1;
        });
        let disc = std::f64::consts::PI * radius * radius;
        if used < MIN_POINTS || area < MIN_COVERAGE * disc {
            return None;
        }
        let functions = self.0.transpose();
        let (products, heights) = moments.equations();
        let mut a = functions * products * self.0;
        let b = functions * heights;
        for k in 0..UNKNOWNS {
            a[(k, k)] += RIDGE * area;
        }
        let c = a.cholesky()?.solve(&b);
        c.iter()
            .all(|c| c.is_finite())
            .then(|| TERMS.map(|(m, j)| coefficient(&c, m, j)))
    }
}

/// Holds coefficients that few points leave open near 0; a trace against the weight's own 1/4.
const RIDGE: f64 = 1e-4;
/// Below this share of a full disc the ball hangs over a boundary.
const MIN_COVERAGE: f64 = 0.6;

/// The weighted mean over the disc of the product of two radial polynomials with cos^2 m theta.
fn inner(m: usize, a: &[(usize, f64)], b: &[(usize, f64)]) -> f64 {
    let mean = |k: usize| 4.0 * (1.0 / (k as f64 + 2.0) - 1.0 / (k as f64 + 4.0));
    let angular = if m == 0 { 1.0 } else { 0.5 };
    a.iter()
        .flat_map(|&(k, x)| b.iter().map(move |&(l, y)| x * y * mean(k + l)))
        .sum::<f64>()
        * angular
}

/// The complex coefficient of a harmonic in the solution.
fn coefficient(c: &SVector<f64, UNKNOWNS>, m: usize, j: usize) -> Complex<f64> {
    // m = 0 has three functions, m = 1 and 2 two pairs each, m = 3 and 4 one pair.
    let start = [0, 3, 7, 11, 13][m];
    if m == 0 {
        Complex::new(c[start + j], 0.0)
    } else {
        Complex::new(c[start + 2 * j], c[start + 2 * j + 1])
    }
}

/// The radii that are compared together: neighbouring two. The smaller ones see a small element without what
/// it stands on, the larger ones see a smooth shape without its noise.
const VIEWS: [[usize; 2]; 2] = [[0, 1], [1, 2]];

impl Relief {
    /// The root mean square height over the radii that are there: near 0 on flat ground.
    pub fn strength(&self) -> f64 {
        let scales = self.0.iter().flatten();
        let count = scales.clone().count().max(1) as f64;
        let sum: f64 = scales.flatten().map(|c| c.norm_sqr()).sum();
        (sum / count).sqrt()
    }

    /// The harmonics by size alone, which no turn and no mirror image changes.
    pub fn sizes(&self) -> Sizes {
        let size = |c: Complex<f64>, m: usize| if m == 0 { c.re } else { c.norm_sqr().sqrt() };
        Sizes(
            self.0
                .map(|scale| scale.map(|c| std::array::from_fn(|k| size(c[k], TERMS[k].0)))),
        )
    }

    /// The gap at a given turn of the second one's frame, in the view where it is smaller.
    pub fn gap_at(&self, other: &Self, mirrored: bool, turn: f64) -> Option<f64> {
        VIEWS
            .iter()
            .filter_map(|view| Correlation::new(self, other, mirrored, view))
            .map(|c| c.gap(turn))
            .min_by(f64::total_cmp)
    }

    /// The turns at which `self`, mirrored if asked, lies best on `other`: the local optima with a gap
    /// within `tolerance` in the view where the best one is, the best first.
    pub fn alignments(&self, other: &Self, mirrored: bool, tolerance: f64) -> Vec<Alignment> {
        let optima = |view| {
            let correlation = Correlation::new(self, other, mirrored, view);
            let mut found = correlation.map_or_else(Vec::new, |c| c.optima(tolerance));
            found.sort_by(|a, b| a.gap.total_cmp(&b.gap));
            found
        };
        let [small, large] = [optima(&VIEWS[0]), optima(&VIEWS[1])];
        let best = |found: &[Alignment]| found.first().map_or(f64::INFINITY, |a| a.gap);
        if best(&small) <= best(&large) {
            small
        } else {
            large
        }
    }
}

/// The harmonics of a relief by size: |c_mj|, c_0j itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes([Option<[f64; TERMS.len()]>; SCALES]);

impl Sizes {
    /// Never more than the gap of the best alignment of the two reliefs, mirrored or not. `None` without two
    /// neighbouring radii in common.
    pub fn least_gap(&self, other: &Self) -> Option<f64> {
        let mut parts = [None; SCALES];
        for (part, (a, b)) in parts.iter_mut().zip(self.0.iter().zip(&other.0)) {
            let (Some(a), Some(b)) = (a, b) else {
                continue;
            };
            let (mut difference, mut energy) = (0.0, 0.0);
            for (a, b) in a.iter().zip(b) {
                difference += (a - b) * (a - b);
                energy += a * a + b * b;
            }
            *part = Some((difference, energy));
        }
        let gap = |&[s, t]: &[usize; 2]| {
            let ((d, e), (f, g)) = (parts[s]?, parts[t]?);
            Some((2.0 * (d + f) / (e + g)).sqrt())
        };
        VIEWS.iter().filter_map(gap).min_by(f64::total_cmp)
    }
}

/// Turns at which agreement is looked at before it is polished.
const STEPS: usize = 24;
/// For each of them e^(-i m alpha), m = 0 to the highest order.
static TURNS: LazyLock<[[Complex<f64>; ORDERS + 1]; STEPS]> = LazyLock::new(|| {
    std::array::from_fn(|k| {
        let alpha = TAU / STEPS as f64 * k as f64;
        std::array::from_fn(|m| Complex::from_polar(1.0, -(m as f64) * alpha))
    })
});

/// The agreement of two reliefs as a function of the turn: Re sum g_m e^(-i m alpha).
struct Correlation {
    g: [Complex<f64>; ORDERS + 1],
    energy: f64,
}

impl Correlation {
    fn new(p: &Relief, q: &Relief, mirrored: bool, view: &[usize; 2]) -> Option<Self> {
        let mut g = [Complex::new(0.0, 0.0); ORDERS + 1];
        let mut energy = 0.0;
        for &s in view {
            for ((a, b), (m, _)) in p.0[s]?.iter().zip(&q.0[s]?).zip(TERMS) {
                // The conjugate of p's coefficient, and of the mirrored one's.
                let a_conj = if mirrored { *a } else { a.conj() };
                g[m] += b * a_conj;
                energy += a.norm_sqr() + b.norm_sqr();
            }
        }
        (energy > 0.0).then_some(Self { g, energy })
    }

    /// How much the gap changes with the turn, against the relief: below about the gap itself a turn is a
    /// matter of noise.
    fn directedness(&self, alpha: f64) -> f64 {
        let terms = self.g.iter().enumerate();
        let second: f64 = terms
            .map(|(m, g)| (m * m) as f64 * (g * Complex::from_polar(1.0, -(m as f64) * alpha)).re)
            .sum();
        (2.0 * second.max(0.0) / self.energy).sqrt()
    }

    fn gap(&self, alpha: f64) -> f64 {
        let turn = Complex::from_polar(1.0, -alpha);
        // Horner in e^(-i alpha).
        let sum = self
            .g
            .iter()
            .rev()
            .fold(Complex::new(0.0, 0.0), |s, g| s * turn + g);
        (2.0 * (self.energy - 2.0 * sum.re).max(0.0) / self.energy).sqrt()
    }

    fn optima(&self, tolerance: f64) -> Vec<Alignment> {
        let agreement = TURNS.each_ref().map(|powers| {
            let terms = self.g.iter().zip(powers);
            terms.map(|(g, z)| g.re * z.re - g.im * z.im).sum::<f64>()
        });
        // Where the gap is half as much again.
        let least = 0.5 * self.energy * (1.0 - 0.5 * (1.5 * tolerance).powi(2));
        (0..STEPS)
            .filter_map(|k| {
                let (before, here, after) = (
                    agreement[(k + STEPS - 1) % STEPS],
                    agreement[k],
                    agreement[(k + 1) % STEPS],
                );
                if here < before || here <= after || here < least {
                    return None;
                }
                let turn = self.polish(TAU / STEPS as f64 * k as f64);
                let gap = self.gap(turn);
                (gap <= tolerance && self.directedness(turn) > gap)
                    .then_some(Alignment { turn, gap })
            })
            .collect()
    }

    /// Newton on the derivative of the agreement, from a grid point beside its maximum.
    fn polish(&self, mut alpha: f64) -> f64 {
        for _ in 0..4 {
            let turn = Complex::from_polar(1.0, -alpha);
            let mut power = Complex::new(1.0, 0.0);
            let (mut first, mut second) = (0.0, 0.0);
            for (m, g) in self.g.iter().enumerate() {
                let m = m as f64;
                let z = g * power;
                first += m * z.im;
                second -= m * m * z.re;
                power *= turn;
            }
            if second >= 0.0 {
                break;
            }
            alpha -= (first / second).clamp(-0.1, 0.1);
        }
        alpha
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Matrix3, exp_rotation};
    use crate::shape::Surface;

    /// A lively height field over a square, finely and unevenly triangulated.
    fn ground() -> Surface {
        let n = 90_u32;
        let at = |i: u32, j: u32| i * n + j;
        let positions = (0..n * n)
            .map(|k| {
                let x = f64::from(k / n) / f64::from(n) - 0.5 + 0.002 * f64::from(k % 7) / 7.0;
                let y = f64::from(k % n) / f64::from(n) - 0.5;
                let h = 0.05 * (9.0 * x + 4.0 * y).sin() + 0.3 * x * x * y - 0.2 * y * y
                    + 0.4 * x * x * x;
                Point::new(x, y, h)
            })
            .collect();
        let mut triangles = Vec::new();
        for i in 0..n - 1 {
            for j in 0..n - 1 {
                triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        Surface::new(positions, triangles.into())
    }

    fn relief_of(surface: &Surface, frame: &Frame, x: &Point) -> Relief {
        let cloud = Cloud::new(surface, 0.02);
        Harmonics::new().relief(&cloud, x, frame, 0.06)
    }

    /// The turn of the frame is found again, for a moved and for a mirrored copy, and only there.
    #[test]
    fn turns_and_mirrors_are_told_apart() {
        let surface = ground();
        let vertex = 45 * 90 + 45;
        let x = surface.positions[vertex];
        let frame = Frame {
            n: surface.vertex_normals[vertex],
            e1: crate::geom::any_orthogonal(&surface.vertex_normals[vertex]),
        };
        let relief = relief_of(&surface, &frame, &x);
        let n = Vector::new(0.3, -0.5, 0.8).normalize();
        let mirror = Matrix3::identity() - 2.0 * n * n.transpose();
        let motion = exp_rotation(&Vector::new(0.4, -1.1, 0.7));
        for (t, mirrored) in [(motion, false), (mirror, true)] {
            let moved = surface.with_positions(
                surface
                    .positions
                    .iter()
                    .map(|p| Point::from(t * p.coords))
                    .collect(),
            );
            // A mirrored copy is seen from outside again when its triangles are turned.
            let triangles: Vec<[u32; 3]> =
                moved.triangles.iter().map(|&[a, b, c]| [b, a, c]).collect();
            let moved = if mirrored {
                Surface::new(moved.positions, triangles.into())
            } else {
                moved
            };
            let there = Frame {
                n: (t * frame.n),
                e1: crate::geom::any_orthogonal(&(t * frame.n)),
            }
            .turned(0.7);
            let other = relief_of(&moved, &there, &Point::from(t * x.coords));
            let best = relief.alignments(&other, mirrored, 0.2);
            assert_eq!(best.len(), 1, "{best:?}");
            assert!(best[0].gap < 1e-5);
            let e1 = there.turned(best[0].turn).e1;
            assert!((e1 - t * frame.e1).norm() < 1e-5, "mirrored {mirrored}");
            assert!(relief.sizes().least_gap(&other.sizes()).unwrap() <= best[0].gap + 1e-6);
            // The other hand does not fit.
            assert!(relief.alignments(&other, !mirrored, 0.05).is_empty());
        }
    }

    /// The strength is the rms height over the disc: that of a bowl, without the level that is its place.
    #[test]
    fn the_strength_is_a_height() {
        let flat = ground();
        let positions = flat
            .positions
            .iter()
            .map(|p| Point::new(p.x, p.y, 0.5 * (p.x * p.x + p.y * p.y)));
        let bowl = flat.with_positions(positions.collect());
        let frame = Frame {
            n: Vector::z(),
            e1: Vector::x(),
        };
        let strength = relief_of(&bowl, &frame, &Point::origin()).strength();
        // h = r rho^2 / 2 at r, 2r, 4r; rho^2 varies by sqrt(1/18) under the weight.
        let radii = [0.06, 0.12, 0.24];
        let mean: f64 = radii
            .iter()
            .map(|r| (r / 2.0_f64).powi(2) / 18.0)
            .sum::<f64>()
            / 3.0;
        assert!((strength / mean.sqrt() - 1.0).abs() < 0.05, "{strength}");
    }
}
