//! Area-uniform sampling.
mod common;

use common::{planar_grid, sphere, working};
use symmetrizer::Context;
use symmetrizer::geom::Point;
use symmetrizer::sample::uniform::uniform;

#[test]
fn every_face_gets_its_share_to_within_one_sample() {
    // Faces of very different sizes: a stretched sphere.
    let mut mesh = sphere(3);
    for p in &mut mesh.positions {
        p.x = p.x.powi(3) * 5.0;
    }
    let s = working(&mesh).0.surface;
    let count = 10_000;
    let points = uniform(&s, count, &mut Context::new(3).rng("test"));
    assert_eq!(points.len(), count);
    let mut got = vec![0.0; s.triangles.len()];
    for p in &points {
        got[p.face as usize] += 1.0;
        assert!(p.bary.iter().all(|&b| b >= 0.0));
        assert!((p.bary.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
    let (mut seen, mut share) = (0.0, 0.0);
    for (n, area) in got.iter().zip(&s.face_areas) {
        seen += n;
        share += area / s.area() * count as f64;
        assert!(f64::abs(seen - share) <= 1.0 + 1e-6, "{seen} for {share}");
    }
}

#[test]
fn points_are_uniform_inside_a_triangle() {
    let mesh = planar_grid(1);
    let s = working(&mesh).0.surface;
    let points = uniform(&s, 20_000, &mut Context::new(3).rng("test"));
    let at: Vec<Point> = points.iter().map(|p| s.point(p)).collect();
    let n = at.len() as f64;
    // The side of the square in working units, from L = 4 rms radius, rms radius = side / sqrt 6.
    let side = 6.0_f64.sqrt() / 4.0;
    let mean_x = at.iter().map(|p| p.x).sum::<f64>() / n;
    let mean_xx = at.iter().map(|p| p.x * p.x).sum::<f64>() / n;
    assert!(mean_x.abs() < 0.01 * side, "{mean_x}");
    assert!(
        (mean_xx / (side * side / 12.0) - 1.0).abs() < 0.03,
        "{mean_xx}"
    );
}

#[test]
fn seeds_decide() {
    let s = working(&sphere(2)).0.surface;
    let draw = |seed| uniform(&s, 50, &mut Context::new(seed).rng("test"));
    assert_eq!(draw(1), draw(1));
    assert_ne!(draw(1), draw(2));
    let flat = s.with_positions(vec![Point::origin(); s.positions.len()]);
    assert!(uniform(&flat, 5, &mut Context::new(1).rng("test")).is_empty());
}
