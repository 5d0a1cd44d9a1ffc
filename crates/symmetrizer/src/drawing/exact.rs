//! A drawing that is its own mirror image, or its own copy under a group, to the last digit that is written.
//!
//! Its line becomes x = 0 of the file, one half is drawn with curves, and the other half has the same numbers with
//! the other sign.

mod orbits;

use kurbo::{CubicBez, PathSeg, Point as Flat, Rect};

use super::outline::{Outline, Ring};
use super::path::{Path, Subpath, write};
use super::trace::Tracer;
use crate::error::{Error, Result};
use crate::geom::{Point, Vector};

/// Of the diagonal: how near curves lie to the outline, how exactly coordinates are written, the room around the
/// shape, and over which way corners are told from curves.
const TOLERANCE: f64 = 1e-4;
const PRECISION: f64 = 1e-5;
const MARGIN: f64 = 0.02;
const REACH: f64 = 0.004;
/// Of the diagonal: pieces that come no further from the line are left out.
const SLIVER: f64 = 1e-3;
/// Steep enough to cross the line at a right angle: the cosine of what is missing.
const ACROSS: f64 = 0.9;

pub use orbits::Turns;
pub(super) use orbits::svg as svg_of_group;

/// The text of an SVG file with `outline` made exactly symmetric about the line n.x = offset, which stands upright in
/// it.
///
/// # Errors
/// [`Error::Input`] where nothing lies on one side of the line.
pub(super) fn svg(outline: &Outline, normal: Vector, offset: f64) -> Result<String> {
    // Turned as little as an upright line allows.
    let side = if normal.x < 0.0 { -1.0 } else { 1.0 };
    let (n, d) = (side * normal, side * offset);
    let placed = |x: &Point| Flat::new(n.dot(&x.coords) - d, n.y * x.x - n.x * x.y);
    let diagonal = outline.diagonal();
    let tracer = Tracer {
        tolerance: TOLERANCE * diagonal,
        reach: REACH * diagonal,
    };
    let rings = outline.rings.iter().map(|ring: &Ring| {
        let points: Vec<Flat> = ring.points.iter().map(placed).collect();
        halves(&points)
    });
    let mut subpaths = Vec::new();
    for half in rings.flatten() {
        if half.points.iter().all(|p| p.x.abs() < SLIVER * diagonal) {
            continue;
        }
        subpaths.extend(half.whole(&tracer));
    }
    if subpaths.is_empty() {
        let what = "nothing lies on one side of the line of symmetry";
        return Err(Error::input(what, "write it without --exact"));
    }
    let decimals = write::decimals(PRECISION * diagonal);
    let path = rounded(&Path { subpaths }, decimals);
    Ok(text(&path, decimals, diagonal))
}

/// An SVG file of `path` alone.
fn text(path: &Path, decimals: u32, diagonal: f64) -> String {
    let data = write::data(path, decimals);
    let mut points = path.control_points();
    let first = points.next().unwrap_or_default();
    let around = points.fold(Rect::from_points(first, first), |r, p| r.union_pt(p));
    let around = around.inflate(MARGIN * diagonal, MARGIN * diagonal);
    let window = [around.x0, around.y0, around.width(), around.height()];
    let window = window.map(|v| write::number(v, decimals)).join(" ");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{window}\">\
         <path fill-rule=\"evenodd\" d=\"{data}\"/></svg>\n"
    )
}

/// A piece of a ring on the side x < 0.
struct Half {
    points: Vec<Flat>,
    /// Whether it begins and ends on the line; else it is a ring of its own.
    is_open: bool,
}

/// The pieces of a ring on the side x < 0.
fn halves(ring: &[Flat]) -> Vec<Half> {
    let count = ring.len();
    let inside = |k: usize| ring[k % count].x < 0.0;
    let Some(start) = (0..count).find(|&k| !inside(k) && inside(k + 1)) else {
        let whole = (0..count).all(inside).then(|| Half {
            points: ring.to_vec(),
            is_open: false,
        });
        return whole.into_iter().collect();
    };
    let crossing = |a: Flat, b: Flat| {
        let t = a.x / (a.x - b.x);
        Flat::new(0.0, a.y + t * (b.y - a.y))
    };
    let mut pieces: Vec<Half> = Vec::new();
    for k in start..start + count {
        let (a, b) = (ring[k % count], ring[(k + 1) % count]);
        match (inside(k), inside(k + 1)) {
            (false, true) => pieces.push(Half {
                points: vec![crossing(a, b), b],
                is_open: true,
            }),
            (true, now) => {
                let next = if now { b } else { crossing(a, b) };
                if let Some(piece) = pieces.last_mut() {
                    piece.points.push(next);
                }
            }
            (false, false) => {}
        }
    }
    pieces
}

impl Half {
    /// With its mirror image: one closed path, or two.
    fn whole(&self, tracer: &Tracer) -> Vec<Subpath> {
        if !self.is_open {
            let curves = tracer.ring(self.points.clone());
            return vec![closed(&curves), closed(&mirrored(&curves))];
        }
        let mut curves = tracer.chain(&self.points);
        if let (Some(first), Some(last)) = (self.points.first(), self.points.last()) {
            level(&mut curves, *first, *last);
        }
        let back = mirrored(&curves);
        vec![closed(&[curves, back].concat())]
    }
}

/// Lets the ends lie on the line, and cross it at a right angle where they nearly do: the two halves then meet
/// without a corner.
fn level(curves: &mut [CubicBez], first: Flat, last: Flat) {
    let flat = |end: Flat, handle: Flat| {
        let way = handle - end;
        if way.x.abs() > ACROSS * way.hypot() {
            Flat::new(handle.x, end.y)
        } else {
            handle
        }
    };
    if let Some(curve) = curves.first_mut() {
        curve.p0 = Flat::new(0.0, first.y);
        curve.p1 = flat(curve.p0, curve.p1);
    }
    if let Some(curve) = curves.last_mut() {
        curve.p3 = Flat::new(0.0, last.y);
        curve.p2 = flat(curve.p3, curve.p2);
    }
}

/// The mirror image, run through the other way.
fn mirrored(curves: &[CubicBez]) -> Vec<CubicBez> {
    let image = |p: Flat| Flat::new(-p.x, p.y);
    let back = |c: &CubicBez| CubicBez::new(image(c.p3), image(c.p2), image(c.p1), image(c.p0));
    curves.iter().rev().map(back).collect()
}

fn closed(curves: &[CubicBez]) -> Subpath {
    let mut drawn = Subpath::new(curves.first().map_or(Flat::ZERO, |c| c.p0));
    drawn
        .segments
        .extend(curves.iter().copied().map(PathSeg::Cubic));
    drawn.close();
    drawn
}

/// A point to so many decimals; opposite ones stay opposite.
fn round(p: Flat, decimals: u32) -> Flat {
    let unit = 10f64.powi(decimals as i32);
    let [x, y] = [p.x, p.y].map(|c| (c * unit).round() / unit + 0.0);
    Flat::new(x, y)
}

/// Every coordinate to so many decimals, so that differences that are written are exact, too.
fn rounded(path: &Path, decimals: u32) -> Path {
    let round = |p: Flat| round(p, decimals);
    let subpath = |s: &Subpath| {
        let mut drawn = Subpath::new(round(s.start));
        let segments = s.segments.iter().map(|segment| {
            let c = segment.to_cubic();
            PathSeg::Cubic(CubicBez::new(
                round(c.p0),
                round(c.p1),
                round(c.p2),
                round(c.p3),
            ))
        });
        drawn.segments.extend(segments);
        drawn.close();
        drawn
    };
    Path {
        subpaths: path.subpaths.iter().map(subpath).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Format, Reading, decode};

    #[test]
    fn numbers_come_in_pairs_of_either_sign() {
        // A crooked heart about a slanted line.
        let line: Vector = Vector::new(0.8, 0.6, 0.0);
        let along = Vector::new(-0.6, 0.8, 0.0);
        let point = |k: u32| {
            let angle = f64::from(k) / 200.0 * std::f64::consts::TAU;
            let (sin, cos) = angle.sin_cos();
            let x = 16.0 * sin.powi(3);
            let y = 13.0 * cos - 5.0 * (2.0 * angle).cos() - 2.0 * (3.0 * angle).cos();
            Point::from(line * (x + 3.0) + along * y)
        };
        let outline = Outline {
            rings: vec![Ring::new((0..200).map(point).collect())],
        };
        let text = svg(&outline, line, 3.0).expect("a file");
        let drawing = decode(text.clone().into_bytes(), Format::Svg, &Reading::default());
        let read = drawing.expect("a drawing");
        let area = outline.area().abs();
        assert!((read.outline().area().abs() - area).abs() < 0.01 * area);
        let mut xs: Vec<f64> = read.outline().points().map(|p| p.x).collect();
        xs.sort_by(f64::total_cmp);
        for (a, b) in xs.iter().zip(xs.iter().rev()) {
            assert!((a + b).abs() < 1e-12, "{a} {b}: {text}");
        }
    }
}
