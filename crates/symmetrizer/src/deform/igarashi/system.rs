//! Positions of the plane for given rotations of its triangles: one matrix for both axes, factorised anew only where
//! other points are held.

use std::sync::Mutex;

use crate::deform::Pull;
use crate::deform::igarashi::rigid::{Turn, turns};
use crate::deform::solver::{Entries, Factorized, SolveError};
use crate::geom::{Point, Vector};
use crate::shape::{Surface, SurfacePoint};

/// Cotangents are kept within this range: obtuse angles would else push neighbours apart.
const COTANGENT: (f64, f64) = (0.02, 20.0);
/// Share of the mean diagonal that is added to it: parts that nothing holds stay where they are.
const RIDGE: f64 = 1e-11;

/// What is held where.
pub struct Held {
    /// Places that vertices keep.
    pub places: Vec<Option<Point>>,
    /// Pulls at points of the inside.
    pub pulls: Vec<Pull>,
}

/// The energy of the inside: sum over triangles and their edges of w |x_ij - R p_ij|^2, w a quarter of the
/// cotangent opposite, so that it is the area times the square of an even stretch.
pub struct System {
    /// For each triangle the weights of the edges opposite its corners, without stiffness.
    weights: Vec<[f64; 3]>,
    stiffness: Vec<f64>,
    /// The last matrix and what it was made for.
    factor: Mutex<Option<(Key, Factorized)>>,
}

/// The points that are held, and how firmly.
#[derive(PartialEq)]
struct Key {
    kept: Vec<bool>,
    pulls: Vec<(SurfacePoint, f64)>,
}

/// Where a point of `rest` is while its vertices are at `positions`.
pub fn place(rest: &Surface, at: &SurfacePoint, positions: &[Point]) -> Point {
    let corners = rest.triangles[at.face as usize].iter().zip(at.bary);
    let sum: Vector = corners
        .map(|(&v, b)| positions[v as usize].coords * b)
        .sum();
    sum.into()
}

impl Held {
    /// What the pulls miss their targets by, each by its weight.
    pub fn missed(&self, rest: &Surface, positions: &[Point]) -> f64 {
        let missed =
            |p: &Pull| p.weight * (place(rest, &p.at, positions) - p.target).norm_squared();
        self.pulls.iter().map(missed).sum()
    }

    /// How far the pulls go in the mean, fraction of L.
    pub fn asked(&self, rest: &Surface, positions: &[Point]) -> f64 {
        let weights: f64 = self.pulls.iter().map(|p| p.weight).sum();
        (self.missed(rest, positions) / weights.max(f64::MIN_POSITIVE)).sqrt()
    }

    fn key(&self) -> Key {
        Key {
            kept: self.places.iter().map(Option::is_some).collect(),
            pulls: self.pulls.iter().map(|p| (p.at, p.weight)).collect(),
        }
    }
}

impl System {
    /// Of the flat surface `rest`.
    pub fn new(rest: &Surface) -> Self {
        let weights = |corners: &[u32; 3]| {
            let x = corners.map(|v| rest.positions[v as usize]);
            std::array::from_fn(|k| {
                let (u, v) = (x[(k + 1) % 3] - x[k], x[(k + 2) % 3] - x[k]);
                let cotangent = u.dot(&v) / u.cross(&v).z.max(f64::MIN_POSITIVE);
                cotangent.clamp(COTANGENT.0, COTANGENT.1) / 4.0
            })
        };
        Self {
            weights: rest.triangles.iter().map(weights).collect(),
            stiffness: vec![1.0; rest.triangles.len()],
            factor: Mutex::new(None),
        }
    }

    /// Of each triangle.
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Takes another stiffness of each triangle.
    pub fn set_stiffness(&mut self, per_triangle: &[f64]) {
        self.stiffness = per_triangle.to_vec();
        self.factor = Mutex::new(None);
    }

    /// The energy with each triangle turned as fits best.
    pub fn strain(&self, rest: &Surface, positions: &[Point]) -> f64 {
        let turns = turns(rest, positions);
        let mut sum = 0.0;
        self.edges(rest, &turns, |[i, j], w, wanted| {
            sum += w * (positions[i] - positions[j] - wanted).norm_squared();
        });
        sum
    }

    /// Positions of the vertices that make the energy under `turns` and the pulls together least.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn positions(
        &self,
        rest: &Surface,
        turns: &[Turn],
        held: &Held,
    ) -> Result<Vec<Point>, SolveError> {
        let numbers = numbers(&held.places);
        let free = numbers.iter().flatten().count();
        let mut right = vec![Vector::zeros(); free];
        let ridge = self.ridge(rest);
        for (number, x) in numbers.iter().zip(&rest.positions) {
            if let Some(n) = number {
                right[*n] += ridge * x.coords;
            }
        }
        let mut ask = |terms: &[(usize, f64)], weight: f64, target: Vector| {
            let kept = terms
                .iter()
                .filter_map(|(v, t)| Some(*t * held.places[*v]?.coords));
            let left = target - kept.sum::<Vector>();
            for (v, t) in terms {
                if let Some(n) = numbers[*v] {
                    right[n] += weight * *t * left;
                }
            }
        };
        self.edges(rest, turns, |[i, j], w, wanted| {
            ask(&[(i, 1.0), (j, -1.0)], w, wanted)
        });
        for pull in &held.pulls {
            ask(&terms(rest, pull), pull.weight, pull.target.coords);
        }
        let mut solved = [vec![0.0; free], vec![0.0; free]];
        if free > 0 {
            let mut factor = self
                .factor
                .lock()
                .unwrap_or_else(std::sync::PoisonError::into_inner);
            let key = held.key();
            if factor.as_ref().is_none_or(|(known, _)| *known != key) {
                *factor = Some((key, self.matrix(rest, held, &numbers, free)?));
            }
            if let Some((_, matrix)) = factor.as_mut() {
                for (axis, x) in solved.iter_mut().enumerate() {
                    *x = right.iter().map(|b| b[axis]).collect();
                    matrix.solve(x)?;
                }
            }
        }
        let at = |(number, kept): (&Option<usize>, &Option<Point>)| {
            let moved = number.map(|n| Point::new(solved[0][n], solved[1][n], 0.0));
            moved.or(*kept).unwrap_or_else(Point::origin)
        };
        Ok(numbers.iter().zip(&held.places).map(at).collect())
    }

    /// The matrix of `free` vertices, by their `numbers`.
    fn matrix(
        &self,
        rest: &Surface,
        held: &Held,
        numbers: &[Option<usize>],
        free: usize,
    ) -> Result<Factorized, SolveError> {
        let mut entries = Entries::default();
        let mut add = |terms: &[(usize, f64)], weight: f64| {
            let own = terms.iter().filter_map(|(v, t)| Some((numbers[*v]?, *t)));
            entries.add_square(&own.collect::<Vec<_>>(), weight);
        };
        for (f, corners) in rest.triangles.iter().enumerate() {
            for k in 0..3 {
                let [i, j] = [1, 2].map(|d| corners[(k + d) % 3] as usize);
                add(
                    &[(i, 1.0), (j, -1.0)],
                    self.stiffness[f] * self.weights[f][k],
                );
            }
        }
        for pull in &held.pulls {
            add(&terms(rest, pull), pull.weight);
        }
        let ridge = self.ridge(rest);
        (0..free).for_each(|n| entries.add(n, n, ridge));
        entries.factorized(free)
    }

    fn ridge(&self, rest: &Surface) -> f64 {
        let all = self.weights.iter().zip(&self.stiffness);
        let sum: f64 = all.map(|(w, s)| 2.0 * s * w.iter().sum::<f64>()).sum();
        RIDGE * sum / rest.positions.len().max(1) as f64
    }

    /// Goes through the edges of all triangles: ends i and j, weight, and the turned edge x_i - x_j at rest.
    fn edges(&self, rest: &Surface, turns: &[Turn], mut each: impl FnMut([usize; 2], f64, Vector)) {
        for (f, (corners, turn)) in rest.triangles.iter().zip(turns).enumerate() {
            for k in 0..3 {
                let [i, j] = [1, 2].map(|d| corners[(k + d) % 3] as usize);
                let wanted = turn.apply(&(rest.positions[i] - rest.positions[j]));
                each([i, j], self.stiffness[f] * self.weights[f][k], wanted);
            }
        }
    }
}

/// The corners that carry a pull, those that do.
fn terms(rest: &Surface, pull: &Pull) -> Vec<(usize, f64)> {
    let corners = rest.triangles[pull.at.face as usize]
        .iter()
        .zip(pull.at.bary);
    let carrying = corners.filter(|(_, b)| *b != 0.0);
    carrying.map(|(&v, b)| (v as usize, b)).collect()
}

/// The numbers of vertices that are free to move.
fn numbers(places: &[Option<Point>]) -> Vec<Option<usize>> {
    let mut count = 0;
    let number = |place: &Option<Point>| {
        place.is_none().then(|| {
            count += 1;
            count - 1
        })
    };
    places.iter().map(number).collect()
}
