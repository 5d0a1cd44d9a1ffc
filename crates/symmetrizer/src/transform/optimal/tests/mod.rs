//! The closed forms against descents that know nothing of them, and on degenerate sets.

mod limits;
mod motions;
mod special;

use super::*;
use crate::geom::exp_rotation;
use crate::transform::Plane;
use rand::RngExt;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

fn vector(rng: &mut Pcg64, size: f64) -> Vector {
    Vector::from_fn(|_, _| size * rng.random_range(-1.0..1.0))
}

fn random_motion(rng: &mut Pcg64) -> Isometry {
    Isometry {
        linear: exp_rotation(&vector(rng, 2.0)),
        translation: vector(rng, 1.0),
    }
}

fn flip() -> Isometry {
    Isometry::mirror(&Plane {
        normal: Vector::z(),
        offset: 0.1,
    })
}

/// Noisy images under `t` of points of a box of the given thickness, far from the origin.
fn noisy(
    t: &Isometry,
    count: u32,
    thickness: f64,
    noise: f64,
    rng: &mut Pcg64,
) -> Vec<Correspondence> {
    (0..count)
        .map(|i| {
            let mut v = vector(rng, 1.0);
            v.z *= thickness;
            let p = Point::from(v + Vector::new(2.0, -1.0, 3.0));
            Correspondence {
                p,
                q: t.apply(&p) + vector(rng, noise),
                weight: 0.5 + f64::from(i % 3),
            }
        })
        .collect()
}

fn cost(pairs: &[Correspondence], t: &Isometry) -> f64 {
    let one = |x: &Correspondence| 0.5 * x.weight * (t.apply(&x.p) - x.q).norm_squared();
    pairs.iter().map(one).sum()
}

/// The least cost a descent finds over motions exp(omega) R0 + t from many starts; R0 gives the
/// handedness.
fn brute_force(goal: &dyn Fn(&Isometry) -> f64, r0: &Matrix3, rng: &mut Pcg64) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..15 {
        let mut here = Isometry {
            linear: exp_rotation(&vector(rng, 3.0)) * r0,
            translation: vector(rng, 2.0),
        };
        let mut value = goal(&here);
        let mut step = 0.5;
        while step > 1e-8 {
            let mut improved = false;
            for _ in 0..24 {
                let there = Isometry {
                    linear: exp_rotation(&vector(rng, step)) * here.linear,
                    translation: here.translation,
                };
                let there = centred(goal, there);
                let reached = goal(&there);
                if reached < value {
                    (here, value, improved) = (there, reached, true);
                }
            }
            if !improved {
                step /= 2.0;
            }
        }
        best = best.min(value);
    }
    best
}

/// The best translation for a given R, by the parabola along each axis.
fn centred(goal: &dyn Fn(&Isometry) -> f64, mut t: Isometry) -> Isometry {
    for axis in 0..3 {
        let at = |x: f64| {
            let mut moved = t;
            moved.translation[axis] += x;
            goal(&moved)
        };
        let (low, middle, high) = (at(-1.0), at(0.0), at(1.0));
        t.translation[axis] += 0.5 * (low - high) / (low - 2.0 * middle + high);
    }
    t
}
