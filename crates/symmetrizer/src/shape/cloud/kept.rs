//! Which points of a cloud stand for the others.

use rand::SeedableRng;
use rand::seq::index::sample;
use rand_pcg::Pcg64;

use crate::geom::{Point, Vector};
use crate::shape::mesh::is_finite;

/// Thinning ends with at least this share of the points wanted, ...
const ENOUGH: f64 = 0.7;
/// aims at this one, ...
const AIM: f64 = 0.85;
/// ... or after this many sizes of the cells.
const SIZES: usize = 12;

/// The document's indices of the finite `points` in different places, each place once, and for each
/// document point the number of its place among them.
pub(super) fn distinct(points: &[Point]) -> (Vec<u32>, Vec<Option<u32>>) {
    // Adding 0.0 makes -0.0 and 0.0 one place.
    let key = |i: u32| <[f64; 3]>::from(points[i as usize].coords.map(|c| c + 0.0));
    let compare = |a: u32, b: u32| {
        let pairs = key(a).into_iter().zip(key(b));
        pairs
            .map(|(p, q)| p.total_cmp(&q))
            .fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
    };
    let mut order: Vec<u32> = (0..points.len() as u32)
        .filter(|&i| is_finite(&points[i as usize]))
        .collect();
    order.sort_unstable_by(|&a, &b| compare(a, b).then(a.cmp(&b)));
    let mut leader = vec![None; points.len()];
    for same in order.chunk_by(|&a, &b| compare(a, b).is_eq()) {
        for &i in same {
            leader[i as usize] = Some(same[0]);
        }
    }
    let mut places = Vec::new();
    let mut number = vec![None; points.len()];
    for i in 0..points.len() {
        let Some(first) = leader[i] else { continue };
        // A leader is the first of its place in the file and has its number before the others.
        if first as usize == i {
            number[i] = Some(places.len() as u32);
            places.push(first);
        }
        number[i] = number[first as usize];
    }
    (places, number)
}

/// At most `most` of `points`, drawn at random from all, so that they scatter as all do.
pub(super) fn drawn(points: &[Point], most: usize) -> Vec<Point> {
    if points.len() <= most {
        return points.to_vec();
    }
    let mut rng = Pcg64::seed_from_u64(0);
    let mut chosen = sample(&mut rng, points.len(), most).into_vec();
    chosen.sort_unstable();
    chosen.into_iter().map(|i| points[i]).collect()
}

/// Indices of those of `points` that are kept, increasing: all where they are at most `most` and
/// `coarse` is 0, or else one of each cell of a grid of at least the size `coarse` that leaves about
/// `most` or fewer; and for each point the number of the kept one of its cell.
pub(super) fn thin(points: &[Point], most: usize, coarse: f64) -> (Vec<u32>, Vec<u32>) {
    let all = || (0..points.len() as u32).collect::<Vec<_>>();
    if points.len() <= most && coarse <= 0.0 {
        return (all(), all());
    }
    let low = points.iter().fold(points[0], |low, p| low.inf(p));
    let high = points.iter().fold(points[0], |high, p| high.sup(p));
    let mut size = coarse.max((high - low).norm() / (most as f64).sqrt());
    let mut cells = Cells::new(points, low, size);
    for _ in 0..SIZES {
        let share = cells.count() as f64 / most as f64;
        let wanted = (ENOUGH..=1.0).contains(&share) || (share < ENOUGH && size <= coarse);
        if wanted {
            break;
        }
        // Cells that a surface meets grow fewer with the square of their size.
        size = coarse.max(size * (share / AIM).sqrt());
        cells = Cells::new(points, low, size);
    }
    cells.kept(points)
}

/// Points sorted by the cell of a grid that they are in.
struct Cells {
    order: Vec<([u32; 3], u32)>,
}

impl Cells {
    fn new(points: &[Point], low: Point, size: f64) -> Self {
        let cell = |p: &Point| <[u32; 3]>::from(((p - low) / size).map(|c| c as u32));
        let mut order: Vec<([u32; 3], u32)> =
            (0..).zip(points).map(|(i, p)| (cell(p), i)).collect();
        order.sort_unstable();
        Self { order }
    }

    fn each(&self) -> impl Iterator<Item = &[([u32; 3], u32)]> {
        self.order.chunk_by(|a, b| a.0 == b.0)
    }

    fn count(&self) -> usize {
        self.each().count()
    }

    fn kept(&self, points: &[Point]) -> (Vec<u32>, Vec<u32>) {
        let mut chosen = vec![0; points.len()];
        for cell in self.each() {
            let places = cell.iter().map(|c| points[c.1 as usize].coords);
            let middle = places.sum::<Vector>() / cell.len() as f64;
            let gap = |i: u32| (points[i as usize].coords - middle).norm_squared();
            let nearer = |a: u32, b: u32| if gap(b) < gap(a) { b } else { a };
            let best = cell.iter().map(|c| c.1).fold(cell[0].1, nearer);
            cell.iter().for_each(|c| chosen[c.1 as usize] = best);
        }
        let mut kept = chosen.clone();
        kept.sort_unstable();
        kept.dedup();
        let mut number = vec![0; points.len()];
        (0..).zip(&kept).for_each(|(n, &k)| number[k as usize] = n);
        (
            kept,
            chosen.into_iter().map(|k| number[k as usize]).collect(),
        )
    }
}
