//! Bringing an outline back to where it was before it was opened, as far as nothing touches.
//!
//! Edges of the plane can only come to cross through a vertex that meets an edge. So no vertex goes further at once than
//! a share of its distance from every edge that it is no end of, and of the distance of every vertex from its own
//! edges: what does not cross at first never does.

use crate::geom::Point;
use crate::shape::wall::Wall;

/// Steps at the most.
const STEPS: usize = 60;
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
