//! Asymmetry: exact shapes, known planes, invariance, threads.
mod common;

use common::{load, model, working};
use symmetrizer::Context;
use symmetrizer::apply::measure::asymmetry;

#[test]
fn probe() {
    for name in std::env::var("PROBE").unwrap_or_default().split(',') {
        let Some(path) = model(name) else { continue };
        let mesh = load(&path);
        let (w, d) = working(&mesh);
        let t = std::time::Instant::now();
        let a = asymmetry(&w.surface, d, &[], &Context::new(7)).unwrap();
        let n = a.plane.normal;
        println!("{name}: {} faces {:.3}s mean {:.4} rms {:.4} p95 {:.4} p99 {:.4} max {:.4} n {:.3} {:.3} {:.3} d {:.4} near {:?}", w.surface.triangles.len(), t.elapsed().as_secs_f64(), a.mean, a.rms, a.p95, a.p99, a.max, n.x, n.y, n.z, a.plane.offset, a.also_near.iter().map(|p| (p.mean, p.plane.normal.as_slice().to_vec())).collect::<Vec<_>>());
    }
}
