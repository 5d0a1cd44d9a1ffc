//! The inside of an outline follows what pulls at it.

use crate::shared::wall;
use symmetrizer::Context;
use symmetrizer::deform::{Deformer, Igarashi, Pull};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::transform::{Isometry, Plane, displacements};

/// Figure 6: two points of transformation space are pulled to their centroid, and the shape follows.
#[test]
fn two_points_of_transformation_space_meet() {
    let Some(wall) = wall("truth/gecko_bent.svg", 0.0, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall.clone()).expect("an inside");
    let mut ctx = Context::new(0);
    // Two pairs of places that lie opposite each other across two lines.
    let length = wall.length(0);
    let at = |share: f64| wall.at(0, share * length);
    let pairs = [[at(0.10), at(0.62)], [at(0.30), at(0.52)]];
    let line =
        |x: &[Point]| Plane::through(&nalgebra::center(&x[0], &x[1]), (x[0] - x[1]).normalize());
    let ends = |body: &Igarashi| pairs.map(|pair| body.places(&pair));
    let lines = |body: &Igarashi| ends(body).map(|x| line(&x));
    let apart = |[a, b]: [Plane; 2]| a.normal.cross(&b.normal).norm().asin().to_degrees();
    let before = apart(lines(&body));
    for _ in 0..40 {
        let [a, b] = lines(&body);
        let normal = a.normal + b.normal * a.normal.dot(&b.normal).signum();
        let offset = a.offset + b.offset * a.normal.dot(&b.normal).signum();
        let common = Plane {
            normal: normal.normalize(),
            offset: offset / normal.norm(),
        };
        let mirror = Isometry::mirror(&common);
        let pulls: Vec<Pull> = pairs
            .iter()
            .zip(ends(&body))
            .flat_map(|(pair, x)| {
                let (d_p, d_q) = displacements(&x[0], &x[1], &mirror);
                let pull = |k: usize, d: Vector| Pull {
                    at: pair[k],
                    target: x[k] + d,
                    weight: 100.0,
                };
                [pull(0, d_p), pull(1, d_q)]
            })
            .collect();
        body.deform(&pulls, &mut ctx).expect("a step");
    }
    let after = apart(lines(&body));
    println!(
        "the lines are {before:.2} degrees apart, then {after:.3}; energy {:.5}",
        body.energy()
    );
    assert!(before > 5.0 && after < 0.05 * before, "{before} {after}");
    let inside = body.sheet().surface.with_positions(body.inside().to_vec());
    assert!(inside.face_normals.iter().all(|n| n.z > 0.0));
    assert!((inside.area() / body.sheet().surface.area() - 1.0).abs() < 0.05);
}

#[test]
fn the_plane_moves_as_one_with_three_points_of_it() {
    let Some(wall) = wall("truth/gecko_straight.svg", 0.3, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall.clone()).expect("an inside");
    let turn = nalgebra::Rotation3::from_axis_angle(&Vector::z_axis(), 2.5);
    let shift = Vector::new(0.3, -0.8, 0.0);
    let pulls: Vec<Pull> = (0..3)
        .map(|k| {
            let at = wall.at(0, f64::from(k) * wall.length(0) / 3.0);
            Pull {
                at,
                target: turn * wall.surface.point(&at) + shift,
                weight: 1.0,
            }
        })
        .collect();
    body.deform(&pulls, &mut Context::new(0)).expect("a step");
    let rest = &body.sheet().surface.positions;
    let off = rest
        .iter()
        .zip(body.inside())
        .map(|(x, y)| (turn * x + shift - y).norm());
    let off = off.fold(0.0, f64::max);
    assert!(off < 1e-4, "{off}");
    assert!(body.energy() < 1e-8, "{}", body.energy());
}

#[test]
fn a_prescribed_rotation_is_where_a_deformation_begins() {
    let Some(wall) = wall("truth/gecko_straight.svg", 0.3, 1.0) else {
        return;
    };
    let mut body = Igarashi::new(wall).expect("an inside");
    let count = body.sheet().surface.triangles.len();
    body.start_from(&vec![0.7; count]).expect("rotations");
    assert!(body.energy() < 1e-9, "{}", body.energy());
    assert!(body.start_from(&[0.0]).is_err());
    assert!(body.set_stiffness_inside(&vec![0.0; count]).is_err());
}
