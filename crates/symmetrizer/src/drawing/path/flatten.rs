//! Curves as polygons whose points know their parameter.

use kurbo::{ParamCurve, PathSeg, Point};

use super::{Path, Subpath};

/// Pieces of one curve at most, whatever its size.
const MOST: f64 = 500.0;

/// A polygon; its last point is joined to its first.
#[derive(Debug, Clone, Default)]
pub(in crate::drawing) struct Loop {
    pub points: Vec<Point>,
    /// Segment of the path and parameter on it, for each point.
    pub at: Vec<(u32, f64)>,
}

/// Every subpath of more than one segment as a polygon, closed or not, no farther than `tolerance`
/// from it.
pub(in crate::drawing) fn loops(path: &Path, tolerance: f64) -> Vec<Loop> {
    let mut first = 0;
    let mut found = Vec::new();
    for subpath in &path.subpaths {
        found.push(polygon(subpath, first, tolerance));
        first += subpath.segments.len() as u32;
    }
    found.retain(|l| l.points.len() > 2);
    found
}

fn polygon(subpath: &Subpath, first: u32, tolerance: f64) -> Loop {
    let mut polygon = Loop::default();
    for (segment, number) in subpath.segments.iter().zip(first..) {
        let count = pieces(segment, tolerance);
        for i in 0..count {
            let t = f64::from(i) / f64::from(count);
            polygon.points.push(segment.eval(t));
            polygon.at.push((number, t));
        }
    }
    // An open subpath is filled as if a line closed it; its end is a point of its own.
    if let (false, Some(last)) = (subpath.closed, subpath.segments.last()) {
        let number = first + subpath.segments.len() as u32 - 1;
        polygon.points.push(last.end());
        polygon.at.push((number, 1.0));
    }
    polygon
}

/// How many equal steps of the parameter keep chords within `tolerance` of a curve (Wang's bound on
/// its second derivative).
fn pieces(segment: &PathSeg, tolerance: f64) -> u32 {
    let bend = match segment {
        PathSeg::Line(_) => return 1,
        PathSeg::Quad(q) => 2.0 * (q.p0.to_vec2() - 2.0 * q.p1.to_vec2() + q.p2.to_vec2()).hypot(),
        PathSeg::Cubic(c) => {
            let at = |a: Point, b: Point, c: Point| {
                (a.to_vec2() - 2.0 * b.to_vec2() + c.to_vec2()).hypot()
            };
            6.0 * at(c.p0, c.p1, c.p2).max(at(c.p1, c.p2, c.p3))
        }
    };
    (bend / (8.0 * tolerance)).sqrt().ceil().clamp(1.0, MOST) as u32
}
