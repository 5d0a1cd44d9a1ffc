//! A stretch of a symmetric outline with the form that the other side of the line has.

use crate::geom::{Point, Vector};
use crate::optimize::uncross::stretch::Stretch;
use crate::shape::ClosestPoint;
use crate::shape::wall::Wall;
use crate::transform::Isometry;

/// The ends of a stretch lie no further than this from the mirror image of the outline, fraction of L, which faces
/// the same way there to within this cosine.
const CLOSE: f64 = 0.01;
const FACING: f64 = 0.5;
/// Both sides are so many times as long as each other at the most.
const ALIKE: f64 = 2.0;

/// `positions` of the outline of `wall` with a `stretch` as the `mirror` image of what lies opposite its ends, spread
/// over that as it is at rest; `None` where nothing does, or the stretch itself.
pub fn opposite(
    wall: &Wall,
    positions: &[Point],
    mirror: &Isometry,
    stretch: &Stretch,
) -> Option<Vec<Point>> {
    let now = wall.moved(positions.to_vec());
    let closest = ClosestPoint::new(&now.surface);
    let (first, last) = (*stretch.edges.first()?, *stretch.edges.last()?);
    let ends = [(first, now.start(first)), (last, now.start(now.next(last)))];
    let meet = |(edge, x): (usize, Point)| {
        let normal = mirror.rotate(&now.surface.face_normals[2 * edge]);
        let hit = closest.nearest_facing(&mirror.apply(&x), &normal, FACING, CLOSE)?;
        Some(now.along(&hit.at))
    };
    // The other side runs the other way.
    let [(ring, to), (other, from)] = [meet(ends[0])?, meet(ends[1])?];
    let around = now.length(ring);
    let span = (to - from).rem_euclid(around);
    let ways = ways(wall, stretch);
    let long = *ways.last()?;
    let alike = span <= ALIKE * long && long <= ALIKE * span;
    let own = |x: f64| within(&now, stretch, ring, x);
    if ring != other || !alike || own(from) || own(to) || own(from + span / 2.0) {
        return None;
    }
    let place = |share: f64| mirror.apply(&now.place(ring, to - share * span));
    let gaps = [ends[0].1 - place(0.0), ends[1].1 - place(1.0)];
    let mut taken = positions.to_vec();
    for (&edge, way) in stretch.inner().iter().zip(&ways) {
        let share = way / long;
        let gap: Vector = gaps[0] * (1.0 - share) + gaps[1] * share;
        let x = place(share) + gap;
        for v in [2 * edge, 2 * edge + 1] {
            (taken[v].x, taken[v].y) = (x.x, x.y);
        }
    }
    Some(taken)
}

/// Lengths at rest from the start of a stretch to the ends of its edges.
fn ways(wall: &Wall, stretch: &Stretch) -> Vec<f64> {
    let mut along = 0.0;
    let way = |&e: &usize| {
        along += (wall.start(wall.next(e)) - wall.start(e)).norm();
        along
    };
    stretch.edges.iter().map(way).collect()
}

/// Whether the stretch holds the point of a ring at the length `along` from its start.
fn within(now: &Wall, stretch: &Stretch, ring: usize, along: f64) -> bool {
    let (edge, _) = Wall::on_edge(&now.at(ring, along));
    stretch.edges.contains(&edge)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::optimize::uncross::stretch::stretches;
    use crate::transform::Plane;

    /// An ellipse whose radius is changed on one side.
    fn dented(depth: f64) -> Vec<Point> {
        let point = |k: u32| {
            let angle = f64::from(k) / 3000.0 * std::f64::consts::TAU;
            let dent = 1.0 - depth * (-(angle / 0.02).powi(2)).exp();
            Point::new(dent * angle.cos(), 1.5 * angle.sin(), 0.0)
        };
        (0..3000).map(point).collect()
    }

    #[test]
    fn a_dent_of_one_side_goes() {
        let wall = Wall::new(&[dented(0.0)]).expect("a wall");
        let normalization = wall.normalization;
        let dented = dented(0.02);
        let at = |e: usize| normalization.to_working(&dented[e]);
        let positions: Vec<Point> = (0..2 * wall.edges())
            .map(|v| Point::new(at(v / 2).x, at(v / 2).y, wall.surface.positions[v].z))
            .collect();
        let mirror = Isometry::mirror(&Plane::through(&Point::origin(), Vector::x()));
        let around = stretches(&wall, &[[2999, 0]], 60);
        let taken = opposite(&wall, &positions, &mirror, &around[0]).expect("another side");
        let away = taken.iter().zip(&wall.surface.positions);
        let most = away.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(most < 1e-4, "{most}");
        // At the line there is no other side.
        let top = stretches(&wall, &[[749, 750]], 60);
        assert!(opposite(&wall, &positions, &mirror, &top[0]).is_none());
    }
}
