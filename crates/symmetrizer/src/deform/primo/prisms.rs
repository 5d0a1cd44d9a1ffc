//! Rigid prisms over the faces of a surface, joined elastically: energy and Gauss-Newton step.

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::deform::bridges::bridges;
use crate::deform::primo::joint::{Joint, gauss_points};
use crate::deform::primo::motion::Motion;
use crate::deform::solver::{Coupling, SolveError, Solver, System, Twist, solver};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::Surface;

/// A point that several prisms carry together, pulled towards a target.
#[derive(Debug, Clone)]
pub struct Pulled {
    /// The prisms' shares of it, which sum to 1.
    pub shares: Vec<Share>,
    /// Its target.
    pub target: Point,
    /// Weight of the squared distance.
    pub weight: f64,
}

/// What one prism has in a point.
#[derive(Debug, Clone, Copy)]
pub struct Share {
    /// Which prism.
    pub prism: u32,
    /// How much of the point it carries.
    pub share: f64,
    /// The prism's point at rest.
    pub rest: Point,
}

impl Pulled {
    /// Where the point is.
    pub fn place(&self, motions: &[Motion]) -> Point {
        let carried = |s: &Share| motions[s.prism as usize].apply(&s.rest).coords * s.share;
        Point::from(self.shares.iter().map(carried).sum::<Vector>())
    }
}

/// The prisms of a surface and their motions.
pub struct Prisms {
    joints: Vec<Joint>,
    /// Joint weights before stiffness.
    base_weights: Vec<f64>,
    /// The present motion of each prism.
    pub motions: Vec<Motion>,
    fixed: Vec<bool>,
    solver: Box<dyn Solver>,
}

/// Pair weights |e|^2 / (A_i + A_j) are clamped to this range: slivers would else lock or tear
/// (ours).
const WEIGHT_RANGE: (f64, f64) = (1e-3, 50.0);

/// Weight of the joint that ties a separate component to its nearest neighbour, beside 1 to 3 for
/// an ordinary edge.
const BRIDGE_WEIGHT: f64 = 0.1;

/// Share of the mean diagonal that is added to it: parts that nothing holds stay where they are.
const RIDGE: f64 = 1e-7;

impl Prisms {
    /// Prisms of half height `h` (fraction of L) over `surface`.
    ///
    /// # Errors
    /// [`SolveError::Setup`].
    pub fn new(surface: &Surface, h: f64) -> Result<Self, SolveError> {
        let mut joints = edge_joints(surface, h);
        let centers: Vec<Point> = (0..surface.triangles.len() as u32)
            .map(|f| center(surface, f))
            .collect();
        let ties = bridges(&centers, joints.iter().map(|j| [j.i as u32, j.j as u32]));
        joints.extend(
            ties.iter()
                .map(|&[i, j]| tie(surface, &centers, i as usize, j as usize)),
        );
        let pairs: Vec<[u32; 2]> = joints.iter().map(|j| [j.i as u32, j.j as u32]).collect();
        let motions = centers.into_iter().map(Motion::rest).collect();
        Ok(Self {
            base_weights: joints.iter().map(|j| j.weight).collect(),
            fixed: vec![false; surface.triangles.len()],
            joints,
            motions,
            solver: solver(surface.triangles.len(), &pairs)?,
        })
    }

    /// Sets each prism's stiffness; a joint takes the harmonic mean of its two.
    pub fn set_stiffness(&mut self, k: &[f64]) {
        for (joint, base) in self.joints.iter_mut().zip(&self.base_weights) {
            let (a, b) = (k[joint.i], k[joint.j]);
            joint.weight = base * 2.0 * a * b / (a + b);
        }
    }

    /// Sets which prisms must not move.
    pub fn set_fixed(&mut self, fixed: Vec<bool>) {
        self.fixed = fixed;
    }

    /// The elastic energy at the present motions, L^2.
    pub fn energy(&self) -> f64 {
        self.energy_at(&self.motions)
    }

    fn energy_at(&self, motions: &[Motion]) -> f64 {
        self.joints.iter().map(|j| j.energy(motions)).sum()
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
            between: Vec::with_capacity(self.joints.len()),
            fixed: self.fixed.clone(),
        };
        let mut gradient = vec![Twist::zeros(); n];
        let blocks: Vec<_> = self
            .joints
            .par_iter()
            .map(|j| j.blocks(&self.motions))
            .collect();
        for (joint, blocks) in self.joints.iter().zip(blocks) {
            let [h_ii, h_jj, h_ij] = blocks.hessian;
            system.diagonal[joint.i] += h_ii;
            system.diagonal[joint.j] += h_jj;
            system.between.push(h_ij);
            gradient[joint.i] += blocks.gradient[0];
            gradient[joint.j] += blocks.gradient[1];
        }
        for pull in pulls {
            // A Hessian of its own for each prism that carries the point is an upper bound, so the
            // step is safe; at rest the forces are those of the point itself.
            let force = pull.weight * (pull.place(&self.motions) - pull.target);
            for s in &pull.shares {
                let prism = s.prism as usize;
                let m = &self.motions[prism];
                let (y, f) = (m.apply(&s.rest) - m.center, s.share * force);
                let w = s.share * pull.weight;
                system.diagonal[prism] += Coupling::new(w, &Matrix3::zeros(), &y, &y);
                let torque = y.cross(&f);
                gradient[prism] += Twist::new(torque.x, torque.y, torque.z, f.x, f.y, f.z);
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

/// A joint for each pair of faces along an edge; where more than two meet, the first with each.
fn edge_joints(surface: &Surface, h: f64) -> Vec<Joint> {
    let mut faces_of_edge: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (f, &[a, b, c]) in surface.triangles.iter().enumerate() {
        for (u, v) in [(a, b), (b, c), (c, a)] {
            faces_of_edge
                .entry((u.min(v), u.max(v)))
                .or_default()
                .push(f);
        }
    }
    let mut joints = Vec::new();
    for ((u, v), faces) in faces_of_edge {
        let (a, b) = (u as usize, v as usize);
        let (x_a, x_b) = (surface.positions[a], surface.positions[b]);
        let (n_a, n_b) = (surface.vertex_normals[a], surface.vertex_normals[b]);
        for &j in &faces[1..] {
            let i = faces[0];
            let areas = surface.face_areas[i] + surface.face_areas[j];
            let w = ((x_b - x_a).norm_squared() / areas.max(f64::MIN_POSITIVE))
                .clamp(WEIGHT_RANGE.0, WEIGHT_RANGE.1);
            let points = gauss_points(&x_a, &x_b, &n_a, &n_b, h);
            joints.push(Joint::new(i, j, &points, w));
        }
    }
    joints
}

fn center(surface: &Surface, f: u32) -> Point {
    let [a, b, c] = surface.corners(f);
    Point::from((a.coords + b.coords + c.coords) / 3.0)
}

/// A soft joint between prisms of two components.
fn tie(surface: &Surface, centers: &[Point], i: usize, j: usize) -> Joint {
    let [a, b, c] = surface.corners(i as u32);
    let points = [a, b, c, nalgebra::center(&centers[i], &centers[j])];
    Joint::new(i, j, &points, BRIDGE_WEIGHT)
}
