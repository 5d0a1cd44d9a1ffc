//! Deformation: points are pulled towards targets, the shape follows with as little change as
//! possible (section 4.2). Nothing here has heard of symmetry.

pub mod arap;
pub mod bridges;
pub mod carry;
pub mod control;
pub mod elastic;
pub mod harmonic;
pub mod igarashi;
pub mod laplacian;
pub mod params;
pub mod poisson;
pub mod primo;
pub mod regain;
pub mod relax;
pub mod smooth;
pub mod solver;
pub mod stiffness;

use crate::context::Context;
use crate::deform::solver::SolveError;
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::{Surface, SurfacePoint};

pub use arap::Arap;
pub use carry::carry;
pub use control::control_mesh;
pub use igarashi::Igarashi;
pub use params::{DeformParams, Model};
pub use primo::Primo;
pub use relax::relax;
pub use stiffness::Stiffness;

/// A soft positional constraint at a point of the rest surface.
#[derive(Debug, Clone, Copy)]
pub struct Pull {
    /// Which point of the surface.
    pub at: SurfacePoint,
    /// Where it should go, working coordinates.
    pub target: Point,
    /// Weight w of w |x - target|^2 against the deformation energy, dimensionless (area over
    /// squared stiffness length, docs/definitions.md).
    pub weight: f64,
}

/// Two points of the rest surface that are to lie opposite each other across the plane x = 0.
#[derive(Debug, Clone, Copy)]
pub struct Tie {
    /// One.
    pub p: SurfacePoint,
    /// The other.
    pub q: SurfacePoint,
    /// Weight of the squared distance, 1 as much as a vertex's edges.
    pub weight: f64,
}

/// What a call to [`Deformer::deform`] did.
#[derive(Debug, Clone, Copy)]
pub struct Deformed {
    /// Deformation energy after the call, see [`Deformer::energy`].
    pub energy: f64,
    /// rms motion of the pulled points during the call, fraction of L.
    pub motion: f64,
}

/// A shape that resists deformation. The rest shape never changes, so the energy always measures
/// the deviation from the input.
pub trait Deformer {
    /// One step towards the targets of `pulls`.
    ///
    /// # Errors
    /// [`crate::Error::Numerical`] where the system cannot be solved, [`crate::Error::Cancelled`].
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed>;

    /// Stiffness of each face of the rest surface, as a multiple of the default (1).
    ///
    /// # Errors
    /// [`crate::Error::Params`] for a wrong count or a value that is not positive and finite.
    fn set_stiffness(&mut self, per_face: &[f64]) -> Result<()>;

    /// Faces of the rest surface that must not move.
    ///
    /// # Errors
    /// [`crate::Error::Params`] for a wrong count.
    fn set_fixed(&mut self, faces: &[bool]) -> Result<()>;

    /// The energy per area: about the mean square strain (0.01 is 10 % stretch everywhere),
    /// dimensionless, 0 under rigid motion.
    fn energy(&self) -> f64;

    /// The energy with the surface's vertices at `positions`, its elements following them as well as they can.
    fn energy_at(&self, positions: &[Point]) -> f64;

    /// Vertex positions of the surface as it is deformed now.
    fn positions(&self) -> Vec<Point>;

    /// Where points of the surface are now, without computing the rest of it.
    fn places(&self, at: &[SurfacePoint]) -> Vec<Point>;

    /// The deformation as a value that [`Deformer::restore`] takes.
    fn state(&self) -> State;

    /// Goes back to an earlier state of the same deformer.
    fn restore(&mut self, state: &State);

    /// The rest surface.
    fn rest(&self) -> &Surface;
}

/// A deformer's state, a rigid motion for each of its elements; only a deformer of the same kind over the
/// same surface takes it.
#[derive(Debug, Clone)]
pub struct State(Vec<elastic::Motion>);

/// The deformer that `params` name, over `rest`.
///
/// # Errors
/// [`Error::Params`], [`Error::Numerical`].
pub fn deformer(rest: &Surface, params: &DeformParams) -> Result<Box<dyn Deformer>> {
    Ok(match params.model {
        Model::Primo => Box::new(Primo::new(rest, params)?),
        Model::Arap => Box::new(Arap::new(rest, params)?),
    })
}

fn check_pulls(pulls: &[Pull], step: usize) -> Result<()> {
    let bad = |p: &Pull| {
        !p.target.iter().all(|c| c.is_finite()) || !p.weight.is_finite() || p.weight < 0.0
    };
    if pulls.iter().any(bad) {
        return Err(failure(SolveError::Inaccurate, step));
    }
    Ok(())
}

fn check_stiffness(per_face: &[f64], rest: &Surface) -> Result<()> {
    if per_face.len() != rest.triangles.len() {
        return Err(Error::params("stiffness", "needs one value for each face"));
    }
    if !per_face.iter().all(|k| k.is_finite() && *k > 0.0) {
        return Err(Error::params("stiffness", "must be positive and finite"));
    }
    Ok(())
}

fn failure(e: SolveError, step: usize) -> Error {
    let what = match e {
        SolveError::NotPositiveDefinite => "the deformation system is singular",
        SolveError::Inaccurate => "the deformation targets are not finite or cannot be met",
        SolveError::Setup => "the deformation system could not be set up",
    };
    Error::Numerical {
        stage: "deform",
        step,
        what: what.into(),
    }
}
