//! The orbits of all goals drawn to their means, round by round.
//!
//! The motions are fitted to the surface first, so that it moves as little as it can. Then the displacements of each
//! round are smoothed over the surface, over ever shorter lengths, as in the finish.

use crate::context::Context;
use crate::deform::control::{Decimated, decimated, stiffness_on};
use crate::deform::smooth::SmoothField;
use crate::deform::{Deformer, carry};
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};
use crate::optimize::balance::balanced;
use crate::optimize::contact::SMOOTH_COS;
use crate::optimize::orbit::goal::Goal;
use crate::optimize::orbit::ground::{Member, members};
use crate::optimize::orbit::means::{Means, Scene};
use crate::optimize::untangle::untangle;
use crate::sample::Samples;
use crate::shape::inverted::inverted_faces;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::Ambient;

/// Fits of the motions before anything moves.
const FITS: usize = 8;
/// Smoothing lengths of the first and the last, fractions of L.
const LENGTHS: [f64; 2] = [0.03, 0.001];
/// Factor of the length from round to round.
const REFINE: f64 = 0.7;
/// Rounds that leave more than this share of the distances gain nothing.
const STALLED: f64 = 0.98;
/// The share of their drift along the surface that vertices go back in a round.
const SLIDE: f64 = 0.5;
/// Attempts at keeping faces from being turned over.
const UNFOLDINGS: usize = 4;
/// Distances that are small enough, fraction of L.
const DONE: f64 = 1e-6;
/// A finer surface is carried along by a copy of about this many faces.
const FULL: usize = 100_000;

/// Goals on a surface.
pub struct Fitted {
    /// Their motions where they fit it best.
    pub goals: Vec<Goal>,
    /// Of each the rms distance of the copies from the surface, fraction of L.
    pub rms: Vec<f64>,
    /// Of each the rms displacement of its places by which equation 1 meets it, fraction of L.
    pub halves: Vec<f64>,
    /// Of each the share of its copies that were found, by area.
    pub held: Vec<f64>,
    /// rms displacement by which equation 1 meets them, over the surface, fraction of L.
    pub predicted: f64,
}

impl Fitted {
    /// The `goals` fitted to `surface`, on which `samples` lie.
    ///
    /// # Errors
    /// As [`decimated`].
    pub fn of(surface: &Surface, samples: &Samples, goals: &[Goal]) -> Result<Self> {
        let copy = decimated(surface, FULL)?;
        let rest = copy.as_ref().map_or(surface, |c| &c.surface);
        let mut cloth = Cloth::new(rest, samples, goals);
        for _ in 0..FITS {
            cloth.refit();
        }
        Ok(Self {
            rms: cloth.rms(),
            halves: cloth.means.tallies.iter().map(|t| t.half()).collect(),
            held: cloth.means.tallies.iter().map(|t| t.held()).collect(),
            predicted: cloth.predicted(),
            goals: cloth.goals,
        })
    }
}

/// For each vertex of `surface` how far it is from the mean of its copies under the `goals`, fitted, fraction of L.
pub fn apart(surface: &Surface, samples: &Samples, goals: &[Goal]) -> Vec<f64> {
    let mut cloth = Cloth::new(surface, samples, goals);
    for _ in 0..FITS {
        cloth.refit();
    }
    cloth.means.halves.iter().map(|d| d.abs()).collect()
}

/// What was done.
pub struct Drawn {
    /// Vertex positions.
    pub positions: Vec<Point>,
    /// The goals, their motions where they were at the end.
    pub goals: Vec<Goal>,
    /// Rounds that were taken.
    pub rounds: usize,
    /// Of each goal the rms distance of the copies from the surface, fraction of L.
    pub rms: Vec<f64>,
    /// Whether the energy limit ended it.
    pub limited: bool,
}

/// How far a surface may be deformed, and by what that is measured.
pub struct Limit<'a> {
    /// The deformer over the input.
    pub body: &'a dyn Deformer,
    /// Its energy at the most.
    pub most: Option<f64>,
}

impl Limit<'_> {
    /// Whether the surface, its vertices as those of the body's, is beyond it.
    fn is_passed(&self, surface: &Surface) -> bool {
        let energy = |most: f64| self.body.energy_at(&surface.positions) > most;
        self.most.is_some_and(energy)
    }
}

/// Draws the orbits of `goals` on `surface` to their means in up to `rounds` rounds; `stiffness` is that of its faces,
/// `samples` lie on it.
///
/// # Errors
/// [`Error::Numerical`], [`Error::Cancelled`].
pub fn draw(
    surface: &Surface,
    samples: &Samples,
    goals: &[Goal],
    rounds: usize,
    stiffness: Option<&[f64]>,
    limit: &Limit<'_>,
    ctx: &mut Context<'_>,
) -> Result<Drawn> {
    let copy = decimated(surface, FULL)?;
    let rest = copy.as_ref().map_or(surface, |c| &c.surface);
    let stiffness = match (&copy, stiffness) {
        (Some(copy), Some(k)) => Some(stiffness_on(&copy.surface, surface, k)),
        (_, k) => k.map(<[f64]>::to_vec),
    };
    let mut cloth = Cloth::new(rest, samples, goals);
    cloth.refit();
    let mut field = SmoothField::new(rest, stiffness.as_deref()).map_err(failure)?;
    let mut limited = false;
    while cloth.round < rounds && cloth.means.distance() >= DONE {
        ctx.progress(cloth.round as f64 / rounds as f64)?;
        let was = cloth.now.clone();
        let gained = cloth.round(&mut field)?;
        let whole = || spread(surface, copy.as_ref(), &cloth.now);
        if gained && limit.most.is_some() && limit.is_passed(&whole()) {
            cloth.go_to(was);
            limited = true;
            break;
        }
        if !gained && cloth.length <= LENGTHS[1] {
            break;
        }
        cloth.length = (cloth.length * REFINE).max(LENGTHS[1]);
    }
    let (kept, _) = untangle(surface, spread(surface, copy.as_ref(), &cloth.now));
    let seen = copy.map_or_else(|| kept.clone(), |c| c.following(&kept));
    cloth.go_to(seen);
    Ok(Drawn {
        positions: kept.positions,
        rounds: cloth.taken,
        rms: cloth.rms(),
        goals: cloth.goals,
        limited,
    })
}

/// The surface whose copy is `now`.
fn spread(surface: &Surface, copy: Option<&Decimated>, now: &Surface) -> Surface {
    match copy {
        Some(copy) => surface.with_positions(carry(surface, &copy.surface, &now.positions)),
        None => now.clone(),
    }
}

/// The surface as it is drawn.
struct Cloth {
    goals: Vec<Goal>,
    members: Vec<Vec<Member>>,
    now: Surface,
    closest: ClosestPoint,
    means: Means,
    /// The surface as it was.
    start: Surface,
    /// Smoothing length of the next round.
    length: f64,
    round: usize,
    /// Rounds that gained something.
    taken: usize,
}

impl Cloth {
    fn new(surface: &Surface, samples: &Samples, goals: &[Goal]) -> Self {
        let members = members(surface, samples, goals);
        let closest = ClosestPoint::new(surface);
        let scene = Scene {
            surface,
            closest: &closest,
            points: &points(surface),
            members: &members,
        };
        Self {
            means: Means::at(&scene, goals, 0),
            goals: goals.to_vec(),
            now: surface.clone(),
            start: surface.clone(),
            members,
            closest,
            length: LENGTHS[0],
            round: 0,
            taken: 0,
        }
    }

    /// The means of the surface as it is, its motions fitted once more.
    fn refit(&mut self) {
        let fitted = self.goals.iter().zip(&self.means.tallies);
        self.goals = fitted.map(|(g, t)| g.adjusted(&t.equations)).collect();
        self.look();
    }

    fn look(&mut self) {
        let scene = Scene {
            surface: &self.now,
            closest: &self.closest,
            points: &points(&self.now),
            members: &self.members,
        };
        self.means = Means::at(&scene, &self.goals, self.round);
    }

    fn go_to(&mut self, surface: Surface) {
        self.closest.follow(&surface);
        self.now = surface;
        self.look();
    }

    /// One round; false, and nothing changed, where it gained nothing.
    fn round(&mut self, field: &mut SmoothField) -> Result<bool> {
        let (targets, confidence) = (&self.means.targets, &self.means.confidence);
        let moves = field
            .solve(targets, confidence, self.length)
            .map_err(failure)?;
        let moves = match self.ambient() {
            Ambient::Space => balanced(&self.now, &moves, &self.means.copies, confidence),
            Ambient::Plane => moves,
        };
        let moved = self.now.positions.iter().zip(&moves).map(|(x, u)| x + u);
        let next = self.now.with_positions(moved.collect());
        let next = next.with_positions(self.without_drift(&next));
        // Round by round, so that what would cross goes back by one round only.
        let (next, _) = untangle(&self.now, self.unfolded(next));
        let (was, goals) = (self.now.clone(), self.goals.clone());
        let before = self.means.clone();
        self.round += 1;
        self.go_to(next);
        self.refit();
        if self.means.gained(&before, STALLED) {
            self.taken += 1;
            return Ok(true);
        }
        self.goals = goals;
        self.go_to(was);
        Ok(false)
    }

    /// The vertices of `next` slid over it towards where they began: along a smooth surface nothing is to be gained.
    /// Corners of an outline are what its form is.
    fn without_drift(&self, next: &Surface) -> Vec<Point> {
        if self.ambient() == Ambient::Plane {
            return next.positions.clone();
        }
        let smooth = next.smooth_vertices(SMOOTH_COS);
        let slid = |v: usize| {
            let (x, n) = (next.positions[v], next.vertex_normals[v]);
            let back = self.start.positions[v] - x;
            match smooth[v] {
                true => x + (back - n * n.dot(&back)) * SLIDE,
                false => x,
            }
        };
        (0..smooth.len()).map(slid).collect()
    }

    /// `next` with the corners of faces that would be turned over where they are now.
    fn unfolded(&self, mut next: Surface) -> Surface {
        for _ in 0..UNFOLDINGS {
            let faces = inverted_faces(&self.start, &next);
            if faces.is_empty() {
                break;
            }
            let mut positions = next.positions.clone();
            for v in faces.iter().flat_map(|&f| next.triangles[f as usize]) {
                positions[v as usize] = self.now.positions[v as usize];
            }
            next = next.with_positions(positions);
        }
        next
    }

    /// Where the shape lives.
    fn ambient(&self) -> Ambient {
        match self.goals.iter().any(|g| g.ambient == Ambient::Plane) {
            true => Ambient::Plane,
            false => Ambient::Space,
        }
    }

    fn rms(&self) -> Vec<f64> {
        self.means.tallies.iter().map(|t| t.rms()).collect()
    }

    /// rms displacement towards the means.
    fn predicted(&self) -> f64 {
        let areas = &self.now.vertex_areas;
        let ways = self.means.halves.iter().zip(areas);
        let sum: f64 = ways.map(|(d, a)| d * d * a).sum();
        (sum / self.now.area()).sqrt()
    }
}

/// The vertices as points of the surface.
fn points(surface: &Surface) -> Vec<(Point, Vector, f64)> {
    let normals = surface.vertex_normals.iter().zip(&surface.vertex_areas);
    let all = surface.positions.iter().zip(normals);
    all.map(|(x, (n, a))| (*x, *n, *a)).collect()
}

fn failure(_: crate::deform::solver::SolveError) -> Error {
    Error::Numerical {
        stage: "orbits",
        step: 0,
        what: "the smoothing system could not be solved".into(),
    }
}
