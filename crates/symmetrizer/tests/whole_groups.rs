//! Symmetries of the whole on shapes that are warped as a whole, so that no single motion holds as well as a copy does.

mod common;

use common::{placed, sphere};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::Step;
use symmetrizer::shape::Mesh;
use symmetrizer::{Context, Detected, Params, detect_in, symmetrize};

/// Amplitude of the warp, rms fraction of the bounding-box diagonal.
const WARP: f64 = 0.004;

/// A bump on a sphere: where, how high, how wide (radians).
type Bump = (Vector, f64, f64);

/// A sphere, an octahedron divided `levels` times, squeezed along z, with bumps.
fn bumpy(levels: u32, squeeze: f64, bumps: &[Bump]) -> Mesh {
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
fn warped(mesh: &Mesh) -> Mesh {
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

fn detected(mesh: &Mesh) -> Detected {
    detect_in(mesh, &Params::default(), &mut Context::new(3)).expect("detection")
}

/// The name of the group of most of the surface.
fn group(mesh: &Mesh) -> Option<String> {
    let found = detected(mesh);
    found.detection.groups.first().map(|g| g.name.clone())
}

/// Around z, at this height (cosine), as many as `count`, the first at `phase` (radians).
fn ring(count: u32, height: f64, phase: f64, high: f64, wide: f64) -> Vec<Bump> {
    let step = std::f64::consts::TAU / f64::from(count);
    let around = (0..count).map(|k| f64::from(k) * step + phase);
    let across = (1.0 - height * height).sqrt();
    around
        .map(|a| Vector::new(across * a.cos(), across * a.sin(), height))
        .map(|at| (at, high, wide))
        .collect()
}

fn tetrapod() -> Mesh {
    let at = |x: f64, y: f64, z: f64| (Vector::new(x, y, z).normalize(), 0.6, 0.35);
    let arms = [
        at(1.0, 1.0, 1.0),
        at(1.0, -1.0, -1.0),
        at(-1.0, 1.0, -1.0),
        at(-1.0, -1.0, 1.0),
    ];
    bumpy(5, 1.0, &arms)
}

/// Seven teeth, each with another one beside it, on a disc that slides along itself.
fn ratchet() -> Mesh {
    let mut teeth = ring(7, 0.0, 0.0, 0.35, 0.15);
    teeth.extend(ring(7, 0.35, 0.3, 0.3, 0.2));
    bumpy(6, 0.45, &teeth)
}

/// Three teeth above, turned against three below.
fn twisted() -> Mesh {
    let mut teeth = ring(3, 0.3, 0.15, 0.5, 0.25);
    teeth.extend(ring(3, -0.3, -0.15, 0.5, 0.25));
    bumpy(5, 0.7, &teeth)
}

#[test]
fn groups_of_the_whole_are_found_through_a_warp() {
    let star = ring(5, 0.0, 0.0, 0.6, 0.3);
    let mut above = star.clone();
    above.push((Vector::z(), 0.3, 0.4));
    for (name, mesh) in [
        ("C5v", bumpy(5, 0.5, &above)),
        ("Td", tetrapod()),
        ("D3", twisted()),
    ] {
        assert_eq!(group(&warped(&mesh)).as_deref(), Some(name));
    }
}

/// What is round about an axis, or about none, has no turn of its own.
#[test]
fn round_shapes_have_no_turns_of_their_own() {
    let potato = [
        (Vector::new(0.8, 0.6, 0.0), 0.25, 0.7),
        (Vector::new(-0.36, 0.48, 0.8), 0.2, 0.5),
        (Vector::new(0.1, -0.7, -0.7).normalize(), 0.3, 0.6),
    ];
    let pot = [(Vector::z(), 0.5, 0.5), (-Vector::z(), 0.2, 0.9)];
    for mesh in [bumpy(5, 1.0, &potato), bumpy(5, 0.8, &pot)] {
        let found = detected(&warped(&mesh));
        let turns = found.detection.groups.iter().filter(|g| g.order > 4);
        let names: Vec<&str> = turns.map(|g| g.name.as_str()).collect();
        assert!(names.is_empty(), "{names:?}");
    }
}

/// The whole is made exact under all of its group, not bent to a mirror of a part.
#[test]
fn a_warped_ratchet_is_made_exact() {
    let mesh = warped(&ratchet());
    let done = symmetrize(&mesh, &Params::default(), &mut Context::new(3)).expect("a run");
    let goals = done.report.steps.iter().find_map(|step| match step {
        Step::Orbits { goals, .. } => Some(goals),
        _ => None,
    });
    let met = goals.and_then(|g| g.iter().find(|g| g.name == "C7"));
    let [before, after] = met.expect("C7 is made exact").residual;
    assert!(after < 0.125 * before, "{before} -> {after}");
}
