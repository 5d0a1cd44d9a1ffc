//! What a slide implies, and what it does not.

use std::f64::consts::PI;

use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::transform::{Isometry, Plane};

use crate::common::sphere;
use crate::shapes::{tin, turned};
use crate::{Slides, slides};

/// Turns about `axis` through `point`, or the mirror across it.
fn about(axis: Vector, point: Point, angle: f64) -> Isometry {
    let linear = exp_rotation(&(axis * angle));
    Isometry {
        linear,
        translation: point.coords - linear * point.coords,
    }
}

fn shift(by: Vector) -> Isometry {
    Isometry {
        translation: by,
        ..Isometry::identity()
    }
}

#[test]
fn slides_imply_their_own_isometries() {
    let z = Vector::z();
    let tin = slides(&tin(1.0, 1.5), 3);
    let pipe = slides(&turned(&[[0.5, 0.0], [0.5, 2.0]], 30), 3);
    let ball = slides(&sphere(5), 3);
    let implied = |s: &Slides, t: &Isometry| s.parts[0].implies(t, &s.samples, 0.005);
    let middle = tin.parts[0].point;
    let along = Isometry::mirror(&Plane::through(&middle, Vector::new(0.6, 0.8, 0.0)));
    let across = Isometry::mirror(&Plane::through(&middle, z));
    let half_turn = about(Vector::x(), middle, PI);
    for (name, t, of_tin, of_pipe) in [
        ("turn", about(z, middle, 1.1), true, true),
        ("mirror along", along, true, true),
        ("mirror across", across, false, true),
        ("half-turn", half_turn, false, true),
        ("shift", shift(z * 0.2), false, true),
        ("shift aside", shift(Vector::x() * 0.05), false, false),
        ("tilt", about(Vector::x(), middle, 0.1), false, false),
    ] {
        assert_eq!(implied(&tin, &t), of_tin, "tin: {name}");
        assert_eq!(implied(&pipe, &t), of_pipe, "pipe: {name}");
    }
    let middle = ball.parts[0].point;
    assert!(implied(
        &ball,
        &about(Vector::new(0.6, 0.0, 0.8), middle, 2.0)
    ));
    assert!(!implied(&ball, &shift(z * 0.05)));
}
