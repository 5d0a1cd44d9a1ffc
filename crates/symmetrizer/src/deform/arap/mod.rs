//! As rigid as possible with smooth rotations (Sorkine & Alexa 2007, Levi & Gotsman 2015): a rotation
//! for each vertex, neighbours' rotations alike. Beside PriMo the fast way, and an independent check.
//!
//! E = c sum over edges k_ij ( |x_ij - R_i p_ij|^2 / 2 + |x_ij - R_j p_ij|^2 / 2 + a |R_i - R_j|^2 ), minimised
//! by turns: rotations for given positions, vertex by vertex; positions for given rotations, one linear
//! system whose matrix stays. a = h^2 / 6 gives the plate that PriMo's prisms of half height h are.

pub mod rotation;
pub mod system;

use std::collections::BTreeMap;

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::bridges::bridges;
use crate::deform::laplacian::edge_weights;
use crate::deform::params::DeformParams;
use crate::deform::{Deformed, Deformer, Pull, State, check_pulls, check_stiffness, failure};
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector};
use crate::shape::{Surface, SurfacePoint};
use rotation::nearest_rotation;
use system::EdgeSystem;

/// c: what makes the energy of a stretched sheet that of PriMo's prisms, whose pair weights
/// |e|^2 / (A_i + A_j) are two thirds of the dual edges' cotangents on equilateral triangles.
const MEMBRANE: f64 = 2.0 / 3.0;
/// Turns of rotations and positions in one call.
const TURNS: usize = 3;
/// Sweeps over the rotations in each turn: neighbours follow each other only slowly.
const SWEEPS: usize = 3;
/// Weight k_ij of the edge that ties a separate component to its nearest neighbour.
const BRIDGE: f64 = 0.1;

/// The deformer over a rest surface.
pub struct Arap {
    rest: Surface,
    system: EdgeSystem,
    ties: Vec<[u32; 2]>,
    positions: Vec<Point>,
    rotations: Vec<Matrix3>,
    /// a.
    smoothing: f64,
    steps: usize,
}

impl Arap {
    /// The deformer of `rest` in its rest shape.
    ///
    /// # Errors
    /// [`Error::Params`] for lengths that are not positive, [`Error::Numerical`].
    pub fn new(rest: &Surface, params: &DeformParams) -> Result<Self> {
        params.check()?;
        let mut weights = edge_weights(rest, None);
        let ties = bridges(&rest.positions, weights.keys().map(|&(u, v)| [u, v]));
        tie(&mut weights, &ties);
        Ok(Self {
            system: EdgeSystem::new(rest, &weights).map_err(|e| failure(e, 0))?,
            ties,
            positions: rest.positions.clone(),
            rotations: vec![Matrix3::identity(); rest.positions.len()],
            smoothing: params.half_height * params.half_height / 6.0,
            rest: rest.clone(),
            steps: 0,
        })
    }

    /// Each vertex's best rotation beside its neighbours' present ones.
    fn turn(&mut self) {
        let rest = &self.rest.positions;
        self.rotations = (0..rest.len())
            .into_par_iter()
            .with_min_len(256)
            .map(|i| {
                let mut m = Matrix3::zeros();
                for &(e, j) in self.system.around(i) {
                    let (k, j) = (self.system.weights()[e as usize], j as usize);
                    let (x, p) = (self.positions[i] - self.positions[j], rest[i] - rest[j]);
                    m += k * (x * p.transpose() + 2.0 * self.smoothing * self.rotations[j]);
                }
                nearest_rotation(&m, &self.rotations[i])
            })
            .collect();
    }

    fn place(&self, at: &SurfacePoint) -> Point {
        let corners = self.rest.triangles[at.face as usize];
        let x = |(v, b): (u32, f64)| self.positions[v as usize].coords * b;
        Point::from(corners.into_iter().zip(at.bary).map(x).sum::<Vector>())
    }
}

fn tie(weights: &mut BTreeMap<(u32, u32), f64>, ties: &[[u32; 2]]) {
    for &[i, j] in ties {
        weights.insert((i.min(j), i.max(j)), BRIDGE);
    }
}

impl Deformer for Arap {
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed> {
        ctx.check()?;
        check_pulls(pulls, self.steps)?;
        let before = self.places(&pulls.iter().map(|p| p.at).collect::<Vec<_>>());
        for _ in 0..TURNS {
            let ways = self
                .system
                .ways(
                    &self.rest,
                    &self.rotations,
                    pulls,
                    MEMBRANE,
                    &self.positions,
                )
                .map_err(|e| failure(e, self.steps))?;
            self.positions
                .iter_mut()
                .zip(&ways)
                .for_each(|(x, way)| *x += way);
            for _ in 0..SWEEPS {
                self.turn();
            }
        }
        self.steps += 1;
        let moved = pulls.iter().zip(&before);
        let moved: f64 = moved
            .map(|(p, x)| (self.place(&p.at) - x).norm_squared())
            .sum();
        Ok(Deformed {
            energy: self.energy(),
            motion: (moved / pulls.len().max(1) as f64).sqrt(),
        })
    }

    fn set_stiffness(&mut self, per_face: &[f64]) -> Result<()> {
        check_stiffness(per_face, &self.rest)?;
        let mut weights = edge_weights(&self.rest, Some(per_face));
        tie(&mut weights, &self.ties);
        self.system.set_weights(&weights);
        Ok(())
    }

    fn set_fixed(&mut self, faces: &[bool]) -> Result<()> {
        if faces.len() != self.rest.triangles.len() {
            return Err(Error::params("fixed", "needs one value for each face"));
        }
        let mut fixed = vec![false; self.positions.len()];
        for (corners, _) in self.rest.triangles.iter().zip(faces).filter(|(_, f)| **f) {
            for &v in corners {
                fixed[v as usize] = true;
            }
        }
        self.system.set_fixed(fixed);
        Ok(())
    }

    fn energy(&self) -> f64 {
        let rest = &self.rest.positions;
        let edges = self.system.edges().par_iter().zip(self.system.weights());
        let each: Vec<f64> = edges
            .map(|(&[i, j], k)| {
                let (i, j) = (i as usize, j as usize);
                let (x, p) = (self.positions[i] - self.positions[j], rest[i] - rest[j]);
                let (r_i, r_j) = (&self.rotations[i], &self.rotations[j]);
                let strain = (x - r_i * p).norm_squared() + (x - r_j * p).norm_squared();
                k * (0.5 * strain + self.smoothing * (r_i - r_j).norm_squared())
            })
            .collect();
        MEMBRANE * each.iter().sum::<f64>() / self.rest.area()
    }

    fn positions(&self) -> Vec<Point> {
        self.positions.clone()
    }

    fn places(&self, at: &[SurfacePoint]) -> Vec<Point> {
        at.par_iter().map(|at| self.place(at)).collect()
    }

    fn state(&self) -> State {
        State::Vertices(self.positions.clone(), self.rotations.clone())
    }

    fn restore(&mut self, state: &State) {
        if let State::Vertices(positions, rotations) = state {
            self.positions.clone_from(positions);
            self.rotations.clone_from(rotations);
        }
    }

    fn rest(&self) -> &Surface {
        &self.rest
    }
}
