//! Rings whose edges bend.

use super::{Ring, Source};
use crate::geom::Point;

/// An edge is halved this often at most.
const DEEPEST: u32 = 8;

/// The image of a ring, with as many points on its edges as they need.
pub(super) fn ring(ring: &Ring, map: &dyn Fn(Point) -> Point, tolerance: f64) -> Ring {
    let count = ring.points.len();
    let mut bent = Ring::default();
    for (i, &p) in ring.points.iter().enumerate() {
        let next = (i + 1) % count;
        let edge = Edge {
            from: p,
            to: ring.points[next],
            source: between(ring.sources[i], ring.sources[next]),
        };
        let images = [map(p), map(edge.to)];
        bent.points.push(images[0]);
        bent.sources.push(ring.sources[i]);
        let inner = edge.halved([0.0, 1.0], images, DEEPEST, &Bend { map, tolerance });
        for (t, image) in inner {
            bent.points.push(image);
            bent.sources.push(edge.source_at(t));
        }
    }
    bent
}

struct Bend<'a> {
    map: &'a dyn Fn(Point) -> Point,
    tolerance: f64,
}

struct Edge {
    from: Point,
    to: Point,
    /// Where it begins on a path, and the parameter at its end.
    source: Option<(Source, f64)>,
}

/// The piece of one segment between two neighbours, if they lie on the same.
fn between(a: Option<Source>, b: Option<Source>) -> Option<(Source, f64)> {
    let (a, b) = (a?, b?);
    if a.path != b.path {
        return None;
    }
    // The next segment begins where this one ends.
    let end = if a.segment == b.segment && b.t > a.t {
        b.t
    } else {
        1.0
    };
    let follows = b.segment == a.segment || b.segment == a.segment + 1 || b.segment == 0;
    (follows && (a.segment == b.segment || b.t == 0.0)).then_some((a, end))
}

impl Edge {
    fn source_at(&self, t: f64) -> Option<Source> {
        let (start, end) = self.source?;
        Some(Source {
            t: start.t + t * (end - start.t),
            ..start
        })
    }

    /// The points needed between two parameters with these images, in order.
    fn halved(
        &self,
        [a, b]: [f64; 2],
        images: [Point; 2],
        depth: u32,
        bend: &Bend<'_>,
    ) -> Vec<(f64, Point)> {
        let at = |t: f64| (bend.map)(self.from + (self.to - self.from) * (a + t * (b - a)));
        let inner = [0.25, 0.5, 0.75].map(at);
        // What is no number is near nothing; who looks at the result finds it.
        let off = |p: &Point| distance(p, &images) > bend.tolerance;
        if depth == 0 || !inner.iter().any(off) {
            return Vec::new();
        }
        let middle = f64::midpoint(a, b);
        let mut found = self.halved([a, middle], [images[0], inner[1]], depth - 1, bend);
        found.push((middle, inner[1]));
        found.extend(self.halved([middle, b], [inner[1], images[1]], depth - 1, bend));
        found
    }
}

/// From the segment between two points.
fn distance(p: &Point, ends: &[Point; 2]) -> f64 {
    let along = ends[1] - ends[0];
    let length = along.norm_squared();
    let t = if length > 0.0 {
        (p - ends[0]).dot(&along) / length
    } else {
        0.0
    };
    (p - (ends[0] + along * t.clamp(0.0, 1.0))).norm()
}
