//! A surface that hangs on elastic elements, as a deformer.

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::carry::motions;
use crate::deform::elastic::Motion;
use crate::deform::elastic::binding::Binding;
use crate::deform::elastic::elements::{Elements, Pulled, Share, Spring};
use crate::deform::{Deformed, Deformer, Pull, State, check_pulls, check_stiffness, failure};
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use crate::shape::{Surface, SurfacePoint};

/// A rest surface and what carries it.
pub struct Body<S> {
    rest: Surface,
    binding: Binding,
    elements: Elements<S>,
    steps: usize,
}

impl<S: Spring> Body<S> {
    /// `rest` hanging on `elements` by `binding`.
    pub(crate) fn over(rest: &Surface, binding: Binding, elements: Elements<S>) -> Self {
        Self {
            rest: rest.clone(),
            binding,
            elements,
            steps: 0,
        }
    }

    /// Per-face values of the rest surface as values of the elements: the mean over the faces that hang
    /// on each.
    fn to_elements(&self, per_face: &[f64]) -> Vec<f64> {
        let mut sum = vec![(0.0, 0.0); self.elements.motions.len()];
        for (f, corners) in self.rest.triangles.iter().enumerate() {
            for &v in corners {
                for &(element, share) in self.binding.of(v as usize) {
                    let s = &mut sum[element as usize];
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

    /// The motions of the elements that take the rest surface nearest to `moved`: each has the mean rotation of
    /// the vertices that hang on it, and goes where they go.
    fn following(&self, moved: &Surface) -> Vec<Motion> {
        let vertices = motions(&self.rest, moved);
        let elements = &self.elements.motions;
        let mut turns = vec![Matrix3::zeros(); elements.len()];
        let mut places = vec![(Vector::zeros(), 0.0); elements.len()];
        for (v, vertex) in vertices.iter().enumerate() {
            for &(element, share) in self.binding.of(v) {
                let e = element as usize;
                let w = share * self.rest.vertex_areas[v];
                turns[e] += w * vertex.rotation;
                places[e].0 += w * vertex.apply(&elements[e].rest_center).coords;
                places[e].1 += w;
            }
        }
        let motion = |((old, turn), (sum, w)): ((&Motion, &Matrix3), &(Vector, f64))| Motion {
            rotation: nearest_orthogonal(turn, false),
            rest_center: old.rest_center,
            center: if *w > 0.0 {
                Point::from(sum / *w)
            } else {
                old.center
            },
        };
        elements
            .iter()
            .zip(&turns)
            .zip(&places)
            .map(motion)
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
                self.binding.place(v, x, &self.elements.motions).coords * b
            })
            .sum::<Vector>();
        Point::from(sum)
    }

    /// The pull as the elements feel it that carry its point.
    fn pulled(&self, pull: &Pull) -> Pulled {
        let corners = self.rest.triangles[pull.at.face as usize];
        let mut shares: Vec<Share> = Vec::new();
        for (&v, b) in corners.iter().zip(pull.at.bary) {
            let x = self.rest.positions[v as usize];
            let carried = self.binding.of(v as usize).iter();
            shares.extend(carried.map(|&(element, share)| Share {
                element,
                share: b * share,
                rest: x,
            }));
        }
        shares.retain(|s| s.share > 0.0);
        shares.sort_by_key(|s| s.element);
        shares.dedup_by(|next, kept| {
            let same = next.element == kept.element;
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

impl<S: Spring> Deformer for Body<S> {
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed> {
        ctx.check()?;
        check_pulls(pulls, self.steps)?;
        let on_elements: Vec<Pulled> = pulls.par_iter().map(|p| self.pulled(p)).collect();
        let before: Vec<Point> = pulls.par_iter().map(|p| self.place(&p.at)).collect();
        self.elements
            .step(&on_elements)
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
        let k = self.to_elements(per_face);
        self.elements.set_stiffness(&k);
        Ok(())
    }

    fn set_fixed(&mut self, faces: &[bool]) -> Result<()> {
        if faces.len() != self.rest.triangles.len() {
            return Err(Error::params("fixed", "needs one value for each face"));
        }
        // Every element that carries a corner of a fixed face, else the face's rim would give way.
        let mut fixed = vec![false; self.elements.motions.len()];
        for (corners, _) in self.rest.triangles.iter().zip(faces).filter(|(_, f)| **f) {
            for &v in corners {
                for &(element, _) in self.binding.of(v as usize) {
                    fixed[element as usize] = true;
                }
            }
        }
        self.elements.set_fixed(fixed);
        Ok(())
    }

    fn energy(&self) -> f64 {
        self.elements.energy() / self.rest.area()
    }

    fn energy_at(&self, positions: &[Point]) -> f64 {
        let moved = self.rest.with_positions(positions.to_vec());
        self.elements.energy_at(&self.following(&moved)) / self.rest.area()
    }

    fn positions(&self) -> Vec<Point> {
        self.binding
            .places(&self.rest.positions, &self.elements.motions)
    }

    fn places(&self, at: &[SurfacePoint]) -> Vec<Point> {
        at.par_iter().map(|at| self.place(at)).collect()
    }

    fn state(&self) -> State {
        State(self.elements.motions.clone())
    }

    fn restore(&mut self, state: &State) {
        self.elements.motions.clone_from(&state.0);
    }

    fn rest(&self) -> &Surface {
        &self.rest
    }
}
