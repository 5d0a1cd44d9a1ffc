//! PriMo (Botsch, Pauly, Gross, Kobbelt 2006): rigid prisms with elastic joints, on a control mesh
//! that carries the fine surface.

pub mod binding;
pub mod cage;
pub mod joint;
pub mod motion;
pub mod prisms;

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::solver::SolveError;
use crate::deform::{Deformed, Deformer, Pull, State};
use crate::error::{Error, Result};
use crate::geom::Point;
use crate::shape::{Surface, SurfacePoint};
use binding::Binding;
use prisms::{PrismPull, Prisms};

/// The deformation model's parameters.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeformParams {
    /// Stiffness length l, fraction of L: asymmetry on larger scales follows, smaller is kept by
    /// the shell. 0.05, docs/definitions.md.
    pub length: f64,
    /// Half height of the prisms, fraction of L: bending stiffness grows with its square. 0.02,
    /// ours (.005 gave spikes).
    pub half_height: f64,
    /// Faces of the control mesh. 4000, ours.
    pub control_faces: usize,
}

impl Default for DeformParams {
    fn default() -> Self {
        Self {
            length: 0.05,
            half_height: 0.02,
            control_faces: 4000,
        }
    }
}

/// The PriMo deformer over a rest surface.
pub struct Primo {
    rest: Surface,
    control: Surface,
    binding: Binding,
    prisms: Prisms,
    steps: usize,
}

impl Primo {
    /// Prisms over a control mesh of `rest`.
    ///
    /// # Errors
    /// [`Error::Params`] for lengths that are not positive, [`Error::Numerical`].
    pub fn new(rest: &Surface, params: &DeformParams) -> Result<Self> {
        for (name, value) in [
            ("deform.length", params.length),
            ("deform.half_height", params.half_height),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::params(name, "must be positive"));
            }
        }
        if params.control_faces < 100 {
            return Err(Error::params(
                "deform.control_faces",
                "at least 100 are needed",
            ));
        }
        let control = cage::control_mesh(rest, params.control_faces)?;
        let is_fine = control.triangles.len() == rest.triangles.len();
        let binding = if is_fine {
            Binding::incident(rest)
        } else {
            Binding::nearest(rest, &control)
        };
        let prisms = Prisms::new(&control, params.half_height).map_err(|e| failure(e, 0))?;
        Ok(Self {
            rest: rest.clone(),
            control,
            binding,
            prisms,
            steps: 0,
        })
    }

    /// Per-face values of the rest surface as values of the prisms: their own where the surface is its
    /// own control mesh, else the mean over the faces that hang on each prism.
    fn to_control(&self, per_face: &[f64]) -> Vec<f64> {
        if self.control.triangles.len() == self.rest.triangles.len() {
            return per_face.to_vec();
        }
        let mut sum = vec![(0.0, 0.0); self.control.triangles.len()];
        for (f, corners) in self.rest.triangles.iter().enumerate() {
            for &v in corners {
                for &(prism, share) in self.binding.prisms(v as usize) {
                    let s = &mut sum[prism as usize];
                    let w = share * self.rest.face_areas[f];
                    s.0 += w * per_face[f];
                    s.1 += w;
                }
            }
        }
        sum.iter()
            .map(|&(s, w)| if w > 0.0 { s / w } else { 1.0 })
            .collect()
    }

    fn place(&self, at: &SurfacePoint) -> Point {
        let corners = self.rest.triangles[at.face as usize];
        let sum = corners
            .iter()
            .zip(at.bary)
            .map(|(&v, b)| {
                let v = v as usize;
                let x = &self.rest.positions[v];
                self.binding.place(v, x, &self.prisms.motions).coords * b
            })
            .sum::<crate::geom::Vector>();
        Point::from(sum)
    }

    /// The pull as its strongest prism feels it: the same displacement, from where the prism itself
    /// holds the point.
    fn prism_pull(&self, pull: &Pull) -> PrismPull {
        let corners = self.rest.triangles[pull.at.face as usize];
        let heaviest = pull.at.bary.iter().enumerate();
        let k = heaviest
            .max_by(|a, b| a.1.total_cmp(b.1))
            .map_or(0, |(k, _)| k);
        let prism = self.binding.strongest(corners[k] as usize) as usize;
        let rest = self.rest.point(&pull.at);
        let held = self.prisms.motions[prism].apply(&rest);
        PrismPull {
            prism,
            rest,
            target: held + (pull.target - self.place(&pull.at)),
            weight: pull.weight,
        }
    }
}

impl Deformer for Primo {
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed> {
        ctx.check()?;
        if pulls
            .iter()
            .any(|p| !p.target.iter().all(|c| c.is_finite()) || p.weight.is_nan() || p.weight < 0.0)
        {
            return Err(failure(SolveError::Inaccurate, self.steps));
        }
        let on_prisms: Vec<PrismPull> = pulls.par_iter().map(|p| self.prism_pull(p)).collect();
        let before: Vec<Point> = pulls.par_iter().map(|p| self.place(&p.at)).collect();
        self.prisms
            .step(&on_prisms)
            .map_err(|e| failure(e, self.steps))?;
        self.steps += 1;
        let moved: Vec<f64> = pulls
            .par_iter()
            .zip(&before)
            .map(|(p, x)| (self.place(&p.at) - x).norm_squared())
            .collect();
        Ok(Deformed {
            energy: self.energy(),
            motion: (moved.iter().sum::<f64>() / moved.len().max(1) as f64).sqrt(),
        })
    }

    fn set_stiffness(&mut self, per_face: &[f64]) -> Result<()> {
        if per_face.len() != self.rest.triangles.len() {
            return Err(Error::params("stiffness", "needs one value for each face"));
        }
        if !per_face.iter().all(|k| k.is_finite() && *k > 0.0) {
            return Err(Error::params("stiffness", "must be positive and finite"));
        }
        let k = self.to_control(per_face);
        self.prisms.set_stiffness(&k);
        Ok(())
    }

    fn set_fixed(&mut self, faces: &[bool]) -> Result<()> {
        if faces.len() != self.rest.triangles.len() {
            return Err(Error::params("fixed", "needs one value for each face"));
        }
        // Every prism that carries a corner of a fixed face, else the face's rim would give way.
        let mut fixed = vec![false; self.control.triangles.len()];
        for (corners, _) in self.rest.triangles.iter().zip(faces).filter(|(_, f)| **f) {
            for &v in corners {
                for &(prism, _) in self.binding.prisms(v as usize) {
                    fixed[prism as usize] = true;
                }
            }
        }
        self.prisms.set_fixed(fixed);
        Ok(())
    }

    fn energy(&self) -> f64 {
        self.prisms.energy() / self.rest.area()
    }

    fn positions(&self) -> Vec<Point> {
        (0..self.rest.positions.len())
            .into_par_iter()
            .map(|v| {
                self.binding
                    .place(v, &self.rest.positions[v], &self.prisms.motions)
            })
            .collect()
    }

    fn places(&self, at: &[SurfacePoint]) -> Vec<Point> {
        at.par_iter().map(|at| self.place(at)).collect()
    }

    fn state(&self) -> State {
        State(self.prisms.motions.clone())
    }

    fn restore(&mut self, state: &State) {
        self.prisms.motions.clone_from(&state.0);
    }

    fn rest(&self) -> &Surface {
        &self.rest
    }
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
