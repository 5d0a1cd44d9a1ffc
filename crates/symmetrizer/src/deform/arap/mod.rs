//! As rigid as possible with smooth rotations (Sorkine & Alexa 2007, Levi & Gotsman 2015): a rotation
//! for each vertex, neighbours' rotations alike. Beside PriMo the fast way, and an independent check.
//!
//! E = c sum over edges k_ij ( |x_ij - R_i p_ij|^2 / 2 + |x_ij - R_j p_ij|^2 / 2 + a |R_i - R_j|^2 ). a = h^2 / 6
//! gives the plate that PriMo's prisms of half height h are. Minimised by Gauss-Newton over positions and
//! rotations at once: by turns, as usual, it takes dozens of rounds where this takes one or two steps
//! (decision 0015).

pub mod rod;

use crate::deform::bridges::bridges;
use crate::deform::control::control_mesh;
use crate::deform::elastic::{Binding, Body, Elements, Sites};
use crate::deform::failure;
use crate::deform::laplacian::edge_weights;
use crate::deform::params::DeformParams;
use crate::error::Result;
use crate::shape::Surface;
use rod::Rod;

/// The as-rigid-as-possible deformer.
pub type Arap = Body<Rod>;

/// c: what makes the energy of a stretched sheet that of PriMo's prisms, whose pair weights
/// |e|^2 / (A_i + A_j) are two thirds of the dual edges' cotangents on equilateral triangles.
const MEMBRANE: f64 = 2.0 / 3.0;
/// Weight k_ij of the rod that ties a separate component to its nearest neighbour.
const BRIDGE: f64 = 0.1;

impl Arap {
    /// Rods along the edges of a control mesh of `rest`.
    ///
    /// # Errors
    /// [`crate::Error::Params`] for lengths that are not positive, [`crate::Error::Numerical`].
    pub fn new(rest: &Surface, params: &DeformParams) -> Result<Self> {
        params.check()?;
        let control = control_mesh(rest, params.control_faces)?;
        let binding = if control.triangles.len() == rest.triangles.len() {
            Binding::own(rest)
        } else {
            Binding::within_reach(rest, &control, &Sites::vertices(&control))
        };
        let weights = edge_weights(&control, None);
        let ties = bridges(&control.positions, weights.keys().map(|&(u, v)| [u, v]));
        let ties = ties.iter().map(|&[i, j]| ((i, j), BRIDGE));
        let rods = weights.into_iter().chain(ties).map(|((i, j), k)| Rod {
            i: i as usize,
            j: j as usize,
            weight: MEMBRANE * k,
            smoothing: params.half_height * params.half_height / 6.0,
        });
        let rods = Elements::new(&control.positions, rods.collect()).map_err(|e| failure(e, 0))?;
        Ok(Self::over(rest, binding, rods))
    }
}
