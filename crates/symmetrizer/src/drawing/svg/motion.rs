//! Simple motions that come nearest to a map of the plane.

use kurbo::{Affine, Point, Vec2};

/// The rigid motion that takes `at` where the map does and turns as the map does around it. It
/// never turns over: text stays legible. `None` where the map has no direction there.
pub(super) fn rigid(map: &dyn Fn(Point) -> Point, at: Point, step: f64) -> Option<Affine> {
    let slope = |d: Vec2| (map(at + d) - map(at - d)) / (2.0 * step);
    let (u, v) = (slope(Vec2::new(step, 0.0)), slope(Vec2::new(0.0, step)));
    // Of all rotations the one nearest to the derivative.
    let (cos, sin) = (u.x + v.y, u.y - v.x);
    let to = map(at);
    let turn = if cos.hypot(sin) > 1e-9 * (u.hypot() + v.hypot()) {
        sin.atan2(cos)
    } else {
        0.0
    };
    let motion =
        Affine::translate(to.to_vec2()) * Affine::rotate(turn) * Affine::translate(-at.to_vec2());
    motion.is_finite().then_some(motion)
}

/// The affine map with the least squared distance from the map at some points; a shift where they
/// lie in a line.
pub(super) fn affine(map: &dyn Fn(Point) -> Point, points: &[Point]) -> Option<Affine> {
    let count = points.len() as f64;
    if points.is_empty() {
        return None;
    }
    let images: Vec<Point> = points.iter().map(|&p| map(p)).collect();
    let mean = |all: &[Point]| all.iter().map(|p| p.to_vec2()).sum::<Vec2>() / count;
    let (from, to) = (mean(points), mean(&images));
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    let (mut xq, mut yq) = (Vec2::ZERO, Vec2::ZERO);
    for (p, q) in points.iter().zip(&images) {
        let (p, q) = (p.to_vec2() - from, q.to_vec2() - to);
        xx += p.x * p.x;
        xy += p.x * p.y;
        yy += p.y * p.y;
        xq += q * p.x;
        yq += q * p.y;
    }
    let det = xx * yy - xy * xy;
    let linear = if det > 1e-9 * (xx + yy).powi(2) {
        let (a, b) = ((xq * yy - yq * xy) / det, (yq * xx - xq * xy) / det);
        Affine::new([a.x, a.y, b.x, b.y, 0.0, 0.0])
    } else {
        Affine::IDENTITY
    };
    let fit = Affine::translate(to) * linear * Affine::translate(-from);
    fit.is_finite().then_some(fit)
}
