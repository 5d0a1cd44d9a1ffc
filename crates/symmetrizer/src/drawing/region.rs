//! Filled loops, whatever they cross, as rings that do not: by fill rule, clipped and united.
//!
//! Boolean operations run on whole numbers, a grid of 2^29 steps over the drawing. Points of the
//! input come out with the coordinates and the source they came in with.

use std::collections::HashMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{IntOverlayOptions, Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;
use kurbo::Point as Flat;

use super::crossings;
use super::outline::{Outline, Ring, Source};
use super::path::flatten::Loop;
use crate::error::{Error, Result};
use crate::geom::Point;

/// Steps from the middle of the drawing to its border; the library takes up to 2^30.
const STEPS: f64 = (1 << 28) as f64;

/// Of the squared diagonal: rings below this area are seams that rounding has opened.
const SEAM: f64 = 1e-8;

/// Coordinates are smaller than this, so that there are enough digits for what is between them.
pub(super) const FARTHEST: f64 = 1e9;

/// Closed contours on the grid.
pub(super) type Contours = Vec<Vec<IntPoint<i32>>>;

/// Which winding numbers are inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    EvenOdd,
    NonZero,
}

/// The grid, and what has been put on it.
pub(super) struct Regions {
    middle: Flat,
    scale: f64,
    /// Looked up only, never gone through.
    known: HashMap<(i32, i32), (Flat, Source)>,
}

impl Regions {
    /// A grid for points between `low` and `high`.
    pub fn new(low: Flat, high: Flat) -> Self {
        let reach = (high - low).hypot().max(f64::MIN_POSITIVE) / 2.0;
        Self {
            middle: low.midpoint(high),
            scale: STEPS / reach,
            known: HashMap::new(),
        }
    }

    /// What the loops of path number `path` fill.
    ///
    /// # Errors
    /// [`crate::Error::Input`] where they cross more often than could be sorted out in time.
    pub fn fill(&mut self, path: u32, loops: &[Loop], rule: Rule) -> Result<Contours> {
        let contours: Contours = loops.iter().map(|l| self.know(path, l)).collect();
        crossings::check(&contours)?;
        let rule = match rule {
            Rule::EvenOdd => FillRule::EvenOdd,
            Rule::NonZero => FillRule::NonZero,
        };
        Ok(overlay(
            &contours,
            &Contours::new(),
            OverlayRule::Subject,
            rule,
        ))
    }

    /// Keeps the points of a loop, those that are known already as they are.
    fn know(&mut self, path: u32, l: &Loop) -> Vec<IntPoint<i32>> {
        let mut contour = Vec::with_capacity(l.points.len());
        for (&p, &(segment, t)) in l.points.iter().zip(&l.at) {
            let at = self.rounded(p);
            let source = Source { path, segment, t };
            self.known.entry((at.x, at.y)).or_insert((p, source));
            contour.push(at);
        }
        contour
    }

    /// Where both are.
    pub fn common(a: &Contours, b: &Contours) -> Result<Contours> {
        let both: Contours = a.iter().chain(b).cloned().collect();
        crossings::check(&both)?;
        Ok(overlay(a, b, OverlayRule::Intersect, FillRule::NonZero))
    }

    /// The rings around all of it.
    ///
    /// # Errors
    /// As for [`Regions::fill`].
    pub fn united(&self, contours: &Contours) -> Result<Outline> {
        crossings::check(contours)?;
        let none = Contours::new();
        let united = overlay(contours, &none, OverlayRule::Subject, FillRule::NonZero);
        let rings: Vec<Ring> = united.iter().map(|c| self.ring(c)).collect();
        let mut outline = Outline { rings };
        let seam = SEAM * outline.diagonal().powi(2);
        outline.rings.retain(|r| r.area().abs() > seam);
        Ok(outline)
    }

    fn ring(&self, contour: &[IntPoint<i32>]) -> Ring {
        let mut ring = Ring::default();
        for at in contour {
            let known = self.known.get(&(at.x, at.y));
            let p = known.map_or_else(|| self.place(at), |k| k.0);
            ring.points.push(Point::new(p.x, p.y, 0.0));
            ring.sources.push(known.map(|k| k.1));
        }
        ring
    }

    fn rounded(&self, p: Flat) -> IntPoint<i32> {
        let at = (p - self.middle) * self.scale;
        IntPoint::new(at.x.round() as i32, at.y.round() as i32)
    }

    fn place(&self, at: &IntPoint<i32>) -> Flat {
        self.middle + kurbo::Vec2::new(f64::from(at.x), f64::from(at.y)) / self.scale
    }
}

/// The region that is inside an odd number of rings; the source of a point is its ring, as the
/// path, and its number there, as the segment.
///
/// # Errors
/// As for [`Regions::fill`]; also where coordinates are no numbers or too large.
pub(super) fn of_rings(rings: &[Vec<Point>]) -> Result<Outline> {
    let points = || rings.iter().flatten().map(|p| Flat::new(p.x, p.y));
    if points().any(|p| !(p.x.abs() < FARTHEST && p.y.abs() < FARTHEST)) {
        let what = format!("a point has coordinates of {FARTHEST:e} or more, or none");
        return Err(Error::input(what, "scale the shape down"));
    }
    let Some(first) = points().next() else {
        return Ok(Outline::default());
    };
    let around = points().fold(kurbo::Rect::from_points(first, first), |r, p| r.union_pt(p));
    let mut regions = Regions::new(around.origin(), around.origin() + around.size().to_vec2());
    let loops: Vec<Loop> = rings.iter().map(|r| loop_of(r)).collect();
    // All rings decide together what is inside, but each gives its own number to its points.
    for (number, l) in loops.iter().enumerate() {
        regions.know(number as u32, l);
    }
    let filled = regions.fill(0, &loops, Rule::EvenOdd)?;
    regions.united(&filled)
}

fn loop_of(ring: &[Point]) -> Loop {
    Loop {
        points: ring.iter().map(|p| Flat::new(p.x, p.y)).collect(),
        at: (0..ring.len() as u32).map(|i| (i, 0.0)).collect(),
    }
}

fn overlay(subject: &Contours, clip: &Contours, rule: OverlayRule, fill: FillRule) -> Contours {
    let capacity = subject.iter().chain(clip).map(Vec::len).sum();
    // Points on straight edges are kept: the drawing has them.
    let options = IntOverlayOptions::keep_all_points();
    let mut overlay = Overlay::<i32>::new_custom(capacity, options, Default::default());
    overlay.add_source(subject, ShapeType::Subject);
    overlay.add_source(clip, ShapeType::Clip);
    let shapes = overlay.overlay(rule, fill);
    shapes.into_iter().flatten().collect()
}
