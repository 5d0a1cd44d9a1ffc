//! The rounds of the finish: displacements smoothed over ever shorter lengths.

use crate::context::Context;
use crate::deform::control::{Decimated, stiffness_on};
use crate::deform::smooth::SmoothField;
use crate::deform::solver::SolveError;
use crate::error::{Error, Result};
use crate::geom::Vector;
use crate::optimize::OptimizeParams;
use crate::optimize::aim::Aim;
use crate::optimize::balance::balanced;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::{Ambient, Plane};

/// Factor of the smoothing length from round to round.
const REFINE: f64 = 0.8;

/// The first rounds, whose smoothing length is far above any detail, are run in any case: they cost
/// nothing and draw in what the mean does not show, such as the tip of an ear.
const COARSE_ROUNDS: usize = 5;

/// A round that leaves more than this share of the asymmetry gains nothing that is worth its change.
const STALLED: f64 = 0.995;

/// What may be changed of a surface, and how easily.
#[derive(Clone)]
pub(super) struct Changed {
    /// Where the shape lives.
    pub ambient: Ambient,
    /// Stiffness of each face, where it is not 1 everywhere.
    pub stiffness: Option<Vec<f64>>,
    /// How far each vertex may be changed, 0 to 1, where it is not the whole surface.
    pub region: Option<Vec<f64>>,
}

impl Changed {
    /// The same of a `surface` for a decimated copy of it.
    pub fn on(&self, surface: &Surface, copy: &Decimated) -> Self {
        let stiffness = self.stiffness.as_deref();
        let region = self.region.as_deref();
        Self {
            ambient: self.ambient,
            stiffness: stiffness.map(|k| stiffness_on(&copy.surface, surface, k)),
            region: region.map(|region| copy.of_vertices(region)),
        }
    }
}

/// How far the rounds have come.
pub(super) struct Rounds<'a> {
    params: &'a OptimizeParams,
    goal: f64,
    /// Rounds run.
    pub done: usize,
    /// Smoothing length of the next round.
    lambda: f64,
    /// The mirror as it was fitted last.
    pub plane: Plane,
    /// Mean asymmetry before the first and after the last round.
    pub asymmetry: Option<[f64; 2]>,
    finished: bool,
}

impl<'a> Rounds<'a> {
    /// None run yet, of those that `params` ask for, towards the mean asymmetry `goal` (fraction of L).
    pub fn new(params: &'a OptimizeParams, goal: f64, plane: Plane) -> Self {
        Self {
            params,
            goal,
            done: 0,
            lambda: params.finish_lengths[0],
            plane,
            asymmetry: None,
            finished: false,
        }
    }

    /// Whether there are rounds left of lengths of at least `until`.
    fn wanted(&self, until: f64) -> bool {
        !self.finished && self.done < self.params.finish_rounds && self.lambda >= until
    }

    /// Takes note of how asymmetric the surface is now.
    pub fn note(&mut self, aim: &Aim) {
        let before = self.asymmetry.map_or(aim.asymmetry, |a| a[0]);
        self.asymmetry = Some([before, aim.asymmetry]);
        self.plane = aim.plane;
    }

    /// `surface` after rounds of ever shorter smoothing lengths down to `until` (fraction of L).
    ///
    /// # Errors
    /// [`Error::Numerical`], [`Error::Cancelled`].
    pub fn run(
        &mut self,
        surface: &Surface,
        changed: &Changed,
        until: f64,
        ctx: &mut Context<'_>,
    ) -> Result<Surface> {
        if !self.wanted(until) {
            return Ok(surface.clone());
        }
        let mut cloth = Cloth::new(surface, changed, self.plane).map_err(failure)?;
        self.note(&cloth.aim);
        while self.wanted(until) {
            ctx.progress(self.done as f64 / self.params.finish_rounds as f64)?;
            self.round(&mut cloth).map_err(failure)?;
            self.note(&cloth.aim);
        }
        Ok(cloth.now)
    }

    fn round(&mut self, cloth: &mut Cloth<'_>) -> std::result::Result<(), SolveError> {
        let shortest = self.params.finish_lengths[1];
        let settled = self.done + 1 >= COARSE_ROUNDS;
        let moves = cloth.moves(self.lambda)?;
        let (next, aim) = cloth.moved(&moves, 1.0);
        let [was, asymmetry] = [cloth.aim.asymmetry, aim.asymmetry];
        let reached = settled && asymmetry <= self.goal;
        if self.done < COARSE_ROUNDS || asymmetry <= STALLED * was {
            (cloth.now, cloth.aim) = if reached && was > self.goal {
                // No further than the goal: the part of the round that takes it there.
                cloth.moved(&moves, (was - self.goal) / (was - asymmetry))
            } else {
                (next, aim)
            };
        } else if self.lambda <= shortest {
            self.finished = true;
        }
        // Where nothing was to be gained at this length, the next is tried without having taken the round.
        self.done += 1;
        self.lambda = (self.lambda * REFINE).max(shortest);
        self.finished |= reached;
        Ok(())
    }
}

/// The surface as it is drawn, round by round.
struct Cloth<'a> {
    changed: &'a Changed,
    field: SmoothField,
    now: Surface,
    closest: ClosestPoint,
    aim: Aim,
}

impl<'a> Cloth<'a> {
    fn new(
        surface: &Surface,
        changed: &'a Changed,
        plane: Plane,
    ) -> std::result::Result<Self, SolveError> {
        let stiffness = changed.stiffness.as_deref();
        let (field, closest) = rayon::join(
            || SmoothField::new(surface, stiffness),
            || ClosestPoint::new(surface),
        );
        Ok(Self {
            field: field?,
            now: surface.clone(),
            aim: Aim::at(surface, plane, &closest, changed, None),
            closest,
            changed,
        })
    }

    /// The displacements of a round of smoothing length `lambda`.
    fn moves(&mut self, lambda: f64) -> std::result::Result<Vec<Vector>, SolveError> {
        let aim = &self.aim;
        let moves = self.field.solve(&aim.targets, &aim.confidence, lambda)?;
        // Beside what is still bent partners are not each other's, and what they have in common may be needed.
        let is_bent = self.changed.region.is_some();
        Ok(match self.changed.ambient {
            Ambient::Space if !is_bent => balanced(&self.now, &moves, &aim.copies, &aim.confidence),
            _ => moves,
        })
    }

    /// With `fraction` of the displacements `moves`.
    fn moved(&mut self, moves: &[Vector], fraction: f64) -> (Surface, Aim) {
        let moved = self.now.positions.iter().zip(moves);
        let moved = moved.map(|(x, u)| x + u * fraction).collect();
        let next = self.now.with_positions(moved);
        self.closest.follow(&next);
        let before = &self.aim;
        let aim = Aim::at(
            &next,
            before.plane,
            &self.closest,
            self.changed,
            Some(before),
        );
        (next, aim)
    }
}

fn failure(_: SolveError) -> Error {
    Error::Numerical {
        stage: "finish",
        step: 0,
        what: "the smoothing system could not be solved".into(),
    }
}
