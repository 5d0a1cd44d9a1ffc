//! Fairing a noisy surface before it is looked at: low-pass filtering without shrinking (Taubin 1995).
//!
//! Steps x += lambda u(x) and x += mu u(x) in turn, u the umbrella vector: the mean of a vertex's
//! neighbours less the vertex. Waves longer than the pass band stay, shorter ones die out.

use crate::geom::{Vector, median};
use crate::shape::surface::Surface;

/// Weights of the two steps, for a pass band of 0.1.
const LAMBDA: f64 = 0.5;
const MU: f64 = -0.526;
/// A surface whose median angle between neighbouring triangles exceeds this is rough: models without
/// noise, coarse ones too, stay below 24 degrees. Radians.
const ROUGH: f64 = 30.0 * std::f64::consts::PI / 180.0;
/// Only a surface with triangles this small, fraction of L, can be noisy: a coarse one has large angles of
/// its own, a cube nothing else.
const FINE: f64 = 0.04;
/// Fairing ends at this: what noise is left makes partners look doubtful; further on shape goes with it. Radians.
const FAIR: f64 = 7.0 * std::f64::consts::PI / 180.0;
/// Pairs of steps between looks at the angles, and how many looks at the most.
const STEPS: usize = 5;
const LOOKS: usize = 15;

/// The surface without its noise, its triangles as they were; `None` where it is not rough.
pub fn faired(surface: &Surface) -> Option<Surface> {
    let sides = sides_with_faces(surface);
    if surface.median_edge() > FINE || roughness(surface, &sides) < ROUGH {
        return None;
    }
    let neighbors = neighbors(surface, &sides);
    let mut fair = surface.clone();
    for _ in 0..LOOKS {
        for _ in 0..STEPS {
            step(&mut fair, &neighbors, LAMBDA);
            step(&mut fair, &neighbors, MU);
        }
        fair = surface.with_positions(fair.positions);
        if roughness(&fair, &sides) < FAIR {
            break;
        }
    }
    Some(fair)
}

/// The sides of all triangles with their triangles, sorted.
fn sides_with_faces(surface: &Surface) -> Vec<([u32; 2], u32)> {
    let mut sides: Vec<([u32; 2], u32)> = surface
        .triangles
        .iter()
        .zip(0..)
        .flat_map(|(&[a, b, c], f)| [([a, b], f), ([b, c], f), ([c, a], f)])
        .map(|([u, v], f)| ([u.min(v), u.max(v)], f))
        .collect();
    sides.sort_unstable();
    sides
}

/// The median angle between triangles that share a side, radians.
fn roughness(surface: &Surface, sides: &[([u32; 2], u32)]) -> f64 {
    let mut angles: Vec<f64> = sides
        .windows(2)
        .filter(|w| w[0].0 == w[1].0)
        .map(|w| {
            let [m, n] = [w[0].1, w[1].1].map(|f| surface.face_normals[f as usize]);
            m.cross(&n).norm().atan2(m.dot(&n))
        })
        .collect();
    median(&mut angles).unwrap_or(0.0)
}

/// For each vertex those joined to it by a side; of a vertex on a boundary those along the boundary, so
/// that it does not draw inwards.
fn neighbors(surface: &Surface, sides: &[([u32; 2], u32)]) -> Vec<Vec<u32>> {
    let count = surface.positions.len();
    let mut all = vec![Vec::new(); count];
    let mut rim = vec![Vec::new(); count];
    for group in sides.chunk_by(|a, b| a.0 == b.0) {
        let [u, v] = group[0].0;
        let kinds: &mut [&mut Vec<Vec<u32>>] = if group.len() == 1 {
            &mut [&mut all, &mut rim]
        } else {
            &mut [&mut all]
        };
        for of in kinds {
            of[u as usize].push(v);
            of[v as usize].push(u);
        }
    }
    all.into_iter()
        .zip(rim)
        .map(|(all, rim)| if rim.is_empty() { all } else { rim })
        .collect()
}

fn step(surface: &mut Surface, neighbors: &[Vec<u32>], weight: f64) {
    let moved = surface
        .positions
        .iter()
        .zip(neighbors)
        .map(|(x, near)| {
            if near.is_empty() {
                return *x;
            }
            let sum: Vector = near
                .iter()
                .map(|&v| surface.positions[v as usize].coords)
                .sum();
            x + weight * (sum / near.len() as f64 - x.coords)
        })
        .collect();
    surface.positions = moved;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use rand::RngExt;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::SeedableRng;

    /// A sphere of radius 1/4, as L = 1 has it, `noise` in units of the radius along its normals.
    fn sphere(noise: f64) -> Surface {
        let (rows, columns) = (40_u32, 80_u32);
        let mut rng = Pcg64::seed_from_u64(5);
        let mut positions = Vec::new();
        for i in 1..rows {
            for j in 0..columns {
                let t = std::f64::consts::PI * f64::from(i) / f64::from(rows);
                let p = std::f64::consts::TAU * f64::from(j) / f64::from(columns);
                let r = 1.0 + noise * rng.random_range(-1.0..1.0);
                positions
                    .push(Point::new(t.sin() * p.cos(), t.sin() * p.sin(), t.cos()) * (0.25 * r));
            }
        }
        let at = |i: u32, j: u32| (i - 1) * columns + j % columns;
        let mut triangles = Vec::new();
        for i in 1..rows - 1 {
            for j in 0..columns {
                triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
        Surface::new(positions, triangles.into())
    }

    fn rms_from_sphere(surface: &Surface) -> f64 {
        let squares = surface
            .positions
            .iter()
            .map(|x| (4.0 * x.coords.norm() - 1.0).powi(2));
        (squares.sum::<f64>() / surface.positions.len() as f64).sqrt()
    }

    #[test]
    fn noise_goes_and_the_shape_stays() {
        let rough = sphere(0.1);
        let fair = faired(&rough).expect("rough");
        assert!(rms_from_sphere(&rough) > 0.05);
        assert!(rms_from_sphere(&fair) < 0.025, "{}", rms_from_sphere(&fair));
    }

    #[test]
    fn a_coarse_surface_is_left_alone() {
        let rough = sphere(0.1);
        let grown = rough.positions.iter().map(|x| x * 3.0).collect();
        assert!(faired(&rough.with_positions(grown)).is_none());
    }

    #[test]
    fn a_smooth_surface_is_left_alone() {
        assert!(faired(&sphere(0.0)).is_none());
        assert!(faired(&sphere(0.002)).is_none());
    }
}
