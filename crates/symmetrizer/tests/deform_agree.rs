//! Deformers against each other: both solvers, PriMo and its rival, coarse and fine meshes, prescribed
//! rotations, whatever the order of faces, the place and the size.
#![allow(clippy::print_stdout)]
mod common;

use common::{sphere, union, working};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;
use symmetrizer::deform::elastic::{Motion, Spring};
use symmetrizer::deform::poisson::integrate;
use symmetrizer::deform::primo::joint::{Joint, gauss_points};
use symmetrizer::deform::solver::{Coupling, Direct, Solver, System, Twist, TwoLevel};
use symmetrizer::deform::{Arap, DeformParams, Deformer, Model, Pull, deformer, relax};
use symmetrizer::geom::{Matrix3, Point, Vector, exp_rotation};
use symmetrizer::shape::{Mesh, Surface, SurfacePoint};
use symmetrizer::{Context, Error};

fn rng() -> Pcg64 {
    Context::new(5).rng("test")
}

/// A bar along x, `n` quads long and a quarter as many around each of its sides, its faces left whole or
/// in any order.
fn bar(n: u32) -> Mesh {
    let (wide, long) = (0.1, 1.0);
    let across = (n / 10).max(2);
    let around = 4 * across;
    let corner = |k: u32| {
        let (side, t) = (k / across % 4, f64::from(k % across) / f64::from(across));
        let t = wide * (2.0 * t - 1.0);
        [(t, -wide), (wide, t), (-t, wide), (-wide, -t)][side as usize]
    };
    let mut positions = Vec::new();
    for i in 0..=n {
        let x = long * (2.0 * f64::from(i) / f64::from(n) - 1.0);
        positions.extend((0..around).map(|k| {
            let (y, z) = corner(k);
            Point::new(x, y, z)
        }));
    }
    let mut triangles = Vec::new();
    for i in 0..n {
        for k in 0..around {
            let (a, b) = (i * around + k, i * around + (k + 1) % around);
            let (c, d) = (a + around, b + around);
            triangles.push([a, d, b]);
            triangles.push([a, c, d]);
        }
    }
    // A fan closes each end.
    for (ring, flip) in [(0, false), (n, true)] {
        let middle = positions.len() as u32;
        positions.push(Point::new(if flip { long } else { -long }, 0.0, 0.0));
        for k in 0..around {
            let (a, b) = (ring * around + k, ring * around + (k + 1) % around);
            triangles.push(if flip { [middle, b, a] } else { [middle, a, b] });
        }
    }
    for t in &mut triangles {
        t.swap(1, 2);
    }
    Mesh::from_triangles(positions, triangles)
}

fn surface(mesh: &Mesh) -> Surface {
    working(mesh).0.surface
}

fn params(model: Model, control_faces: usize) -> DeformParams {
    DeformParams {
        model,
        control_faces,
        ..DeformParams::default()
    }
}

/// Pulls spread evenly over the surface, as many as the stiffness length asks for, to `target`.
fn pulls(
    s: &Surface,
    wanted: impl Fn(&Point) -> bool,
    target: impl Fn(&Point) -> Point,
) -> Vec<Pull> {
    let length = DeformParams::default().length;
    (0..s.triangles.len() as u32)
        .map(|face| {
            (
                face,
                SurfacePoint {
                    face,
                    bary: [1.0 / 3.0; 3],
                },
            )
        })
        .filter(|(_, at)| wanted(&s.point(at)))
        .map(|(face, at)| Pull {
            at,
            target: target(&s.point(&at)),
            weight: s.face_areas[face as usize] / (length * length),
        })
        .collect()
}

fn rms(a: &[Point], b: &[Point]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(x, y)| (x - y).norm_squared()).sum();
    (sum / a.len() as f64).sqrt()
}

/// A gentle bend: z rises with the square of x.
fn bend(x: &Point) -> Point {
    Point::new(x.x, x.y, x.z + 0.3 * x.x * x.x)
}

fn settled(d: &mut dyn Deformer, pulls: &[Pull]) -> Vec<Point> {
    let done = relax(d, pulls, 1e-6, &mut Context::default()).expect("it comes to rest");
    println!("{done:?}");
    d.positions()
}

#[test]
fn both_solvers_give_one_answer() {
    let mut rng = rng();
    // A strip of elements, each joined to the next and to the tenth after it, some of them held.
    let n = 4000;
    let centers: Vec<Point> = (0..n)
        .map(|i| {
            Point::new(
                f64::from(i % 10),
                f64::from(i / 10),
                rng.random_range(-0.2..0.2),
            )
        })
        .collect();
    let motions: Vec<Motion> = centers.iter().map(|c| Motion::rest(*c)).collect();
    let mut pairs = Vec::new();
    let mut system = System {
        diagonal: vec![Coupling::zero(); n as usize],
        ridge: 1e-6,
        between: Vec::new(),
        fixed: (0..n).map(|i| i > 3950).collect(),
        centers,
    };
    for i in 0..n as usize {
        for j in [i + 1, i + 10].into_iter().filter(|&j| j < n as usize) {
            let (a, b) = (system.centers[i], system.centers[j]);
            let up = Vector::new(0.0, 0.1, 1.0).normalize();
            let joint = Joint::new(i, j, &gauss_points(&a, &b, &Vector::z(), &up, 0.3), 1.0);
            let [h_ii, h_jj, h_ij] = joint.blocks(&motions).hessian;
            system.diagonal[i] += h_ii;
            system.diagonal[j] += h_jj;
            system.between.push(h_ij);
            pairs.push([i as u32, j as u32]);
        }
    }
    let b: Vec<Twist> = (0..n as usize)
        .map(|i| {
            let force = Twist::from_fn(|_, _| rng.random_range(-1.0..1.0));
            if system.fixed[i] {
                Twist::zeros()
            } else {
                force
            }
        })
        .collect();
    let exact = Direct::new(n as usize, &pairs)
        .unwrap()
        .solve(&system, &b)
        .unwrap();
    let near = TwoLevel::new(n as usize, &pairs)
        .unwrap()
        .solve(&system, &b)
        .unwrap();
    let norm = |x: &[Twist]| x.iter().map(|t| t.norm_squared()).sum::<f64>().sqrt();
    let apart: Vec<Twist> = exact.iter().zip(&near).map(|(a, b)| a - b).collect();
    println!("apart {:.1e} of {:.1e}", norm(&apart), norm(&exact));
    assert!(norm(&apart) < 0.02 * norm(&exact));
    assert!(
        near.iter()
            .zip(&system.fixed)
            .all(|(t, f)| !f || *t == Twist::zeros())
    );
}

#[test]
fn coarse_and_fine_bars_bend_alike() {
    let (coarse, fine) = (surface(&bar(40)), surface(&bar(80)));
    for model in [Model::Primo, Model::Arap] {
        let ends = |s: &Surface| {
            let to = pulls(s, |x| x.x.abs() > 0.2, bend);
            let mut d = deformer(s, &params(model, 100_000)).unwrap();
            settled(d.as_mut(), &to)
        };
        let (a, b) = (ends(&coarse), ends(&fine));
        // Vertices of the coarse bar are among those of the fine one, by place.
        let moved = rms(&a, &coarse.positions);
        let twin = |x: &Point| {
            let by = |y: &&(Point, Point)| (y.0 - x).norm();
            let all: Vec<(Point, Point)> = fine
                .positions
                .iter()
                .copied()
                .zip(b.iter().copied())
                .collect();
            all.iter()
                .min_by(|p, q| by(p).total_cmp(&by(q)))
                .map(|p| p.1)
                .unwrap()
        };
        let twins: Vec<Point> = coarse.positions.iter().map(twin).collect();
        let away = rms(&a, &twins);
        println!("{model:?}: {:.2} % of {moved:.3}", 100.0 * away / moved);
        assert!(away < 0.02 * moved, "{model:?}: {away} of {moved}");
    }
}

#[test]
fn the_rivals_agree_on_small_displacements() {
    let s = surface(&bar(60));
    let small = |x: &Point| x + (bend(x) - x) * 0.1;
    let to = pulls(&s, |x| x.x.abs() > 0.2, small);
    let [a, b] = [Model::Primo, Model::Arap].map(|m| {
        let mut d = deformer(&s, &params(m, 100_000)).unwrap();
        settled(d.as_mut(), &to)
    });
    let moved = rms(&a, &s.positions);
    println!("{:.2} % of {moved:.4}", 100.0 * rms(&a, &b) / moved);
    assert!(rms(&a, &b) < 0.05 * moved, "{} of {moved}", rms(&a, &b));
}

#[test]
fn order_of_faces_place_and_size_do_not_matter() {
    let mesh = bar(40);
    let mut mixed: Vec<[u32; 3]> = mesh.triangles().map(|(t, _)| t).collect();
    mixed.shuffle(&mut rng());
    let mixed = Mesh::from_triangles(mesh.positions.clone(), mixed);
    let turn = exp_rotation(&Vector::new(0.4, 1.1, -0.7));
    let s = surface(&mesh);
    for model in [Model::Primo, Model::Arap] {
        let run = |s: &Surface, turn: &Matrix3| {
            let target = |x: &Point| {
                Point::from(turn * bend(&Point::from(turn.transpose() * x.coords)).coords)
            };
            let to = pulls(s, |x| (turn.transpose() * x.coords).x.abs() > 0.2, target);
            let mut d = deformer(s, &params(model, 100_000)).unwrap();
            settled(d.as_mut(), &to)
        };
        let reference = run(&s, &Matrix3::identity());
        let moved = rms(&reference, &s.positions);
        let away = rms(&run(&surface(&mixed), &Matrix3::identity()), &reference);
        println!("{model:?}, mixed: {:.3} %", 100.0 * away / moved);
        assert!(away < 0.01 * moved);
        let turned: Vec<Point> = s
            .positions
            .iter()
            .map(|x| Point::from(turn * x.coords))
            .collect();
        let there: Vec<Point> = run(&s.with_positions(turned), &turn)
            .iter()
            .map(|x| Point::from(turn.transpose() * x.coords))
            .collect();
        let away = rms(&there, &reference);
        println!("{model:?}, turned: {:.3} %", 100.0 * away / moved);
        assert!(away < 0.01 * moved);
    }
}

#[test]
fn the_rival_keeps_what_primo_keeps() {
    let s = surface(&union(&bar(40), &{
        let mut small = sphere(2);
        small
            .positions
            .iter_mut()
            .for_each(|x| *x = Point::from(x.coords * 0.05) + Vector::new(0.9, 0.0, 0.2));
        small
    }));
    let rigid = |x: &Point| {
        Point::from(
            exp_rotation(&Vector::new(0.9, -0.8, 1.0)) * x.coords + Vector::new(0.2, -0.1, 0.3),
        )
    };
    let mut d = Arap::new(&s, &DeformParams::default()).unwrap();
    assert!(d.energy() < 1e-30);
    let big = bar(40).triangles().count() as u32;
    let to: Vec<Pull> = pulls(&s, |_| true, rigid)
        .into_iter()
        .filter(|p| p.at.face < big)
        .collect();
    settled(&mut d, &to);
    let wanted: Vec<Point> = s.positions.iter().map(rigid).collect();
    println!(
        "{:.1e}, energy {:.1e}",
        rms(&d.positions(), &wanted),
        d.energy()
    );
    assert!(
        rms(&d.positions(), &wanted) < 2e-3,
        "the loose part rides along"
    );
    // States, fixed faces, stiffness, bad input.
    let state = d.state();
    let there = d.positions();
    d.deform(&pulls(&s, |_| true, bend), &mut Context::default())
        .unwrap();
    d.restore(&state);
    assert_eq!(d.positions(), there);
    let fixed: Vec<bool> = (0..s.triangles.len() as u32)
        .map(|f| s.corners(f).iter().all(|c| c.x < 0.0))
        .collect();
    let mut d = Arap::new(&s, &DeformParams::default()).unwrap();
    d.set_fixed(&fixed).unwrap();
    settled(&mut d, &pulls(&s, |_| true, bend));
    let moved = d.positions();
    for (corners, _) in s.triangles.iter().zip(&fixed).filter(|(_, f)| **f) {
        assert!(
            corners
                .iter()
                .all(|&v| (moved[v as usize] - s.positions[v as usize]).norm() < 1e-12)
        );
    }
    assert!(rms(&moved, &s.positions) > 0.01, "the free part follows");
    assert!(matches!(d.set_stiffness(&[1.0]), Err(Error::Params { .. })));
    let bad = pulls(&s, |_| true, |x| Point::new(x.x, f64::NAN, x.z));
    assert!(matches!(
        d.deform(&bad, &mut Context::default()),
        Err(Error::Numerical { .. })
    ));
}

#[test]
fn without_pulls_nothing_moves_and_opposite_ones_meet_halfway() {
    let s = surface(&bar(40));
    for model in [Model::Primo, Model::Arap] {
        let mut d = deformer(&s, &params(model, 100_000)).unwrap();
        let still = settled(d.as_mut(), &[]);
        assert!(rms(&still, &s.positions) < 1e-12, "{model:?}");
        let shift = Vector::new(0.0, 0.0, 0.2);
        let mut to = pulls(&s, |_| true, |x| x + shift);
        to.extend(pulls(&s, |_| true, |x| x - shift * 0.5));
        let met: Vec<Point> = s.positions.iter().map(|x| x + shift * 0.25).collect();
        let moved = settled(d.as_mut(), &to);
        assert!(rms(&moved, &met) < 1e-4, "{model:?}: {}", rms(&moved, &met));
    }
}

#[test]
fn rotations_are_integrated() {
    let s = surface(&bar(60));
    let n = s.positions.len();
    let turn = exp_rotation(&Vector::new(0.5, -0.3, 0.8));
    let moved = integrate(&s, &vec![turn; n], None, &[]).unwrap();
    let about = s
        .positions
        .iter()
        .zip(&s.vertex_areas)
        .map(|(x, a)| x.coords * *a)
        .sum::<Vector>()
        / s.area();
    let wanted: Vec<Point> = s
        .positions
        .iter()
        .map(|x| Point::from(turn * (x.coords - about) + about))
        .collect();
    println!("rigid: {:.1e}", rms(&moved, &wanted));
    assert!(rms(&moved, &wanted) < 1e-8);
    // The bar wound into a quarter of a circle about y: arc length is kept along its middle line.
    let (low, high) = s
        .positions
        .iter()
        .fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x.x), h.max(x.x)));
    let quarter = std::f64::consts::FRAC_PI_2;
    let angle = |x: &Point| quarter * ((x.x - low) / (high - low) - 0.5);
    let radius = (high - low) / quarter;
    let field: Vec<Matrix3> = s
        .positions
        .iter()
        .map(|x| exp_rotation(&Vector::new(0.0, -angle(x), 0.0)))
        .collect();
    let bent = integrate(&s, &field, None, &[]).unwrap();
    let middle = (low + high) / 2.0;
    let arc = |x: &Point| {
        let (a, r) = (angle(x), radius - x.z);
        Point::new(middle + r * a.sin(), x.y, radius - r * a.cos())
    };
    let mut wanted: Vec<Point> = s.positions.iter().map(arc).collect();
    let center = |x: &[Point]| {
        x.iter()
            .zip(&s.vertex_areas)
            .map(|(x, a)| x.coords * *a)
            .sum::<Vector>()
            / s.area()
    };
    let drift = center(&bent) - center(&wanted);
    wanted.iter_mut().for_each(|x| *x += drift);
    println!(
        "quarter: {:.4} of {:.4}",
        rms(&bent, &wanted),
        rms(&bent, &s.positions)
    );
    assert!(rms(&bent, &wanted) < 0.02 * rms(&bent, &s.positions));
}
