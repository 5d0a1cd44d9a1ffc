//! Point clouds: normals, their side, discs, and the symmetries found on them.

mod common;

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use common::data;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::cloud::Discs;
use symmetrizer::shape::io;

/// Points with the true outward normals.
struct Sampled {
    points: Vec<Point>,
    normals: Vec<Vector>,
}

/// A number from the standard normal distribution (Box and Muller).
fn gauss(rng: &mut Pcg64) -> f64 {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos()
}

fn diagonal(points: &[Point]) -> f64 {
    let low = points.iter().fold(points[0], |l, p| l.inf(p));
    let high = points.iter().fold(points[0], |h, p| h.sup(p));
    (high - low).norm()
}

impl Sampled {
    /// `count` points that `draw` returns, half of those with x > 0 left out where `uneven`, moved
    /// by a standard deviation of `noise` times the diagonal.
    fn new(
        count: usize,
        noise: f64,
        uneven: bool,
        draw: impl Fn(&mut Pcg64) -> Option<(Vector, Vector)>,
    ) -> Self {
        let mut rng = Pcg64::seed_from_u64(7);
        let mut sampled = Self {
            points: Vec::new(),
            normals: Vec::new(),
        };
        while sampled.points.len() < count {
            let Some((x, n)) = draw(&mut rng) else {
                continue;
            };
            if uneven && x.x > 0.0 && rng.random::<f64>() < 0.5 {
                continue;
            }
            sampled.points.push(Point::from(x));
            sampled.normals.push(n);
        }
        let sigma = noise * diagonal(&sampled.points);
        for p in &mut sampled.points {
            *p += Vector::from_fn(|_, _| gauss(&mut rng)) * sigma;
        }
        sampled
    }
}

fn sphere(rng: &mut Pcg64) -> Option<(Vector, Vector)> {
    let n = Vector::from_fn(|_, _| gauss(rng)).normalize();
    Some((n, n))
}

fn torus(rng: &mut Pcg64) -> Option<(Vector, Vector)> {
    let (u, v) = (TAU * rng.random::<f64>(), TAU * rng.random::<f64>());
    let r = 1.0 + 0.4 * v.cos();
    let n = Vector::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
    let x = Vector::new(r * u.cos(), r * u.sin(), 0.4 * v.sin());
    (rng.random::<f64>() * 1.4 < r).then_some((x, n))
}

/// A box of the given sides.
fn cuboid(sides: Vector) -> impl Fn(&mut Pcg64) -> Option<(Vector, Vector)> {
    move |rng| {
        let area = |k: usize| sides[(k + 1) % 3] * sides[(k + 2) % 3];
        let mut at = rng.random::<f64>() * (area(0) + area(1) + area(2));
        let axis = (0..3).find(|&k| {
            at -= area(k);
            at < 0.0
        })?;
        let side = if rng.random::<bool>() { 1.0 } else { -1.0 };
        let mut x = Vector::from_fn(|k, _| sides[k] * (rng.random::<f64>() - 0.5));
        let mut n = Vector::zeros();
        x[axis] = 0.5 * side * sides[axis];
        n[axis] = side;
        Some((x, n))
    }
}

/// A prism over a star of five rounded points, with sharp rims.
fn star(rng: &mut Pcg64) -> Option<(Vector, Vector)> {
    let t = TAU * rng.random::<f64>();
    let r = 1.0 + 0.3 * (5.0 * t).cos();
    let slope = -1.5 * (5.0 * t).sin();
    let z = rng.random::<f64>() - 0.5;
    if rng.random::<f64>() < 0.3 {
        let inner = r * rng.random::<f64>().sqrt();
        let x = Vector::new(inner * t.cos(), inner * t.sin(), 0.5 * z.signum());
        return Some((x, Vector::z() * z.signum()));
    }
    let n = Vector::new(
        r * t.cos() + slope * t.sin(),
        r * t.sin() - slope * t.cos(),
        0.0,
    );
    Some((Vector::new(r * t.cos(), r * t.sin(), z), n.normalize()))
}

/// Share of the normals on the right side, and the median and 90th percentile of the angle between the
/// lines of found and true normals, degrees.
fn judged(discs: &Discs, truth: &[Vector]) -> [f64; 3] {
    let pairs = || discs.normals.iter().zip(&discs.document);
    let cosines: Vec<f64> = pairs().map(|(n, &i)| n.dot(&truth[i as usize])).collect();
    let mut angles: Vec<f64> = cosines
        .iter()
        .map(|c| c.abs().min(1.0).acos().to_degrees())
        .collect();
    angles.sort_by(f64::total_cmp);
    // At a right angle neither side is wrong.
    let told: Vec<&f64> = cosines.iter().filter(|c| c.abs() > 0.2).collect();
    let right = told.iter().filter(|c| ***c > 0.0).count();
    let at = |share: f64| angles[(share * angles.len() as f64) as usize];
    [right as f64 / told.len() as f64, at(0.5), at(0.9)]
}

#[test]
fn explore() {
    type Draw = Box<dyn Fn(&mut Pcg64) -> Option<(Vector, Vector)>>;
    let shapes: [(&str, Draw, f64); 5] = [
        ("sphere", Box::new(sphere), 4.0 * 3.14159),
        ("torus", Box::new(torus), 4.0 * 9.8696 * 0.4),
        ("box", Box::new(cuboid(Vector::new(1.0, 0.7, 0.5))), 3.1),
        ("slab", Box::new(cuboid(Vector::new(1.0, 1.0, 0.08))), 2.32),
        ("star", Box::new(star), 1.0),
    ];
    for (name, draw, area) in &shapes {
        for count in [1000, 4000] {
            for noise in [0.0, 0.005, 0.01] {
                for uneven in [false, true] {
                    let s = Sampled::new(count, noise, uneven, draw);
                    let d = Discs::new(&s.points, None).unwrap();
                    let [right, mid, p90] = judged(&d, &s.normals);
                    let total: f64 = d.areas.iter().sum();
                    println!(
                        "{name} {count} noise {noise} uneven {uneven}: right {right:.3} angle {mid:.1} {p90:.1} area {:.2} noise {:.4} spacing {:.4}",
                        total / area,
                        d.noise / diagonal(&s.points),
                        d.spacing / diagonal(&s.points)
                    );
                }
            }
        }
    }
}

#[test]
fn explore_shrec() {
    for i in 0..24 {
        let Some(path) = data(&format!("truth/shrec_style/points{i}.txt")) else {
            return;
        };
        let points = io::read(&path).unwrap().mesh.positions;
        let sym =
            std::fs::read_to_string(path.with_file_name(format!("points{i}_sym.txt"))).unwrap();
        let row: Vec<f64> = sym
            .lines()
            .nth(1)
            .unwrap()
            .split_whitespace()
            .map(|w| w.parse().unwrap())
            .collect();
        let center = Point::new(row[3], row[4], row[5]);
        let d = Discs::new(&points, None).unwrap();
        let mut wrong = 0;
        for (x, n) in d.points.iter().zip(&d.normals) {
            wrong += usize::from((x - center).dot(n) < 0.0);
        }
        println!(
            "points{i}: {} outward {:.3} noise {:.4} spacing {:.4}",
            points.len(),
            1.0 - wrong as f64 / d.points.len() as f64,
            d.noise / diagonal(&points),
            d.spacing / diagonal(&points)
        );
    }
}
