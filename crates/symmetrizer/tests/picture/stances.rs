//! Which way shapes stand, whatever way the file has them.

use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::{Angle, Stance, views_about};
use symmetrizer::transform::isometry::Plane;

use crate::models::{Model, load, sphere};

fn plane(normal: Vector) -> Plane {
    Plane {
        normal: normal.normalize(),
        offset: 0.0,
    }
}

/// A tall body with a nose at the upper front (+z).
fn nosed() -> Model {
    let body = sphere(12).map(|p| Point::new(p.x, 2.0 * p.y, p.z));
    let nose = sphere(12).map(|p| Point::new(0.3 * p.x, 1.5 + 0.3 * p.y, 1.2 + 0.5 * p.z));
    body.and(&nose)
}

#[test]
fn the_front_view_sees_the_plane_edge_on_and_upright() {
    let normals = [
        Vector::x(),
        Vector::y(),
        Vector::z(),
        Vector::new(0.04, 0.01, 1.0),
        Vector::new(1.0, 1.0, 1.0),
        Vector::new(0.0, 1.0, -1.0),
    ];
    let model = nosed();
    for normal in normals {
        let plane = plane(normal);
        let stance = Stance::about(Some(&plane), &model.positions);
        let front = stance.view(Angle::Front);
        assert!(front.direction.dot(&plane.normal).abs() < 1e-12);
        assert!((front.right().dot(&plane.normal).abs() - 1.0).abs() < 1e-12);
        let side = stance.view(Angle::Side);
        assert!((side.direction.dot(&plane.normal).abs() - 1.0).abs() < 1e-12);
        for view in views_about(Some(&plane), &model.positions) {
            assert!((view.direction.norm() - 1.0).abs() < 1e-12);
            assert!((view.up.norm() - 1.0).abs() < 1e-12);
            assert!(view.direction.dot(&view.up).abs() < 1e-12);
        }
    }
}

#[test]
fn y_is_up_then_z_and_the_head_is_in_front() {
    let model = nosed();
    let upright = Stance::about(Some(&plane(Vector::x())), &model.positions);
    assert_eq!((upright.up, upright.front), (Vector::y(), Vector::z()));
    let turned = model.map(|p| Point::new(p.z, p.y, -p.x));
    let stance = Stance::about(Some(&plane(Vector::z())), &turned.positions);
    assert_eq!((stance.up, stance.front), (Vector::y(), Vector::x()));
    let back = model.map(|p| Point::new(-p.x, p.y, -p.z));
    let stance = Stance::about(Some(&plane(Vector::x())), &back.positions);
    assert_eq!((stance.up, stance.front), (Vector::y(), -Vector::z()));
    let lying = model.map(|p| Point::new(p.z, -p.x, p.y));
    let stance = Stance::about(Some(&plane(Vector::y())), &lying.positions);
    assert_eq!((stance.up, stance.front), (Vector::z(), Vector::x()));
}

#[test]
fn a_shape_without_plane_or_points_stands_as_its_file_says() {
    let expected = (Vector::y(), Vector::z());
    let stance = Stance::about(None, &nosed().positions);
    assert_eq!((stance.up, stance.front), expected);
    for normal in [Vector::zeros(), Vector::repeat(f64::NAN)] {
        let plane = Plane {
            normal,
            offset: 0.0,
        };
        let stance = Stance::about(Some(&plane), &[]);
        assert_eq!((stance.up, stance.front), expected);
    }
    let nan = [Point::new(f64::NAN, 0.0, 0.0)];
    Stance::about(Some(&plane(Vector::new(1.0, 1.0, 1.0))), &nan);
    Stance::about(Some(&plane(Vector::new(1.0, 1.0, 1.0))), &[]);
}

#[test]
fn the_bunny_looks_at_the_camera() {
    let Some(bunny) = load("bunny.obj") else {
        return;
    };
    let plane = plane(Vector::new(0.04, 0.01, 1.0));
    let stance = Stance::about(Some(&plane), &bunny.positions);
    assert!(stance.front.x < -0.9 && stance.up.y > 0.9);
}
