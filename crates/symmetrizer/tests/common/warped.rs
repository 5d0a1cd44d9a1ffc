//! Spheres with bumps, and shapes warped as a whole.

use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::Step;
use symmetrizer::shape::Mesh;
use symmetrizer::{Context, Detected, Params, detect_in, symmetrize};

use super::{placed, sphere};

/// Amplitude of the warp, rms fraction of the bounding-box diagonal.
const WARP: f64 = 0.004;

/// A bump on a sphere: where, how high, how wide (radians).
pub type Bump = (Vector, f64, f64);

/// A sphere, an octahedron divided `levels` times, squeezed along z, with bumps.
pub fn bumpy(levels: u32, squeeze: f64, bumps: &[Bump]) -> Mesh {
    let mut mesh = sphere(levels);
    for p in &mut mesh.positions {
        let n = p.coords.normalize();
        let bump = |(at, high, wide): &Bump| {
            let angle = n.dot(at).clamp(-1.0, 1.0).acos() / wide;
            high * (-angle * angle).exp()
        };
        let radius = 1.0 + bumps.iter().map(bump).sum::<f64>();
        *p = Point::from(radius * n);
        p.z *= squeeze;
    }
    mesh
}

/// The mesh warped smoothly by sums of waves longer than itself, and placed anywhere.
pub fn warped(mesh: &Mesh) -> Mesh {
    let mut warped = mesh.clone();
    let waves = [
        (Vector::new(1.9, 0.7, -1.1), Vector::new(0.3, -1.0, 0.5)),
        (Vector::new(-0.6, 2.1, 0.9), Vector::new(1.0, 0.4, 0.2)),
        (Vector::new(0.8, -1.0, 2.2), Vector::new(-0.5, 0.6, 1.0)),
        (Vector::new(2.4, 1.3, 0.4), Vector::new(0.2, 0.9, -0.8)),
    ];
    let way = |p: &Point| {
        let wave = |(k, a): &(Vector, Vector)| a * (k.dot(&p.coords) + a.x).sin();
        waves.iter().map(wave).sum::<Vector>()
    };
    let squares = mesh.positions.iter().map(|p| way(p).norm_squared());
    let rms = (squares.sum::<f64>() / mesh.positions.len() as f64).sqrt();
    let by = WARP * mesh.diagonal() / rms;
    for p in &mut warped.positions {
        *p += by * way(p);
    }
    let omega = Vector::new(0.4, -1.2, 0.9);
    placed(&warped, omega, 7.0, Vector::new(3.0, -2.0, 5.0))
}

/// Around z, at this height (cosine), as many as `count`, the first at `phase` (radians).
pub fn ring(count: u32, height: f64, phase: f64, high: f64, wide: f64) -> Vec<Bump> {
    let step = std::f64::consts::TAU / f64::from(count);
    let around = (0..count).map(|k| f64::from(k) * step + phase);
    let across = (1.0 - height * height).sqrt();
    around
        .map(|a| Vector::new(across * a.cos(), across * a.sin(), height))
        .map(|at| (at, high, wide))
        .collect()
}

/// What is found on a mesh by default.
pub fn detected(mesh: &Mesh) -> Detected {
    detect_in(mesh, &Params::default(), &mut Context::new(3)).expect("detection")
}

/// How far apart the copies of the goal `name` are before and after a default run on a mesh, rms; the goal must be among those that
/// are made exact.
pub fn made_exact(mesh: &Mesh, name: &str) -> [f64; 2] {
    let done = symmetrize(mesh, &Params::default(), &mut Context::new(3)).expect("a run");
    let goals = done.report.steps.iter().find_map(|step| match step {
        Step::Orbits { goals, .. } => Some(goals),
        _ => None,
    });
    let met = goals.and_then(|g| g.iter().find(|g| g.name == name));
    met.unwrap_or_else(|| panic!("{name} is not made exact"))
        .residual
}
