//! Growth of a field over the surface: pairs are accepted next to accepted ones, the surest first.

use rayon::prelude::*;

use crate::context::CancelToken;
use crate::field::cut::torn;
use crate::field::local::{Local, fit};
use crate::field::{Partner, Reach, SymmetryField};
use crate::geom::{Point, PointIndex, Vector};
use crate::sample::Samples;
use crate::shape::wall::Wall;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::Isometry;

/// What a field grows on.
pub struct Land<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// Its closest points.
    pub closest: &'a ClosestPoint,
    /// Its samples.
    pub samples: &'a Samples,
    /// What lies around each sample.
    pub reach: &'a Reach,
    /// Stiffness of each face, where it is not 1 everywhere.
    pub stiffness: Option<&'a [f64]>,
    /// The wall that the surface is, where it is one.
    pub wall: Option<&'a Wall>,
    index: PointIndex<3>,
}

/// Distances of a partner from where its neighbours' mirrors say, fractions of L, each exhausted before the
/// next: grown at the widest at once, pairs slide.
const TIERS: [f64; 4] = [0.006, 0.01, 0.015, 0.02];
/// Those of the second stage, with isometries instead of mirrors.
const WIDE_TIERS: [f64; 3] = [0.015, 0.02, 0.03];
/// Radius of local fits in both stages, fractions of L.
pub const RADII: [f64; 2] = [0.08, 0.045];
/// The second stage is left out where the first covers more.
const COVERED: f64 = 0.985;
/// Partners face where the image faces to within this cosine.
const MIN_COS: f64 = 0.5;
/// Accepted neighbours that a candidate needs.
const NEIGHBORS: usize = 2;
/// Rounds of a tier at the most.
const ROUNDS: usize = 80;
/// Cuts at the most.
const CUTS: usize = 3;

impl<'a> Land<'a> {
    /// Over a surface and its samples.
    pub fn new(
        surface: &'a Surface,
        closest: &'a ClosestPoint,
        samples: &'a Samples,
        reach: &'a Reach,
    ) -> Self {
        let places: Vec<[f64; 3]> = samples
            .list
            .iter()
            .map(|s| s.position.coords.into())
            .collect();
        Self {
            index: PointIndex::new(&places),
            surface,
            closest,
            samples,
            reach,
            stiffness: None,
            wall: None,
        }
    }

    /// The same with a stiffness for each face.
    pub fn with_stiffness(self, stiffness: Option<&'a [f64]>) -> Self {
        Self { stiffness, ..self }
    }

    /// The same over a wall.
    pub fn with_wall(self, wall: Option<&'a Wall>) -> Self {
        Self { wall, ..self }
    }

    /// Stiffness between two samples: the mean of theirs.
    pub fn firmness(&self, [i, j]: [u32; 2]) -> f64 {
        let at = |k: u32| self.samples.list[k as usize].at.face as usize;
        self.stiffness.map_or(1.0, |s| (s[at(i)] + s[at(j)]) / 2.0)
    }

    /// The partner of sample `s` under `t`, where the surface lies within `tau` of its image and faces its
    /// way.
    pub fn image(&self, s: u32, t: &Isometry, tau: f64) -> Option<Partner> {
        let sample = &self.samples.list[s as usize];
        self.near(&t.apply(&sample.position), &t.rotate(&sample.normal), tau)
    }

    /// The sample nearest to a place.
    pub fn nearest(&self, x: &Point) -> Option<u32> {
        Some(self.index.nearest(&x.coords.into())?.0)
    }

    fn near(&self, image: &Point, normal: &Vector, tau: f64) -> Option<Partner> {
        let hit = self.closest.nearest_facing(image, normal, MIN_COS, tau)?;
        Some(Partner {
            at: hit.at,
            position: hit.point,
            normal: self.surface.normal(&hit.at),
            sample: self.nearest(&hit.point)?,
            residual: hit.distance,
        })
    }
}

/// Grows `seeds` over the surface, no further once `cancel` is set.
pub fn grow(land: &Land<'_>, seeds: Vec<Option<Partner>>, cancel: &CancelToken) -> SymmetryField {
    let tiers = |partners: &mut _, (local, radius), taus: &[f64]| {
        tiers(land, partners, (local, radius), taus, cancel);
    };
    let mut partners = seeds;
    for _ in 0..=CUTS {
        tiers(&mut partners, (Local::Mirror, RADII[0]), &TIERS);
        let maps = fit(land.samples, land.reach, &partners, Local::Mirror, RADII[0]);
        if !torn(land, &mut partners, &maps) {
            break;
        }
    }
    let share = partners.iter().flatten().count() as f64 / partners.len().max(1) as f64;
    let (local, radius) = if share < COVERED {
        tiers(&mut partners, (Local::Improper, RADII[1]), &WIDE_TIERS);
        (Local::Improper, RADII[1])
    } else {
        (Local::Mirror, RADII[0])
    };
    let maps = fit(land.samples, land.reach, &partners, local, radius);
    SymmetryField { partners, maps }
}

/// Grows `seeds` over the rest of the surface and leaves them as they are: pairs that were found all at once.
pub fn fill(land: &Land<'_>, seeds: Vec<Option<Partner>>, cancel: &CancelToken) -> SymmetryField {
    let narrow = (Local::Improper, RADII[1]);
    let mut partners = seeds.clone();
    for &tau in &TIERS {
        for _ in 0..ROUNDS {
            if cancel.is_cancelled() {
                break;
            }
            let mut next = grown(land, &partners, narrow, tau);
            for (p, seed) in next.iter_mut().zip(&seeds).filter(|(_, s)| s.is_some()) {
                *p = *seed;
            }
            if !more(&mut partners, next) {
                break;
            }
        }
    }
    let maps = fit(land.samples, land.reach, &partners, Local::Mirror, RADII[0]);
    SymmetryField { partners, maps }
}

/// Accepts candidates tier by tier; accepted pairs are matched anew in every round.
fn tiers(
    land: &Land<'_>,
    partners: &mut Vec<Option<Partner>>,
    local: (Local, f64),
    taus: &[f64],
    cancel: &CancelToken,
) {
    for &tau in taus {
        for _ in 0..ROUNDS {
            if cancel.is_cancelled() {
                return;
            }
            let next = grown(land, partners, local, tau);
            if !more(partners, next) {
                break;
            }
        }
    }
}

/// The partners a round later: accepted ones matched anew, candidates within `tau` accepted.
fn grown(
    land: &Land<'_>,
    partners: &[Option<Partner>],
    (local, radius): (Local, f64),
    tau: f64,
) -> Vec<Option<Partner>> {
    let maps = fit(land.samples, land.reach, partners, local, radius);
    (0..partners.len() as u32)
        .into_par_iter()
        .map(|s| match (&partners[s as usize], &maps[s as usize]) {
            (Some(_), Some(t)) => land.image(s, t, tau),
            (Some(kept), None) => Some(*kept),
            _ => candidate(land, &maps, s, tau),
        })
        .collect()
}

/// Takes over the partners of the next round; whether they are more.
fn more(partners: &mut Vec<Option<Partner>>, next: Vec<Option<Partner>>) -> bool {
    let accepted = |p: &[Option<Partner>]| p.iter().flatten().count();
    let grown = accepted(&next) > accepted(partners);
    *partners = next;
    grown
}

/// The partner of a sample without one where the maps of its neighbours say.
fn candidate(land: &Land<'_>, maps: &[Option<Isometry>], s: u32, tau: f64) -> Option<Partner> {
    let sample = &land.samples.list[s as usize];
    let near = &land.reach.neighbors[s as usize];
    let (mut image, mut normal, mut count) = (Vector::zeros(), Vector::zeros(), 0);
    for t in near.iter().filter_map(|&n| maps[n as usize].as_ref()) {
        image += t.apply(&sample.position).coords;
        normal += t.rotate(&sample.normal);
        count += 1;
    }
    if count < NEIGHBORS {
        return None;
    }
    let normal = normal.try_normalize(1e-6)?;
    land.near(&Point::from(image / count as f64), &normal, tau)
}
