//! PriMo's energy against closed forms: the integral over a joint, and what a plate costs that is stretched
//! or bent (docs/definitions.md).
#![allow(clippy::print_stdout)]

use rand::RngExt;
use symmetrizer::Context;
use symmetrizer::deform::elastic::{Motion, Spring};
use symmetrizer::deform::primo::joint::{Joint, gauss_points};
use symmetrizer::deform::primo::prisms;
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::Surface;

/// The gap f_ij - f_ji at the corners (u, v) of a side face, v across the surface.
fn gaps(
    x: [&Point; 2],
    n: [&Vector; 2],
    h: f64,
    [i, j]: [&Motion; 2],
) -> impl Fn(f64, f64) -> Vector {
    move |u, v| {
        let on_edge = x[0] + (x[1] - x[0]) * u;
        let at = on_edge + (n[0] * (1.0 - u) + n[1] * u) * (h * (2.0 * v - 1.0));
        i.apply(&at) - j.apply(&at)
    }
}

#[test]
fn a_joint_is_the_integral_over_its_face() {
    let mut rng = Context::new(3).rng("test");
    let mut vector = |size: f64| Vector::from_fn(|_, _| size * rng.random_range(-1.0..1.0));
    for _ in 0..20 {
        let [a, b] = [0, 1].map(|_| Point::from(vector(1.0)));
        let [n_a, n_b] = [0, 1].map(|_| vector(1.0).normalize());
        let mut motion = || Motion {
            rotation: exp_rotation(&vector(1.0)),
            rest_center: Point::from(vector(1.0)),
            center: Point::from(vector(1.0)),
        };
        let motions = [motion(), motion()];
        let h = 0.3;
        let joint = Joint::new(0, 1, &gauss_points(&a, &b, &n_a, &n_b, h), 1.0);
        let gap = gaps([&a, &b], [&n_a, &n_b], h, [&motions[0], &motions[1]]);
        // Botsch et al.: one ninth of sum a_ij . a_kl 2^(-|i-k| - |j-l|) over the corners.
        let mut closed = 0.0;
        for (i, j, k, l) in (0..16).map(|c| (c & 1, c >> 1 & 1, c >> 2 & 1, c >> 3 & 1)) {
            let [p, q] = [(i, j), (k, l)].map(|(u, v)| gap(f64::from(u), f64::from(v)));
            let apart = i32::abs(i - k) + i32::abs(j - l);
            closed += p.dot(&q) * 0.5_f64.powi(apart) / 9.0;
        }
        const FINE: i32 = 100;
        let middle = |k: i32| (f64::from(k) + 0.5) / f64::from(FINE);
        let cells = (0..FINE).flat_map(|u| (0..FINE).map(move |v| (u, v)));
        let sum: f64 = cells
            .map(|(u, v)| gap(middle(u), middle(v)).norm_squared())
            .sum();
        let quadrature = sum / f64::from(FINE * FINE);
        let energy = joint.energy(&motions);
        assert!(
            (energy - closed).abs() < 1e-12 * closed,
            "{energy} {closed}"
        );
        assert!((energy - quadrature).abs() < 1e-3 * closed, "{quadrature}");
    }
}

/// A plate of equilateral triangles with sides of 1 / n.
fn plate(n: u32) -> Surface {
    let side = 1.0 / f64::from(n);
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let place = |i: u32, j: u32| {
        let shift = 0.5 * f64::from(j % 2);
        Point::new(
            side * (f64::from(i) + shift),
            side * f64::from(j) * 0.75_f64.sqrt(),
            0.0,
        )
    };
    let positions = (0..=n).flat_map(|j| (0..=n).map(move |i| place(i, j)));
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
        if j % 2 == 0 {
            triangles.extend([[a, b, c], [b, d, c]]);
        } else {
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    Surface::new(positions.collect(), triangles.into())
}

/// The energy per area of a plate whose prisms lie as `motion` says of their centres.
fn energy(plate: &Surface, h: f64, motion: impl Fn(&Point) -> (Point, Vector)) -> f64 {
    let mut prisms = prisms(plate, h).expect("prisms");
    for m in &mut prisms.motions {
        let (center, turn) = motion(&m.rest_center);
        m.center = center;
        m.rotation = exp_rotation(&turn);
    }
    prisms.energy() / plate.area()
}

#[test]
fn stretch_costs_two_thirds_of_its_square_whatever_the_height() {
    let plate = plate(40);
    for h in [0.005, 0.02, 0.08] {
        for s in [0.01, 0.1] {
            let stretched = |x: &Point| (Point::new(x.x * (1.0 + s), x.y, x.z), Vector::zeros());
            let ratio = energy(&plate, h, stretched) / (s * s);
            println!("h {h} s {s}: {ratio:.4}");
            assert!((ratio - 2.0 / 3.0).abs() < 0.03, "{ratio}");
        }
    }
}

#[test]
fn bending_costs_two_ninths_of_the_height_times_curvature_squared() {
    let (plate, k) = (plate(40), 0.5);
    let rolled = |x: &Point| {
        let a = k * x.x;
        let center = Point::new(a.sin() / k, x.y, (1.0 - a.cos()) / k);
        (center, Vector::new(0.0, -a, 0.0))
    };
    let cost = |h: f64| energy(&plate, h, rolled);
    let thin = cost(0.001);
    for h in [0.02_f64, 0.05, 0.1] {
        let ratio = (cost(h) - thin) / (h * k).powi(2);
        println!("h {h}: {ratio:.4}");
        assert!((ratio - 2.0 / 9.0).abs() < 0.01, "{ratio}");
    }
    // What is left at no height is the mesh's: it falls with the square of its edges.
    assert!(thin < 2.0 / 9.0 * (0.02 * k).powi(2), "{thin}");
}
