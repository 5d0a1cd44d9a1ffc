//! One side for all normals of a cloud: outwards where it looks closed.
//!
//! Hoppe et al. 1992 carry the side along a spanning tree of neighbours with like normals. Here two
//! neighbours agree when one normal, mirrored in the plane half way between them, is the other: that
//! is right on arcs, across sharp edges and between the two sides of a sheet alike. Regions inside
//! which all is clear are then joined by the vote of all neighbours along their borders.

use rayon::prelude::*;

use crate::geom::{Point, PointIndex, Vector, directions};

/// Neighbours that a point talks to.
const NEIGHBOURS: usize = 10;
/// Agreement from which two neighbours need no vote.
const CLEAR: f64 = 0.85;
/// Noise below which the direction between two neighbours says nothing, in standard deviations.
const BLURRED: f64 = 0.7;
/// Directions in which the outermost points are looked for.
const DIRECTIONS: usize = 256;

/// How two neighbours agree: the sign says whether their normals are on one side as they are, the
/// size how clearly.
struct Bond {
    i: u32,
    j: u32,
    agreement: f64,
}

/// Unit normals of points, to either side, and how far they can be trusted.
#[derive(Clone, Copy)]
pub(super) struct Sided<'a> {
    /// Where.
    pub points: &'a [Point],
    /// The normals.
    pub normals: &'a [Vector],
    /// From 1, clear, to 0, unknown.
    pub trust: &'a [f64],
    /// Standard deviation of the points' distance from the surface.
    pub noise: f64,
}

/// The given normals turned to one side, outwards where that can be told.
pub(super) fn orient(given: Sided<'_>) -> Vec<Vector> {
    let points = given.points;
    let mut normals = given.normals.to_vec();
    let bonds = bonds(given);
    let mut sides = Sides::new(points.len());
    for bond in bonds.iter().take_while(|b| b.agreement.abs() >= CLEAR) {
        sides.join(bond.i, bond.j, bond.agreement < 0.0);
    }
    while join_by_votes(&mut sides, &bonds) {}
    let found: Vec<(u32, bool)> = (0..points.len() as u32).map(|i| sides.find(i)).collect();
    for (n, (_, turned)) in normals.iter_mut().zip(&found) {
        if *turned {
            *n = -*n;
        }
    }
    let regions: Vec<u32> = found.into_iter().map(|f| f.0).collect();
    let inwards = inwards(points, &normals, &regions);
    for (n, &region) in normals.iter_mut().zip(&regions) {
        if inwards[region as usize] {
            *n = -*n;
        }
    }
    normals
}

/// The share of neighbours whose normals are clearly on different sides.
pub(super) fn disagreement(given: Sided<'_>) -> f64 {
    let bonds = bonds(given);
    let clear = bonds.iter().filter(|b| b.agreement.abs() >= CLEAR);
    let against = clear.clone().filter(|b| b.agreement < 0.0).count();
    against as f64 / clear.count().max(1) as f64
}

/// All bonds, the clearest first.
fn bonds(given: Sided<'_>) -> Vec<Bond> {
    let Sided {
        points,
        normals,
        trust,
        noise,
    } = given;
    let places: Vec<[f64; 3]> = points.iter().map(|p| p.coords.into()).collect();
    let index = PointIndex::new(&places);
    let blur = (BLURRED * noise).powi(2);
    let mut bonds: Vec<Bond> = (0..points.len())
        .into_par_iter()
        .flat_map_iter(|i| {
            let near = index.nearest_n(&places[i], NEIGHBOURS + 1).into_iter();
            let others = near.map(|(j, _)| j as usize).filter(move |&j| j != i);
            others.map(move |j| Bond {
                i: i as u32,
                j: j as u32,
                agreement: trust[i].min(trust[j])
                    * agreement([points[i], points[j]], [normals[i], normals[j]], blur),
            })
        })
        .collect();
    let clarity = |b: &Bond| b.agreement.abs();
    bonds.par_sort_by(|a, b| {
        clarity(b)
            .total_cmp(&clarity(a))
            .then((a.i, a.j).cmp(&(b.i, b.j)))
    });
    bonds
}

/// The cosine between the second normal and the first one mirrored in the plane half way between
/// the points; where these are within the noise of each other, of the first one as it is.
fn agreement([p, q]: [Point; 2], [m, n]: [Vector; 2], blur: f64) -> f64 {
    let d = q - p;
    let square = d.norm_squared() + blur;
    if square <= 0.0 {
        return m.dot(&n);
    }
    m.dot(&n) - 2.0 * m.dot(&d) * n.dot(&d) / square
}

/// Joins regions by the sum of the bonds between them, the clearest sums first and each region once;
/// whether any were joined.
fn join_by_votes(sides: &mut Sides, bonds: &[Bond]) -> bool {
    let mut votes: Vec<(u32, u32, f64)> = Vec::new();
    for bond in bonds {
        let ((a, turn_a), (b, turn_b)) = (sides.find(bond.i), sides.find(bond.j));
        if a != b {
            let sign = if turn_a == turn_b { 1.0 } else { -1.0 };
            votes.push((a.min(b), a.max(b), sign * bond.agreement));
        }
    }
    votes.sort_by_key(|v| (v.0, v.1));
    let mut sums: Vec<(u32, u32, f64)> = votes
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .map(|same| (same[0].0, same[0].1, same.iter().map(|v| v.2).sum()))
        .collect();
    sums.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
    let mut joined = vec![false; sides.parent.len()];
    for (a, b, sum) in &sums {
        if !joined[*a as usize] && !joined[*b as usize] {
            joined[*a as usize] = true;
            joined[*b as usize] = true;
            sides.join(*a, *b, *sum < 0.0);
        }
    }
    !sums.is_empty()
}

/// For each region, by its number, whether its outermost points look inwards. A region that has none
/// of the whole cloud's outermost points is asked for its own.
fn inwards(points: &[Point], normals: &[Vector], regions: &[u32]) -> Vec<bool> {
    let mut votes = vec![0.0; points.len()];
    let mut vote = |i: usize, direction: &Vector| {
        let outwards = normals[i].dot(direction);
        votes[regions[i] as usize] += outwards * outwards.abs();
    };
    let mut asked = vec![false; points.len()];
    let all: Vec<usize> = (0..points.len()).collect();
    for direction in directions(DIRECTIONS) {
        if let Some(i) = outermost(points, &all, &direction) {
            vote(i, &direction);
            asked[regions[i] as usize] = true;
        }
    }
    let mut rest: Vec<usize> = all
        .into_iter()
        .filter(|&i| !asked[regions[i] as usize])
        .collect();
    rest.sort_by_key(|&i| (regions[i], i));
    for region in rest.chunk_by(|&i, &j| regions[i] == regions[j]) {
        for direction in directions(DIRECTIONS) {
            if let Some(i) = outermost(points, region, &direction) {
                vote(i, &direction);
            }
        }
    }
    votes.into_iter().map(|v| v < 0.0).collect()
}

fn outermost(points: &[Point], of: &[usize], direction: &Vector) -> Option<usize> {
    let reach = |i: &usize| points[*i].coords.dot(direction);
    of.iter()
        .copied()
        .max_by(|a, b| reach(a).total_cmp(&reach(b)))
}

/// Disjoint sets in which each member is on the side of its set or turned against it.
struct Sides {
    parent: Vec<u32>,
    turned: Vec<bool>,
    size: Vec<u32>,
}

impl Sides {
    fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
            turned: vec![false; count],
            size: vec![1; count],
        }
    }

    /// The set of `i`, and whether `i` is turned against it.
    fn find(&self, mut i: u32) -> (u32, bool) {
        // Sets are joined by size, so that the way up is short.
        let mut turned = false;
        while self.parent[i as usize] != i {
            turned ^= self.turned[i as usize];
            i = self.parent[i as usize];
        }
        (i, turned)
    }

    /// Makes the sets of two members one, so that these are turned against each other or not; nothing
    /// where it is one set already.
    fn join(&mut self, i: u32, j: u32, against: bool) {
        let ((a, turn_a), (b, turn_b)) = (self.find(i), self.find(j));
        if a == b {
            return;
        }
        let (top, below) = match self.size[a as usize] >= self.size[b as usize] {
            true => (a, b),
            false => (b, a),
        };
        self.parent[below as usize] = top;
        self.turned[below as usize] = turn_a ^ turn_b ^ against;
        self.size[top as usize] += self.size[below as usize];
    }
}
