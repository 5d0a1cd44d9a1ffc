//! Cubic curves through sampled points, by least squares (after Schneider, *An algorithm for
//! automatically fitting digitized curves*, 1990).

use kurbo::{CubicBez, ParamCurve, ParamCurveDeriv, Point, Vec2};

/// Newton steps that bring each sample to its nearest parameter.
const STEPS: usize = 3;

/// Handles longer than this times the chord bend back on themselves.
const LONGEST: f64 = 4.0;

/// A piece of curve as it was sampled, in order, with the directions in which it leaves and
/// arrives; a zero direction leaves the handle on its end.
pub(in crate::drawing) struct Samples<'a> {
    pub points: &'a [Point],
    /// Where each sample lies on the curve, 0 to 1.
    pub at: &'a [f64],
    pub leaves: Vec2,
    pub arrives: Vec2,
}

/// The cubic nearest to the samples and its greatest distance from any of them.
pub(in crate::drawing) fn cubic(samples: &Samples<'_>) -> Option<(CubicBez, f64)> {
    let mut at = samples.at.to_vec();
    let mut best: Option<(CubicBez, f64)> = None;
    for _ in 0..=STEPS {
        let Some(curve) = solved(samples, &at) else {
            break;
        };
        for (t, p) in at.iter_mut().zip(samples.points) {
            *t = nearer(&curve, *t, *p);
        }
        let gap = |(&t, &p): (&f64, &Point)| curve.eval(t).distance(p);
        let worst = at.iter().zip(samples.points).map(gap).fold(0.0, f64::max);
        if best.is_none_or(|(_, least)| worst < least) {
            best = Some((curve, worst));
        }
    }
    best
}

/// The lengths of the handles that fit best for the given parameters.
fn solved(samples: &Samples<'_>, at: &[f64]) -> Option<CubicBez> {
    let (&from, &to) = (samples.points.first()?, samples.points.last()?);
    let (u, v) = (samples.leaves, samples.arrives);
    let (mut aa, mut ab, mut bb, mut ac, mut bc) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (&t, p) in at.iter().zip(samples.points) {
        let s = 1.0 - t;
        let (b1, b2) = (3.0 * t * s * s, 3.0 * t * t * s);
        let (a, b) = (u * b1, v * -b2);
        let ends = from.to_vec2() * (s * s * s + b1) + to.to_vec2() * (t * t * t + b2);
        let rest = p.to_vec2() - ends;
        aa += a.dot(a);
        ab += a.dot(b);
        bb += b.dot(b);
        ac += a.dot(rest);
        bc += b.dot(rest);
    }
    let (mut x, mut y) = (0.0, 0.0);
    let det = aa * bb - ab * ab;
    if det > 1e-12 * aa * bb {
        x = (ac * bb - bc * ab) / det;
        y = (aa * bc - ab * ac) / det;
    } else if aa > 0.0 {
        x = ac / aa;
    } else if bb > 0.0 {
        y = bc / bb;
    }
    let span = span(samples.points);
    // A handle that points backwards would make a loop; one that is far too long does not fit.
    let sane = |length: f64, direction: Vec2| {
        let unit = direction.hypot();
        if unit * length <= LONGEST * span {
            length.max(0.0)
        } else {
            span / (3.0 * unit)
        }
    };
    let curve = CubicBez::new(from, from + u * sane(x, u), to - v * sane(y, v), to);
    curve.is_finite().then_some(curve)
}

/// The length of the polygon of the samples.
fn span(points: &[Point]) -> f64 {
    points.windows(2).map(|w| w[0].distance(w[1])).sum()
}

/// One Newton step towards the parameter nearest to `p`.
fn nearer(curve: &CubicBez, t: f64, p: Point) -> f64 {
    let first = curve.deriv();
    let (gap, slope, bend) = (
        curve.eval(t) - p,
        first.eval(t).to_vec2(),
        first.deriv().eval(t).to_vec2(),
    );
    let (f, df) = (gap.dot(slope), slope.dot(slope) + gap.dot(bend));
    if df > 0.0 {
        (t - f / df).clamp(0.0, 1.0)
    } else {
        t
    }
}
