//! Stretches of an outline's rings.

use crate::shape::wall::Wall;

/// Crossings whose edges lie no further apart along their ring than this share of it are loops: what lies between is
/// changed with them.
const LOOP: f64 = 0.05;

/// Edges of a ring that follow each other, fewer than all.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stretch {
    /// The ring.
    pub ring: usize,
    /// The first edge, and all that follow, in order.
    pub edges: Vec<usize>,
}

impl Stretch {
    /// The edges whose start lies within: all but the first.
    pub fn inner(&self) -> &[usize] {
        &self.edges[1..]
    }
}

/// The stretches around `pairs` of edges that cross, with so many edges `beside` each; rings that would change as a whole
/// are left out.
pub fn stretches(wall: &Wall, pairs: &[[usize; 2]], beside: usize) -> Vec<Stretch> {
    let mut marks = vec![false; wall.edges()];
    for pair in pairs {
        pair.iter()
            .for_each(|&e| mark(wall, [e, e], beside, &mut marks));
        if let Some(between) = between(wall, *pair) {
            mark(wall, between, beside, &mut marks);
        }
    }
    (0..wall.rings.len())
        .flat_map(|ring| runs(wall, ring, &marks))
        .collect()
}

/// Which edges of a wall start within one of the stretches.
pub fn marked(wall: &Wall, stretches: &[Stretch]) -> Vec<bool> {
    let mut marks = vec![false; wall.edges()];
    let inner = stretches.iter().flat_map(Stretch::inner);
    inner.for_each(|&e| marks[e] = true);
    marks
}

/// First and last edge of the shorter way between two of one ring, where that is a loop.
fn between(wall: &Wall, [e, f]: [usize; 2]) -> Option<[usize; 2]> {
    let ring = wall.rings.iter().find(|r| r.contains(&e))?;
    if !ring.contains(&f) {
        return None;
    }
    let count = ring.len();
    let way = (f + count - e) % count;
    let (first, last, way) = match way <= count - way {
        true => (e, f, way),
        false => (f, e, count - way),
    };
    (way as f64 <= LOOP * count as f64).then_some([first, last])
}

/// Marks the edges from the first to the last, on their ring, and so many `beside` them.
fn mark(wall: &Wall, [first, last]: [usize; 2], beside: usize, marks: &mut [bool]) {
    let Some(ring) = wall.rings.iter().find(|ring| ring.contains(&first)) else {
        return;
    };
    let count = ring.len();
    let way = (last + count - first) % count;
    let from = first - ring.start + count * (1 + beside / count) - beside;
    for k in 0..=way + 2 * beside {
        marks[ring.start + (from + k) % count] = true;
    }
}

/// The runs of marked edges of a ring, none where all are.
fn runs(wall: &Wall, ring: usize, marks: &[bool]) -> Vec<Stretch> {
    let range = wall.rings[ring].clone();
    let Some(open) = range.clone().find(|&e| !marks[e]) else {
        return Vec::new();
    };
    let mut found: Vec<Vec<usize>> = Vec::new();
    let mut going = false;
    for k in 1..range.len() {
        let edge = range.start + (open - range.start + k) % range.len();
        match (marks[edge], going, found.last_mut()) {
            (true, true, Some(run)) => run.push(edge),
            (true, ..) => found.push(vec![edge]),
            _ => {}
        }
        going = marks[edge];
    }
    let stretch = |edges| Stretch { ring, edges };
    found.into_iter().map(stretch).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    /// A regular polygon of a hundred edges, none of them long enough to be cut.
    fn round() -> Wall {
        let corner = |k: u32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 2000.0).sin_cos();
            Point::new(cos, sin, 0.0)
        };
        Wall::new(&[(0..2000).map(corner).collect()]).expect("a wall")
    }

    #[test]
    fn a_loop_is_one_stretch_over_the_seam() {
        let wall = round();
        let count = wall.edges();
        let found = stretches(&wall, &[[3, count - 4]], 2);
        let edges: Vec<usize> = (count - 6..count).chain(0..6).collect();
        assert_eq!(found, [Stretch { ring: 0, edges }]);
    }

    #[test]
    fn edges_far_apart_are_two_stretches() {
        let wall = round();
        let found = stretches(&wall, &[[100, 1000]], 3);
        let edges: Vec<usize> = found.iter().map(|s| s.edges.len()).collect();
        assert_eq!(edges, [7, 7]);
        let inside = marked(&wall, &found).iter().filter(|m| **m).count();
        assert_eq!(inside, 12);
    }

    #[test]
    fn a_whole_ring_is_no_stretch() {
        let wall = round();
        assert!(stretches(&wall, &[[0, 1]], 1500).is_empty());
    }
}
