//! Smooth curves along the points of a bitmap's outline.

use kurbo::{CubicBez, Line, Point, Vec2};

use super::path::fit::{self, Samples};

/// A turn by more than this over the reach to both sides is a corner, radians; a tip as round as the
/// reach turns by 1.
const CORNER: f64 = 1.1;

/// Of the reach: how far pixels round a corner, how far its sides are looked at, and how far its tip
/// may lie out.
const ROUND: f64 = 0.5;
const STRAIGHT: f64 = 1.2;
const TIP: f64 = 0.35;

/// Points of one curve at most.
const LONGEST: usize = 600;

/// How closely curves follow points.
pub(super) struct Tracer {
    /// How near they lie.
    pub tolerance: f64,
    /// Over which way corners are told from roughness.
    pub reach: f64,
}

impl Tracer {
    /// The ring as curves; it begins at a corner if it has one.
    pub fn ring(&self, points: Vec<Point>) -> Vec<CubicBez> {
        let corners = self.corners(&points);
        let (mut points, corners) = self.sharpened(&points, &corners);
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

    /// An open row of points as curves.
    pub fn chain(&self, points: &[Point]) -> Vec<CubicBez> {
        let last = points.len() - 1;
        let mut ends = vec![0];
        // As if it were a ring: what is found at its ends is none of the row's.
        let corners = self.corners(points).into_iter();
        ends.extend(corners.filter(|c| (1..last).contains(c)));
        ends.push(last);
        let mut curves = Vec::new();
        for piece in ends.windows(2) {
            self.piece(&points[piece[0]..=piece[1]], false, &mut curves);
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
            points[i] - self.walked(points, i, points.len() - 1, self.reach),
            self.walked(points, i, 1, self.reach) - points[i],
        );
        to.cross(from).atan2(to.dot(from)).abs()
    }

    /// The point at some way from number `i`, in steps of `step` around the ring.
    fn walked(&self, points: &[Point], i: usize, step: usize, reach: f64) -> Point {
        let (mut at, mut way) = (i, 0.0);
        for _ in 0..points.len() / 2 {
            let next = (at + step) % points.len();
            let length = points[next].distance(points[at]);
            if way + length >= reach && length > 0.0 {
                return points[at].lerp(points[next], (reach - way) / length);
            }
            way += length;
            at = next;
        }
        points[at]
    }

    /// The corners where the sides around them meet: what is rounded there is the pixels' doing.
    fn sharpened(&self, points: &[Point], corners: &[usize]) -> (Vec<Point>, Vec<usize>) {
        let count = points.len();
        let mut kept: Vec<Option<Point>> = points.iter().copied().map(Some).collect();
        for &c in corners {
            let side = |step: usize| {
                let at = |part: f64| self.walked(points, c, step, part * self.reach);
                Line::new(at(ROUND), at(STRAIGHT))
            };
            let tip = side(count - 1).crossing_point(side(1));
            let Some(tip) = tip.filter(|t| t.distance(points[c]) <= TIP * self.reach) else {
                continue;
            };
            for step in [1, count - 1] {
                let (mut at, mut way) = (c, 0.0);
                for _ in 0..count / 4 {
                    let next = (at + step) % count;
                    way += points[next].distance(points[at]);
                    if way > ROUND * self.reach || corners.contains(&next) {
                        break;
                    }
                    kept[next] = None;
                    at = next;
                }
            }
            kept[c] = Some(tip);
        }
        let mut places = Vec::new();
        let mut sharp = Vec::new();
        for (i, p) in kept.into_iter().enumerate() {
            if corners.binary_search(&i).is_ok() {
                sharp.push(places.len());
            }
            places.extend(p);
        }
        (places, sharp)
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
        let span = |from: usize, forward: bool, reach: f64| {
            let mut at = from;
            let mut way = 0.0;
            while way < reach && if forward { at < last } else { at > 0 } {
                let next = if forward { at + 1 } else { at - 1 };
                way += points[next].distance(points[at]);
                at = next;
            }
            points[at]
        };
        let half = self.reach / 2.0;
        let (before, after) = match i {
            // Both ends are one point of a ring without corners.
            _ if round && (i == 0 || i == last) => (span(last, false, half), span(0, true, half)),
            // Beyond what pixels round off.
            0 => (points[0], span(0, true, STRAIGHT * self.reach)),
            _ if i == last => (span(last, false, STRAIGHT * self.reach), points[last]),
            _ => (span(i, false, half), span(i, true, half)),
        };
        let along = after - before;
        if along.hypot() > 0.0 {
            along.normalize()
        } else {
            Vec2::ZERO
        }
    }
}
