//! The part of a surface that a mirror holds for.

use rayon::prelude::*;

use crate::geom::PointIndex;
use crate::patch::Symmetry;
use crate::sample::Samples;
use crate::shape::Surface;

/// How often membership is averaged among neighbours.
const AVERAGED: usize = 2;
/// Averaged membership below which a place is left alone, and above which it may be changed as the rest.
const BETWEEN: [f64; 2] = [0.4, 0.7];

/// How far each vertex of `surface` may be changed, 0 to 1: entirely within the patch of `symmetry`, not at all away
/// from it, and by degrees between.
pub fn part(surface: &Surface, samples: &Samples, symmetry: &Symmetry) -> Vec<f64> {
    let member = symmetry.membership(samples.list.len());
    let mut share: Vec<f64> = member.iter().map(|&m| f64::from(u8::from(m))).collect();
    for _ in 0..AVERAGED {
        let mean = |(value, near): (&f64, &Vec<u32>)| {
            let sum: f64 = near.iter().map(|&i| share[i as usize]).sum();
            (value + sum) / (1 + near.len()) as f64
        };
        share = share.iter().zip(&samples.neighbors).map(mean).collect();
    }
    let places: Vec<[f64; 3]> = samples
        .list
        .iter()
        .map(|s| surface.point(&s.at).coords.into())
        .collect();
    let index = PointIndex::new(&places);
    let [low, high] = BETWEEN;
    let vertices = surface.positions.par_iter().zip(&surface.vertex_normals);
    let at = |(x, normal): (&crate::geom::Point, &crate::geom::Vector)| {
        let near = index.nearest_n(&x.coords.into(), NEAR);
        let facing =
            |&&(s, _): &&(u32, f64)| surface.normal(&samples.list[s as usize].at).dot(normal) > 0.0;
        let nearest = near.iter().find(facing).or_else(|| near.first());
        let share = nearest.map_or(0.0, |&(s, _)| share[s as usize]);
        ((share - low) / (high - low)).clamp(0.0, 1.0)
    };
    vertices.map(at).collect()
}

/// Samples among which the nearest that faces a vertex's way is looked for.
const NEAR: usize = 6;
