//! What is tangled at the end gets the form back that it had.
//!
//! Fingers, claws and folds that have no counterpart, or a wrong one, may be pushed through each other on the
//! way. Nothing that was gained is worth that: there the surface regains the input's own form, carried along
//! with what lies around, over no more of it than it takes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::deform::carry::motions;
use crate::deform::regain::regain;
use crate::error::Result;
use crate::optimize::ease::eased;
use crate::optimize::tangles::Tangles;
use crate::shape::Surface;
use crate::shape::crossings::crossing_faces;
use crate::shape::inverted::inverted_faces;

/// Rings of vertices around the last tangled faces that are eased at the most.
const RINGS: usize = 3;
/// Attempts at the most.
const ATTEMPTS: usize = 10;
/// How far around a tangle the form is given back in the first attempt, along the surface: fraction of L, and mean
/// edges at the least.
const FIRST: (f64, f64) = (0.015, 2.0);
/// How much further in each one that follows, where it was not enough.
const FURTHER: f64 = 1.5;

/// What lies around makes room, as far from a tangle as this many times that.
const ROOM: f64 = 3.0;
/// No more than this share of the area is given back.
const MOST: f64 = 0.5;

/// To untangle a face is worth the new form of so many: two slivers between two fingers are not worth a hand.
const WORTH: f64 = 100.0;

/// A surface that was mended.
pub struct Mended {
    /// The surface.
    pub surface: Surface,
    /// Share of its area that has the form of the input again.
    pub share: f64,
    /// Faces that are tangled all the same.
    pub left: usize,
}

impl Mended {
    /// What is tangled and what it took, as a share of the surface.
    fn cost(&self) -> f64 {
        WORTH * self.left as f64 / self.surface.triangles.len().max(1) as f64 + self.share
    }
}

/// `after`, a deformed state of `before`, mended where faces cross or are turned over that did not and were not
/// before: there it has the form of `before` again. What cannot be mended, or only at the cost of much that is well,
/// stays.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn mend(before: &Surface, after: Surface) -> Result<Mended> {
    let untouched = |surface, left| Mended {
        surface,
        share: 0.0,
        left,
    };
    if crossing_faces(&after).is_empty() && inverted_faces(before, &after).is_empty() {
        return Ok(untouched(after, 0));
    }
    let (mut mending, motions) = rayon::join(|| Mending::new(before), || motions(before, &after));
    let mut tangled = mending.tangles.faces(before, &after);
    let mut best = untouched(after.clone(), tangled.len());
    for _ in 0..ATTEMPTS {
        if tangled.is_empty() {
            break;
        }
        mending.widen(before, &tangled);
        let core = mending.within(before, 1.0);
        let share = share(before, &core);
        if share > MOST {
            break;
        }
        let freed = mending.within(before, ROOM);
        let surface = after.with_positions(regain((before, &after), &motions, &core, &freed)?);
        tangled = mending.tangles.faces(before, &surface);
        let mended = Mended {
            surface,
            share,
            left: tangled.len(),
        };
        if mended.cost() < best.cost() {
            best = mended;
        }
    }
    Ok(mending.eased(before, best))
}

/// The share of the area at the vertices that are freed.
fn share(surface: &Surface, freed: &[bool]) -> f64 {
    let areas = surface.vertex_areas.iter().zip(freed);
    areas.filter(|(_, f)| **f).map(|(a, _)| a).sum::<f64>() / surface.area()
}

/// How far the mending has come.
struct Mending {
    tangles: Tangles,
    /// Vertices next to each.
    neighbors: Vec<Vec<u32>>,
    /// How far around each vertex the form is given back, 0 where it lies at no tangle.
    reach: Vec<f64>,
    /// The first of them.
    first: f64,
}

impl Mending {
    fn new(before: &Surface) -> Self {
        let neighbors = before.next_to_vertices();
        Self {
            tangles: Tangles::of(before, &neighbors),
            reach: vec![0.0; before.positions.len()],
            first: FIRST.0.max(FIRST.1 * before.mean_edge()),
            neighbors,
        }
    }

    /// Reaches further from where faces are still tangled than what was given back there did.
    fn widen(&mut self, surface: &Surface, tangled: &[u32]) {
        let (_, owner) = self.spread(surface, 1.0);
        let mut at: Vec<u32> = tangled
            .iter()
            .flat_map(|&f| surface.triangles[f as usize])
            .collect();
        at.sort_unstable();
        at.dedup();
        let wider = |&v: &u32| match owner[v as usize] {
            Some(source) => (self.reach[source as usize] * FURTHER).max(self.reach[v as usize]),
            None => self.first,
        };
        let reach: Vec<f64> = at.iter().map(wider).collect();
        for (v, reach) in at.into_iter().zip(reach) {
            self.reach[v as usize] = reach;
        }
    }

    /// What is `mended` but for a few faces, these and what is next to them eased, where that leaves fewer.
    fn eased(&mut self, before: &Surface, mut best: Mended) -> Mended {
        let mut freed = vec![false; before.positions.len()];
        for _ in 0..RINGS {
            if best.left == 0 {
                break;
            }
            let tangled = self.tangles.faces(before, &best.surface);
            for &v in tangled.iter().flat_map(|&f| &before.triangles[f as usize]) {
                freed[v as usize] = true;
            }
            freed = self.next_to(&freed);
            let surface = eased(before, &best.surface, &freed, &self.neighbors);
            let next = Mended {
                left: self.tangles.faces(before, &surface).len(),
                share: best.share + share(before, &freed),
                surface,
            };
            if next.cost() < best.cost() {
                best = next;
            }
        }
        best
    }

    /// These vertices and those next to them.
    fn next_to(&self, inside: &[bool]) -> Vec<bool> {
        let near = |v: usize| self.neighbors[v].iter().any(|&n| inside[n as usize]);
        (0..inside.len()).map(|v| inside[v] || near(v)).collect()
    }

    /// The vertices within so many times the reach of a tangle, along the edges at rest.
    fn within(&self, surface: &Surface, times: f64) -> Vec<bool> {
        let (left, _) = self.spread(surface, times);
        left.iter().map(|l| *l > 0.0).collect()
    }

    /// How much of so many `times` its reach is left at each vertex, of that tangled vertex which reaches furthest
    /// beyond it, and which one that is.
    fn spread(&self, surface: &Surface, times: f64) -> (Vec<f64>, Vec<Option<u32>>) {
        let mut left: Vec<f64> = self.reach.iter().map(|r| times * r).collect();
        let own = (0..).zip(&left).map(|(v, r)| (*r > 0.0).then_some(v));
        let mut owner: Vec<Option<u32>> = own.collect();
        // Lengths are not negative, so their bits are in order.
        let entry = |left: f64, v: u32| (left.to_bits(), Reverse(v));
        let sources = (0..).zip(&left).filter(|(_, r)| **r > 0.0);
        let mut queue: BinaryHeap<_> = sources.map(|(v, r)| entry(*r, v)).collect();
        while let Some((bits, Reverse(v))) = queue.pop() {
            let here = f64::from_bits(bits);
            if left[v as usize] > here {
                continue;
            }
            for &n in &self.neighbors[v as usize] {
                let way = surface.positions[n as usize] - surface.positions[v as usize];
                let there = here - way.norm();
                if there > left[n as usize] {
                    left[n as usize] = there;
                    owner[n as usize] = owner[v as usize];
                    queue.push(entry(there, n));
                }
            }
        }
        (left, owner)
    }
}
