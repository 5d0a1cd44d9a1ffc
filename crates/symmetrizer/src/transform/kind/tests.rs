//! Kinds of exact and noisy isometries, and elements that give their isometry back.

use super::*;
use crate::geom::{Point, Vector, exp_rotation};
use crate::transform::Plane;
use rand::RngExt;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

const TOLERANCE: f64 = 0.01;

fn vector(rng: &mut Pcg64, size: f64) -> Vector {
    Vector::from_fn(|_, _| size * rng.random_range(-1.0..1.0))
}

/// A support of unit radius, off the origin, longer than wide.
fn space(rng: &mut Pcg64) -> TransformSpace {
    let centre = vector(rng, 1.0);
    let points: Vec<(Point, f64)> = (0..100)
        .map(|_| {
            let v = vector(rng, 1.0).component_mul(&Vector::new(1.3, 0.9, 0.6));
            (Point::from(centre + v), rng.random_range(0.5..1.5))
        })
        .collect();
    TransformSpace::new(points.iter().copied())
}

/// Random elements of `kind`, well away from simpler kinds.
fn random_elements(kind: Kind, space: &TransformSpace, rng: &mut Pcg64) -> Elements {
    let axis = vector(rng, 1.0).normalize();
    let axis = if axis[axis.iamax()] < 0.0 {
        -axis
    } else {
        axis
    };
    let sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let shift = vector(rng, 1.0) + Vector::repeat(0.3);
    let along = axis * (sign * rng.random_range(0.2..0.6));
    let across = shift - axis * axis.dot(&shift);
    let turns = matches!(kind, Kind::Rotation | Kind::Screw | Kind::Rotoreflection);
    Elements {
        kind,
        axis: (turns || matches!(kind, Kind::Mirror | Kind::Glide)).then_some(axis),
        point: space.centre() + vector(rng, 0.5),
        angle: if turns {
            sign * rng.random_range(0.3..2.6)
        } else {
            0.0
        },
        shift: match kind {
            Kind::Translation => shift,
            Kind::Screw => along,
            Kind::Glide => across,
            _ => Vector::zeros(),
        },
        order: None,
    }
}

fn noisy(t: &Isometry, space: &TransformSpace, noise: f64, rng: &mut Pcg64) -> Isometry {
    let turn = exp_rotation(&vector(rng, noise / space.radius()));
    let centre = t.apply(&space.centre()).coords;
    Isometry {
        linear: turn * t.linear,
        translation: turn * (t.translation - centre) + centre + vector(rng, noise),
    }
}

#[test]
fn every_kind_is_recognised_through_noise_and_gives_its_isometry_back() {
    let mut rng = Pcg64::seed_from_u64(21);
    for round in 0..200 {
        let kind = Kind::ALL[round % Kind::ALL.len()];
        let space = space(&mut rng);
        let t = random_elements(kind, &space, &mut rng).isometry();
        let measured = noisy(&t, &space, 0.003, &mut rng);
        let e = measured.elements(&space, TOLERANCE);
        assert_eq!(e.kind, kind, "round {round}: {e:?}");
        assert_eq!(kind.is_improper(), t.is_improper());
        assert!(space.distance(&e.isometry(), &measured) <= TOLERANCE);
        let exact = t.elements(&space, TOLERANCE);
        assert!(space.distance(&exact.isometry(), &t) < 1e-9, "{kind}");
        if let Some(axis) = exact.axis {
            assert!(axis[axis.iamax()] > 0.0);
        }
        let back = t.inverse().elements(&space, TOLERANCE);
        assert!((back.angle + exact.angle).abs() < 1e-7 || exact.angle == 0.0);
    }
}

#[test]
fn the_nearest_member_of_a_kind_is_nearest() {
    let mut rng = Pcg64::seed_from_u64(22);
    for round in 0..80 {
        let kind = Kind::ALL[round % Kind::ALL.len()];
        let space = space(&mut rng);
        let t = random_elements(kind, &space, &mut rng).isometry();
        let measured = noisy(&t, &space, 0.003, &mut rng);
        let nearest = measured.nearest(kind, &space).unwrap();
        let distance = space.distance(&measured, &nearest);
        assert!(distance <= space.distance(&measured, &t) + 1e-6, "{kind}");
        let e = nearest.elements(&space, 1e-9);
        assert_eq!(e.kind, kind);
        for _ in 0..100 {
            let mut other = e;
            let size = 0.003;
            other.point += vector(&mut rng, size);
            other.angle += if e.angle == 0.0 {
                0.0
            } else {
                rng.random_range(-size..size)
            };
            other.axis = e.axis.map(|a| (a + vector(&mut rng, size)).normalize());
            let axis = other.axis.unwrap_or_default();
            let shift = other.shift + vector(&mut rng, size);
            other.shift = match kind {
                Kind::Translation => shift,
                Kind::Screw => axis * axis.dot(&shift),
                Kind::Glide => shift - axis * axis.dot(&shift),
                _ => other.shift,
            };
            let there = space.distance(&measured, &other.isometry());
            // Second order is what is promised for rotations.
            assert!(there >= distance - 2e-5, "{kind}: {there} < {distance}");
        }
    }
}

/// Far from its axis a short screw is a tilted rotation: dropping the pitch is not the nearest.
#[test]
fn a_screw_far_from_its_axis_is_nearly_a_rotation() {
    let mut rng = Pcg64::seed_from_u64(23);
    let space = space(&mut rng);
    let screw = Elements {
        kind: Kind::Screw,
        axis: Some(Vector::z()),
        point: space.centre() + Vector::x() * 40.0,
        angle: 1.0,
        shift: Vector::z() * 0.1,
        order: None,
    }
    .isometry();
    let nearest = screw.nearest(Kind::Rotation, &space).unwrap();
    assert!(space.distance(&screw, &nearest) < 0.01);
    assert_eq!(screw.elements(&space, TOLERANCE).kind, Kind::Rotation);
    assert_eq!(screw.elements(&space, 1e-4).kind, Kind::Screw);
}

#[test]
fn orders_are_the_smallest_that_fit() {
    let mut rng = Pcg64::seed_from_u64(24);
    let space = space(&mut rng);
    let tau = std::f64::consts::TAU;
    for (angle, order) in [
        (tau / 2.0, Some(2)),
        (tau / 3.0, Some(3)),
        (-tau * 2.0 / 5.0, Some(5)),
        (tau / 6.0, Some(6)),
        (tau * 5.0 / 12.0, Some(12)),
        (tau / 64.0, Some(64)),
        (tau / 64.5, None),
    ] {
        for kind in [Kind::Rotation, Kind::Screw, Kind::Rotoreflection] {
            let mut e = random_elements(kind, &space, &mut rng);
            e.angle = angle;
            let found = e.isometry().elements(&space, 1e-4);
            if kind == Kind::Rotoreflection && order == Some(2) {
                assert_eq!((found.kind, found.order), (Kind::Inversion, None));
            } else {
                assert_eq!((found.kind, found.order), (kind, order));
            }
        }
    }
    let half = noisy(
        &Elements {
            angle: tau / 2.0,
            ..random_elements(Kind::Rotation, &space, &mut rng)
        }
        .isometry(),
        &space,
        0.002,
        &mut rng,
    );
    let (_, snapped) = half.snapped(&space, TOLERANCE);
    assert!((snapped.linear - snapped.linear.transpose()).norm() < 1e-12);
}

#[test]
fn a_transformation_and_its_inverse_are_one_symmetry() {
    let mut rng = Pcg64::seed_from_u64(25);
    for kind in Kind::ALL {
        let space = space(&mut rng);
        let t = random_elements(kind, &space, &mut rng).isometry();
        let back = noisy(&t.inverse(), &space, 0.002, &mut rng);
        assert!(same_symmetry(&t, &back, &space, TOLERANCE));
        let other = noisy(&t, &space, 0.2, &mut rng);
        assert!(!same_symmetry(&t, &other, &space, TOLERANCE));
        let one = t.canonical(&space, TOLERANCE);
        let two = t.inverse().canonical(&space, TOLERANCE);
        assert!(space.distance(&one, &two) < 1e-9, "{kind}");
        assert!(one.elements(&space, TOLERANCE).angle >= 0.0);
    }
}

#[test]
fn names_are_those_of_reports() {
    for kind in Kind::ALL {
        assert_eq!(kind.to_string().parse::<Kind>().unwrap(), kind);
        let json = serde_json::to_string(&kind).unwrap();
        assert_eq!(json, format!("\"{kind}\""));
    }
    let error = "turn".parse::<Kind>().unwrap_err().to_string();
    assert!(error.contains("rotoreflection"), "{error}");
}

/// Flat supports cannot tell a mirror in their own plane from the identity; the handedness does.
#[test]
fn flat_supports_have_kinds_too() {
    let points: Vec<(Point, f64)> = (0..40)
        .map(|i| {
            let t = f64::from(i);
            (Point::new(t.sin(), (1.7 * t).cos(), 0.0), 1.0)
        })
        .collect();
    let space = TransformSpace::new(points.iter().copied());
    let mirror = |normal: Vector| {
        Isometry::mirror(&Plane {
            normal,
            offset: 0.0,
        })
    };
    for normal in [Vector::z(), Vector::x()] {
        assert_eq!(
            mirror(normal).elements(&space, TOLERANCE).kind,
            Kind::Mirror
        );
    }
    let turn = Isometry {
        linear: exp_rotation(&Vector::z()),
        translation: Vector::new(0.3, 0.1, 0.0),
    };
    let e = turn.elements(&space, TOLERANCE);
    assert_eq!(e.kind, Kind::Rotation);
    assert!((e.isometry().apply(&Point::origin()) - turn.apply(&Point::origin())).norm() < 1e-12);
}
