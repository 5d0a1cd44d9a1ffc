//! Elements and springs: energy and Gauss-Newton step.

use rayon::prelude::*;

use crate::deform::elastic::motion::Motion;
use crate::deform::solver::{Coupling, SolveError, Solver, System, Twist, solver};
use crate::geom::{Matrix3, Point, Vector};

/// A point that several elements carry together, pulled towards a target.
#[derive(Debug, Clone)]
pub struct Pulled {
    /// The elements' shares of it, which sum to 1.
    pub shares: Vec<Share>,
    /// Its target.
    pub target: Point,
    /// Weight of the squared distance.
    pub weight: f64,
}

/// What one element has in a point.
#[derive(Debug, Clone, Copy)]
pub struct Share {
    /// Which element.
    pub element: u32,
    /// How much of the point it carries.
    pub share: f64,
    /// The element's point at rest.
    pub rest: Point,
}

impl Pulled {
    /// Where the point is.
    pub fn place(&self, motions: &[Motion]) -> Point {
        let carried = |s: &Share| motions[s.element as usize].apply(&s.rest).coords * s.share;
        Point::from(self.shares.iter().map(carried).sum::<Vector>())
    }
}

/// What holds two elements together.
pub trait Spring: Send + Sync {
    /// The two elements.
    fn ends(&self) -> [usize; 2];
    /// Its weight, stiffness included.
    fn weight(&self) -> f64;
    /// Gives it another weight.
    fn set_weight(&mut self, weight: f64);
    /// Its energy with its weight.
    fn energy(&self, motions: &[Motion]) -> f64;
    /// Its Gauss-Newton blocks about the elements' present centres.
    fn blocks(&self, motions: &[Motion]) -> Blocks;
}

/// The Hessian blocks and gradients of one spring under Gauss-Newton, of half the energy.
pub struct Blocks {
    /// H_ii, H_jj, H_ij.
    pub hessian: [Coupling; 3],
    /// g_i, g_j.
    pub gradient: [Twist; 2],
}

/// Elements and their motions.
pub struct Elements<S> {
    springs: Vec<S>,
    /// Weights before stiffness.
    base_weights: Vec<f64>,
    /// The present motion of each element.
    pub motions: Vec<Motion>,
    fixed: Vec<bool>,
    solver: Box<dyn Solver>,
}

/// Share of the mean diagonal that is added to it: parts that nothing holds stay where they are.
const RIDGE: f64 = 1e-7;

impl<S: Spring> Elements<S> {
    /// Elements at rest about `centers`.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(centers: &[Point], springs: Vec<S>) -> Result<Self, SolveError> {
        let pairs: Vec<[u32; 2]> = springs.iter().map(|s| s.ends().map(|i| i as u32)).collect();
        Ok(Self {
            base_weights: springs.iter().map(Spring::weight).collect(),
            fixed: vec![false; centers.len()],
            springs,
            motions: centers.iter().map(|c| Motion::rest(*c)).collect(),
            solver: solver(centers.len(), &pairs)?,
        })
    }

    /// Sets each element's stiffness; a spring takes the harmonic mean of its two.
    pub fn set_stiffness(&mut self, k: &[f64]) {
        for (spring, base) in self.springs.iter_mut().zip(&self.base_weights) {
            let [a, b] = spring.ends().map(|i| k[i]);
            spring.set_weight(base * 2.0 * a * b / (a + b));
        }
    }

    /// Sets which elements must not move.
    pub fn set_fixed(&mut self, fixed: Vec<bool>) {
        self.fixed = fixed;
    }

    /// The elastic energy at the present motions, L^2.
    pub fn energy(&self) -> f64 {
        self.energy_at(&self.motions)
    }

    /// The elastic energy at other motions, L^2.
    pub fn energy_at(&self, motions: &[Motion]) -> f64 {
        self.springs.iter().map(|s| s.energy(motions)).sum()
    }

    /// One Gauss-Newton step with backtracking on elastic energy plus pulls.
    ///
    /// # Errors
    /// [`SolveError`].
    pub fn step(&mut self, pulls: &[Pulled]) -> Result<(), SolveError> {
        let twists = self.gauss_newton(pulls)?;
        let total = |motions: &[Motion]| self.energy_at(motions) + pull_energy(motions, pulls);
        let before = total(&self.motions);
        let mut fraction = 1.0;
        for _ in 0..8 {
            let trial: Vec<Motion> = self
                .motions
                .iter()
                .zip(&twists)
                .map(|(m, twist)| m.moved(&(twist * fraction)))
                .collect();
            if total(&trial) <= before {
                self.motions = trial;
                return Ok(());
            }
            fraction /= 2.0;
        }
        // No descent left: the present motions are a minimum to rounding.
        Ok(())
    }

    /// Solves H delta = -g.
    fn gauss_newton(&mut self, pulls: &[Pulled]) -> Result<Vec<Twist>, SolveError> {
        let n = self.motions.len();
        let mut system = System {
            centers: self.motions.iter().map(|m| m.center).collect(),
            diagonal: vec![Coupling::zero(); n],
            ridge: 0.0,
            between: Vec::with_capacity(self.springs.len()),
            fixed: self.fixed.clone(),
        };
        let mut gradient = vec![Twist::zeros(); n];
        let blocks: Vec<Blocks> = self
            .springs
            .par_iter()
            .map(|s| s.blocks(&self.motions))
            .collect();
        for (spring, blocks) in self.springs.iter().zip(blocks) {
            let ([i, j], [h_ii, h_jj, h_ij]) = (spring.ends(), blocks.hessian);
            system.diagonal[i] += h_ii;
            system.diagonal[j] += h_jj;
            system.between.push(h_ij);
            gradient[i] += blocks.gradient[0];
            gradient[j] += blocks.gradient[1];
        }
        for pull in pulls {
            // A Hessian of its own for each element that carries the point is an upper bound, so the
            // step is safe; at rest the forces are those of the point itself.
            let force = pull.weight * (pull.place(&self.motions) - pull.target);
            for s in &pull.shares {
                let element = s.element as usize;
                let m = &self.motions[element];
                let (y, f) = (m.apply(&s.rest) - m.center, s.share * force);
                let w = s.share * pull.weight;
                system.diagonal[element] += Coupling::new(w, &Matrix3::zeros(), &y, &y);
                let torque = y.cross(&f);
                gradient[element] += Twist::new(torque.x, torque.y, torque.z, f.x, f.y, f.z);
            }
        }
        let trace: f64 = system.diagonal.iter().map(Coupling::trace).sum();
        system.ridge = (RIDGE * trace / (6 * n) as f64).max(f64::MIN_POSITIVE);
        let b: Vec<Twist> = gradient
            .iter()
            .zip(&self.fixed)
            .map(|(g, fixed)| if *fixed { Twist::zeros() } else { -g })
            .collect();
        if b.iter().all(|g| *g == Twist::zeros()) {
            return Ok(b);
        }
        self.solver.solve(&system, &b)
    }
}

fn pull_energy(motions: &[Motion], pulls: &[Pulled]) -> f64 {
    let energy = |p: &Pulled| p.weight * (p.place(motions) - p.target).norm_squared();
    pulls.iter().map(energy).sum()
}
