//! Symmetry fields and straightening: bends are found and undone, what is straight stays.
#![allow(clippy::print_stdout)]
mod common;

use common::{load, model, working};
use symmetrizer::detect::{DetectParams, Detection, detect};
use symmetrizer::field::grow::Land;
use symmetrizer::field::{Reach, SymmetryField, find};
use symmetrizer::geom::{Matrix3, Point, Vector, nearest_orthogonal};
use symmetrizer::shape::{ClosestPoint, Surface};
use symmetrizer::straighten::straighten;
use symmetrizer::{Context, Mesh};

struct Bent {
    surface: Surface,
    found: Detection,
    reach: Reach,
    field: SymmetryField,
}

fn bent(mesh: &Mesh) -> Bent {
    let surface = working(mesh).0.surface;
    let params = DetectParams::default().mirrors_only();
    let found = detect(&surface, &params, &mut Context::new(0)).expect("a detection");
    let reach = Reach::new(&found.samples, 0.12);
    let closest = ClosestPoint::new(&surface);
    let land = Land::new(&surface, &closest, &found.samples, &reach);
    let mirrors: Vec<_> = found.symmetries.iter().map(|s| s.q_from_p).collect();
    Bent {
        field: find(&land, &mirrors),
        surface,
        found,
        reach,
    }
}

impl Bent {
    fn straight(&self) -> Vec<Point> {
        let done = straighten(&self.surface, &self.found.samples, &self.reach, &self.field);
        done.expect("straightened").positions
    }
}

/// rms distance after the best motion, mirrored or not, fraction of L.
fn apart(x: &[Point], y: &[Point]) -> f64 {
    let n = x.len() as f64;
    let mean = |p: &[Point]| p.iter().map(|p| p.coords).sum::<Vector>() / n;
    let (mx, my) = (mean(x), mean(y));
    let pairs = || x.iter().zip(y).map(|(p, q)| (p.coords - mx, q.coords - my));
    let moment: Matrix3 = pairs().map(|(p, q)| q * p.transpose()).sum();
    let missed = [false, true].map(|mirrored| {
        let r = nearest_orthogonal(&moment, mirrored);
        pairs()
            .map(|(p, q)| (r * p - q).norm_squared())
            .sum::<f64>()
    });
    (missed[0].min(missed[1]) / n).sqrt()
}

#[test]
fn what_is_straight_stays() {
    let Some(path) = model("truth/spot_exact.obj") else {
        return;
    };
    let spot = bent(&load(&path));
    println!("cover {}", spot.field.cover());
    assert!(spot.field.cover() > 0.99);
    let moved = apart(&spot.straight(), &spot.surface.positions);
    println!("moved {moved:.2e}");
    assert!(moved < 5e-4, "{moved}");
}

#[test]
fn a_bent_cow_is_straightened() {
    let Some(path) = model("truth/cow_bend45.off") else {
        return;
    };
    let Some(truth) = model("truth/cow_bend45.truth.json") else {
        return;
    };
    let cow = bent(&load(&path));
    let text = std::fs::read_to_string(truth).expect("readable");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let rest: Vec<[f64; 3]> = serde_json::from_value(truth["rest"].clone()).expect("a rest shape");
    let rest: Vec<Point> = rest.into_iter().map(Point::from).collect();
    // Both in units of their own size: the bend leaves the mean square distance of neighbours.
    let size = |x: &[Point]| {
        let edges = cow.surface.sides();
        let length = |[u, v]: [u32; 2]| (x[u as usize] - x[v as usize]).norm();
        edges.into_iter().map(length).sum::<f64>()
    };
    let scale = size(&cow.surface.positions) / size(&rest);
    let rest: Vec<Point> = rest.iter().map(|x| x * scale).collect();
    let before = apart(&cow.surface.positions, &rest);
    let after = apart(&cow.straight(), &rest);
    println!("cover {}: {before:.4} -> {after:.4}", cow.field.cover());
    assert!(after < 0.12 * before, "{before} -> {after}");
}
