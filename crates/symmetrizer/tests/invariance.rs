//! The same symmetries wherever a shape is put, however large it is, whatever the seed, and however its
//! surface is divided into triangles.
#![allow(clippy::print_stdout)]
mod common;

use common::{data, load, placed};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use symmetrizer::detect::Wanted;
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::Mesh;
use symmetrizer::transform::Class;
use symmetrizer::{Context, Params, detect_in};

/// The same surface with some triangles divided at a random inner point.
fn divided(mesh: &Mesh, share: f64, seed: u64) -> Mesh {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut positions = mesh.positions.clone();
    let mut triangles = Vec::new();
    for (t, _) in mesh.triangles() {
        if !rng.random_bool(share) {
            triangles.push(t);
            continue;
        }
        let weights: [f64; 3] = std::array::from_fn(|_| rng.random_range(0.2..1.0));
        let total: f64 = weights.iter().sum();
        let corners = t.map(|i| mesh.positions[i as usize].coords);
        let inner: Vector = (0..3).map(|k| corners[k] * (weights[k] / total)).sum();
        let middle = positions.len() as u32;
        positions.push(Point::from(inner));
        let [a, b, c] = t;
        triangles.extend([[a, b, middle], [b, c, middle], [c, a, middle]]);
    }
    Mesh::from_triangles(positions, triangles)
}

/// Normal and a point of the planes of which the truth file says that they hold for a rigid part.
fn planes(truth: &serde_json::Value) -> Vec<(Vector, Vector)> {
    let vector = |v: &serde_json::Value| Vector::from_fn(|r, _| v[r].as_f64().expect("a number"));
    let clusters = truth["clusters"].as_array().expect("clusters");
    let rigid = clusters.iter().filter(|c| {
        let figure = |name: &str| c[name].as_f64().expect("a number");
        figure("vertex_fraction") >= 0.1 && figure("rms_rel_diag") <= 0.002
    });
    let plane = |c: &serde_json::Value| (vector(&c["normal"]).normalize(), vector(&c["point"]));
    rigid.map(plane).collect()
}

/// Largest errors of the planes of `name` after detection in a changed shape: degrees, fraction of D.
fn errors(name: &str, change: &Change) -> Option<(f64, f64)> {
    let path = data(name)?;
    let text = std::fs::read_to_string(path.with_extension("truth.json")).expect("a truth file");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let mesh = divided(&load(&path), change.share, change.seed);
    let mesh = placed(&mesh, change.omega, change.scale, change.shift);
    let params = Params {
        detect: Wanted::mirrors(),
        ..Params::default()
    };
    let found = detect_in(&mesh, &params, &mut Context::new(change.seed)).expect("detection");
    let turn = exp_rotation(&change.omega);
    let worst = planes(&truth).into_iter().map(|(normal, point)| {
        let normal = turn * normal;
        let point = change.scale * (turn * point) + change.shift;
        let symmetries = found.symmetries().iter();
        let mirrors = symmetries.filter(|s| s.class == Class::Mirror);
        let error = mirrors.map(|s| {
            let plane = s.plane();
            let off = plane.normal.cross(&normal).norm();
            let angle = off.atan2(plane.normal.dot(&normal).abs());
            let normalization = &found.working.normalization;
            let at = normalization.to_working(&Point::from(point));
            let offset = plane.signed_distance(&at).abs() * normalization.scale;
            (angle.to_degrees(), offset / mesh.diagonal())
        });
        error.fold((90.0, 1.0), |a, b| if b.0 < a.0 { b } else { a })
    });
    Some(worst.fold((0.0, 0.0), |a: (f64, f64), b| (a.0.max(b.0), a.1.max(b.1))))
}

#[derive(Debug)]
struct Change {
    omega: Vector,
    scale: f64,
    shift: Vector,
    seed: u64,
    share: f64,
}

fn changes() -> impl Strategy<Value = Change> {
    let turn = [-2.0..2.0, -2.0..2.0, -2.0..2.0_f64];
    let shift = [-9.0..9.0, -9.0..9.0, -9.0..9.0_f64];
    (turn, -3.0..3.0_f64, shift, 0..1000_u64, 0.0..0.5_f64).prop_map(
        |(omega, power, shift, seed, share)| {
            let scale = 10_f64.powf(power);
            Change {
                omega: omega.into(),
                scale,
                shift: Vector::from(shift) * scale,
                seed,
                share,
            }
        },
    )
}

proptest! {
    // The same cases each time: a test that everyone runs must not fail by chance.
    #![proptest_config(ProptestConfig {
        cases: 4,
        max_shrink_iters: 0,
        rng_seed: RngSeed::Fixed(14),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_mirror_stays_where_it_is(change in changes()) {
        let Some((degrees, offset)) = errors("truth/spot_exact.obj", &change) else { return Ok(()) };
        println!("exact: {degrees:.4} degrees, {:.4} % of D", 100.0 * offset);
        prop_assert!(degrees <= 0.2 && offset <= 0.001, "{degrees} degrees, {offset} of D");
    }

    #[test]
    fn a_head_and_a_body_keep_their_planes(change in changes()) {
        let Some((degrees, offset)) = errors("truth/spot_headturn30.obj", &change) else { return Ok(()) };
        println!("turned head: {degrees:.4} degrees, {:.4} % of D", 100.0 * offset);
        prop_assert!(degrees <= 0.3 && offset <= 0.001, "{degrees} degrees, {offset} of D");
    }
}

/// The one mirror of a body with a bent neck and tail is in doubt with some samples of it, and sure with others.
#[test]
fn a_mirror_in_doubt_is_looked_for_again() {
    let Some(path) = data("3d/diplodocus.off") else {
        return;
    };
    let mesh = load(&path);
    let params = Params {
        detect: Wanted::mirrors(),
        ..Params::default()
    };
    // In 17 of 108 such poses it is in doubt with the first samples, and so in these.
    for seed in [15, 24, 40, 48, 72_u8] {
        let omega = Vector::new(0.3, 0.7, 0.1) * f64::from(seed);
        let turned = placed(&mesh, omega, 1.0, Vector::zeros());
        let mut ctx = Context::new(u64::from(seed));
        let found = detect_in(&turned, &params, &mut ctx).expect("detection");
        let areas = found.symmetries().iter().map(|s| s.area_fraction);
        let largest = areas.fold(0.0, f64::max);
        println!("{seed}: {largest:.2}");
        assert!(largest > 0.5, "{seed}: {largest}");
    }
}
