//! Helpers of the tests of `apply::measure`: models on disk, generated shapes, motions.
#![allow(dead_code, clippy::print_stderr)]

use std::path::PathBuf;

use symmetrizer::geom::{Point, Vector, exp_rotation};
use symmetrizer::shape::Mesh;
use symmetrizer::shape::surface::Working;

/// A mesh of an OBJ (`v`, `f`) or OFF file.
pub fn load(path: &std::path::Path) -> Mesh {
    let text = std::fs::read_to_string(path).expect("a readable file");
    if path.extension().is_some_and(|e| e == "off") {
        parse_off(&text)
    } else {
        parse_obj(&text)
    }
}

fn parse_obj(text: &str) -> Mesh {
    let mut mesh = Mesh::default();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => mesh.positions.push(point(words)),
            Some("f") => {
                let index = |w: &str| w.split('/').next().unwrap().parse::<u32>().unwrap() - 1;
                mesh.polygons.push(&words.map(index).collect::<Vec<_>>());
            }
            _ => {}
        }
    }
    mesh
}

fn parse_off(text: &str) -> Mesh {
    let mut lines = text
        .lines()
        .map(|l| l.split('#').next().unwrap().trim())
        .filter(|l| !l.is_empty())
        .skip(1);
    let counts: Vec<usize> = lines
        .next()
        .unwrap()
        .split_whitespace()
        .map(|w| w.parse().unwrap())
        .collect();
    let mut mesh = Mesh::default();
    for line in lines.by_ref().take(counts[0]) {
        mesh.positions.push(point(line.split_whitespace()));
    }
    for line in lines.take(counts[1]) {
        let corners: Vec<u32> = line
            .split_whitespace()
            .map(|w| w.parse().unwrap())
            .collect();
        mesh.polygons.push(&corners[1..=corners[0] as usize]);
    }
    mesh
}

fn point<'a>(words: impl Iterator<Item = &'a str>) -> Point {
    let c: Vec<f64> = words.take(3).map(|w| w.parse().unwrap()).collect();
    Point::new(c[0], c[1], c[2])
}

/// The path of a model under the shared data, if it is there; says so loudly if not.
pub fn model(name: &str) -> Option<PathBuf> {
    let root = std::env::var_os("SYMMETRIZER_DATA").map_or_else(
        || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
        PathBuf::from,
    );
    let path = root.join(name);
    if path.exists() {
        return Some(path);
    }
    eprintln!(
        "SKIPPED: {} is not there; set SYMMETRIZER_DATA",
        path.display()
    );
    None
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
