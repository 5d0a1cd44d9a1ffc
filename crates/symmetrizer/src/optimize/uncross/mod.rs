//! Outlines that have come to cross themselves at the end: armpits, notches and claws that were pushed over each
//! other, or that one side has and the other has not.
//!
//! What crosses on one side of the line and not on the other is taken from there: the outline is symmetric already, but
//! for what lies in the folds. What crosses on both sides is let go, as far around as it takes for the inside to
//! open it, and brought back as far as it does not touch.

mod approach;
mod opposite;
mod stretch;

use std::collections::HashSet;

use crate::deform::Igarashi;
use crate::error::Result;
use crate::geom::Point;
use crate::shape::crossings::Crossings;
use crate::shape::wall::Wall;
use crate::transform::{Isometry, Plane};
use approach::approached;
use opposite::opposite;
use stretch::{Stretch, marked, stretches};

/// Edges to either side of a crossing that are changed at first, and how often twice as many.
const NEAR: usize = 2;
const WIDER: u32 = 6;

/// The outline of `wall` at `positions`, symmetric about `plane` but for details, without crossings that the wall has
/// not, where that can be had.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn uncrossed(
    wall: &Wall,
    body: &Igarashi,
    positions: Vec<Point>,
    plane: &Plane,
) -> Result<Vec<Point>> {
    let mut work = Uncrossing::new(wall, positions);
    let mirror = Isometry::mirror(plane);
    work.cut_short();
    for wider in 0..WIDER {
        work.take_from_the_other_side(&mirror, NEAR << wider);
    }
    for wider in 0..WIDER {
        if work.pairs.is_empty() {
            break;
        }
        let freed = work.stretches(NEAR << wider);
        if work.let_go(body, &freed)? {
            work.make_alike(&mirror, &freed);
        }
    }
    work.cut_short();
    Ok(work.positions)
}

/// Loops of no more edges are cut short.
const SHORT: usize = 4;

/// What was let go comes back to within this of where it was, fraction of L: a tail that stays bent is no remedy.
const ASTRAY: f64 = 0.03;

/// Edges that follow each other and turn by more than where this is the cosine lie on each other.
const BACK: f64 = -0.985;

/// How far the work has come.
struct Uncrossing<'a> {
    /// The outline at rest.
    wall: &'a Wall,
    crossings: Crossings,
    /// Pairs of edges that cross at rest, or lie on each other.
    known: HashSet<[usize; 2]>,
    positions: Vec<Point>,
    /// Those that do now and not at rest.
    pairs: Vec<[usize; 2]>,
}

impl<'a> Uncrossing<'a> {
    fn new(wall: &'a Wall, positions: Vec<Point>) -> Self {
        let mut work = Self {
            crossings: Crossings::new(&wall.surface),
            known: HashSet::new(),
            pairs: Vec::new(),
            positions: wall.surface.positions.clone(),
            wall,
        };
        work.known = work.crossing(&work.positions).into_iter().collect();
        work.pairs = work.crossing(&positions);
        work.positions = positions;
        work
    }

    /// The pairs of edges that cross at `positions`, or lie on each other, and do not at rest.
    fn crossing(&self, positions: &[Point]) -> Vec<[usize; 2]> {
        let now = self.wall.surface.with_positions(positions.to_vec());
        let mut crossings = self.crossings.clone();
        crossings.follow(&now);
        let faces = crossings.among(&now, |_| true);
        let mut pairs: Vec<[usize; 2]> = faces.iter().map(|p| p.map(|f| f as usize / 2)).collect();
        pairs.extend(self.turned_back(positions));
        pairs.iter_mut().for_each(|p| p.sort_unstable());
        pairs.sort_unstable();
        pairs.dedup();
        pairs.retain(|pair| !self.known.contains(pair));
        pairs
    }

    /// Edges and those that follow them, where the outline turns back on itself: two that meet do not cross.
    fn turned_back(&self, positions: &[Point]) -> Vec<[usize; 2]> {
        let way = |e: usize| positions[2 * self.wall.next(e)] - positions[2 * e];
        let back = |&[e, next]: &[usize; 2]| {
            let (a, b) = (way(e), way(next));
            a.dot(&b) < BACK * a.norm() * b.norm()
        };
        let all = (0..self.wall.edges()).map(|e| [e, self.wall.next(e)]);
        all.filter(back).collect()
    }

    /// Goes over to `positions` where fewer edges cross, or no more than `most`.
    fn accept(&mut self, positions: Vec<Point>, most: usize) -> bool {
        let pairs = self.crossing(&positions);
        let better = pairs.len() <= most;
        if better {
            (self.positions, self.pairs) = (positions, pairs);
        }
        better
    }

    /// Draws loops of a few edges straight, one after the other, where fewer cross by that.
    fn cut_short(&mut self) {
        let mut tried = HashSet::new();
        loop {
            let stretches = stretches(self.wall, &self.pairs, 0).into_iter();
            let mut short = stretches.filter(|s| s.edges.len() <= SHORT && s.edges.len() > 1);
            let Some(stretch) = short.find(|s| tried.insert(s.edges[0])) else {
                return;
            };
            let most = self.pairs.len().saturating_sub(1);
            self.accept(straight(self.wall, &self.positions, &stretch), most);
        }
    }

    fn stretches(&self, beside: usize) -> Vec<Stretch> {
        stretches(self.wall, &self.pairs, beside)
    }

    /// Gives what crosses, with so many edges to either side, the form of the other side where fewer cross by that:
    /// one stretch, both sides of a crossing, or all.
    fn take_from_the_other_side(&mut self, mirror: &Isometry, beside: usize) {
        let all = self.stretches(beside);
        let pairs = self.pairs.iter();
        let mut sets: Vec<Vec<Stretch>> = all.iter().map(|s| vec![s.clone()]).collect();
        sets.extend(pairs.map(|pair| stretches(self.wall, &[*pair], beside)));
        sets.push(all);
        for set in sets {
            let Some(most) = self.pairs.len().checked_sub(1) else {
                return;
            };
            let taken = set.iter().try_fold(self.positions.clone(), |x, stretch| {
                opposite(self.wall, &x, mirror, stretch)
            });
            if let Some(taken) = taken {
                self.accept(taken, most);
            }
        }
    }

    /// Lets the stretches go where the inside takes them, and brings them back as far as nothing touches. Whether
    /// fewer edges cross by that, and all has come back to near where it was.
    fn let_go(&mut self, body: &Igarashi, freed: &[Stretch]) -> Result<bool> {
        let free = marked(self.wall, freed);
        let opened = body.let_go(&self.positions, &free)?;
        let left = self.crossing(&opened);
        if left.len() >= self.pairs.len() {
            return Ok(false);
        }
        let brought = approached(self.wall, &opened, &self.positions, &free);
        let ways = brought.iter().zip(&self.positions);
        let farthest = ways.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        Ok(farthest <= ASTRAY && self.accept(brought, left.len()))
    }

    /// Makes stretches that were changed on both sides alike, where nothing crosses by that.
    fn make_alike(&mut self, mirror: &Isometry, changed: &[Stretch]) {
        for stretch in changed {
            if let Some(taken) = opposite(self.wall, &self.positions, mirror, stretch) {
                self.accept(taken, self.pairs.len());
            }
        }
    }
}

/// `positions` with the starts of edges within a stretch evenly between its ends.
fn straight(wall: &Wall, positions: &[Point], stretch: &Stretch) -> Vec<Point> {
    let count = stretch.edges.len();
    let (first, last) = (stretch.edges[0], wall.next(stretch.edges[count - 1]));
    let mut drawn = positions.to_vec();
    for (k, &e) in stretch.edges.iter().enumerate().skip(1) {
        let share = k as f64 / count as f64;
        for side in 0..2 {
            let (a, b) = (positions[2 * first + side], positions[2 * last + side]);
            drawn[2 * e + side] = a + share * (b - a);
        }
    }
    drawn
}
