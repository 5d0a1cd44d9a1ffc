//! Where the points of a surface should go: each to the mean of its copies, along the normal.

use rayon::prelude::*;

use crate::geom::{Point, Vector};
use crate::optimize::balance::Copy;
use crate::optimize::contact::curved;
use crate::optimize::orbit::freedom::{Contact, Equations};
use crate::optimize::orbit::goal::{Goal, Link};
use crate::optimize::orbit::ground::Member;
use crate::shape::{ClosestPoint, Hit, Surface};
use crate::transform::Ambient;

/// Copies face the way of the place's image to within this cosine.
const MIN_COS: f64 = 0.4;
/// A contact that lies sideways by more than this (fraction of L), beyond a rim or in a fold, is none.
const SIDEWAYS: f64 = 1e-3;
/// Motions of a place that are looked at in a round; of more, others in the next.
const LINKS: usize = 16;
/// The points are taken in so many parts, whatever the number of threads, so that sums are the same.
const PARTS: usize = 16;

/// The surface on which orbits are looked at.
pub struct Scene<'a> {
    /// The surface as it is now.
    pub surface: &'a Surface,
    /// Its closest points.
    pub closest: &'a ClosestPoint,
    /// The points of it that are looked at: position, unit normal, area.
    pub points: &'a [(Point, Vector, f64)],
    /// The places that each of them is in.
    pub members: &'a [Vec<Member>],
}

/// The means of all orbits.
#[derive(Clone)]
pub struct Means {
    /// For each point the way to the mean of its copies.
    pub targets: Vec<Vector>,
    /// The copies of each that were found.
    pub copies: Vec<Vec<Copy>>,
    /// The share of its copies that were found.
    pub confidence: Vec<f64>,
    /// Its distance from the mean of all that were found, whatever their weight: equation 1, which of two copies takes
    /// half.
    pub halves: Vec<f64>,
    /// What was found of each goal.
    pub tallies: Vec<Tally>,
}

/// How well a goal is met.
#[derive(Debug, Clone)]
pub struct Tally {
    /// The fit of its motions.
    pub equations: Equations,
    /// Whether it is met from the start.
    is_met: bool,
    /// Sums of weights times 1, distance and squared distance over the copies that were found.
    found: [f64; 3],
    /// The sum of weights over all copies.
    all: f64,
    /// Sums of weights times 1 and the squared way to the mean of the copies, over the places.
    ways: [f64; 2],
}

impl Tally {
    fn new(goal: &Goal) -> Self {
        Self {
            equations: Equations::new(goal),
            is_met: goal.is_met,
            found: [0.0; 3],
            all: 0.0,
            ways: [0.0; 2],
        }
    }

    fn join(&mut self, other: &Self) {
        self.equations.join(&other.equations);
        for (sum, more) in self.found.iter_mut().zip(other.found) {
            *sum += more;
        }
        self.all += other.all;
        for (sum, more) in self.ways.iter_mut().zip(other.ways) {
            *sum += more;
        }
    }

    /// rms distance of the copies from the surface, fraction of L.
    pub fn rms(&self) -> f64 {
        (self.found[2] / self.found[0].max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Mean distance of the copies from the surface, fraction of L.
    fn mean(&self) -> f64 {
        self.found[1] / self.found[0].max(f64::MIN_POSITIVE)
    }

    /// rms displacement of its places by which equation 1 meets it, fraction of L: without what the flat faces of a
    /// curved surface add to the distances.
    pub fn half(&self) -> f64 {
        (self.ways[1] / self.ways[0].max(f64::MIN_POSITIVE)).sqrt()
    }

    /// The share of the copies that were found, by area.
    pub fn held(&self) -> f64 {
        self.found[0] / self.all.max(f64::MIN_POSITIVE)
    }
}

impl Means {
    /// Of the `goals` on a scene, in their `round`.
    pub fn at(scene: &Scene<'_>, goals: &[Goal], round: usize) -> Self {
        let links: Vec<Vec<Vec<Link>>> = goals
            .iter()
            .map(|goal| {
                let places = goal.links(round).into_iter();
                places.map(|all| in_turn(all, round)).collect()
            })
            .collect();
        let count = scene.points.len();
        let size = count.div_ceil(PARTS).max(1);
        let parts: Vec<(Vec<Way>, Vec<Tally>)> = (0..count)
            .collect::<Vec<usize>>()
            .par_chunks(size)
            .map(|part| {
                let mut tallies: Vec<Tally> = goals.iter().map(Tally::new).collect();
                let ways = part
                    .iter()
                    .map(|&v| way(scene, goals, &links, v, &mut tallies));
                (ways.collect(), tallies)
            })
            .collect();
        let mut tallies: Vec<Tally> = goals.iter().map(Tally::new).collect();
        for (_, part) in &parts {
            tallies.iter_mut().zip(part).for_each(|(t, p)| t.join(p));
        }
        let ways = || parts.iter().flat_map(|(ways, _)| ways);
        Self {
            targets: ways().map(|w| w.target).collect(),
            copies: ways().map(|w| w.copies.clone()).collect(),
            confidence: ways().map(|w| w.confidence).collect(),
            halves: ways().map(|w| w.half).collect(),
            tallies,
        }
    }

    /// Mean distance of all copies from the surface, of goals that are not met yet, fraction of L.
    pub fn distance(&self) -> f64 {
        let pursued = || self.tallies.iter().filter(|t| !t.is_met);
        let sum = |k: usize| pursued().map(|t| t.found[k]).sum::<f64>();
        sum(1) / sum(0).max(f64::MIN_POSITIVE)
    }
}

impl Means {
    /// Whether a goal that is pursued has come nearer than it was in the means `before`, to less than `share` of its distance, and
    /// all together have not gone away.
    pub fn gained(&self, before: &Self, share: f64) -> bool {
        let pairs = self.tallies.iter().zip(&before.tallies);
        let mut pursued = pairs.filter(|(now, _)| !now.is_met);
        let nearer = pursued.any(|(now, was)| now.mean() < share * was.mean());
        nearer && self.distance() < before.distance()
    }
}

/// No more than [`LINKS`] of the motions, others in each round.
fn in_turn(links: Vec<Link>, round: usize) -> Vec<Link> {
    let turns = links.len().div_ceil(LINKS).max(1);
    links
        .into_iter()
        .skip(round % turns)
        .step_by(turns)
        .collect()
}

/// The way of a point: see [`Means`].
struct Way {
    target: Vector,
    copies: Vec<Copy>,
    confidence: f64,
    half: f64,
}

/// The way of point `v` to the mean of its copies, itself among them.
fn way(
    scene: &Scene<'_>,
    goals: &[Goal],
    links: &[Vec<Vec<Link>>],
    v: usize,
    tallies: &mut [Tally],
) -> Way {
    let (_, n, area) = scene.points[v];
    let (mut sum, mut found, mut all) = (0.0, 0.0, 0.0);
    let (mut plain, mut count) = (0.0, 0.0);
    let mut places = Vec::new();
    for m in &scene.members[v] {
        let (goal, tally) = (&goals[m.goal], &mut tallies[m.goal]);
        let (mut own, mut copies) = (0.0, 0.0);
        for link in &links[m.goal][m.place] {
            all += if goal.is_met { 0.0 } else { m.weight };
            tally.all += m.weight * area;
            let Some((contact, hit)) = contact(scene, goal, link, v) else {
                continue;
            };
            let distance = hit.distance;
            let here = m.weight * area;
            for (sum, x) in tally
                .found
                .iter_mut()
                .zip([1.0, distance, distance * distance])
            {
                *sum += here * x;
            }
            let weight = contact.weight * m.weight;
            let weighted = Contact {
                weight: weight * area,
                ..contact
            };
            tally.equations.add(goal, link, &weighted);
            // The way back of the gap, along the point's own normal.
            let back = contact.gap * contact.n.dot(&link.t.rotate(&n));
            (own, copies) = (own + back, copies + 1.0);
            if !goal.is_met {
                sum += weight * back;
                found += weight;
                places.push((hit.at, weight));
            }
        }
        let half = own / (1.0 + copies);
        let here = m.weight * area;
        tally.ways[0] += here;
        tally.ways[1] += here * half * half;
        if !goal.is_met {
            plain += m.weight * own;
            count += m.weight * copies;
        }
    }
    Way {
        target: n * (sum / (1.0 + found)),
        copies: places,
        confidence: found / f64::max(all, 1e-9),
        half: plain / (1.0 + count),
    }
}

/// The contact of a point's image under a link, and the closest point of the surface.
fn contact(scene: &Scene<'_>, goal: &Goal, link: &Link, v: usize) -> Option<(Contact, Hit)> {
    let surface = scene.surface;
    let (x, normal, _) = scene.points[v];
    let normal = link.t.rotate(&normal);
    let y = link.t.apply(&x);
    let hit = scene
        .closest
        .nearest_facing(&y, &normal, MIN_COS, goal.reach)?;
    let between = hit.point - y;
    if between.dot(&normal).abs() < 0.5 * hit.distance && hit.distance > SIDEWAYS {
        return None;
    }
    let place: Point = match goal.ambient {
        Ambient::Space => curved(surface, &hit),
        Ambient::Plane => hit.point,
    };
    let n = surface.normal(&hit.at);
    let near = 1.0 - (hit.distance / goal.reach).powi(2);
    let contact = Contact {
        x,
        y,
        n,
        gap: n.dot(&(place - y)),
        weight: n.dot(&normal).max(0.0).powi(2) * near * near,
    };
    Some((contact, hit))
}
