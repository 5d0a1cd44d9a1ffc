//! Bringing an outline back to where it was before it was opened, as far as nothing touches.
//!
//! Edges of the plane can only come to cross through a vertex that meets an edge. So no vertex goes further at once than
//! a share of its distance from every edge that it is no end of, and of the distance of every vertex from its own
//! edges: what does not cross at first never does.

use crate::geom::Point;
use crate::shape::wall::Wall;

/// Steps at the most.
const STEPS: usize = 150;
/// Share of a distance that a step may use up from either side.
const SHARE: f64 = 0.45;
/// How near parts of the outline may come to each other, fraction of L, that lie more than so many edges apart along it.
const GAP: f64 = 0.001;
const APART: usize = 4;
/// Ways shorter than this have been gone, fraction of L.
const GONE: f64 = 1e-6;

/// Positions of the outline of `wall` on the way from `opened` to `wanted`: the starts of `free` edges go as far as
/// nothing touches, all else stays.
pub fn approached(wall: &Wall, opened: &[Point], wanted: &[Point], free: &[bool]) -> Vec<Point> {
    let mut now: Vec<Point> = (0..wall.edges()).map(|e| flat(opened, e)).collect();
    let moving: Vec<usize> = (0..wall.edges()).filter(|&e| free[e]).collect();
    for _ in 0..STEPS {
        let limits = limits(wall, &now, &moving);
        let mut longest: f64 = 0.0;
        for (&v, limit) in moving.iter().zip(&limits) {
            let way = flat(wanted, v) - now[v];
            let far = way.norm();
            if far > GONE {
                let share = (limit / far).min(1.0);
                now[v] += share * way;
                longest = longest.max(share * far);
            }
        }
        if longest <= GONE {
            break;
        }
    }
    let mut positions = opened.to_vec();
    for &e in &moving {
        for v in [2 * e, 2 * e + 1] {
            (positions[v].x, positions[v].y) = (now[e].x, now[e].y);
        }
    }
    positions
}

fn flat(positions: &[Point], edge: usize) -> Point {
    let x = &positions[2 * edge];
    Point::new(x.x, x.y, 0.0)
}

/// How far each `moving` vertex may go at once.
fn limits(wall: &Wall, now: &[Point], moving: &[usize]) -> Vec<f64> {
    let count = wall.edges();
    let mut limits = vec![f64::INFINITY; count];
    let mut moves = vec![false; count];
    moving.iter().for_each(|&v| moves[v] = true);
    let all: Vec<usize> = (0..count).collect();
    for ring in &wall.rings {
        for edge in ring.clone() {
            let ends = [edge, wall.next(edge)];
            // Of two that stay nothing comes.
            let others = match ends.iter().any(|&v| moves[v]) {
                true => &all,
                false => moving,
            };
            for &v in others.iter().filter(|v| !ends.contains(v)) {
                let near = ring.contains(&v) && apart(ring.len(), v, edge) <= APART;
                let gap = if near { 0.0 } else { GAP };
                let room = SHARE * (distance(&now[v], ends.map(|e| now[e])) - gap).max(0.0);
                for touched in [v, ends[0], ends[1]] {
                    limits[touched] = limits[touched].min(room);
                }
            }
        }
    }
    moving.iter().map(|&v| limits[v]).collect()
}

/// How many edges lie between two of a ring of so many.
fn apart(count: usize, a: usize, b: usize) -> usize {
    let way = (a + count - b) % count;
    way.min(count - way)
}

/// The distance of a point from a line between two.
fn distance(x: &Point, [a, b]: [Point; 2]) -> f64 {
    let way = b - a;
    let t = (x - a).dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE);
    (x - (a + t.clamp(0.0, 1.0) * way)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square with a slot from above, whose sides are to go to the places that the slot's `width` says.
    fn slotted(width: f64) -> Vec<Point> {
        let x = width / 2.0;
        let corners = [
            [-1.0, 0.0],
            [1.0, 0.0],
            [1.0, 2.0],
            [x, 2.0],
            [x, 1.0],
            [-x, 1.0],
            [-x, 2.0],
            [-1.0, 2.0],
        ];
        corners.map(|[x, y]| Point::new(x, y, 0.0)).to_vec()
    }

    #[test]
    fn sides_of_a_slot_stop_before_they_meet() {
        let wall = Wall::new(&[slotted(0.2)]).expect("a wall");
        let scale = wall.normalization.scale;
        let half = 0.1 / scale;
        let opened = wall.surface.positions.clone();
        let slot = |x: &Point| x.x.abs() <= half + 1e-9 && x.y > 0.0;
        let free: Vec<bool> = (0..wall.edges()).map(|e| slot(&wall.start(e))).collect();
        // Each side is to go to beyond where the other is.
        let across = |x: &Point| Point::new(if slot(x) { -x.x } else { x.x }, x.y, x.z);
        let wanted: Vec<Point> = opened.iter().map(across).collect();
        let now = approached(&wall, &opened, &wanted, &free);
        for e in 0..wall.edges() {
            let (was, is) = (opened[2 * e], now[2 * e]);
            assert!(free[e] || was == is, "{e}");
            if free[e] && was.x.abs() > half - 1e-9 && was.y > 0.35 / scale {
                assert!(is.x * was.x > 0.0, "{e}: {was} {is}");
                assert!(is.x.abs() < 0.1 * half, "{e}: {is}");
            }
        }
    }
}
