//! The region of the plane that is made symmetric, as closed rings.

mod bend;
mod simple;

use crate::geom::Point;

/// Where on the drawing a point of a ring lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// The path, counted from 0 in the order of painting; a file without paths is one path.
    pub path: u32,
    /// The segment of the path, counted from 0 over all its subpaths, the closing line included.
    pub segment: u32,
    /// The parameter on the segment, in 0..1.
    pub t: f64,
}

/// A closed polygon; the last point is joined to the first, which is not repeated.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ring {
    /// At z = 0.
    pub points: Vec<Point>,
    /// As long as the points; `None` where two paths cross, which no path has as its own point.
    pub sources: Vec<Option<Source>>,
}

impl Ring {
    /// A ring whose points have no source.
    pub fn new(points: Vec<Point>) -> Self {
        let sources = vec![None; points.len()];
        Self { points, sources }
    }

    /// Signed, drawing units squared: positive for an outer ring, negative for a hole.
    pub fn area(&self) -> f64 {
        let Some(first) = self.points.first() else {
            return 0.0;
        };
        let twice = |(a, b): (&Point, &Point)| {
            let (a, b) = (a - first, b - first);
            a.x * b.y - a.y * b.x
        };
        self.edges().map(twice).sum::<f64>() / 2.0
    }

    /// In drawing units.
    pub fn length(&self) -> f64 {
        self.edges().map(|(a, b)| (b - a).norm()).sum()
    }

    /// The edges, each as its two ends; the last leads back to the first point.
    pub fn edges(&self) -> impl Iterator<Item = (&Point, &Point)> {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next)
    }

    fn reverse(&mut self) {
        self.points.reverse();
        self.sources.reverse();
    }
}

/// A region bounded by closed rings that do not cross: outer rings counter-clockwise, holes
/// clockwise, y upwards, drawing units. Rings may touch in points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outline {
    /// In no particular order.
    pub rings: Vec<Ring>,
}

impl Outline {
    /// Of the region, drawing units squared.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(Ring::area).sum()
    }

    /// Of all rings, drawing units.
    pub fn length(&self) -> f64 {
        self.rings.iter().map(Ring::length).sum()
    }

    /// The number of points of all rings.
    pub fn len(&self) -> usize {
        self.rings.iter().map(|r| r.points.len()).sum()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// All points, ring by ring.
    pub fn points(&self) -> impl Iterator<Item = &Point> {
        self.rings.iter().flat_map(|r| &r.points)
    }

    /// The least and the largest coordinates; the origin twice where there are no points.
    pub fn bounds(&self) -> (Point, Point) {
        let Some(&first) = self.points().next() else {
            return (Point::origin(), Point::origin());
        };
        let wider = |(low, high): (Point, Point), p: &Point| (low.inf(p), high.sup(p));
        self.points().fold((first, first), wider)
    }

    /// Of the bounding box, drawing units.
    pub fn diagonal(&self) -> f64 {
        let (low, high) = self.bounds();
        (high - low).norm()
    }

    /// Whether a point, given in the plane, lies in the region (even-odd over the rings).
    pub fn contains(&self, p: &Point) -> bool {
        let crossed = |(a, b): (&Point, &Point)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) * (b.x - a.x) / (b.y - a.y)
        };
        let edges = self.rings.iter().flat_map(Ring::edges);
        edges.filter(|&edge| crossed(edge)).count() % 2 == 1
    }

    /// The outline with every point moved by `map`. Rings keep their points and their roles; where
    /// `map` turns the plane over, they are reversed.
    #[must_use]
    pub fn mapped(&self, map: &dyn Fn(Point) -> Point) -> Self {
        let mut moved = self.clone();
        for p in moved.rings.iter_mut().flat_map(|r| &mut r.points) {
            *p = map(*p);
        }
        self.facing_as_before(moved)
    }

    /// The outline moved by `map`, edges included: where an edge bends, points are added until
    /// chords lie within `tolerance`, drawing units, of its image.
    #[must_use]
    pub fn bent(&self, map: &dyn Fn(Point) -> Point, tolerance: f64) -> Self {
        let bent = |r: &Ring| bend::ring(r, map, tolerance);
        let rings = self.rings.iter().map(bent).collect();
        self.facing_as_before(Self { rings })
    }

    /// The points of its rings, as few as leave none further than `tolerance`, drawing units, from the lines between
    /// them; rings that are smaller are left out.
    pub fn simplified(&self, tolerance: f64) -> Vec<Vec<Point>> {
        let rings = self.rings.iter();
        let kept = rings.map(|ring| simple::kept(&ring.points, tolerance));
        kept.filter(|ring| ring.len() > 2).collect()
    }

    fn facing_as_before(&self, mut moved: Self) -> Self {
        if moved.area() * self.area() < 0.0 {
            moved.rings.iter_mut().for_each(Ring::reverse);
        }
        moved
    }
}
