//! Reading and writing files in memory: the Stanford bunny (69,451 triangles) as OBJ and as binary
//! PLY, a grid of 1,000,000 triangles as binary PLY.
//!
//! `cargo bench --workspace --bench io`. The bunny is not in the repository: see `SYMMETRIZER_DATA`
//! in CONTRIBUTING.md.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion};
use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::mesh::Mesh;

#[path = "../tests/common/mod.rs"]
mod common;

fn main() {
    let mut c = Criterion::default()
        .sample_size(10)
        .measurement_time(Duration::from_secs(3))
        .configure_from_args();
    match common::data("3d/bunny.obj") {
        Some(path) => {
            let bytes = std::fs::read(&path).expect("the bunny");
            let bunny = read(bytes.clone(), Format::Obj);
            file(&mut c, "bunny", bytes, Format::Obj);
            file(&mut c, "bunny", written(&bunny, Format::Ply), Format::Ply);
        }
        None => eprintln!("NOT MEASURED: the bunny is missing"),
    }
    let grid = grid();
    file(&mut c, "grid", written(&grid, Format::Ply), Format::Ply);
    c.final_summary();
}

fn read(bytes: Vec<u8>, format: Format) -> Document {
    io::decode(bytes, format).expect("a good file")
}

fn written(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, format, &mut bytes).expect("a good document");
    bytes
}

/// Measures reading a file and writing it again.
fn file(c: &mut Criterion, shape: &str, bytes: Vec<u8>, format: Format) {
    let name = format.extension();
    let document = read(bytes.clone(), format);
    let id = BenchmarkId::new(shape, format!("read {name}"));
    c.bench_with_input(id, &bytes, |b, bytes| {
        let copy = || bytes.clone();
        b.iter_batched(copy, |bytes| read(bytes, format), BatchSize::LargeInput);
    });
    let id = BenchmarkId::new(shape, format!("write {name}"));
    c.bench_with_input(id, &document, |b, document| {
        b.iter(|| black_box(written(document, format)));
    });
}

/// A wavy square of 1,000,000 triangles whose file has single precision.
fn grid() -> Document {
    const CELLS: u32 = 1000;
    const TRIANGLES: u32 = 1_000_000;
    let rows = TRIANGLES / (2 * CELLS);
    let point = |i: u32| {
        let (x, y) = (f64::from(i % (CELLS + 1)), f64::from(i / (CELLS + 1)));
        let z = (0.1 * x).sin() * (0.1 * y).cos();
        Point::new(x, y, f64::from(z as f32))
    };
    let positions = (0..(CELLS + 1) * (rows + 1)).map(point).collect();
    let cells = (0..CELLS * rows).map(|c| (c / CELLS) * (CELLS + 1) + c % CELLS);
    let triangles = cells.flat_map(|a| {
        let above = a + CELLS + 1;
        [[a, a + 1, above], [a + 1, above + 1, above]]
    });
    let mesh = Mesh::from_triangles(positions, triangles.collect());
    // As a program that works in single precision writes it.
    let bytes = written(&mesh.into(), Format::Ply);
    read(bytes, Format::Ply)
}
