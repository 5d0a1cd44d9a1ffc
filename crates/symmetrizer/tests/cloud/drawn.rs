//! Points drawn from shapes whose normals are known.

use std::f64::consts::TAU;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::cloud::Discs;

/// A point of a shape with its outward normal; sometimes none, so that points spread evenly.
pub type Drawn = Option<(Vector, Vector)>;

/// Points with the true outward normals.
pub struct Sampled {
    pub points: Vec<Point>,
    pub normals: Vec<Vector>,
}

/// A number from the standard normal distribution (Box and Muller).
fn gauss(rng: &mut Pcg64) -> f64 {
    let (u, v): (f64, f64) = (rng.random(), rng.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos()
}

pub fn diagonal(points: &[Point]) -> f64 {
    let low = points.iter().fold(points[0], |l, p| l.inf(p));
    let high = points.iter().fold(points[0], |h, p| h.sup(p));
    (high - low).norm()
}

impl Sampled {
    /// `count` points that `draw` returns, half of those with x > 0 left out where `uneven`, moved
    /// by a standard deviation of `noise` times the diagonal.
    pub fn new(count: usize, noise: f64, uneven: bool, draw: impl Fn(&mut Pcg64) -> Drawn) -> Self {
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

pub fn sphere(rng: &mut Pcg64) -> Drawn {
    let n = Vector::from_fn(|_, _| gauss(rng)).normalize();
    Some((n, n))
}

pub fn torus(rng: &mut Pcg64) -> Drawn {
    let (u, v) = (TAU * rng.random::<f64>(), TAU * rng.random::<f64>());
    let r = 1.0 + 0.4 * v.cos();
    let n = Vector::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin());
    let x = Vector::new(r * u.cos(), r * u.sin(), 0.4 * v.sin());
    (rng.random::<f64>() * 1.4 < r).then_some((x, n))
}

/// A box of the given sides.
pub fn cuboid(sides: Vector) -> impl Fn(&mut Pcg64) -> Drawn {
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
pub fn star(rng: &mut Pcg64) -> Drawn {
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
pub fn judged(discs: &Discs, truth: &[Vector]) -> [f64; 3] {
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
