//! All pairs settle at once, on the way to the straight shape.
//!
//! A field grows from one place to the next and slides where the surface says little. Here each sample has a
//! rigid motion into the straight shape. Gauss and Newton's method makes them such that the moved surface
//! is its own mirror image, while neighbours move alike: the whole shape says where a pair belongs.

use rayon::prelude::*;

use crate::context::{CancelToken, Context};
use crate::deform::elastic::Motion;
use crate::deform::solver::SolveError;
use crate::error::{Error, Result};
use crate::field::grow::Land;
use crate::field::local::{Local, fit};
use crate::field::{Partner, SymmetryField};
use crate::geom::{Ambient, Matrix3, Point, Vector};
use crate::shape::boundary::Boundary;
use crate::shape::{ClosestPoint, Hit, Surface};
use crate::straighten::blend::Blend;
use crate::straighten::equations::{Equations, Spring, along};
use crate::straighten::rotations::Evenness;
use crate::straighten::slopes::{SIGNS, Slope, slopes};
use crate::straighten::{rotations, solve};

/// Weight of the neighbours' agreement beside a pair's distance: at first, so that parts find their places
/// as wholes, and at last.
const STIFF: [f64; 2] = [3.0, 0.1];
/// Weight of the agreement of their steps: without it the steps overshoot.
const STEADY: f64 = 0.3;
/// Weight of a pair's difference in curvature (asinh k r), L^2: .01 counts like a distance of .00017 L.
const LIKENESS: f64 = 3e-4;
/// Difference at which that begins to count less.
const UNLIKE: f64 = 0.1;
/// Distance at which a pair begins to count less, fraction of L, and at which it is none.
const FAR: f64 = 0.01;
const TOO_FAR: f64 = 0.03;
/// Partners face each other to within this cosine.
const MIN_COS: f64 = 0.5;
/// Rounds at the most, and the share over which the stiffness falls.
const ROUNDS: u32 = 30;
const FALLS: f64 = 0.7;
/// Rounds after which it shows which of several fields is to be trusted.
const GLIMPSE: u32 = 8;
/// Settled where the images move less in the mean, fraction of L.
const SETTLED: f64 = 1e-4;
/// Radius of the local isometries at the end, fraction of L.
const RADIUS: f64 = 0.045;

/// What fields settle on: what is known of a surface and its samples once for all of them.
pub struct Settler<'a> {
    land: &'a Land<'a>,
    blend: Blend,
    boundary: Boundary,
    slopes: Vec<[Option<Slope>; SIGNS]>,
}

impl<'a> Settler<'a> {
    /// On `land`.
    pub fn new(land: &'a Land<'a>) -> Self {
        Self {
            blend: Blend::new(land.surface, land.samples),
            boundary: Boundary::of(land.surface),
            slopes: slopes(land.samples, land.reach),
            land,
        }
    }

    /// `field` with its pairs settled.
    ///
    /// # Errors
    /// [`Error::Numerical`], [`Error::Cancelled`].
    pub fn settle(&self, field: &SymmetryField, ctx: &mut Context<'_>) -> Result<SymmetryField> {
        self.settled(ROUNDS, field, |part| ctx.progress(part))
    }

    /// The same with pairs that have settled as far as it takes to tell fields from each other.
    ///
    /// # Errors
    /// As for [`Settler::settle`].
    pub fn glimpse(&self, field: &SymmetryField, cancel: &CancelToken) -> Result<SymmetryField> {
        self.settled(GLIMPSE, field, |_| cancel.check())
    }

    /// In so many `rounds` at the most, before each of which the share that is done is `reached`.
    fn settled(
        &self,
        rounds: u32,
        field: &SymmetryField,
        mut reached: impl FnMut(f64) -> Result<()>,
    ) -> Result<SymmetryField> {
        let land = self.land;
        let mut settling = Settling::new(self, field)?;
        let mut meetings = settling.meetings();
        for round in 0..rounds {
            reached(f64::from(round) / f64::from(rounds))?;
            let part = (f64::from(round) / (FALLS * f64::from(rounds))).min(1.0);
            let stiff = STIFF[0] * (STIFF[1] / STIFF[0]).powf(part);
            settling
                .step(&meetings, stiff)
                .map_err(|_| Error::Numerical {
                    stage: "straighten",
                    step: round as usize,
                    what: "the motions of the samples could not be solved for".into(),
                })?;
            let next = settling.meetings();
            let moved = moved(&meetings, &next);
            meetings = next;
            if part == 1.0 && moved < SETTLED {
                break;
            }
        }
        let partners: Vec<Option<Partner>> = meetings
            .iter()
            .map(|m| m.as_ref().map(|m| m.partner))
            .collect();
        let maps = fit(land.samples, land.reach, &partners, Local::Improper, RADIUS);
        Ok(SymmetryField { partners, maps })
    }
}

/// The samples on their way.
struct Settling<'a> {
    on: &'a Settler<'a>,
    land: &'a Land<'a>,
    closest: ClosestPoint,
    motions: Vec<Motion>,
}

/// A sample and the point of the moved surface that it meets in the mirror.
struct Meeting {
    /// Where the sample is now.
    x: Point,
    hit: Hit,
    /// The mean of both normals, on the sample's side.
    normal: Vector,
    partner: Partner,
}

/// The straight shape's mirror, x = 0.
fn mirrored(v: &Vector) -> Vector {
    Vector::new(-v.x, v.y, v.z)
}

/// The mean way of the partners over the rest shape, fraction of L.
fn moved(before: &[Option<Meeting>], after: &[Option<Meeting>]) -> f64 {
    let ways: Vec<f64> = before
        .iter()
        .zip(after)
        .filter_map(|(a, b)| {
            Some((a.as_ref()?.partner.position - b.as_ref()?.partner.position).norm())
        })
        .collect();
    ways.iter().sum::<f64>() / ways.len().max(1) as f64
}

impl<'a> Settling<'a> {
    /// Begins with what `field` says by itself.
    fn new(on: &'a Settler<'a>, field: &SymmetryField) -> Result<Self> {
        let land = on.land;
        let turns = rotations::solved(land, (field, field), Evenness::AtFirst)?;
        let begun = solve(land, field, &turns)?;
        let begun = land.surface.with_positions(begun);
        let samples = land.samples.list.iter().zip(turns);
        let motions = samples.map(|(s, rotation)| Motion {
            rotation,
            rest_center: s.position,
            center: begun.point(&s.at),
        });
        Ok(Self {
            closest: land.closest.clone(),
            motions: motions.collect(),
            on,
            land,
        })
    }

    /// What each sample meets in the mirror.
    fn meetings(&mut self) -> Vec<Option<Meeting>> {
        let positions = self.on.blend.positions(self.land.surface, &self.motions);
        let now = self.land.surface.with_positions(positions);
        self.closest.follow(&now);
        let samples = 0..self.land.samples.list.len();
        samples
            .into_par_iter()
            .map(|s| self.meeting(&now, s))
            .collect()
    }

    fn meeting(&self, now: &Surface, s: usize) -> Option<Meeting> {
        let at = &self.land.samples.list[s].at;
        let (x, normal) = (now.point(at), now.normal(at));
        let image = Point::from(mirrored(&x.coords));
        let hit = self
            .closest
            .nearest_facing(&image, &mirrored(&normal), MIN_COS, TOO_FAR)?;
        let rest = self.land.surface;
        // Beyond the boundary there is nothing to meet.
        if self.on.boundary.holds(rest, &hit.at) {
            return None;
        }
        let across = mirrored(&now.normal(&hit.at));
        let position = rest.point(&hit.at);
        Some(Meeting {
            x,
            normal: (normal + across).try_normalize(1e-6)?,
            partner: Partner {
                at: hit.at,
                position,
                normal: rest.normal(&hit.at),
                sample: self.land.nearest(&position)?,
                residual: hit.distance,
            },
            hit,
        })
    }

    /// One step of all motions.
    fn step(
        &mut self,
        meetings: &[Option<Meeting>],
        stiff: f64,
    ) -> std::result::Result<(), SolveError> {
        let mut equations = Equations::new(
            self.motions.len(),
            self.land.samples.ambient == Ambient::Plane,
        );
        self.agree(&mut equations, stiff);
        for (s, meeting) in (0..).zip(meetings) {
            if let Some(meeting) = meeting {
                self.meet(&mut equations, s, meeting);
            }
        }
        let twists = equations.solve()?;
        self.motions
            .iter_mut()
            .zip(&twists)
            .for_each(|(m, t)| *m = m.moved(t));
        Ok(())
    }

    /// Neighbours move alike: their motions take both their places, and points above them, to the same.
    fn agree(&self, equations: &mut Equations, stiff: f64) {
        let edges = &self.land.reach.edges;
        let springs: Vec<Spring> = edges
            .par_iter()
            .map(|&(link, weight)| self.spring(link, weight, stiff))
            .collect();
        for ((link, _), spring) in edges.iter().zip(&springs) {
            equations.add_spring(*link, spring);
        }
    }

    /// What holds two neighbours together.
    fn spring(&self, link: [u32; 2], weight: f64, stiff: f64) -> Spring {
        let ends = link.map(|k| &self.land.samples.list[k as usize]);
        let [a, b] = link.map(|k| &self.motions[k as usize]);
        let length = (ends[0].position - ends[1].position).norm();
        let above = ends.map(|e| e.position + length * e.normal);
        let mut spring = Spring::default();
        // Steps agree and motions agree: of a square for both, the misses count by the share of the latter.
        let share = stiff / (stiff + STEADY);
        let weight = weight * self.land.firmness(link) * (stiff + STEADY) / 4.0;
        for x in [ends[0].position, ends[1].position, above[0], above[1]] {
            let (y, z) = (a.apply(&x), b.apply(&x));
            spring.add([y - a.center, z - b.center], share * (y - z), weight);
        }
        spring
    }

    /// A sample comes to lie on the mirrored surface, and its curvatures on the same.
    fn meet(&self, equations: &mut Equations, s: u32, meeting: &Meeting) {
        let k = meeting.partner.sample;
        let (a, b) = (&self.motions[s as usize], &self.motions[k as usize]);
        let arms = [meeting.x - a.center, meeting.hit.point - b.center];
        // Rows of how far the sample goes along a direction, less what its partner goes in the mirror.
        let rows = |d: &Vector| [(s, along(d, &arms[0])), (k, -along(&mirrored(d), &arms[1]))];
        let gap = meeting.x.coords - mirrored(&meeting.hit.point.coords);
        let say = (1.0 + gap.norm_squared() / (FAR * FAR)).powi(-2);
        equations.add(rows(&meeting.normal), meeting.normal.dot(&gap), say);

        let way = meeting.partner.position - self.land.samples.list[k as usize].position;
        let slopes = self.on.slopes[s as usize]
            .iter()
            .zip(&self.on.slopes[k as usize]);
        let unlike: Vec<(f64, Vector)> = slopes
            .filter_map(|(p, q)| {
                let (p, q) = (p.as_ref()?, q.as_ref()?);
                let gradient: Matrix3 = b.rotation;
                Some((q.at(&way) - p.value, mirrored(&(gradient * q.gradient))))
            })
            .collect();
        let squares: f64 = unlike.iter().map(|u| u.0 * u.0).sum();
        let mean = squares / unlike.len().max(1) as f64;
        let say = say * LIKENESS * (1.0 + mean / (UNLIKE * UNLIKE)).powi(-2);
        for (miss, gradient) in &unlike {
            equations.add(rows(gradient), *miss, say);
        }
    }
}
