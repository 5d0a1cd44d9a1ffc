//! Blue noise on a surface: darts that keep their distance, so that a few samples see it evenly.

use std::collections::HashMap;

use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use crate::geom::{Point, Vector};
use crate::sample::uniform::uniform;
use crate::shape::surface::{Surface, SurfacePoint};

/// Darts thrown per sample wanted; more would fill the last gaps and cost time.
pub const DARTS_PER_SAMPLE: usize = 12;

/// About `count` surface points no two of which are closer than the returned spacing (fraction of
/// L), sides of a thin sheet apart: darts with opposed normals do not see each other.
pub fn blue_noise(surface: &Surface, count: usize, rng: &mut Pcg64) -> (Vec<SurfacePoint>, f64) {
    let spacing = spacing(surface.area(), count);
    let darts = uniform(surface, DARTS_PER_SAMPLE * count, rng);
    (spread(surface, darts, spacing, rng), spacing)
}

/// The spacing of about `count` points that fill `area`: a saturated set covers 0.7 of the densest
/// packing, 2 / (sqrt 3 r^2) points per area.
pub fn spacing(area: f64, count: usize) -> f64 {
    (0.7 * 2.0 / 3.0_f64.sqrt() * area / count as f64).sqrt()
}

/// Those of `darts`, thrown in random order, that keep the `spacing`.
pub fn spread(
    surface: &Surface,
    mut darts: Vec<SurfacePoint>,
    spacing: f64,
    rng: &mut Pcg64,
) -> Vec<SurfacePoint> {
    let mut grid = Grid::new(spacing);
    darts.shuffle(rng);
    darts.retain(|dart| {
        let n = surface.face_normals[dart.face as usize];
        grid.insert(surface.point(dart), n)
    });
    darts
}

/// Points with normals in cells of the spacing's size.
struct Grid {
    spacing: f64,
    cells: HashMap<[i64; 3], Vec<(Point, Vector)>>,
}

impl Grid {
    fn new(spacing: f64) -> Self {
        Self {
            spacing,
            cells: HashMap::new(),
        }
    }

    /// Keeps the point unless one with a like normal is closer than the spacing.
    fn insert(&mut self, x: Point, n: Vector) -> bool {
        let cell: [i64; 3] = x.coords.map(|c| (c / self.spacing).floor() as i64).into();
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let near = self.cells.get(&[cell[0] + dx, cell[1] + dy, cell[2] + dz]);
                    let taken = near.into_iter().flatten().any(|(y, m)| {
                        m.dot(&n) > 0.0 && (y - x).norm_squared() < self.spacing * self.spacing
                    });
                    if taken {
                        return false;
                    }
                }
            }
        }
        self.cells.entry(cell).or_default().push((x, n));
        true
    }
}
