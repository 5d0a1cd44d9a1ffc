//! Drawings whose outlines are sampled anew at random and turned come out as straight as they are.
#![allow(clippy::print_stdout)]
mod common;

use common::model;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use symmetrizer::drawing::{Format, Reading, decode, read};
use symmetrizer::geom::Point;
use symmetrizer::{Context, Drawing, Outcome, Params, symmetrize_drawing};

/// So many points along a closed ring, unevenly.
fn sampled(ring: &[Point], count: usize, rng: &mut Pcg64) -> Vec<Point> {
    let next = ring.iter().cycle().skip(1);
    let mut starts = vec![0.0];
    for (a, b) in ring.iter().zip(next) {
        starts.push(starts[starts.len() - 1] + (b - a).norm());
    }
    let length = starts[ring.len()];
    let at = |along: f64| {
        let k = starts.partition_point(|s| *s <= along).clamp(1, ring.len()) - 1;
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        let edge = starts[k + 1] - starts[k];
        a + (b - a) * ((along - starts[k]) / edge.max(f64::MIN_POSITIVE))
    };
    let mut place = |k: usize| {
        let k = k as f64 + rng.random_range(-0.4..0.4);
        at((k / count as f64 * length).rem_euclid(length))
    };
    (0..count).map(&mut place).collect()
}

/// The rings of a drawing with some `count` points in all, turned.
fn anew(drawing: &Drawing, count: usize, seed: u64) -> Drawing {
    let mut rng = Pcg64::seed_from_u64(seed);
    let (sin, cos) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
    let rings = &drawing.outline().rings;
    let all: usize = rings.iter().map(|r| r.points.len()).sum();
    let mut ring = |points: &[Point]| -> Vec<[f64; 2]> {
        let share = count * points.len() / all;
        let points = sampled(points, share.max(8), &mut rng);
        let turned = |x: &Point| [cos * x.x - sin * x.y, sin * x.x + cos * x.y];
        points.iter().map(turned).collect()
    };
    let rings: Vec<Vec<[f64; 2]>> = rings.iter().map(|r| ring(&r.points)).collect();
    let text = serde_json::json!({ "rings": rings }).to_string();
    decode(text.into_bytes(), Format::Json, &Reading::default()).expect("a drawing")
}

#[test]
fn curled_tails_uncurl_however_they_are_sampled() {
    for name in ["2d/gecko_gi.svg", "2d/lizard_boitel.svg"] {
        let Some(path) = model(name) else {
            return;
        };
        let drawing = read(&path, &Reading::default()).expect("a drawing");
        for seed in 0..4 {
            let sampled = anew(&drawing, 600 + 200 * seed as usize, seed);
            let made = symmetrize_drawing(&sampled, &Params::default(), &mut Context::new(0));
            let job = made.expect("a run").job;
            assert_eq!(job.outcome, Outcome::Converged, "{name} {seed}");
            let result = job.report.result.as_ref().expect("a result");
            let (mean, crossed) = (result.asymmetry.mean, result.distortion.new_crossings);
            println!("{name} {seed}: asymmetry {mean:.4} % of D, {crossed} crossings");
            assert!(
                mean < 0.05 && crossed == 0,
                "{name} {seed}: {mean}, {crossed}"
            );
        }
    }
}
