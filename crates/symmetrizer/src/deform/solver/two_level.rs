//! Conjugate gradients with a two-level preconditioner: pieces of neighbouring elements that move as
//! rigid bodies, factorised, between damped block Jacobi steps.
//!
//! Smooth deformations move neighbours alike, so the pieces catch what Jacobi steps are slow at; a
//! piece that moves rigidly strains only the joints to its neighbours.

use nalgebra::Matrix6;
use rayon::prelude::*;

use crate::deform::solver::aggregate::aggregates;
use crate::deform::solver::coupling::{Coupling, Twist};
use crate::deform::solver::direct::Direct;
use crate::deform::solver::system::{Rows, System, dot};
use crate::deform::solver::{SolveError, Solver};
use crate::geom::{Point, Vector};

/// Elements in a piece; ours: 12 to 90 took about as long on the bunny.
const PIECE: usize = 24;
/// Damping of the Jacobi steps.
const DAMPING: f64 = 0.6;
/// |A x - b| / |b| at which iterations end: a Gauss-Newton step is itself no more exact, the next takes up
/// what is left.
const ENOUGH: f64 = 1e-2;
/// Iterations at the most.
const ITERATIONS: usize = 300;

/// The solver with what it keeps from one system to the next.
pub struct TwoLevel {
    rows: Rows,
    pairs: Vec<[u32; 2]>,
    piece: Vec<u32>,
    pieces: usize,
    coarse: Direct,
    /// For each pair its place among the pairs of the coarse system; `None` within a piece.
    coarse_pair: Vec<Option<u32>>,
    coarse_pairs: Vec<[u32; 2]>,
}

/// A system made ready for iterations.
struct Ready<'a> {
    system: &'a System,
    inverse: Vec<Matrix6<f64>>,
    /// From each element's piece's centre to its own.
    arms: Vec<Vector>,
}

impl TwoLevel {
    /// For systems of `count` elements over these pairs.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(count: usize, pairs: &[[u32; 2]]) -> Result<Self, SolveError> {
        let rows = Rows::new(count, pairs);
        let (piece, pieces) = aggregates(count, &rows, PIECE);
        let of = |&[i, j]: &[u32; 2]| {
            let (a, b) = (piece[i as usize], piece[j as usize]);
            (a != b).then_some([a.min(b), a.max(b)])
        };
        let across: Vec<Option<[u32; 2]>> = pairs.iter().map(of).collect();
        let mut coarse_pairs: Vec<[u32; 2]> = across.iter().flatten().copied().collect();
        coarse_pairs.sort_unstable();
        coarse_pairs.dedup();
        let index = |p: [u32; 2]| coarse_pairs.binary_search(&p).ok().map(|k| k as u32);
        let coarse_pair = across.iter().map(|p| p.and_then(index)).collect();
        Ok(Self {
            coarse: Direct::new(pieces, &coarse_pairs)?,
            rows,
            pairs: pairs.to_vec(),
            piece,
            pieces,
            coarse_pair,
            coarse_pairs,
        })
    }

    /// The system of the pieces: P^T A P with P the rigid motions of the pieces.
    fn coarsened(&self, system: &System, centers: &[Point], arms: &[Vector]) -> System {
        let mut coarse = System {
            centers: centers.to_vec(),
            diagonal: vec![Coupling::zero(); self.pieces],
            ridge: 0.0,
            between: vec![Coupling::zero(); self.coarse_pairs.len()],
            fixed: vec![true; self.pieces],
        };
        for (i, block) in system.diagonal.iter().enumerate() {
            if !system.fixed[i] {
                let a = self.piece[i] as usize;
                let mut own = *block;
                own += Coupling::new(
                    system.ridge,
                    &Default::default(),
                    &Vector::zeros(),
                    &Vector::zeros(),
                );
                coarse.diagonal[a] += own.shifted(&arms[i], &arms[i]);
                coarse.fixed[a] = false;
            }
        }
        for ((&[i, j], block), place) in self
            .pairs
            .iter()
            .zip(&system.between)
            .zip(&self.coarse_pair)
        {
            let (i, j) = (i as usize, j as usize);
            if system.fixed[i] || system.fixed[j] {
                continue;
            }
            let (a, b) = (self.piece[i], self.piece[j]);
            let block = block.shifted(&arms[i], &arms[j]);
            match place {
                None => {
                    coarse.diagonal[a as usize] += block;
                    coarse.diagonal[a as usize] += block.transposed();
                }
                Some(k) if a < b => coarse.between[*k as usize] += block,
                Some(k) => coarse.between[*k as usize] += block.transposed(),
            }
        }
        let mean = coarse.diagonal.iter().map(Coupling::trace).sum::<f64>()
            / (6 * self.pieces.max(1)) as f64;
        coarse.ridge = (COARSE_RIDGE * mean).max(f64::MIN_POSITIVE);
        coarse
    }

    fn ready<'a>(&mut self, system: &'a System) -> Result<Ready<'a>, SolveError> {
        let mut centers = vec![Vector::zeros(); self.pieces];
        let mut counts = vec![0.0; self.pieces];
        for (&a, c) in self.piece.iter().zip(&system.centers) {
            centers[a as usize] += c.coords;
            counts[a as usize] += 1.0;
        }
        let centers: Vec<Point> = centers
            .iter()
            .zip(&counts)
            .map(|(c, n)| Point::from(c / *n))
            .collect();
        let arms: Vec<Vector> = self
            .piece
            .iter()
            .zip(&system.centers)
            .map(|(&a, c)| c - centers[a as usize])
            .collect();
        self.coarse
            .factorize(&self.coarsened(system, &centers, &arms))?;
        let inverse = system
            .diagonal
            .par_iter()
            .zip(&system.fixed)
            .map(|(block, fixed)| {
                if *fixed {
                    return Some(Matrix6::identity());
                }
                let full = block.matrix() + Matrix6::identity() * system.ridge;
                full.cholesky().map(|c| c.inverse())
            })
            .collect::<Option<Vec<_>>>()
            .ok_or(SolveError::NotPositiveDefinite)?;
        Ok(Ready {
            system,
            inverse,
            arms,
        })
    }

    /// One Jacobi step, the pieces, one Jacobi step: symmetric, so conjugate gradients may use it.
    fn precondition(&mut self, ready: &Ready<'_>, r: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        let mut z: Vec<Twist> = jacobi(ready, r);
        let left = minus(r, &ready.system.apply(&self.rows, &z));
        add(&mut z, &self.by_pieces(ready, &left)?);
        let left = minus(r, &ready.system.apply(&self.rows, &z));
        add(&mut z, &jacobi(ready, &left));
        Ok(z)
    }

    /// P (P^T A P)^-1 P^T r.
    fn by_pieces(&mut self, ready: &Ready<'_>, r: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        let mut b = vec![Twist::zeros(); self.pieces];
        for (i, r) in r.iter().enumerate() {
            if ready.system.fixed[i] {
                continue;
            }
            let (torque, force) = halves(r);
            b[self.piece[i] as usize] += join(&(torque + ready.arms[i].cross(&force)), &force);
        }
        let moved = self.coarse.solve_factorized(&b)?;
        let carried = |(i, arm): (usize, &Vector)| {
            if ready.system.fixed[i] {
                return Twist::zeros();
            }
            let (omega, v) = halves(&moved[self.piece[i] as usize]);
            join(&omega, &(v + omega.cross(arm)))
        };
        Ok(ready.arms.par_iter().enumerate().map(carried).collect())
    }

    /// Conjugate gradients from rest.
    ///
    /// # Errors
    /// [`SolveError::Inaccurate`] where they do not come near enough in time.
    fn iterate(&mut self, system: &System, b: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        let ready = self.ready(system)?;
        let mut x = vec![Twist::zeros(); b.len()];
        let mut r = b.to_vec();
        let mut z = self.precondition(&ready, &r)?;
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        let goal = ENOUGH * ENOUGH * dot(b, b);
        for _ in 0..ITERATIONS {
            if dot(&r, &r) <= goal {
                return Ok(x);
            }
            let q = system.apply(&self.rows, &p);
            let alpha = rz / dot(&p, &q);
            if !alpha.is_finite() {
                return Err(SolveError::NotPositiveDefinite);
            }
            x.par_iter_mut().zip(&p).for_each(|(x, p)| *x += alpha * p);
            r.par_iter_mut().zip(&q).for_each(|(r, q)| *r -= alpha * q);
            z = self.precondition(&ready, &r)?;
            let next = dot(&r, &z);
            let beta = next / rz;
            rz = next;
            p.par_iter_mut()
                .zip(&z)
                .for_each(|(p, z)| *p = z + beta * *p);
        }
        Err(SolveError::Inaccurate)
    }
}

/// Share of the mean diagonal that is added to the pieces' system.
const COARSE_RIDGE: f64 = 1e-9;

impl Solver for TwoLevel {
    fn solve(&mut self, system: &System, b: &[Twist]) -> Result<Vec<Twist>, SolveError> {
        match self.iterate(system, b) {
            // Slivers among stiff parts can be too much for iterations; factorising is slow but sure.
            Err(_) => Direct::new(system.centers.len(), &self.pairs)?.solve(system, b),
            solved => solved,
        }
    }
}

fn jacobi(ready: &Ready<'_>, r: &[Twist]) -> Vec<Twist> {
    let step = |(inverse, r): (&Matrix6<f64>, &Twist)| DAMPING * (inverse * r);
    ready
        .inverse
        .par_iter()
        .zip(r)
        .with_min_len(512)
        .map(step)
        .collect()
}

fn minus(a: &[Twist], b: &[Twist]) -> Vec<Twist> {
    a.par_iter()
        .zip(b)
        .with_min_len(512)
        .map(|(a, b)| a - b)
        .collect()
}

fn add(a: &mut [Twist], b: &[Twist]) {
    a.par_iter_mut()
        .zip(b)
        .with_min_len(512)
        .for_each(|(a, b)| *a += b);
}

fn halves(t: &Twist) -> (Vector, Vector) {
    (Vector::new(t[0], t[1], t[2]), Vector::new(t[3], t[4], t[5]))
}

fn join(omega: &Vector, v: &Vector) -> Twist {
    Twist::new(omega.x, omega.y, omega.z, v.x, v.y, v.z)
}
