//! A new, small SVG file for shapes that came from elsewhere.

use kurbo::{Line, PathSeg, Point};

use super::outline::{Outline, Ring};
use super::path::{Path, Subpath, write};
use super::trace::Tracer;

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
