//! What is to be made exact: an orbit's motions and the places that they carry onto each other.

use std::collections::BTreeSet;

use crate::group::Pattern;
use crate::optimize::orbit::slides::slides;
use crate::slip::Continuous;
use crate::transform::{Ambient, Axis, Isometry};

/// Symmetries that are made exact together.
#[derive(Debug, Clone)]
pub struct Goal {
    /// What it is called: `C5`, `row 5`, `6 copies`, `mirror`, ...
    pub name: String,
    /// Ids of the symmetries that it is made of.
    pub symmetries: Vec<u32>,
    /// The motions.
    pub orbit: Orbit,
    /// The samples of each place, increasing: one place of a group or slide, else one for each copy.
    pub places: Vec<Vec<u32>>,
    /// All places as a share of the surface's area.
    pub area_fraction: f64,
    /// How far from the surface an image may lie and still be a copy, fraction of L.
    pub reach: f64,
    /// Where it lives.
    pub ambient: Ambient,
    /// Whether it is exact already: nothing is moved for it.
    pub is_met: bool,
}

/// The motions of an orbit.
#[derive(Debug, Clone)]
pub enum Orbit {
    /// The elements of a group but the identity, all on one place.
    Group(Vec<Isometry>),
    /// Copies in a row or grid.
    Regular(Pattern),
    /// Copies in free positions: the motions from the first to each.
    Free(Vec<Isometry>),
    /// A place that slides along itself, and how far it reaches along its axis, fraction of L.
    Slide(Box<Continuous>, f64),
}

/// A motion that carries one place onto another.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// The place that it carries.
    pub from: usize,
    /// The place that it is carried onto.
    pub to: usize,
    /// The motion.
    pub t: Isometry,
}

impl Goal {
    /// The motions of each place. Of slides, which have any number, those of this `round`.
    pub fn links(&self, round: usize) -> Vec<Vec<Link>> {
        let one = |motions: Vec<Isometry>| {
            let link = |t| Link { from: 0, to: 0, t };
            vec![motions.into_iter().map(link).collect()]
        };
        match &self.orbit {
            Orbit::Group(elements) => one(elements.clone()),
            Orbit::Slide(slide, extent) => one(slides(slide, *extent, round)),
            Orbit::Free(frames) => between(frames),
            Orbit::Regular(pattern) => between(&pattern.elements()),
        }
    }

    /// The motions as they are made exact: the elements of a group without the identity, else the motions from the
    /// first place to each, the identity first. Of slides there are none to list.
    pub fn elements(&self) -> Vec<Isometry> {
        match &self.orbit {
            Orbit::Group(elements) => elements.clone(),
            Orbit::Regular(pattern) => pattern.elements(),
            Orbit::Free(frames) => frames.clone(),
            Orbit::Slide(..) => Vec::new(),
        }
    }

    /// The number of copies in an orbit; none for a slide, which has any number.
    pub fn order(&self) -> Option<usize> {
        match &self.orbit {
            Orbit::Group(elements) => Some(elements.len() + 1),
            Orbit::Regular(_) | Orbit::Free(_) => Some(self.places.len()),
            Orbit::Slide(..) => None,
        }
    }

    /// The order of the group, where it is one of rotations about one axis, and that axis.
    pub fn cyclic(&self) -> Option<(usize, Axis)> {
        let Orbit::Group(elements) = &self.orbit else {
            return None;
        };
        let axis = Axis::of(elements.first()?)?;
        let about = |t: &Isometry| {
            let own = Axis::of(t);
            own.is_some_and(|own| own.direction.cross(&axis.direction).norm() < ONE_AXIS)
        };
        let all = self.ambient == Ambient::Space && elements.iter().all(about);
        all.then_some((elements.len() + 1, axis))
    }

    /// The share of the smaller goal's samples that are in both.
    pub fn shared(&self, other: &Self) -> f64 {
        let samples = |g: &Self| {
            g.places
                .iter()
                .flatten()
                .copied()
                .collect::<BTreeSet<u32>>()
        };
        let (a, b) = (samples(self), samples(other));
        a.intersection(&b).count() as f64 / a.len().min(b.len()).max(1) as f64
    }

    /// Whether its places are the whole surface.
    pub fn is_of_the_whole(&self) -> bool {
        self.area_fraction >= WHOLE
    }
}

/// Rotations are about one axis whose directions differ by less than this sine: those of a group are exact.
const ONE_AXIS: f64 = 1e-6;

/// Places of this share of the area are the whole surface: a few samples beside noise or open rims find no partner.
pub const WHOLE: f64 = 0.95;

/// The motions from each of the copies that `frames` lead to, to all others.
fn between(frames: &[Isometry]) -> Vec<Vec<Link>> {
    let all = 0..frames.len();
    let from = |from: usize| {
        let back = frames[from].inverse();
        let others = all.clone().filter(move |&to| to != from);
        let link = |to: usize| Link {
            from,
            to,
            t: frames[to].after(&back),
        };
        others.map(link).collect()
    };
    all.clone().map(from).collect()
}
