//! A new, small SVG file for shapes that came from elsewhere.

use kurbo::{CubicBez, Line, PathSeg, Point, Vec2};

use super::outline::{Outline, Ring};
use super::path::fit::{self, Samples};
use super::path::{Path, Subpath, write};

/// Of the diagonal: how exactly coordinates are written.
const PRECISION: f64 = 1e-5;

/// Of the diagonal: the room around the shape.
const MARGIN: f64 = 0.02;

/// How rings are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Manner {
    /// Every point is a corner.
    Polygons,
    /// Curves that lie within a tolerance of the points, drawing units; sharp turns over `reach`
    /// are corners.
    Curves { tolerance: f64, reach: f64 },
}

/// A turn by more than this over the reach to both sides is a corner, radians.
const CORNER: f64 = 0.8;

/// Points of one curve at most.
const LONGEST: usize = 600;

/// The text of the file.
pub(super) fn svg(outline: &Outline, manner: Manner) -> String {
    let diagonal = outline.diagonal();
    let (low, high) = outline.bounds();
    let decimals = write::decimals(PRECISION * diagonal);
    let margin = MARGIN * diagonal;
    let number = |v: f64| write::number(v, decimals);
    let window = [
        number(low.x - margin),
        number(-high.y - margin),
        number(high.x - low.x + 2.0 * margin),
        number(high.y - low.y + 2.0 * margin),
    ];
    let subpaths = outline.rings.iter().map(|r| subpath(r, manner)).collect();
    let data = write::data(&Path { subpaths }, decimals);
    let window = window.join(" ");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{window}\">\
         <path fill-rule=\"evenodd\" d=\"{data}\"/></svg>\n"
    )
}

fn subpath(ring: &Ring, manner: Manner) -> Subpath {
    let points: Vec<Point> = ring.points.iter().map(|p| Point::new(p.x, -p.y)).collect();
    let mut drawn = Subpath::new(points.first().copied().unwrap_or_default());
    match manner {
        Manner::Polygons => {
            let lines = points
                .windows(2)
                .map(|w| PathSeg::Line(Line::new(w[0], w[1])));
            drawn.segments.extend(lines);
        }
        Manner::Curves { tolerance, reach } => {
            let curves = Tracer { tolerance, reach }.ring(points);
            drawn.start = curves.first().map_or(drawn.start, |c| c.p0);
            drawn
                .segments
                .extend(curves.into_iter().map(PathSeg::Cubic));
        }
    }
    drawn.close();
    drawn
}

struct Tracer {
    tolerance: f64,
    reach: f64,
}

impl Tracer {
    /// The ring as curves; it begins at a corner if it has one.
    fn ring(&self, mut points: Vec<Point>) -> Vec<CubicBez> {
        let corners = self.corners(&points);
        let first = corners.first().copied().unwrap_or(0);
        points.rotate_left(first);
        let count = points.len();
        let mut ends: Vec<usize> = corners.iter().map(|c| c - first).collect();
        if ends.is_empty() {
            ends.push(0);
        }
        ends.push(count);
        points.push(points[0]);
        let round = corners.is_empty();
        let mut curves = Vec::new();
        for piece in ends.windows(2) {
            self.piece(&points[piece[0]..=piece[1]], round, &mut curves);
        }
        curves
    }

    /// Where the ring turns sharply, and more so than nearby.
    fn corners(&self, points: &[Point]) -> Vec<usize> {
        let turns: Vec<f64> = (0..points.len()).map(|i| self.turn(points, i)).collect();
        let count = points.len();
        let sharpest = |&i: &usize| {
            let mut far = 0.0;
            let beaten =
                |j: usize, earlier: bool| turns[j] > turns[i] || (earlier && turns[j] == turns[i]);
            for k in 1..count / 2 {
                let (before, after) = ((i + count - k) % count, (i + k) % count);
                far += points[after].distance(points[(after + count - 1) % count]);
                if far > self.reach {
                    break;
                }
                if beaten(before, true) || beaten(after, false) {
                    return false;
                }
            }
            true
        };
        (0..count)
            .filter(|&i| turns[i] > CORNER)
            .filter(sharpest)
            .collect()
    }

    /// The angle between the ways to a point and from it, over the reach.
    fn turn(&self, points: &[Point], i: usize) -> f64 {
        let (to, from) = (
            points[i] - self.walked(points, i, points.len() - 1),
            self.walked(points, i, 1) - points[i],
        );
        to.cross(from).atan2(to.dot(from)).abs()
    }

    /// The point at the reach from number `i`, in steps of `step` around the ring.
    fn walked(&self, points: &[Point], i: usize, step: usize) -> Point {
        let (mut at, mut way) = (i, 0.0);
        for _ in 0..points.len() / 2 {
            let next = (at + step) % points.len();
            let length = points[next].distance(points[at]);
            if way + length >= self.reach && length > 0.0 {
                return points[at].lerp(points[next], (self.reach - way) / length);
            }
            way += length;
            at = next;
        }
        points[at]
    }

    /// A piece between corners, in as few curves as the tolerance allows, each as long as it can be.
    fn piece(&self, points: &[Point], round: bool, curves: &mut Vec<CubicBez>) {
        let last = points.len() - 1;
        let mut from = 0;
        while from < last {
            let mut to = from + 1;
            let mut best = None;
            // Twice as far while it fits, then the last step in halves.
            let mut step = 1;
            loop {
                let end = (from + step).min(last).min(from + LONGEST);
                let Some(curve) = self.fitted(points, from, end, round) else {
                    break;
                };
                (best, to) = (Some(curve), end);
                if end == last || end == from + LONGEST {
                    break;
                }
                step *= 2;
            }
            let mut gap = (to - from) / 2;
            while gap > 0 {
                let end = (to + gap).min(last);
                if end > to
                    && let Some(curve) = self.fitted(points, from, end, round)
                {
                    (best, to) = (Some(curve), end);
                }
                gap /= 2;
            }
            let line = || Line::new(points[from], points[to]);
            curves.push(best.unwrap_or_else(|| {
                let l = line();
                let third = (l.p1 - l.p0) / 3.0;
                CubicBez::new(l.p0, l.p0 + third, l.p1 - third, l.p1)
            }));
            from = to;
        }
    }

    fn fitted(&self, points: &[Point], from: usize, to: usize, round: bool) -> Option<CubicBez> {
        let part = &points[from..=to];
        let mut at = vec![0.0];
        for pair in part.windows(2) {
            at.push(at[at.len() - 1] + pair[0].distance(pair[1]));
        }
        let length = at[at.len() - 1];
        at.iter_mut().for_each(|t| *t /= length);
        let samples = Samples {
            points: part,
            at: &at,
            leaves: self.direction(points, from, round),
            arrives: self.direction(points, to, round),
        };
        let (curve, gap) = fit::cubic(&samples)?;
        (gap <= self.tolerance).then_some(curve)
    }

    /// The direction of the ring at a point of a piece; at corners, of the piece alone.
    fn direction(&self, points: &[Point], i: usize, round: bool) -> Vec2 {
        let last = points.len() - 1;
        let span = |from: usize, forward: bool| {
            let mut at = from;
            let mut way = 0.0;
            while way < self.reach / 2.0 && if forward { at < last } else { at > 0 } {
                let next = if forward { at + 1 } else { at - 1 };
                way += points[next].distance(points[at]);
                at = next;
            }
            points[at]
        };
        let is_end = i == 0 || i == last;
        let (before, after) = if is_end && round {
            // Both ends are one point of a ring without corners.
            (span(last, false), span(0, true))
        } else {
            (span(i, false), span(i, true))
        };
        let along = after - before;
        if along.hypot() > 0.0 {
            along.normalize()
        } else {
            Vec2::ZERO
        }
    }
}
