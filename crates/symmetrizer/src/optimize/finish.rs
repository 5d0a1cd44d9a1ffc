//! The finish at full resolution: what the deformer's control mesh is too coarse to carry.
//!
//! Each vertex is drawn half of the way, along its normal, to its mirrored closest point; the field of
//! these displacements is smoothed by a screened Laplacian, so that the surface moves as cloth and
//! not as dust. The smoothing length falls from round to round and the rounds end as soon as the
//! shape is symmetric enough: detail is rubbed out no further than that takes.

use crate::context::Context;
use crate::deform::smooth::SmoothField;
use crate::deform::solver::SolveError;
use crate::deform::{carry, control_mesh};
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::optimize::OptimizeParams;
use crate::optimize::aim::Aim;
use crate::optimize::schedule::Settings;
use crate::optimize::untangle::untangle;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::Plane;

/// What the finish did.
#[derive(Debug, Clone)]
pub struct Finished {
    /// Vertex positions, working coordinates.
    pub positions: Vec<Point>,
    /// The mirror at the end, working coordinates.
    pub plane: Plane,
    /// Rounds run.
    pub rounds: usize,
    /// Mean distance of mirrored vertices from the surface before and after, area-weighted, fraction
    /// of L.
    pub asymmetry: [f64; 2],
    /// Share of the area where it was undone because the surface would have crossed itself.
    pub undone: f64,
}

/// Factor of the smoothing length from round to round.
const REFINE: f64 = 0.8;

/// The first rounds, whose smoothing length is far above any detail, are run in any case: they cost
/// nothing and draw in what the mean does not show, such as the tip of an ear.
const COARSE_ROUNDS: usize = 5;

/// A round that leaves more than this share of the asymmetry gains nothing that is worth its change.
const STALLED: f64 = 0.995;

/// Long smoothing lengths are run on a copy of about the first number of faces, down to this many of its
/// edges; what is left on one of the second, and the rest of the surface is carried along: finer triangles
/// add detail, not asymmetry.
const LEVELS: [(usize, f64); 2] = [(20_000, 1.5), (100_000, 0.0)];

/// Runs the rounds of the finish on `surface` under the mirror `plane` until the mean asymmetry is
/// `goal` (fraction of L) or falls no further.
///
/// # Errors
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn finish(
    surface: &Surface,
    plane: Plane,
    goal: f64,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Finished> {
    let mut now = surface.clone();
    let mut rounds = Rounds::new(settings.optimize, goal, plane);
    for (faces, edges) in LEVELS {
        let control = control_mesh(&now, faces)?;
        let whole = control.triangles.len() == now.triangles.len();
        let until = if whole {
            0.0
        } else {
            edges * control.mean_edge()
        };
        if !rounds.wanted(until) {
            continue;
        }
        let stiffness = settings.stiffness.map(|k| stiffness_on(&control, &now, k));
        let mut cloth =
            Cloth::new(&control, stiffness.as_deref(), rounds.plane).map_err(failure)?;
        rounds.run(&mut cloth, until, ctx)?;
        now = if whole {
            cloth.now
        } else {
            now.with_positions(carry(&now, &control, &cloth.now.positions))
        };
    }
    let (now, undone) = untangle(surface, now);
    if undone > 0.0 {
        let aim = Aim::at(&now, rounds.plane, &ClosestPoint::new(&now));
        rounds.note(&aim);
    }
    Ok(Finished {
        undone,
        positions: now.positions,
        plane: rounds.plane,
        rounds: rounds.done,
        asymmetry: rounds.asymmetry.unwrap_or_default(),
    })
}

/// The stiffness of the nearest face of `surface` at each face of `control`.
fn stiffness_on(control: &Surface, surface: &Surface, stiffness: &[f64]) -> Vec<f64> {
    if control.triangles.len() == surface.triangles.len() {
        return stiffness.to_vec();
    }
    let closest = ClosestPoint::new(surface);
    let at = |f: u32| {
        let [a, b, c] = control.corners(f);
        let center = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let hit = closest.nearest_facing(&center, &control.face_normals[f as usize], 0.0, 1.0);
        hit.map_or(1.0, |hit| stiffness[hit.at.face as usize])
    };
    (0..control.triangles.len() as u32).map(at).collect()
}

/// How far the rounds have come.
struct Rounds<'a> {
    params: &'a OptimizeParams,
    goal: f64,
    done: usize,
    /// Smoothing length of the next round.
    lambda: f64,
    plane: Plane,
    /// Mean asymmetry before the first and after the last round.
    asymmetry: Option<[f64; 2]>,
    finished: bool,
}

impl<'a> Rounds<'a> {
    fn new(params: &'a OptimizeParams, goal: f64, plane: Plane) -> Self {
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

    fn note(&mut self, aim: &Aim) {
        let before = self.asymmetry.map_or(aim.asymmetry, |a| a[0]);
        self.asymmetry = Some([before, aim.asymmetry]);
        self.plane = aim.plane;
    }

    /// Rounds of ever shorter lengths down to `until`.
    fn run(&mut self, cloth: &mut Cloth, until: f64, ctx: &mut Context<'_>) -> Result<()> {
        self.note(&cloth.aim);
        while self.wanted(until) {
            ctx.progress(self.done as f64 / self.params.finish_rounds as f64)?;
            self.round(cloth).map_err(failure)?;
            self.note(&cloth.aim);
        }
        Ok(())
    }

    fn round(&mut self, cloth: &mut Cloth) -> std::result::Result<(), SolveError> {
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
struct Cloth {
    field: SmoothField,
    now: Surface,
    closest: ClosestPoint,
    aim: Aim,
}

impl Cloth {
    fn new(
        surface: &Surface,
        stiffness: Option<&[f64]>,
        plane: Plane,
    ) -> std::result::Result<Self, SolveError> {
        let closest = ClosestPoint::new(surface);
        Ok(Self {
            field: SmoothField::new(surface, stiffness)?,
            now: surface.clone(),
            aim: Aim::at(surface, plane, &closest),
            closest,
        })
    }

    /// The displacements of a round of smoothing length `lambda`.
    fn moves(&mut self, lambda: f64) -> std::result::Result<Vec<Vector>, SolveError> {
        self.field
            .solve(&self.aim.targets, &self.aim.confidence, lambda)
    }

    /// With `fraction` of the displacements `moves`.
    fn moved(&mut self, moves: &[Vector], fraction: f64) -> (Surface, Aim) {
        let moved = self.now.positions.iter().zip(moves);
        let moved = moved.map(|(x, u)| x + u * fraction).collect();
        let next = self.now.with_positions(moved);
        self.closest.follow(&next);
        let aim = Aim::at(&next, self.aim.plane, &self.closest);
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
