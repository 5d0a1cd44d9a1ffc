//! Surfaces on control meshes: the blend between elements is smooth, detail is carried along, and what comes
//! of it is what full resolution gives.
#![allow(clippy::print_stdout)]
mod common;

use common::{sphere, working};
use symmetrizer::Context;
use symmetrizer::deform::elastic::{Binding, Sites};
use symmetrizer::deform::{DeformParams, Model, Pull, carry, control_mesh, deformer, relax};
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::{Surface, SurfacePoint};

/// A dented ball: curvature everywhere, no two places alike.
fn ball(levels: u32) -> Surface {
    let mut mesh = sphere(levels);
    for p in &mut mesh.positions {
        let dent = 0.1 * (5.0 * p.x + 3.0 * p.y).sin() * (4.0 * p.z).cos();
        p.coords *= 1.0 + dent;
        p.y *= 0.6;
    }
    working(&mesh).0.surface
}

fn rms(a: &[Point], b: &[Point]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(x, y)| (x - y).norm_squared()).sum();
    (sum / a.len() as f64).sqrt()
}

/// The largest difference between the weights of a site at the two ends of an edge.
fn largest_step(fine: &Surface, control: &Surface, sites: &Sites) -> f64 {
    let binding = Binding::within_reach(fine, control, sites);
    let share = |v: u32, site: u32| {
        let mut of = binding.of(v as usize).iter();
        of.find(|(s, _)| *s == site).map_or(0.0, |(_, w)| *w)
    };
    let step = |[u, v]: [u32; 2]| {
        let both = binding.of(u as usize).iter().chain(binding.of(v as usize));
        let steps = both.map(|&(s, _)| (share(u, s) - share(v, s)).abs());
        steps.fold(0.0, f64::max)
    };
    fine.sides().into_iter().map(step).fold(0.0, f64::max)
}

#[test]
fn weights_change_smoothly() {
    let control = control_mesh(&ball(5), 500).unwrap();
    for sites in [Sites::faces(&control), Sites::vertices(&control)] {
        let [coarse, fine] = [6, 7].map(|n| largest_step(&ball(n), &control, &sites));
        println!("{coarse:.3} {fine:.3}");
        // A site that came or went at once would jump alike however short the edges.
        assert!(fine < 0.75 * coarse, "{fine} {coarse}");
    }
}

/// The largest angle between a vertex's normal and that of `like`.
fn turned(a: &Surface, b: &Surface) -> f64 {
    let angles = a.vertex_normals.iter().zip(&b.vertex_normals);
    let angles = angles.map(|(m, n)| m.dot(n).clamp(-1.0, 1.0).acos().to_degrees());
    angles.fold(0.0, f64::max)
}

/// Turned about y by an angle that grows with x: a bend by 60 degrees from end to end.
fn bend(x: &Point) -> Point {
    let k = std::f64::consts::FRAC_PI_3;
    let (a, r) = (k * x.x, 1.0 / k - x.z);
    Point::new(r * a.sin(), x.y, 1.0 / k - r * a.cos())
}

#[test]
fn detail_is_carried_along() {
    let fine = ball(6);
    let control = control_mesh(&fine, 3000).unwrap();
    let carried = |map: &dyn Fn(&Point) -> Point| {
        let moved: Vec<Point> = control.positions.iter().map(map).collect();
        fine.with_positions(carry(&fine, &control, &moved))
    };
    let wanted = |map: &dyn Fn(&Point) -> Point| {
        fine.with_positions(fine.positions.iter().map(map).collect())
    };
    let turn = exp_rotation(&Vector::new(0.9, -0.8, 1.0));
    let rigid = |x: &Point| Point::from(turn * x.coords + Vector::new(0.2, -0.1, 0.3));
    let (got, want) = (carried(&rigid), wanted(&rigid));
    assert!(rms(&got.positions, &want.positions) < 1e-12);
    let (got, want) = (carried(&bend), wanted(&bend));
    let moved = rms(&fine.positions, &want.positions);
    let missed = rms(&got.positions, &want.positions);
    let angle = turned(&got, &want);
    println!(
        "{:.3} % of the way, normals within {angle:.2} degrees",
        100.0 * missed / moved
    );
    assert!(missed < 0.03 * moved);
    assert!(angle < 7.0);
}

#[test]
fn control_meshes_and_full_resolution_agree() {
    let s = ball(5);
    let length = DeformParams::default().length;
    let pulls: Vec<Pull> = (0..s.triangles.len() as u32)
        .map(|face| {
            let at = SurfacePoint {
                face,
                bary: [1.0 / 3.0; 3],
            };
            Pull {
                at,
                target: bend(&s.point(&at)),
                weight: s.face_areas[face as usize] / (length * length),
            }
        })
        .collect();
    for model in [Model::Primo, Model::Arap] {
        let [full, control] = [100_000, 2000].map(|control_faces| {
            let params = DeformParams {
                model,
                control_faces,
                ..DeformParams::default()
            };
            let mut d = deformer(&s, &params).unwrap();
            relax(d.as_mut(), &pulls, 1e-6, &mut Context::default()).unwrap();
            s.with_positions(d.positions())
        });
        let moved = rms(&full.positions, &s.positions);
        let apart = rms(&full.positions, &control.positions) / moved;
        let angle = turned(&full, &control);
        println!(
            "{model:?}: {:.2} %, normals within {angle:.2} degrees",
            100.0 * apart
        );
        assert!(apart < 0.05, "{model:?}");
        assert!(angle < 8.0, "{model:?}");
    }
}
