//! Shapes that slide along themselves in known ways.

use std::f64::consts::TAU;

use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::Mesh;

use crate::common::union;

/// A grid of `rows` x `columns` quads over x(u, v), u and v from 0 to 1; closed in v where the ends
/// meet.
pub fn grid(rows: u32, columns: u32, x: impl Fn(f64, f64) -> Vector) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=rows {
        for j in 0..=columns {
            let (u, v) = (
                f64::from(i) / f64::from(rows),
                f64::from(j) / f64::from(columns),
            );
            mesh.positions.push(Point::from(x(u, v)));
        }
    }
    let at = |i: u32, j: u32| i * (columns + 1) + j;
    for i in 0..rows {
        for j in 0..columns {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.polygons.push(&quad);
        }
    }
    mesh
}

/// The profile (r, z) turned about the z axis, each of its straight pieces cut into `rows`.
pub fn turned(profile: &[[f64; 2]], rows: u32) -> Mesh {
    let pieces = profile.windows(2).map(|ends| {
        let [a, b] = [ends[0], ends[1]];
        grid(rows, 72, |u, v| {
            let (r, z) = (a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1]));
            let (sin, cos) = (TAU * v).sin_cos();
            Vector::new(r * cos, r * sin, z)
        })
    });
    pieces.reduce(|a, b| union(&a, &b)).expect("two points")
}

/// The profile (x, y), a loop, drawn along z from 0 to `height`, without lids.
pub fn drawn(profile: &[[f64; 2]], height: f64) -> Mesh {
    let sides = (0..profile.len()).map(|k| {
        let (a, b) = (profile[k], profile[(k + 1) % profile.len()]);
        grid(10, 20, |u, v| {
            Vector::new(
                a[0] + u * (b[0] - a[0]),
                a[1] + u * (b[1] - a[1]),
                v * height,
            )
        })
    });
    sides.reduce(|a, b| union(&a, &b)).expect("a profile")
}

/// A rectangle at the height z that faces up; down where an interval runs backwards.
pub fn rectangle(x: [f64; 2], y: [f64; 2], z: f64) -> Mesh {
    grid(14, 14, |u, v| {
        Vector::new(x[0] + u * (x[1] - x[0]), y[0] + v * (y[1] - y[0]), z)
    })
}

/// A tube of radius `r` about the curve.
pub fn tube(r: f64, rows: u32, curve: impl Fn(f64) -> Vector) -> Mesh {
    grid(rows, 20, |u, v| {
        let along = (curve(u + 1e-5) - curve(u - 1e-5)).normalize();
        let side = along.cross(&Vector::z()).normalize();
        let (sin, cos) = (TAU * v).sin_cos();
        curve(u) + r * (cos * side + sin * side.cross(&along))
    })
}

/// The mesh stretched along the axes.
pub fn stretched(mesh: &Mesh, by: [f64; 3]) -> Mesh {
    let mut other = mesh.clone();
    for p in &mut other.positions {
        *p = Point::new(p.x * by[0], p.y * by[1], p.z * by[2]);
    }
    other
}

/// A cylinder with lids.
pub fn tin(radius: f64, height: f64) -> Mesh {
    turned(
        &[[0.0, 0.0], [radius, 0.0], [radius, height], [0.0, height]],
        12,
    )
}
