//! The zero level of a distance field as a closed mesh of well-shaped triangles.

use fast_surface_nets::ndshape::{RuntimeShape, Shape};
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use rayon::prelude::*;

use crate::geom::{Matrix3, Point, Vector, exp_rotation};
use crate::shape::mesh::Mesh;

/// Rounds of smoothing along the surface; more do not improve the triangles visibly.
const ROUNDS: usize = 8;

/// Squared slopes of the field below this are creases, where a Newton step would go astray.
const LEAST_SLOPE: f64 = 0.05;

/// Grid points along the edge of a block, and half the edge in cells.
const BLOCK: u32 = 4;
const REACH: f64 = 0.5 * (BLOCK - 1) as f64;
/// How much faster than a true distance the field may grow: bent parts and ellipsoids are not exact.
const FAR: f64 = 2.0;

/// Turns the grid by an angle that no symmetry of a model shares, about an axis likewise, so that
/// the triangles of a symmetric model are not symmetric.
fn odd_rotation() -> Matrix3 {
    exp_rotation(&(Vector::new(0.31, 0.23, 0.92).normalize() * 0.41))
}

/// Cubes of the edge length `cell` over a box, turned.
struct Grid {
    cell: f64,
    /// In the turned coordinates.
    low: Vector,
    shape: RuntimeShape<u32, 3>,
    world_from_grid: Matrix3,
}

impl Grid {
    fn over([low, high]: [[f64; 3]; 2], cell: f64) -> Self {
        let world_from_grid = odd_rotation();
        let corner =
            |k: usize| Vector::from_fn(|i, _| if k >> i & 1 == 0 { low[i] } else { high[i] });
        let corners = (0..8).map(|k| world_from_grid.transpose() * corner(k));
        let (low, high) = corners.fold(
            (
                Vector::repeat(f64::INFINITY),
                Vector::repeat(f64::NEG_INFINITY),
            ),
            |(low, high), c| (low.inf(&c), high.sup(&c)),
        );
        // One cell of margin on each side keeps the surface closed.
        let low = low.add_scalar(-cell);
        let count = (high - low).map(|l| (l / cell).ceil() as u32 + 2);
        Self {
            cell,
            low,
            shape: RuntimeShape::<u32, 3>::new(count.into()),
            world_from_grid,
        }
    }

    fn world(&self, at: [f64; 3]) -> Point {
        Point::from(self.world_from_grid * (self.low + Vector::from(at) * self.cell))
    }

    /// The field at the grid points; far from the surface, where only the sign counts, at the
    /// middle of the block of points instead.
    fn sample(&self, distance: impl Fn(&Point) -> f64 + Sync) -> Vec<f32> {
        let blocks = RuntimeShape::<u32, 3>::new(self.shape.as_array().map(|n| n.div_ceil(BLOCK)));
        let middle = |k: u32| blocks.delinearize(k).map(|i| f64::from(i * BLOCK) + REACH);
        let coarse: Vec<f64> = (0..blocks.size())
            .into_par_iter()
            .map(|k| distance(&self.world(middle(k))))
            .collect();
        let far = FAR * REACH * 3.0_f64.sqrt() * self.cell;
        let value = |k: u32| {
            let at = self.shape.delinearize(k);
            let known = coarse[blocks.linearize(at.map(|i| i / BLOCK)) as usize];
            if known.abs() > far {
                return known as f32;
            }
            distance(&self.world(at.map(f64::from))) as f32
        };
        (0..self.shape.size()).into_par_iter().map(value).collect()
    }
}

/// Meshes the surface `distance` = 0 inside the box `bounds` with triangles of edge length about
/// `cell`. The mesh is a closed manifold; parts thinner than two cells may lose or gain a hole.
pub(super) fn mesh(
    distance: impl Fn(&Point) -> f64 + Sync,
    bounds: [[f64; 3]; 2],
    cell: f64,
) -> Mesh {
    let grid = Grid::over(bounds, cell);
    let mut values = grid.sample(&distance);
    simplify(&mut values, &grid.shape);
    let last = grid.shape.as_array().map(|n| n - 1);
    let mut net = SurfaceNetsBuffer::default();
    surface_nets(&values, &grid.shape, [0; 3], last, &mut net);
    let positions = net.positions.iter().map(|p| grid.world(p.map(f64::from)));
    let triangles: Vec<[u32; 3]> = net.indices.as_chunks().0.to_vec();
    let positions = relax(positions.collect(), &triangles, &distance, cell);
    Mesh::from_triangles(positions, triangles)
}

/// Fills grid points until no cell has two sheets of the surface in it. Surface nets give a cell one
/// vertex, where two sheets would meet in a pinch or an edge of four triangles. Points are only
/// ever filled, nearest to the surface first, so this ends.
fn simplify(values: &mut [f32], shape: &RuntimeShape<u32, 3>) {
    let size = shape.as_array();
    let corners =
        [0, 1, 2, 3, 4, 5, 6, 7].map(|c: u32| shape.linearize([c & 1, c >> 1 & 1, c >> 2]));
    let mut again = true;
    while again {
        again = false;
        for k in 0..shape.size() {
            let at = shape.delinearize(k);
            if (0..3).any(|i| at[i] + 1 >= size[i]) {
                continue;
            }
            let cell = corners.map(|c| (k + c) as usize);
            again |= fill_if_split(values, cell);
        }
    }
}

fn fill_if_split(values: &mut [f32], cell: [usize; 8]) -> bool {
    let inside = cell.map(|i| values[i] < 0.0);
    if connected(inside, true) && connected(inside, false) {
        return false;
    }
    let outer = cell.into_iter().filter(|&i| values[i] >= 0.0);
    let nearest = outer.min_by(|&i, &j| values[i].total_cmp(&values[j]));
    nearest
        .map(|i| values[i] = -f32::EPSILON * (1.0 + values[i]))
        .is_some()
}

/// Whether the corners on one side of the surface hang together along edges of the cell; corners
/// that differ in one bit are neighbours.
fn connected(inside: [bool; 8], side: bool) -> bool {
    let mut open = (0..8).fold(0_u8, |set, c| set | u8::from(inside[c] == side) << c);
    let mut reached = open & open.wrapping_neg();
    while reached != 0 {
        open &= !reached;
        let [x, y, z] = [(1, 0x55), (2, 0x33), (4, 0x0f)]
            .map(|(shift, low)| (reached & low) << shift | reached >> shift & low);
        reached = (x | y | z) & open;
    }
    open == 0
}

/// Evens out the triangles: each vertex goes halfway to the mean of its neighbours, along the
/// surface only, and then back onto it.
fn relax(
    mut positions: Vec<Point>,
    triangles: &[[u32; 3]],
    distance: &(impl Fn(&Point) -> f64 + Sync),
    cell: f64,
) -> Vec<Point> {
    for _ in 0..ROUNDS {
        let means = neighbour_means(&positions, triangles);
        let moved = positions.par_iter().zip(means).map(|(p, mean)| {
            let g = gradient(distance, p, cell);
            let step = (mean - p) * 0.5;
            let along = step - g * (g.dot(&step) / g.norm_squared().max(LEAST_SLOPE));
            onto_surface(distance, p + along, &g, cell)
        });
        positions = moved.collect();
    }
    positions
}

fn neighbour_means(positions: &[Point], triangles: &[[u32; 3]]) -> Vec<Point> {
    let mut sums = vec![(Vector::zeros(), 0.0); positions.len()];
    for &[a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (sum, count) = &mut sums[from as usize];
            *sum += positions[to as usize].coords;
            *count += 1.0;
        }
    }
    sums.into_iter()
        .map(|(sum, n)| Point::from(sum / n))
        .collect()
}

/// Two Newton steps towards the zero level with the gradient `g` of a point nearby; no step is
/// longer than a cell.
fn onto_surface(distance: &impl Fn(&Point) -> f64, mut p: Point, g: &Vector, cell: f64) -> Point {
    for _ in 0..2 {
        let step = g * (distance(&p) / g.norm_squared().max(LEAST_SLOPE));
        p -= step.cap_magnitude(cell);
    }
    p
}

fn gradient(distance: &impl Fn(&Point) -> f64, p: &Point, cell: f64) -> Vector {
    let h = 0.01 * cell;
    Vector::from_fn(|i, _| {
        let mut offset = Vector::zeros();
        offset[i] = h;
        (distance(&(p + offset)) - distance(&(p - offset))) / (2.0 * h)
    })
}
