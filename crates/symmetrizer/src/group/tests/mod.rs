//! Groups and rows from noisy generators, against a shape that knows its own symmetries.

mod families;
mod left_out;
mod rows;

use crate::geom::{Point, Vector, exp_rotation};
use crate::group::Within;
use crate::transform::{Isometry, Plane, TransformSpace};
use rand::RngExt;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

/// Of verified isometries, as a fraction of the support's rms radius 1: angles and shifts.
const NOISE: f64 = 0.005;
const TOLERANCE: f64 = 0.03;

fn rng(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

fn vector(rng: &mut Pcg64, size: f64) -> Vector {
    Vector::from_fn(|_, _| size * rng.random_range(-1.0..1.0))
}

/// A support of rms radius 1 about `centre`.
fn space_at(centre: Vector, rng: &mut Pcg64) -> TransformSpace {
    let points: Vec<(Point, f64)> = (0..200)
        .map(|_| (Point::from(centre + vector(rng, 1.0)), 1.0))
        .collect();
    TransformSpace::new(points.iter().copied())
}

fn noisy(t: &Isometry, space: &TransformSpace, rng: &mut Pcg64) -> Isometry {
    let turn = exp_rotation(&vector(rng, NOISE));
    let centre = t.apply(&space.centre()).coords;
    Isometry {
        linear: turn * t.linear,
        translation: turn * (t.translation - centre) + centre + vector(rng, NOISE),
    }
}

fn rotation(axis: Vector, angle: f64) -> Isometry {
    Isometry {
        linear: exp_rotation(&(axis.normalize() * angle)),
        translation: Vector::zeros(),
    }
}

fn mirror(normal: Vector) -> Isometry {
    Isometry::mirror(&Plane {
        normal: normal.normalize(),
        offset: 0.0,
    })
}

fn shift(by: Vector) -> Isometry {
    Isometry {
        translation: by,
        ..Isometry::identity()
    }
}

/// `t` seen from a frame that is `frame` turned and shifted.
fn seen_from(frame: &Isometry, t: &Isometry) -> Isometry {
    frame.after(t).after(&frame.inverse())
}

fn random_frame(rng: &mut Pcg64) -> Isometry {
    Isometry {
        linear: exp_rotation(&vector(rng, 2.0)),
        translation: vector(rng, 1.0),
    }
}

/// A shape that has `symmetries`: it refines what is near one of them, and refuses the rest.
fn shape<'a>(
    symmetries: &'a [Isometry],
    space: &'a TransformSpace,
    rng: &'a mut Pcg64,
) -> impl FnMut(&Isometry) -> Option<Isometry> + 'a {
    move |t| {
        let near = |s: &&Isometry| space.distance(s, t) < TOLERANCE;
        symmetries.iter().find(near).map(|s| noisy(s, space, rng))
    }
}

fn within(space: &TransformSpace) -> Within<'_> {
    Within {
        space,
        tolerance: TOLERANCE,
    }
}
