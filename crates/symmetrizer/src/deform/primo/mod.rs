//! PriMo (Botsch, Pauly, Gross, Kobbelt 2006): rigid prisms with elastic joints, on a control mesh
//! that carries the fine surface.

pub mod binding;
pub mod cage;
pub mod joint;
pub mod motion;
pub mod prisms;

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::params::DeformParams;
use crate::deform::{Deformed, Deformer, Pull, State, check_pulls, check_stiffness, failure};
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::shape::{Surface, SurfacePoint};
use binding::Binding;
use prisms::{Prisms, Pulled, Share};

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
        params.check()?;
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
            .sum::<Vector>();
        Point::from(sum)
    }

    /// The pull as the prisms feel it that carry its point.
    fn pulled(&self, pull: &Pull) -> Pulled {
        let corners = self.rest.triangles[pull.at.face as usize];
        let mut shares: Vec<Share> = Vec::new();
        for (&v, b) in corners.iter().zip(pull.at.bary) {
            let x = self.rest.positions[v as usize];
            let carried = self.binding.prisms(v as usize).iter();
            shares.extend(carried.map(|&(prism, share)| Share {
                prism,
                share: b * share,
                rest: x,
            }));
        }
        shares.retain(|s| s.share > 0.0);
        shares.sort_by_key(|s| s.prism);
        shares.dedup_by(|next, kept| {
            let same = next.prism == kept.prism;
            if same {
                let share = kept.share + next.share;
                kept.rest += (next.rest - kept.rest) * (next.share / share);
                kept.share = share;
            }
            same
        });
        Pulled {
            shares,
            target: pull.target,
            weight: pull.weight,
        }
    }
}

impl Deformer for Primo {
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed> {
        ctx.check()?;
        check_pulls(pulls, self.steps)?;
        let on_prisms: Vec<Pulled> = pulls.par_iter().map(|p| self.pulled(p)).collect();
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
        check_stiffness(per_face, &self.rest)?;
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
        State::Prisms(self.prisms.motions.clone())
    }

    fn restore(&mut self, state: &State) {
        if let State::Prisms(motions) = state {
            self.prisms.motions.clone_from(motions);
        }
    }

    fn rest(&self) -> &Surface {
        &self.rest
    }
}
