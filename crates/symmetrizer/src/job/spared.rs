//! What would tangle is spared.

use crate::geom::{Point, PointIndex};
use crate::job::Detected;
use crate::optimize::tangles::Tangles;

/// Around what tangles a shape is spared to this distance, and wholly changed from twice that on; fraction of L.
const SPARED: f64 = 0.04;

/// For each vertex of a `state` how far it may be changed, 0 to 1, so that what tangles in `positions` is spared.
pub(super) fn spared(state: &Detected, positions: &[Point]) -> Vec<f64> {
    let rest = &state.working.surface;
    let now = rest.with_positions(positions.to_vec());
    let faces = Tangles::of(rest, &rest.next_to_vertices()).faces(rest, &now);
    let corners = faces.iter().flat_map(|&f| rest.corners(f));
    let places: Vec<[f64; 3]> = corners.map(|x| x.coords.into()).collect();
    let index = PointIndex::new(&places);
    let share = |x: &Point| {
        let nearest = index.nearest(&x.coords.into());
        let distance = nearest.map_or(f64::INFINITY, |(_, square)| square.sqrt());
        (distance / SPARED - 1.0).clamp(0.0, 1.0)
    };
    rest.positions.iter().map(share).collect()
}
