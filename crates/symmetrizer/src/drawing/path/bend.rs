//! A path through a map of the plane: every segment becomes the lines and curves that lie within a
//! tolerance of its image.
//!
//! Segments stay apart, so that the drawing keeps the points its author set. The directions at a
//! point come from one derivative of the map there, so that smooth points stay smooth and corners
//! stay corners.

use kurbo::{CubicBez, Line, ParamCurve, ParamCurveDeriv, ParamCurveNearest, PathSeg, Point, Vec2};

use super::fit::{self, Samples};
use super::{Path, Subpath};

/// Samples of one piece.
const SAMPLES: u32 = 16;

/// A segment is halved this often at most.
const DEEPEST: u32 = 6;

/// A map of the plane, and how exactly curves follow it.
pub(in crate::drawing) struct Bending<'a> {
    pub map: &'a dyn Fn(Point) -> Point,
    /// Curves lie this near to the image.
    pub tolerance: f64,
    /// Half the width over which derivatives are taken.
    pub step: f64,
}

impl Bending<'_> {
    /// The image of `path`, `None` where no point of it moves by more than `still`.
    pub fn path(&self, path: &Path, still: f64) -> Option<Path> {
        if self.rests(path, still) {
            return None;
        }
        let subpaths = path.subpaths.iter().map(|s| self.subpath(s)).collect();
        Some(Path { subpaths })
    }

    fn rests(&self, path: &Path, still: f64) -> bool {
        let rests = |p: Point| (self.map)(p).distance(p) <= still;
        let steps = |s: &PathSeg| (1..=SAMPLES).all(|i| rests(s.eval(fraction(i))));
        path.subpaths.iter().all(|s| rests(s.start)) && path.segments().all(steps)
    }

    fn subpath(&self, subpath: &Subpath) -> Subpath {
        let mut bent = Subpath::new((self.map)(subpath.start));
        for segment in &subpath.segments {
            let before = bent.segments.len();
            self.segment(segment, DEEPEST, &mut bent.segments);
            bent.joined = bent.segments.len() == before + 1
                && matches!(bent.segments[before], PathSeg::Line(_));
        }
        // The line that closing adds need not be written, as long as it is one.
        bent.joined &= subpath.joined;
        bent.closed = subpath.closed;
        bent
    }

    fn segment(&self, segment: &PathSeg, depth: u32, bent: &mut Vec<PathSeg>) {
        let points: Vec<Point> = (0..=SAMPLES)
            .map(|i| (self.map)(segment.eval(fraction(i))))
            .collect();
        if let Some(fitting) = self.straight(segment, &points) {
            bent.push(fitting);
            return;
        }
        let at: Vec<f64> = (0..=SAMPLES).map(fraction).collect();
        let (leaves, arrives) = self.directions(segment);
        let samples = Samples {
            points: &points,
            at: &at,
            leaves,
            arrives,
        };
        let fitted = fit::cubic(&samples);
        match fitted {
            Some((curve, gap)) if gap <= self.tolerance => bent.push(PathSeg::Cubic(curve)),
            _ if depth == 0 => bent.push(fitted.map_or_else(
                || PathSeg::Line(Line::new(points[0], points[SAMPLES as usize])),
                |(curve, _)| PathSeg::Cubic(curve),
            )),
            _ => {
                let (first, second) = (segment.subsegment(0.0..0.5), segment.subsegment(0.5..1.0));
                self.segment(&first, depth - 1, bent);
                self.segment(&second, depth - 1, bent);
            }
        }
    }

    /// A line that stays one.
    fn straight(&self, segment: &PathSeg, points: &[Point]) -> Option<PathSeg> {
        let PathSeg::Line(_) = segment else {
            return None;
        };
        let chord = Line::new(points[0], points[SAMPLES as usize]);
        let limit = self.tolerance * self.tolerance;
        let near = |p: &Point| chord.nearest(*p, self.tolerance).distance_sq <= limit;
        points.iter().all(near).then_some(PathSeg::Line(chord))
    }

    /// The images of the directions in which a segment leaves and arrives.
    fn directions(&self, segment: &PathSeg) -> (Vec2, Vec2) {
        let c = segment.to_cubic();
        let (mut leaves, mut arrives) = (c.p1 - c.p0, c.p3 - c.p2);
        if let PathSeg::Line(line) = segment {
            leaves = (line.p1 - line.p0) / 3.0;
            arrives = leaves;
        }
        // A handle on its own end says nothing; the curve itself does, a little further in.
        if leaves.hypot() <= 1e-9 * extent(&c) {
            leaves = inner(&c, 0.01);
        }
        if arrives.hypot() <= 1e-9 * extent(&c) {
            arrives = inner(&c, 0.99);
        }
        (self.turned(c.p0, leaves), self.turned(c.p3, arrives))
    }

    /// The image of a direction at a point.
    fn turned(&self, at: Point, direction: Vec2) -> Vec2 {
        let h = self.step;
        let slope = |d: Vec2| ((self.map)(at + d * h) - (self.map)(at - d * h)) / (2.0 * h);
        slope(Vec2::new(1.0, 0.0)) * direction.x + slope(Vec2::new(0.0, 1.0)) * direction.y
    }
}

fn fraction(i: u32) -> f64 {
    f64::from(i) / f64::from(SAMPLES)
}

fn extent(c: &CubicBez) -> f64 {
    (c.p1 - c.p0).hypot() + (c.p2 - c.p1).hypot() + (c.p3 - c.p2).hypot()
}

/// A third of the derivative of a curve.
fn inner(c: &CubicBez, t: f64) -> Vec2 {
    c.deriv().eval(t).to_vec2() / 3.0
}
