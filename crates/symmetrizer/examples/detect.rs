//! Lists the mirrors of a mesh and of its parts:
//!
//! ```text
//! cargo run --release --example detect -- bunny.obj
//! ```
#![allow(clippy::print_stdout)]

use std::error::Error;

use symmetrizer::Context;
use symmetrizer::apply::measure::PlaneReport;
use symmetrizer::detect::{DetectParams, detect};
use symmetrizer::shape::io;
use symmetrizer::shape::working::Working;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("usage: detect MESH")?;
    // The document: vertices and faces in the file's own order and units.
    let mesh = io::read(path.as_ref())?.mesh;
    // What the stages run on: triangles, centred, in fractions of the scale L.
    let working = Working::new(&mesh)?;
    let mut ctx = Context::new(7);
    let mirrors = DetectParams::default().mirrors_only();
    let found = detect(&working.surface, &mirrors, &mut ctx)?;
    for s in &found.symmetries {
        let plane = PlaneReport::new(&s.plane(), &working.normalization);
        let [x, y, z] = plane.normal;
        println!(
            "mirror {}: normal ({x:.4}, {y:.4}, {z:.4}), offset {:.6}, height {:.2}, \
             {:.0} % of the surface, rms {:.3} % of L",
            s.id,
            plane.offset,
            s.height,
            100.0 * s.area_fraction,
            100.0 * s.rms,
        );
    }
    for r in &found.refused {
        println!("no symmetry (height {:.2}): {}", r.height, r.reason);
    }
    Ok(())
}
