//! A bar of square section whose vertices are not in rows: jittered, its squares split at random.

use std::collections::BTreeMap;

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use symmetrizer::geom::Point;
use symmetrizer::shape::Mesh;

/// Squares along x, y and z; the bar is four times as long as it is wide.
const SQUARES: [i32; 3] = [64, 16, 16];
/// The longest way of a vertex out of its row, as a share of a square's side.
const JITTER: f64 = 0.25;
/// Where the random numbers start.
const SEED: u64 = 7;

/// The bar, 1 wide, along x from 0.
pub fn bar() -> Mesh {
    let mut rng = Pcg64::seed_from_u64(SEED);
    let mut grid = Grid::default();
    for (axis, &squares) in SQUARES.iter().enumerate() {
        for end in [0, squares] {
            side(&mut grid, axis, end, &mut rng);
        }
    }
    Mesh {
        positions: grid.places.iter().map(|at| place(*at, &mut rng)).collect(),
        polygons: grid.triangles.into_iter().collect(),
    }
}

/// Vertices by their place in the grid.
#[derive(Default)]
struct Grid {
    index: BTreeMap<[i32; 3], u32>,
    places: Vec<[i32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Grid {
    fn vertex(&mut self, at: [i32; 3]) -> u32 {
        *self.index.entry(at).or_insert_with(|| {
            self.places.push(at);
            self.places.len() as u32 - 1
        })
    }
}

/// The side where the coordinate `axis` is `end`, its normals outwards.
fn side(grid: &mut Grid, axis: usize, end: i32, rng: &mut impl Rng) {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    for (i, j) in (0..SQUARES[u]).flat_map(|i| (0..SQUARES[v]).map(move |j| (i, j))) {
        let corner = |grid: &mut Grid, di: i32, dj: i32| {
            let mut at = [0; 3];
            (at[axis], at[u], at[v]) = (end, i + di, j + dj);
            grid.vertex(at)
        };
        let around = [(0, 0), (1, 0), (1, 1), (0, 1)];
        let [a, b, c, d] = around.map(|(di, dj)| corner(grid, di, dj));
        let split = match rng.random_bool(0.5) {
            true => [[a, b, c], [a, c, d]],
            false => [[a, b, d], [b, c, d]],
        };
        let outwards = |[p, q, r]: [u32; 3]| if end == 0 { [p, r, q] } else { [p, q, r] };
        grid.triangles.extend(split.map(outwards));
    }
}

/// A vertex leaves its row within the side or the edge that it lies on.
fn place(at: [i32; 3], rng: &mut impl Rng) -> Point {
    let width = f64::from(SQUARES[1]);
    let coordinate = |k: usize| {
        let way = rng.random_range(-JITTER..JITTER);
        let inside = at[k] > 0 && at[k] < SQUARES[k];
        (f64::from(at[k]) + if inside { way } else { 0.0 }) / width
    };
    Point::from(std::array::from_fn::<f64, 3, _>(coordinate))
}
