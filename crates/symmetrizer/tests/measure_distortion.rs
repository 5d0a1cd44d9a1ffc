//! Distortion: rigid motions, scalings, folds, curvature.
#![allow(clippy::print_stdout)]
mod common;

use common::{load, model, placed, planar_grid, sphere, working};
use symmetrizer::apply::measure::{
    curvature_correlation, distortion, inverted_faces, mean_curvature,
};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::{Mesh, Surface};

fn moved(surface: &Surface, motion: impl Fn(&Point) -> Point) -> Surface {
    surface.with_positions(surface.positions.iter().map(motion).collect())
}

fn some_motion(p: &Point) -> Point {
    let omega = Vector::new(1.0, -0.4, 0.7);
    placed(
        &Mesh::from_triangles(vec![*p], vec![]),
        omega,
        1.0,
        Vector::new(0.3, 0.1, -2.0),
    )
    .positions[0]
}

/// A sphere of radius 1 + height cos(6 z) cos(5 angle).
fn bumpy(surface: &Surface, height: f64) -> Surface {
    moved(surface, |p| {
        let bump = (6.0 * p.z).cos() * (5.0 * p.y.atan2(p.x)).cos() * (1.0 - p.z * p.z);
        Point::from(p.coords * (1.0 + height * bump))
    })
}

fn unit_sphere(levels: u32) -> Surface {
    let w = working(&sphere(levels)).0;
    moved(&w.surface, |p| Point::from(p.coords.normalize()))
}

#[test]
fn a_rigid_motion_distorts_nothing() {
    let s = bumpy(&unit_sphere(5), 0.05);
    let d = distortion(&s, &moved(&s, some_motion), 4.0);
    assert!(d.rms < 1e-11 && d.max < 1e-11, "{d:?}");
    assert!(d.rms_unaligned > 10.0, "{d:?}");
    assert!(d.edge_stretch_p99 < 1e-11, "{d:?}");
    assert!((d.area_ratio - 1.0).abs() < 1e-12, "{d:?}");
    assert!((d.volume_ratio.unwrap() - 1.0).abs() < 1e-12, "{d:?}");
    assert!(
        (d.curvature_correlation.unwrap() - 1.0).abs() < 1e-9,
        "{d:?}"
    );
    assert_eq!((d.inverted_faces, d.new_crossings), (0, 0));
}

#[test]
fn a_shift_is_seen_without_alignment_only() {
    let s = unit_sphere(3);
    let d = distortion(&s, &moved(&s, |p| p + Vector::new(0.0, 0.3, 0.4)), 2.0);
    assert!((d.rms_unaligned - 25.0).abs() < 1e-9 && (d.max_unaligned - 25.0).abs() < 1e-9);
    assert!(d.max < 1e-10, "{d:?}");
}

#[test]
fn a_reflection_is_not_a_rigid_motion() {
    // Chiral, so that no rotation undoes the reflection.
    let s = moved(&unit_sphere(4), |p| {
        Point::new(p.x + 0.4 * p.y * p.z, p.y * 1.4, p.z * 2.0)
    });
    let d = distortion(&s, &moved(&s, |p| Point::new(p.x, p.y, -p.z)), 4.0);
    assert!(d.rms > 1.0, "{d:?}");
    assert!((d.volume_ratio.unwrap() + 1.0).abs() < 1e-12, "{d:?}");
}

#[test]
fn a_scaling_shows_in_lengths_areas_and_volumes() {
    let s = bumpy(&unit_sphere(4), 0.05);
    let d = distortion(&s, &moved(&s, |p| p * 1.1), 4.0);
    assert!((d.edge_stretch_p99 - 1.1_f64.ln()).abs() < 1e-12, "{d:?}");
    assert!((d.area_ratio - 1.21).abs() < 1e-12, "{d:?}");
    assert!((d.volume_ratio.unwrap() - 1.331).abs() < 1e-12, "{d:?}");
    assert!(
        (d.curvature_correlation.unwrap() - 1.0).abs() < 1e-12,
        "{d:?}"
    );
}

#[test]
fn an_open_surface_has_a_volume_that_does_not_depend_on_its_place() {
    // A sphere without the faces around its top, closed by a fan: a ball less a cap.
    let ball = unit_sphere(5);
    let keep = |t: &&[u32; 3]| t.iter().all(|&v| ball.positions[v as usize].z < 0.801);
    let triangles: Vec<[u32; 3]> = ball.triangles.iter().filter(keep).copied().collect();
    let open = Surface::new(ball.positions.clone(), triangles.into());
    let far = moved(&open, |p| p + Vector::new(20.0, -7.0, 5.0));
    let d = distortion(&open, &far, 4.0);
    assert!((d.volume_ratio.unwrap() - 1.0).abs() < 1e-9, "{d:?}");
    let flat = working(&planar_grid(6)).0.surface;
    assert_eq!(distortion(&flat, &flat, 1.0).volume_ratio, None);
}

#[test]
fn folds_are_found_however_the_part_turns() {
    let s = unit_sphere(4);
    // One vertex is drawn over its neighbours; which faces turn over is plain on an unturned sphere.
    let v = 40;
    let target = s.positions[s.triangles[700][0] as usize].coords;
    let from = s.positions[v].coords;
    let mut positions = s.positions.clone();
    let way = (target - from * from.dot(&target)).normalize();
    positions[v] = Point::from(from + way * 0.25);
    let folded = s.with_positions(positions);
    let expected: Vec<u32> = (0..s.triangles.len() as u32)
        .filter(|&f| s.face_normals[f as usize].dot(&folded.face_normals[f as usize]) < 0.0)
        .collect();
    assert!((1..6).contains(&expected.len()), "{expected:?}");
    assert_eq!(inverted_faces(&s, &folded), expected);
    assert_eq!(inverted_faces(&s, &moved(&folded, some_motion)), expected);
    let upside_down = moved(&folded, |p| Point::new(p.x, -p.y, -p.z));
    assert_eq!(inverted_faces(&s, &upside_down), expected);
}

#[test]
fn a_bend_of_half_a_turn_inverts_nothing() {
    // A strip rolled to a half circle: its end has turned by 180 degrees.
    let strip = moved(&working(&planar_grid(24)).0.surface, |p| *p);
    let low = strip
        .positions
        .iter()
        .map(|p| p.x)
        .fold(f64::INFINITY, f64::min);
    let high = strip
        .positions
        .iter()
        .map(|p| p.x)
        .fold(f64::NEG_INFINITY, f64::max);
    let radius = (high - low) / std::f64::consts::PI;
    let rolled = moved(&strip, |p| {
        let a = (p.x - low) / radius;
        Point::new(radius * a.sin(), p.y, radius * (1.0 - a.cos()))
    });
    assert!(inverted_faces(&strip, &rolled).is_empty());
}

#[test]
fn a_sphere_has_curvature_one_over_its_radius() {
    for radius in [0.5, 1.0, 3.0] {
        let s = moved(&unit_sphere(5), |p| p * radius);
        for h in mean_curvature(&s) {
            assert!((h * radius - 1.0).abs() < 0.01, "{h} at radius {radius}");
        }
        // Inside out, it is negative.
        let reversed: Vec<[u32; 3]> = s.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let inside_out = Surface::new(s.positions.clone(), reversed.into());
        assert!(
            mean_curvature(&inside_out)
                .iter()
                .all(|h| (h * radius + 1.0).abs() < 0.01)
        );
    }
}

#[test]
fn curvature_survives_degenerate_triangles() {
    // Vertices drawn together in pairs make needles and faces without area.
    let s = unit_sphere(4);
    let mut positions = s.positions.clone();
    for (f, t) in s.triangles.iter().enumerate().step_by(97) {
        let share = if f % 2 == 0 { 1.0 } else { 1.0 - 1e-9 };
        let way = positions[t[1] as usize] - positions[t[0] as usize];
        positions[t[0] as usize] += way * share;
    }
    let broken = s.with_positions(positions);
    assert!(mean_curvature(&broken).iter().all(|h| h.is_finite()));
    assert!(curvature_correlation(&broken, &broken).is_some());
}

#[test]
fn correlation_tells_kept_lost_and_turned_out_bumps() {
    let s = unit_sphere(5);
    let (out, inwards) = (bumpy(&s, 0.03), bumpy(&s, -0.03));
    let correlation = |a: &Surface, b: &Surface| curvature_correlation(a, b).unwrap();
    assert!((correlation(&out, &out) - 1.0).abs() < 1e-12);
    assert!(correlation(&out, &inwards) < -0.9);
    assert!(correlation(&out, &s).abs() < 0.3);
    assert!(correlation(&out, &bumpy(&s, 0.02)) > 0.99);
    let flat = working(&planar_grid(8)).0.surface;
    assert_eq!(curvature_correlation(&flat, &flat), None);
}

#[test]
fn the_same_bits_with_one_and_two_threads() {
    let Some(path) = model("truth/spot_headturn30.obj") else {
        return;
    };
    let (w, diagonal) = working(&load(&path));
    let after = moved(&w.surface, |p| Point::new(p.x, p.y + 0.3 * p.x * p.x, p.z));
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| format!("{:?}", distortion(&w.surface, &after, diagonal)))
    };
    assert_eq!(run(1), run(2));
}
