//! As rigid as possible in the plane (Igarashi, Moscovich and Hughes 2005): the inside of an outline, deformed by
//! pulls at the outline.
//!
//! Their two steps find a first answer however far the pulls go: triangles that may turn and grow (`similar`), then
//! triangles of their own size turned as those were (`rigid`). What they leave is taken out by going on with the
//! second step, rotations from positions and positions from rotations (local and global, Sorkine and Alexa 2007).
//! From where the shape was a moment ago that alone is enough.
//!
//! To the stages the shape is the wall over its outline: places and pulls are those of its surface.

mod rigid;
mod similar;
mod system;

use crate::context::Context;
use crate::deform::elastic::Motion;
use crate::deform::harmonic::rotations_inside;
use crate::deform::solver::SolveError;
use crate::deform::{
    Deformed, Deformer, Pull, State, carry, check_pulls, check_stiffness, failure,
};
use crate::error::{Error, Result};
use crate::geom::{Matrix3, Point};
use crate::shape::sheet::Sheet;
use crate::shape::wall::Wall;
use crate::shape::{Surface, SurfacePoint};
use rigid::Turn;
use system::{Held, System};

/// Rounds of rotations and positions in each call.
const ROUNDS: usize = 4;
/// Rounds that lower the energy by less than this share of it end a call.
const SETTLED: f64 = 1e-3;
/// Pulls that ask for more than this in the mean, fraction of L, begin with the first step.
const FAR: f64 = 0.05;
/// A step that turns triangles over is halved as often at the most.
const HALVINGS: usize = 5;

/// The inside of an outline that resists deformation.
pub struct Igarashi {
    wall: Wall,
    sheet: Sheet,
    positions: Vec<Point>,
    system: System,
    /// Which vertices of the sheet do not move.
    fixed: Vec<bool>,
}

impl Igarashi {
    /// Over what `wall` encloses.
    ///
    /// # Errors
    /// [`Error::Input`] where it encloses nothing.
    pub fn new(wall: Wall) -> Result<Self> {
        let sheet = Sheet::new(&wall)?;
        Ok(Self {
            positions: sheet.surface.positions.clone(),
            system: System::new(&sheet.surface),
            fixed: vec![false; sheet.surface.positions.len()],
            wall,
            sheet,
        })
    }

    /// The inside, at rest.
    pub fn sheet(&self) -> &Sheet {
        &self.sheet
    }

    /// Where the vertices of the inside are.
    pub fn inside(&self) -> &[Point] {
        &self.positions
    }

    /// Stiffness of each triangle of the inside, as a multiple of the default (1).
    ///
    /// # Errors
    /// [`Error::Params`] for a wrong count or a value that is not positive and finite.
    pub fn set_stiffness_inside(&mut self, per_triangle: &[f64]) -> Result<()> {
        check_stiffness(per_triangle, &self.sheet.surface)?;
        self.system.set_stiffness(per_triangle);
        Ok(())
    }

    /// Takes the rotations, radians, of all triangles as where to begin, whatever the pulls of the next call ask for:
    /// the shape goes to where they fit best.
    ///
    /// # Errors
    /// [`Error::Params`] for a wrong count, [`Error::Numerical`].
    pub fn start_from(&mut self, rotations: &[f64]) -> Result<()> {
        if rotations.len() != self.sheet.surface.triangles.len() {
            return Err(Error::params("rotations", "needs one for each triangle"));
        }
        let turns: Vec<Turn> = rotations.iter().map(|&r| Turn::by(r)).collect();
        let held = self.held(&[]);
        self.positions = self
            .positions_for(&turns, &held)
            .map_err(|e| failure(e, 0))?;
        Ok(())
    }

    /// The inside for a wall that is at `positions`, as rigid as it allows.
    ///
    /// # Errors
    /// [`Error::Numerical`].
    pub fn filled(&self, positions: &[Point]) -> Result<Vec<Point>> {
        self.filled_but(positions, |_| false)
    }

    /// Where the wall's vertices are if it is at `positions` but for the starts of its `free` edges, which go where it is
    /// as rigid as the others allow.
    ///
    /// # Errors
    /// [`Error::Numerical`].
    pub fn let_go(&self, positions: &[Point], free: &[bool]) -> Result<Vec<Point>> {
        let inside = self.filled_but(positions, |edge| free[edge])?;
        Ok(self.sheet.wall(&self.wall, &inside))
    }

    fn filled_but(&self, positions: &[Point], free: impl Fn(usize) -> bool) -> Result<Vec<Point>> {
        let moved = self.wall.surface.with_positions(positions.to_vec());
        let motions = carry::motions(&self.wall.surface, &moved);
        let mut known: Vec<Option<Matrix3>> = vec![None; self.positions.len()];
        let mut places: Vec<Option<Point>> = vec![None; self.positions.len()];
        let held = self.sheet.corners.iter().enumerate();
        for (e, &v) in held.filter(|(e, _)| !free(*e)) {
            let x = &positions[2 * e];
            known[v as usize] = Some(motions[2 * e].rotation);
            places[v as usize] = Some(Point::new(x.x, x.y, 0.0));
        }
        let rotations = rotations_inside(&self.sheet.surface, &known)?;
        let turns: Vec<Turn> = self
            .sheet
            .surface
            .triangles
            .iter()
            .map(|t| Turn::mean(t, &rotations))
            .collect();
        let held = Held {
            places,
            pulls: Vec::new(),
        };
        let mut found = self
            .system
            .positions(&self.sheet.surface, &turns, &held)
            .map_err(|e| failure(e, 0))?;
        for _ in 0..ROUNDS {
            let turns = rigid::turns(&self.sheet.surface, &found);
            found = self
                .system
                .positions(&self.sheet.surface, &turns, &held)
                .map_err(|e| failure(e, 0))?;
        }
        Ok(found)
    }

    /// What is held where, the pulls in the plane's own measure: those of a wall come by its area.
    fn held(&self, pulls: &[Pull]) -> Held {
        let scale = self.sheet.surface.area() / self.wall.surface.area();
        let inside = |p: &Pull| Pull {
            at: self.sheet.at(&p.at),
            weight: scale * p.weight,
            ..*p
        };
        let place = |(x, fixed): (&Point, &bool)| fixed.then_some(*x);
        Held {
            places: self.positions.iter().zip(&self.fixed).map(place).collect(),
            pulls: pulls
                .iter()
                .filter(|p| p.weight > 0.0)
                .map(inside)
                .collect(),
        }
    }

    fn positions_for(
        &self,
        turns: &[Turn],
        held: &Held,
    ) -> std::result::Result<Vec<Point>, SolveError> {
        self.system.positions(&self.sheet.surface, turns, held)
    }

    /// What the rounds make small.
    fn total(&self, positions: &[Point], held: &Held) -> f64 {
        let strain = self.system.strain(&self.sheet.surface, positions);
        strain + held.missed(&self.sheet.surface, positions)
    }

    fn relax(&mut self, held: &Held) -> std::result::Result<(), SolveError> {
        let rest = &self.sheet.surface;
        let mut total = self.total(&self.positions, held);
        let mut next = None;
        if held.asked(rest, &self.positions) > FAR {
            next = Some(rigid::turns(
                rest,
                &similar::positions(rest, self.system.stiffness(), held)?,
            ));
        }
        for _ in 0..ROUNDS {
            let turns = next
                .take()
                .unwrap_or_else(|| rigid::turns(rest, &self.positions));
            let target = self.positions_for(&turns, held)?;
            let moved = unfolded(rest, &self.positions, target);
            let now = self.total(&moved, held);
            self.positions = moved;
            if (total - now).abs() <= SETTLED * total {
                break;
            }
            total = now;
        }
        Ok(())
    }
}

/// `target`, or as much of the way to it as turns no triangle over.
fn unfolded(rest: &Surface, from: &[Point], target: Vec<Point>) -> Vec<Point> {
    let folded = |x: &[Point]| rest.triangles.iter().filter(|t| area(t, x) <= 0.0).count();
    let before = folded(from);
    let mut share = 1.0;
    let mut moved = target.clone();
    for _ in 0..HALVINGS {
        if folded(&moved) <= before {
            return moved;
        }
        share /= 2.0;
        let ways = from.iter().zip(&target);
        moved = ways.map(|(x, y)| x + share * (y - x)).collect();
    }
    moved
}

/// Twice the signed area of a triangle of the plane.
fn area(corners: &[u32; 3], x: &[Point]) -> f64 {
    let [a, b, c] = corners.map(|v| x[v as usize]);
    (b - a).cross(&(c - a)).z
}

impl Deformer for Igarashi {
    fn deform(&mut self, pulls: &[Pull], ctx: &mut Context<'_>) -> Result<Deformed> {
        ctx.check()?;
        check_pulls(pulls, 0)?;
        let at: Vec<SurfacePoint> = pulls.iter().map(|p| p.at).collect();
        let before = self.places(&at);
        let held = self.held(pulls);
        self.relax(&held).map_err(|e| failure(e, 0))?;
        let after = self.places(&at);
        let squares = before
            .iter()
            .zip(&after)
            .map(|(x, y)| (y - x).norm_squared());
        Ok(Deformed {
            energy: self.energy(),
            motion: (squares.sum::<f64>() / pulls.len().max(1) as f64).sqrt(),
        })
    }

    /// Of the wall's faces: inside, that of the nearest.
    fn set_stiffness(&mut self, per_face: &[f64]) -> Result<()> {
        check_stiffness(per_face, &self.wall.surface)?;
        self.set_stiffness_inside(&self.sheet.nearest_on(&self.wall, |edge| per_face[2 * edge]))
    }

    fn set_fixed(&mut self, faces: &[bool]) -> Result<()> {
        if faces.len() != self.wall.surface.triangles.len() {
            return Err(Error::params("fixed", "needs one value for each face"));
        }
        self.fixed.fill(false);
        for edge in (0..self.wall.edges()).filter(|e| faces[2 * e]) {
            for end in [edge, self.wall.next(edge)] {
                self.fixed[self.sheet.corners[end] as usize] = true;
            }
        }
        Ok(())
    }

    fn energy(&self) -> f64 {
        self.system.strain(&self.sheet.surface, &self.positions) / self.sheet.surface.area()
    }

    fn energy_at(&self, positions: &[Point]) -> f64 {
        let filled = self.filled(positions);
        let strain = filled.map(|x| self.system.strain(&self.sheet.surface, &x));
        strain.map_or(f64::INFINITY, |strain| strain / self.sheet.surface.area())
    }

    fn positions(&self) -> Vec<Point> {
        self.sheet.wall(&self.wall, &self.positions)
    }

    fn places(&self, at: &[SurfacePoint]) -> Vec<Point> {
        let place = |at: &SurfacePoint| {
            system::place(&self.sheet.surface, &self.sheet.at(at), &self.positions)
        };
        at.iter().map(place).collect()
    }

    fn state(&self) -> State {
        let at = |(rest, x): (&Point, &Point)| Motion {
            center: *x,
            ..Motion::rest(*rest)
        };
        State(
            self.sheet
                .surface
                .positions
                .iter()
                .zip(&self.positions)
                .map(at)
                .collect(),
        )
    }

    fn restore(&mut self, state: &State) {
        self.positions = state.0.iter().map(|m| m.center).collect();
    }

    fn rest(&self) -> &Surface {
        &self.wall.surface
    }
}
