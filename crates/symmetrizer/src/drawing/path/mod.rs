//! Paths of lines and Bezier curves: read, flattened, bent and written.

mod arc;
pub(super) mod bend;
pub(super) mod fit;
pub(super) mod flatten;
pub(super) mod parse;
pub(super) mod write;

use kurbo::{Affine, ParamCurve, PathSeg, Point};

/// Of a coordinate: what sums of thousands of them are off by.
const ROUNDING: f64 = 1e-11;

/// A connected part of a path.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Subpath {
    pub start: Point,
    /// Each begins where the one before it ends. Where the subpath is closed, they end at its start.
    pub segments: Vec<PathSeg>,
    /// Whether the path says that it is closed.
    pub closed: bool,
    /// Whether the last segment is the line that closing adds.
    pub joined: bool,
}

impl Subpath {
    pub fn new(start: Point) -> Self {
        Self {
            start,
            segments: Vec::new(),
            closed: false,
            joined: false,
        }
    }

    pub fn end(&self) -> Point {
        self.segments.last().map_or(self.start, ParamCurve::end)
    }

    /// Closes the subpath, with a line where its end is not its start.
    pub fn close(&mut self) {
        self.closed = true;
        let (start, end) = (self.start, self.end());
        // Sums of relative coordinates rarely come back to the last bit.
        let reach = |m: f64, p: Point| m.max(p.x.abs()).max(p.y.abs());
        let ends = self.segments.iter().map(ParamCurve::end);
        let near = ROUNDING * ends.fold(reach(0.0, start), reach);
        if start.distance(end) > near {
            self.segments
                .push(PathSeg::Line(kurbo::Line::new(end, start)));
            self.joined = true;
        } else if let Some(last) = self.segments.last_mut() {
            match last {
                PathSeg::Line(l) => l.p1 = start,
                PathSeg::Quad(q) => q.p2 = start,
                PathSeg::Cubic(c) => c.p3 = start,
            }
        }
    }

    pub fn transformed(&self, by: Affine) -> Self {
        Self {
            start: by * self.start,
            segments: self.segments.iter().map(|&s| by * s).collect(),
            ..*self
        }
    }
}

/// A path in the coordinates of its element.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Path {
    pub subpaths: Vec<Subpath>,
}

impl Path {
    pub fn segments(&self) -> impl Iterator<Item = &PathSeg> {
        self.subpaths.iter().flat_map(|s| &s.segments)
    }

    /// Ends and handles.
    pub fn control_points(&self) -> impl Iterator<Item = Point> {
        let of_segment = |s: &PathSeg| {
            let c = s.to_cubic();
            [c.p0, c.p1, c.p2, c.p3]
        };
        let starts = self.subpaths.iter().map(|s| s.start);
        starts.chain(self.segments().flat_map(of_segment))
    }

    pub fn transformed(&self, by: Affine) -> Self {
        let subpaths = self.subpaths.iter().map(|s| s.transformed(by)).collect();
        Self { subpaths }
    }
}
