//! Single faces that stay turned over, slivers between two fingers, follow what lies around them.

use crate::deform::carry::motions;
use crate::geom::{Point, Vector};
use crate::shape::Surface;

/// How often the motions around are worked out, and steps with each.
const ROUNDS: usize = 3;
const STEPS: usize = 10;

/// `now`, a deformed state of `rest`, with those vertices that are `freed` where the motions of their `neighbors` carry them; all others
/// stay. The local and the global step of Sorkine and Alexa (2007) with all weights 1, the latter by Jacobi's method and with the rotation
/// of the other end alone: that of a vertex on a turned face says nothing.
pub fn eased(rest: &Surface, now: &Surface, freed: &[bool], neighbors: &[Vec<u32>]) -> Surface {
    let free: Vec<usize> = (0..freed.len())
        .filter(|&v| freed[v] && !neighbors[v].is_empty())
        .collect();
    let mut positions = now.positions.clone();
    for _ in 0..ROUNDS {
        let motions = motions(rest, &now.with_positions(positions.clone()));
        for _ in 0..STEPS {
            let carried = |&v: &usize| -> Point {
                let near = &neighbors[v];
                let says = near.iter().map(|&n| {
                    let way = rest.positions[v] - rest.positions[n as usize];
                    positions[n as usize].coords + motions[n as usize].rotation * way
                });
                Point::from(says.sum::<Vector>() / near.len() as f64)
            };
            let next: Vec<Point> = free.iter().map(carried).collect();
            for (&v, x) in free.iter().zip(next) {
                positions[v] = x;
            }
        }
    }
    now.with_positions(positions)
}
