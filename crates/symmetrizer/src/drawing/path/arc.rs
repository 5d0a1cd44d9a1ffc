//! Elliptical arcs as cubic curves.

use std::f64::consts::FRAC_PI_4;

use kurbo::{CubicBez, Point, SvgArc};

/// Of the radius: how far the curves may lie from the arc. Curves over 45 degrees are at 4e-6.
const ACCURACY: f64 = 1e-5;

/// The curves of an arc from one point to another; none where it is a straight line.
pub(super) fn curves(arc: &SvgArc) -> Vec<CubicBez> {
    let Some(round) = kurbo::Arc::from_svg_arc(arc) else {
        return Vec::new();
    };
    let radius = round.radii.x.max(round.radii.y);
    let mut found = Vec::new();
    let mut from = arc.from;
    // Parts, so that the number of curves has a bound whatever the radii are.
    let count = (round.sweep_angle.abs() / FRAC_PI_4).ceil().max(1.0);
    round.to_cubic_beziers(radius * ACCURACY, |a, b, to| {
        found.push(CubicBez::new(from, a, b, to));
        from = to;
    });
    debug_assert!(found.len() as f64 <= 4.0 * count + 4.0);
    if let Some(last) = found.last_mut() {
        // The arc ends where the path says, to the last bit.
        last.p3 = Point::new(arc.to.x, arc.to.y);
    }
    found
}
