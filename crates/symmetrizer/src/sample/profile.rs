//! The profile of an outline around a sample: what relief is in the plane.
//!
//! Over the length s from -r to r along the outline its height over the tangent is h = r sum c_k P_k(s / r), the P_k
//! Legendre polynomials, orthonormal under the mean over the interval; c_0 and c_1 are the sample's place and normal
//! and left out, as of a relief. In the plane a motion has two turns only: a proper one keeps the way along the
//! outline, an improper one runs it backwards, which changes the sign of all odd c_k. As harmonics the c_k lie where a
//! [`Relief`] turned by 0, or mirrored and turned by pi, changes just these signs, so that profiles are compared as
//! reliefs are.

use std::f64::consts::PI;

use nalgebra::Complex;

use crate::geom::Vector;
use crate::sample::relief::{Frame, Harmonic, Relief, TERMS};
use crate::sample::signature::SCALES;
use crate::shape::wall::Wall;

/// Places that a height is taken at, and the length they are means over, a share of the radius: what is traced from a
/// bitmap has teeth of a pixel.
const PLACES: i32 = 32;
const SMOOTH: f64 = 0.125;
/// A ring around which a radius reaches further than this share says nothing of that radius.
const AROUND: f64 = 0.25;
/// Highest degree.
const DEGREE: usize = 7;

/// The turn of the second frame, radians, at which profiles lie on each other under a motion of the plane.
pub fn turn(improper: bool) -> f64 {
    if improper { PI } else { 0.0 }
}

/// The frame at a length along a ring: the normal to the chord over `radius` to either side, away from the shape, and
/// the chord's own direction; e2 is that of z.
pub fn frame(wall: &Wall, ring: usize, along: f64, radius: f64) -> Option<Frame> {
    let [before, after] = [-radius, radius].map(|way| wall.place(ring, along + way));
    let e1 = (after - before).try_normalize(f64::MIN_POSITIVE)?;
    let n = Vector::new(e1.y, -e1.x, 0.0);
    Some(Frame { n, e1 })
}

/// The profile at a length along a ring in `frame`, at the radii r0, 2 r0, 4 r0.
pub fn profile(wall: &Wall, ring: usize, along: f64, frame: &Frame, r0: f64) -> Relief {
    let x = wall.place(ring, along);
    let at = |scale: usize| {
        let r = r0 * f64::from(1 << scale);
        let height = |s: f64| {
            let place = wall.mean_place(ring, along + s * r, SMOOTH * r);
            frame.n.dot(&(place - x)) / r
        };
        (r <= AROUND * wall.length(ring)).then(|| harmonics(&height))
    };
    Relief(std::array::from_fn::<_, SCALES, _>(at))
}

/// The coefficients of a height over -1..1, as harmonics.
fn harmonics(height: &dyn Fn(f64) -> f64) -> Harmonic {
    let mut c = [0.0; DEGREE + 1];
    for k in 0..PLACES {
        let s = (2.0 * f64::from(k) + 1.0) / f64::from(PLACES) - 1.0;
        let h = height(s) / f64::from(PLACES);
        for (c, p) in c.iter_mut().zip(legendre(s)) {
            *c += h * p;
        }
    }
    // Even ones where a turn by pi of what is mirrored keeps the sign, odd ones where it changes it.
    TERMS.map(|term| match term {
        (0, 1) => Complex::new(c[2], 0.0),
        (0, 2) => Complex::new(c[4], 0.0),
        (1, 1) => Complex::new(c[3], c[6]),
        (2, 0) => Complex::new(0.0, c[5]),
        (3, 0) => Complex::new(c[7], 0.0),
        _ => Complex::new(0.0, 0.0),
    })
}

/// The Legendre polynomials at s, sqrt(2 k + 1) P_k, by their recursion.
fn legendre(s: f64) -> [f64; DEGREE + 1] {
    let mut p = [1.0; DEGREE + 1];
    p[1] = s;
    for k in 1..DEGREE {
        let n = k as f64;
        p[k + 1] = ((2.0 * n + 1.0) * s * p[k] - n * p[k - 1]) / (n + 1.0);
    }
    std::array::from_fn(|k| (2.0 * k as f64 + 1.0).sqrt() * p[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    /// A lively closed curve, or its mirror image run the other way round, turned and moved.
    fn curve(mirrored: bool) -> Wall {
        let point = |k: i32| {
            let a = f64::from(k) / 400.0 * std::f64::consts::TAU;
            let r =
                1.0 + 0.2 * (3.0 * a + 1.0).sin() + 0.1 * (7.0 * a).cos() + 0.1 * (2.0 * a).sin();
            let (x, y) = (r * a.cos(), r * a.sin());
            let (sin, cos) = 0.8_f64.sin_cos();
            match mirrored {
                false => Point::new(x, y, 0.0),
                true => Point::new(cos * x + sin * y + 3.0, sin * x - cos * y - 1.0, 0.0),
            }
        };
        let mut ring: Vec<Point> = (0..400).map(point).collect();
        if mirrored {
            ring.reverse();
            ring.rotate_right(1);
        }
        Wall::new(&[ring]).expect("a wall")
    }

    #[test]
    fn a_mirror_image_runs_backwards_and_only_that() {
        let [wall, image] = [false, true].map(curve);
        let of = |wall: &Wall, along: f64| {
            let frame = frame(wall, 0, along, 0.04).expect("a frame");
            profile(wall, 0, along, &frame, 0.04)
        };
        for k in 0..20 {
            let along = f64::from(k) / 20.0 * wall.length(0);
            let here = of(&wall, along);
            let there = of(&image, image.length(0) - along);
            let gap = |improper: bool| here.gap_at(&there, improper, turn(improper));
            let [same, other] = [true, false].map(|c| gap(c).expect("a gap"));
            assert!(same < 0.05, "{k}: {same}");
            assert!(other > 3.0 * same, "{k}: {other}");
            assert!(here.sizes().least_gap(&there.sizes()).expect("a gap") <= same + 1e-9);
        }
    }
}
