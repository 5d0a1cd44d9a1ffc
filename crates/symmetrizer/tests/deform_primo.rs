//! PriMo: energy and its derivatives, exactness, fixed and stiff regions, loose parts, states.
#![allow(clippy::print_stdout)]
mod common;

use common::{sphere, union, working};
use rand::RngExt;
use rand_pcg::Pcg64;
use symmetrizer::deform::elastic::{Motion, Spring};
use symmetrizer::deform::primo::joint::{Joint, gauss_points};
use symmetrizer::deform::primo::prisms;
use symmetrizer::deform::{DeformParams, Primo};
use symmetrizer::deform::{Deformer, Pull};
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::sample::blue_noise::blue_noise;
use symmetrizer::shape::{Mesh, Surface, SurfacePoint};
use symmetrizer::{Context, Error};

/// An ellipsoid with three different axes: no motion but rest leaves it where it is.
fn ellipsoid(levels: u32) -> Mesh {
    let mut mesh = sphere(levels);
    for p in &mut mesh.positions {
        p.y *= 0.6;
        p.z *= 0.4;
    }
    mesh
}

fn surface(mesh: &Mesh) -> Surface {
    working(mesh).0.surface
}

fn primo(surface: &Surface) -> Primo {
    Primo::new(surface, &DeformParams::default()).expect("prisms")
}

/// Prisms over the surface's own faces and over a control mesh of a few of them.
fn fine_and_coarse(surface: &Surface) -> [Primo; 2] {
    [4000, 300].map(|control_faces| {
        let params = DeformParams {
            control_faces,
            ..DeformParams::default()
        };
        Primo::new(surface, &params).expect("prisms")
    })
}

fn rng() -> Pcg64 {
    Context::new(11).rng("test")
}

fn random_vector(rng: &mut Pcg64, size: f64) -> Vector {
    Vector::from_fn(|_, _| size * rng.random_range(-1.0..1.0))
}

/// A pull at the middle of every `stride`th face to where `target` takes it.
fn pulls(
    surface: &Surface,
    stride: usize,
    weight: f64,
    target: impl Fn(&Point) -> Point,
) -> Vec<Pull> {
    (0..surface.triangles.len() as u32)
        .step_by(stride)
        .map(|face| {
            let at = SurfacePoint {
                face,
                bary: [1.0 / 3.0; 3],
            };
            Pull {
                at,
                target: target(&surface.point(&at)),
                weight,
            }
        })
        .collect()
}

fn run(primo: &mut Primo, pulls: &[Pull], steps: usize) -> f64 {
    let mut ctx = Context::default();
    let mut energy = primo.energy();
    for _ in 0..steps {
        energy = primo.deform(pulls, &mut ctx).expect("a step").energy;
    }
    energy
}

/// The largest distance of a vertex from where `target` takes its rest position.
fn worst(primo: &Primo, target: impl Fn(&Point) -> Point) -> f64 {
    let rest = &primo.rest().positions;
    let moved = primo.positions();
    let away = moved.iter().zip(rest).map(|(x, r)| (x - target(r)).norm());
    away.fold(0.0, f64::max)
}

fn rms(a: &[Point], b: &[Point]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(x, y)| (x - y).norm_squared()).sum();
    (sum / a.len() as f64).sqrt()
}

/// A quarter of a turn and a shift.
fn rigid(x: &Point) -> Point {
    let r = exp_rotation(&Vector::new(0.9, -0.8, 1.0));
    Point::from(r * x.coords + Vector::new(0.2, -0.1, 0.3))
}

#[test]
fn rigid_motion_costs_no_energy() {
    let s = surface(&ellipsoid(3));
    let mut prisms = prisms(&s, 0.02).expect("prisms");
    assert!(prisms.energy() < 1e-30, "{}", prisms.energy());
    for m in &mut prisms.motions {
        m.rotation = exp_rotation(&Vector::new(0.9, -0.8, 1.0));
        m.center = rigid(&m.rest_center);
    }
    assert!(prisms.energy() < 1e-26, "{}", prisms.energy());
    prisms.motions[7].center.x += 0.01;
    assert!(prisms.energy() > 1e-6, "{}", prisms.energy());
}

/// A joint between two prisms that are turned and shifted at random.
fn random_joint(rng: &mut Pcg64) -> (Joint, [Motion; 2]) {
    let (a, b) = (Point::origin(), Point::new(0.1, 0.02, -0.01));
    let (n_a, n_b) = (Vector::z(), Vector::new(0.1, -0.2, 0.9).normalize());
    let joint = Joint::new(0, 1, &gauss_points(&a, &b, &n_a, &n_b, 0.03), 0.7);
    let motions = [Vector::new(0.05, 0.04, 0.0), Vector::new(0.05, -0.05, 0.0)].map(|c| {
        let rest = Motion::rest(Point::from(c));
        rest.twisted(&random_vector(rng, 0.8), &random_vector(rng, 0.1))
    });
    (joint, motions)
}

/// The twist of six numbers (omega, v) applied to one of the two motions.
fn twisted(motions: &[Motion; 2], which: usize, twist: &[f64; 6]) -> [Motion; 2] {
    let mut out = *motions;
    let omega = Vector::from_row_slice(&twist[..3]);
    let v = Vector::from_row_slice(&twist[3..]);
    out[which] = motions[which].twisted(&omega, &v);
    out
}

#[test]
fn the_gradient_equals_finite_differences() {
    let mut rng = rng();
    for _ in 0..20 {
        let (joint, motions) = random_joint(&mut rng);
        let blocks = joint.blocks(&motions);
        let scale = blocks.gradient.iter().map(|g| g.norm()).fold(0.0, f64::max);
        for which in 0..2 {
            for axis in 0..6 {
                let h = 1e-6;
                let at = |step: f64| {
                    let mut twist = [0.0; 6];
                    twist[axis] = step;
                    joint.energy(&twisted(&motions, which, &twist))
                };
                // The blocks belong to half the energy: H delta = -g.
                let numeric = (at(h) - at(-h)) / (4.0 * h);
                let exact = blocks.gradient[which][axis];
                assert!((numeric - exact).abs() < 1e-7 * scale, "{numeric} {exact}");
            }
        }
    }
}

#[test]
fn the_hessian_is_exact_where_the_joint_is_closed() {
    let mut rng = rng();
    let (joint, mut motions) = random_joint(&mut rng);
    // Both prisms moved as one: no gap, so Gauss-Newton leaves nothing out.
    let r = exp_rotation(&random_vector(&mut rng, 1.0));
    for m in &mut motions {
        m.rotation = r;
        m.center = Point::from(r * m.rest_center.coords);
    }
    let [h_ii, h_jj, h_ij] = joint.blocks(&motions).hessian.map(|h| h.matrix());
    for _ in 0..20 {
        let twist: [f64; 6] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let other: [f64; 6] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
        let (u, v) = (
            nalgebra::Vector6::from(twist),
            nalgebra::Vector6::from(other),
        );
        let quadratic = (u.transpose() * h_ii * u + v.transpose() * h_jj * v)[0]
            + 2.0 * (u.transpose() * h_ij * v)[0];
        let h = 1e-5;
        let one = twisted(&motions, 0, &twist.map(|t| h * t));
        let both = twisted(&one, 1, &other.map(|t| h * t));
        let numeric = joint.energy(&both) / (h * h);
        assert!(
            (numeric / quadratic - 1.0).abs() < 1e-3,
            "{numeric} {quadratic}"
        );
    }
}

#[test]
fn a_translation_is_met_in_one_step() {
    let s = surface(&ellipsoid(3));
    let mut p = primo(&s);
    let shift = |x: &Point| x + Vector::new(0.3, -0.2, 0.1);
    let energy = run(&mut p, &pulls(&s, 7, 1.0, shift), 1);
    // The ridge that holds loose parts takes its share of 1e-7.
    assert!(worst(&p, shift) < 1e-5, "{}", worst(&p, shift));
    assert!(energy < 1e-10, "{energy}");
}

#[test]
fn a_rigid_pull_is_met_without_energy() {
    let s = surface(&ellipsoid(4));
    let to = pulls(&s, 5, 1.0, rigid);
    for mut p in fine_and_coarse(&s) {
        let energy = run(&mut p, &to, 25);
        let away = worst(&p, rigid);
        println!("energy {energy:.1e}, worst {away:.1e}");
        assert!(energy < 1e-9 && away < 1e-4, "{energy} {away}");
    }
}

/// The largest way of the vertices for which `wanted` holds at rest.
fn farthest(p: &Primo, wanted: impl Fn(&Point) -> bool) -> f64 {
    let ways = p.positions().into_iter().zip(&p.rest().positions);
    let ways = ways.filter(|(_, rest)| wanted(rest));
    ways.map(|(x, rest)| (x - rest).norm()).fold(0.0, f64::max)
}

#[test]
fn no_corner_of_a_fixed_face_moves() {
    let s = surface(&ellipsoid(4));
    let fixed: Vec<bool> = (0..s.triangles.len() as u32)
        .map(|f| s.corners(f).iter().all(|c| c.x < 0.0))
        .collect();
    let to = pulls(&s, 3, 1.0, |x| x + Vector::new(0.0, 0.1, 0.05));
    for mut p in fine_and_coarse(&s) {
        p.set_fixed(&fixed).expect("one value for each face");
        run(&mut p, &to, 10);
        let moved = p.positions();
        let corners = s.triangles.iter().zip(&fixed).filter(|(_, f)| **f);
        for &v in corners.flat_map(|(corners, _)| corners) {
            let way = (moved[v as usize] - s.positions[v as usize]).norm();
            assert!(way < 1e-12, "vertex {v} of a fixed face moved by {way}");
        }
        assert!(farthest(&p, |x| x.x > 0.1) > 0.05, "the free part follows");
    }
}

#[test]
fn a_mask_of_no_or_all_faces_means_it() {
    let s = surface(&ellipsoid(4));
    let shift = |x: &Point| x + Vector::new(0.3, -0.2, 0.1);
    let to = pulls(&s, 5, 1.0, shift);
    for mut p in fine_and_coarse(&s) {
        p.set_fixed(&vec![true; s.triangles.len()]).expect("a mask");
        run(&mut p, &to, 2);
        assert!(farthest(&p, |_| true) < 1e-12, "all fixed");
        p.set_fixed(&vec![false; s.triangles.len()])
            .expect("a mask");
        run(&mut p, &to, 10);
        assert!(worst(&p, shift) < 1e-5, "none fixed: {}", worst(&p, shift));
    }
}

/// rms distance of points from the rigid motion that takes `rest` nearest to `moved`.
fn bent(rest: &[Point], moved: &[Point]) -> f64 {
    let n = rest.len() as f64;
    let mean = |x: &[Point]| x.iter().map(|p| p.coords).sum::<Vector>() / n;
    let (a, b) = (mean(rest), mean(moved));
    let h = rest
        .iter()
        .zip(moved)
        .map(|(x, y)| (x.coords - a) * (y.coords - b).transpose())
        .sum::<nalgebra::Matrix3<f64>>();
    let svd = h.svd(true, true);
    let (u, v) = (svd.u.unwrap(), svd.v_t.unwrap().transpose());
    let r = v * u.transpose();
    let fitted: Vec<Point> = rest
        .iter()
        .map(|x| Point::from(r * (x.coords - a) + b))
        .collect();
    rms(&fitted, moved)
}

/// How much the part x > 0.16 is bent when its faces (and a rim) are `factor` times as stiff.
fn bent_when(mut p: Primo, factor: f64) -> f64 {
    let s = p.rest().clone();
    let stiffness: Vec<f64> = (0..s.triangles.len() as u32)
        .map(|f| s.corners(f).iter().all(|c| c.x > 0.08))
        .map(|stiff| if stiff { factor } else { 1.0 })
        .collect();
    p.set_stiffness(&stiffness).expect("valid stiffness");
    let bend = |x: &Point| x + Vector::new(0.0, 0.0, 1.2 * x.x * x.x);
    run(&mut p, &pulls(&s, 5, 0.02, bend), 15);
    let moved = p.positions();
    let part: Vec<usize> = (0..moved.len())
        .filter(|&v| s.positions[v].x > 0.16)
        .collect();
    let pick = |x: &[Point]| part.iter().map(|&v| x[v]).collect::<Vec<_>>();
    bent(&pick(&s.positions), &pick(&moved))
}

#[test]
fn a_stiff_region_moves_as_one_piece() {
    let s = surface(&ellipsoid(4));
    for which in 0..2 {
        let with = |factor| {
            let [fine, coarse] = fine_and_coarse(&s);
            bent_when(if which == 0 { fine } else { coarse }, factor)
        };
        let (soft, usual, stiff) = (with(0.01), with(1.0), with(100.0));
        println!("bent by {soft:.5}, {usual:.5}, {stiff:.5}");
        assert!(
            usual < soft && stiff < usual / 20.0,
            "{soft} {usual} {stiff}"
        );
    }
}

#[test]
fn invalid_stiffness_and_masks_are_refused() {
    let s = surface(&ellipsoid(2));
    let mut p = primo(&s);
    let n = s.triangles.len();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            p.set_stiffness(&vec![bad; n]),
            Err(Error::Params { .. })
        ));
    }
    assert!(p.set_stiffness(&[1.0]).is_err());
    assert!(p.set_fixed(&[true]).is_err());
}

#[test]
fn state_and_restore_are_a_round_trip() {
    let s = surface(&ellipsoid(3));
    let mut p = primo(&s);
    let to = pulls(&s, 5, 1.0, |x| Point::new(x.x, x.y + x.x * x.x, x.z));
    run(&mut p, &to, 3);
    let (state, energy, positions) = (p.state(), p.energy(), p.positions());
    run(&mut p, &to, 3);
    assert_ne!(p.positions(), positions);
    p.restore(&state);
    assert_eq!((p.energy(), p.positions()), (energy, positions));
    // What is done again comes out the same.
    run(&mut p, &to, 3);
    let again = p.positions();
    p.restore(&state);
    run(&mut p, &to, 3);
    assert_eq!(p.positions(), again);
}

#[test]
fn loose_parts_ride_along() {
    let mut small = sphere(2);
    for x in &mut small.positions {
        *x = Point::from(x.coords * 0.1) + Vector::new(0.3, 0.2, 0.55);
    }
    let s = surface(&union(&ellipsoid(4), &small));
    let big = sphere(4).triangles().count();
    let mut p = primo(&s);
    let to: Vec<Pull> = pulls(&s, 5, 1.0, rigid)
        .into_iter()
        .filter(|pull| (pull.at.face as usize) < big)
        .collect();
    let energy = run(&mut p, &to, 40);
    println!("energy {energy:.1e}, worst {:.1e}", worst(&p, rigid));
    assert!(worst(&p, rigid) < 1e-3, "{}", worst(&p, rigid));
}

/// A smooth change of form that no rigid motion makes: longer, bent and twisted a little.
fn form(x: &Point) -> Point {
    let turn = exp_rotation(&Vector::new(0.5 * x.x, 0.0, 0.0));
    Point::new(1.1 * x.x, 0.0, 0.4 * x.x * x.x) + turn * Vector::new(0.0, x.y, x.z)
}

/// The shape at rest under `count` samples drawn to `form` with time step `dt`: each step goes the
/// share dt of the way with the weight A_s / (l^2 dt) (docs/definitions.md: stiffness is a length).
fn settled(s: &Surface, count: usize, dt: f64, steps: usize) -> Vec<Point> {
    let mut p = primo(s);
    let (samples, _) = blue_noise(s, count, &mut Context::new(3).rng("samples"));
    let length = DeformParams::default().length;
    let weight = s.area() / samples.len() as f64 / (length * length * dt);
    let mut ctx = Context::default();
    for _ in 0..steps {
        let places = p.places(&samples);
        let pulls: Vec<Pull> = samples
            .iter()
            .zip(&places)
            .map(|(at, x)| Pull {
                at: *at,
                target: x + (form(&s.point(at)) - x) * dt,
                weight,
            })
            .collect();
        p.deform(&pulls, &mut ctx).expect("a step");
    }
    p.positions()
}

#[test]
fn neither_time_step_nor_sample_count_changes_the_result() {
    let s = surface(&ellipsoid(4));
    let reference = settled(&s, 1500, 0.3, 25);
    let moved = rms(&reference, &s.positions);
    let targets: Vec<Point> = s.positions.iter().map(form).collect();
    println!(
        "moved {moved:.4}, {:.4} short of the targets",
        rms(&reference, &targets)
    );
    for (count, dt, steps) in [
        (1500, 0.1, 75),
        (1500, 1.0, 8),
        (750, 0.3, 25),
        (3000, 0.3, 25),
    ] {
        let away = rms(&settled(&s, count, dt, steps), &reference);
        println!("{count} samples, dt {dt}: {:.3} %", 100.0 * away / moved);
        assert!(
            away < 0.01 * moved,
            "{count} samples, dt {dt}: {away} of {moved}"
        );
    }
}

#[test]
fn targets_that_are_no_numbers_are_an_error() {
    let s = surface(&ellipsoid(2));
    let mut p = primo(&s);
    let before = p.positions();
    for bad in [f64::NAN, f64::INFINITY] {
        let to = pulls(&s, 3, 1.0, |x| Point::new(x.x, bad, x.z));
        let result = p.deform(&to, &mut Context::default());
        assert!(matches!(result, Err(Error::Numerical { .. })), "{bad}");
    }
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let to = pulls(&s, 3, bad, |x| *x);
        assert!(
            p.deform(&to, &mut Context::default()).is_err(),
            "weight {bad}"
        );
    }
    assert_eq!(p.positions(), before);
}

#[test]
fn a_cancelled_step_says_so() {
    let s = surface(&ellipsoid(2));
    let mut p = primo(&s);
    let cancel = symmetrizer::CancelToken::default();
    cancel.cancel();
    let mut ctx = Context::with_sink(0, cancel, |_| {});
    let result = p.deform(&pulls(&s, 3, 1.0, rigid), &mut ctx);
    assert!(matches!(result, Err(Error::Cancelled)));
}
