//! What the test files share: models on disk, generated shapes, motions.
#![allow(dead_code)] // No test file uses all of it.

pub mod warped;

use std::path::{Path, PathBuf};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{Mesh, io};

/// The file or folder `relative` of the test data: below `SYMMETRIZER_DATA`, or below `shared/data`
/// beside the checkout. `None`, with a loud line, where there is none: the data is not in the
/// repository.
pub fn data(relative: &str) -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let root = std::env::var_os("SYMMETRIZER_DATA").map_or(beside, PathBuf::from);
    let path = root.join(relative);
    if path.exists() {
        return Some(path);
    }
    skip(&path);
    None
}

#[allow(clippy::print_stderr)] // A test that does nothing must not look like one that passed.
fn skip(path: &Path) {
    eprintln!("SKIPPED: no test data at {}", path.display());
}

/// The mesh in a file that is known to be readable.
pub fn load(path: &Path) -> Mesh {
    io::read(path).expect("a readable file").mesh
}

/// The path of a model of the test data, if it is there.
pub fn model(name: &str) -> Option<PathBuf> {
    data(name)
}

/// The working surface of a mesh and its bounding-box diagonal in working units.
pub fn working(mesh: &Mesh) -> (Working, f64) {
    let working = Working::new(mesh).expect("a usable mesh");
    let diagonal = mesh.diagonal() / working.normalization.scale;
    (working, diagonal)
}

/// x -> scale R x + shift, R about `omega`.
pub fn placed(mesh: &Mesh, omega: Vector, scale: f64, shift: Vector) -> Mesh {
    let r = exp_rotation(&omega);
    let mut moved = mesh.clone();
    for p in &mut moved.positions {
        *p = Point::from(r * p.coords * scale + shift);
    }
    moved
}

/// A sphere of unit radius about the origin, an octahedron divided `levels` times.
pub fn sphere(levels: u32) -> Mesh {
    let n = 1 << levels;
    let mut mesh = Mesh::default();
    let corners = [
        Vector::x(),
        Vector::y(),
        Vector::z(),
        -Vector::x(),
        -Vector::y(),
        -Vector::z(),
    ];
    let faces = [
        [0, 1, 2],
        [1, 3, 2],
        [3, 4, 2],
        [4, 0, 2],
        [1, 0, 5],
        [3, 1, 5],
        [4, 3, 5],
        [0, 4, 5],
    ];
    for [a, b, c] in faces {
        let base = mesh.positions.len() as u32;
        let at = |i: u32, j: u32| base + i * (2 * n + 3 - i) / 2 + j;
        for i in 0..=n {
            for j in 0..=(n - i) {
                // Sums of the same integers in either face, so that the seams weld exactly.
                let v = corners[a] * f64::from(n - i - j)
                    + corners[b] * f64::from(i)
                    + corners[c] * f64::from(j);
                mesh.positions.push(Point::from(v.normalize()));
            }
        }
        for i in 0..n {
            for j in 0..(n - i) {
                mesh.polygons.push(&[at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 1 < n {
                    mesh.polygons
                        .push(&[at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
    }
    mesh
}

/// The unit square in z = 0, `n` x `n` quads, cut alternately so that it is symmetric.
pub fn planar_grid(n: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for j in 0..=n {
        for i in 0..=n {
            let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            mesh.positions.push(Point::new(x, y, 0.0));
        }
    }
    let at = |i: u32, j: u32| j * (n + 1) + i;
    for j in 0..n {
        for i in 0..n {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.polygons.push(&quad);
        }
    }
    mesh
}

/// Both meshes as one.
pub fn union(a: &Mesh, b: &Mesh) -> Mesh {
    let mut both = a.clone();
    let base = a.positions.len() as u32;
    both.positions.extend_from_slice(&b.positions);
    for polygon in b.polygons.iter() {
        let corners: Vec<u32> = polygon.iter().map(|v| v + base).collect();
        both.polygons.push(&corners);
    }
    both
}

/// The mesh with normally distributed noise of deviation `sigma` in each coordinate.
pub fn noisy(mesh: &Mesh, sigma: f64, seed: u64) -> Mesh {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut moved = mesh.clone();
    // The sum of twelve uniform numbers has variance 1.
    let mut normal = || (0..12).map(|_| rng.random::<f64>()).sum::<f64>() - 6.0;
    for p in &mut moved.positions {
        *p += sigma * Vector::new(normal(), normal(), normal());
    }
    moved
}
