//! Basic shapes as paths.

use kurbo::{Point, Size, SvgArc, Vec2};
use roxmltree::Node;
use svgtypes::PointsParser;

use super::units::{Axis, length};
use crate::drawing::path::Path;
use crate::drawing::path::parse::Drawn;

/// The attributes that say where a basic shape is; as a path it has none of them.
pub(super) fn geometry(name: &str) -> &'static [&'static str] {
    match name {
        "rect" => &["x", "y", "width", "height", "rx", "ry"],
        "circle" => &["cx", "cy", "r"],
        "ellipse" => &["cx", "cy", "rx", "ry"],
        "line" => &["x1", "y1", "x2", "y2"],
        "polyline" | "polygon" => &["points"],
        _ => &[],
    }
}

/// The path of a basic shape; `None` for any other element and for shapes of no size.
pub(super) fn path(node: Node<'_, '_>, view: Size) -> Option<Path> {
    let x = |name| length(node, name, Axis::X, view);
    let y = |name| length(node, name, Axis::Y, view);
    match node.tag_name().name() {
        "rect" => rect(node, view),
        "circle" => {
            let r = length(node, "r", Axis::Diagonal, view)?;
            ellipse(x("cx"), y("cy"), r, r)
        }
        "ellipse" => {
            let (rx, ry) = (x("rx"), y("ry"));
            ellipse(x("cx"), y("cy"), rx.or(ry)?, ry.or(rx)?)
        }
        "line" => {
            let at =
                |a: Option<f64>, b: Option<f64>| Point::new(a.unwrap_or(0.0), b.unwrap_or(0.0));
            Some(chain(&[at(x("x1"), y("y1")), at(x("x2"), y("y2"))], false))
        }
        name @ ("polyline" | "polygon") => {
            let points = PointsParser::from(node.attribute("points")?);
            let points: Vec<Point> = points.map(|(x, y)| Point::new(x, y)).collect();
            (points.len() > 1).then(|| chain(&points, name == "polygon"))
        }
        _ => None,
    }
}

fn chain(points: &[Point], closed: bool) -> Path {
    let mut drawn = Drawn::default();
    drawn.start(points[0]);
    points[1..].iter().for_each(|&p| drawn.line(p));
    if closed {
        drawn.close();
    }
    drawn.path()
}

fn ellipse(cx: Option<f64>, cy: Option<f64>, rx: f64, ry: f64) -> Option<Path> {
    if !(rx > 0.0 && ry > 0.0) {
        return None;
    }
    let c = Point::new(cx.unwrap_or(0.0), cy.unwrap_or(0.0));
    let (east, south) = (Vec2::new(rx, 0.0), Vec2::new(0.0, ry));
    let mut drawn = Drawn::default();
    drawn.start(c + east);
    for to in [c + south, c - east, c - south, c + east] {
        round(&mut drawn, to, Vec2::new(rx, ry));
    }
    drawn.close();
    Some(drawn.path())
}

/// A quarter of an ellipse, clockwise on the screen.
fn round(drawn: &mut Drawn, to: Point, radii: Vec2) {
    drawn.arc(&SvgArc {
        from: drawn.at(),
        to,
        radii,
        x_rotation: 0.0,
        large_arc: false,
        sweep: true,
    });
}

fn rect(node: Node<'_, '_>, view: Size) -> Option<Path> {
    let x = |name| length(node, name, Axis::X, view);
    let y = |name| length(node, name, Axis::Y, view);
    let (w, h) = (x("width")?, y("height")?);
    if !(w > 0.0 && h > 0.0) {
        return None;
    }
    let at = Point::new(x("x").unwrap_or(0.0), y("y").unwrap_or(0.0));
    // A radius that is not given is the other one.
    let (rx, ry) = (x("rx").filter(|r| *r >= 0.0), y("ry").filter(|r| *r >= 0.0));
    let rx_or = rx.or(ry).unwrap_or(0.0).min(w / 2.0);
    let ry_or = ry.or(rx).unwrap_or(0.0).min(h / 2.0);
    let corner = |fx: f64, fy: f64| at + Vec2::new(fx, fy);
    if rx_or == 0.0 || ry_or == 0.0 {
        let corners = [
            corner(0.0, 0.0),
            corner(w, 0.0),
            corner(w, h),
            corner(0.0, h),
        ];
        return Some(chain(&corners, true));
    }
    let radii = Vec2::new(rx_or, ry_or);
    let mut drawn = Drawn::default();
    drawn.start(corner(rx_or, 0.0));
    for (line, arc) in [
        (corner(w - rx_or, 0.0), corner(w, ry_or)),
        (corner(w, h - ry_or), corner(w - rx_or, h)),
        (corner(rx_or, h), corner(0.0, h - ry_or)),
        (corner(0.0, ry_or), corner(rx_or, 0.0)),
    ] {
        if drawn.at() != line {
            drawn.line(line);
        }
        round(&mut drawn, arc, radii);
    }
    drawn.close();
    Some(drawn.path())
}
