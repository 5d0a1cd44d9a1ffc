//! How long reading shape files takes: fastest and median of several times, in milliseconds.
//!
//! `cargo run --release --example read -- FILE...`; `benches/peers.py` puts other readers beside it.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use symmetrizer::shape::io;

/// Times that a file is read.
const TIMES: usize = 7;

fn main() -> symmetrizer::Result<()> {
    for path in std::env::args().skip(1) {
        let mut times = Vec::with_capacity(TIMES);
        let mut faces = io::read(path.as_ref())?.mesh.polygons.len();
        for _ in 0..TIMES {
            let begun = Instant::now();
            faces = faces.min(io::read(path.as_ref())?.mesh.polygons.len());
            times.push(1e3 * begun.elapsed().as_secs_f64());
        }
        times.sort_by(f64::total_cmp);
        println!("{path}\t{faces}\t{:.2}\t{:.2}", times[0], times[TIMES / 2]);
    }
    Ok(())
}
