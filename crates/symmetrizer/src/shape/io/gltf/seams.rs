//! Values per corner: glTF has values per vertex only, so a vertex whose corners differ is split.

use std::cmp::Ordering;

use crate::shape::document::{Layer, NO_ROW, Values};
use crate::shape::mesh::Mesh;

/// The vertices after splitting. Those of one vertex follow each other, and no others come between.
pub(super) struct Seams {
    /// The vertex that each of them was.
    pub source: Vec<u32>,
    /// A corner of each, or [`NO_ROW`] for a vertex that no face uses.
    pub corner: Vec<u32>,
    /// The vertex of each corner.
    pub corners: Vec<u32>,
    /// How many vertices were split.
    pub split: usize,
}

impl Seams {
    /// Splits the vertices of `mesh` where the values of `layers`, which are per corner, differ.
    pub fn new(mesh: &Mesh, layers: &[&Layer]) -> Self {
        let corners: Vec<u32> = mesh.polygons.iter().flatten().copied().collect();
        let count = mesh.positions.len();
        let rows: Vec<Vec<u32>> = layers
            .iter()
            .map(|l| rows(&l.values, corners.len()))
            .collect();
        if rows.is_empty() {
            return Self {
                source: (0..count as u32).collect(),
                corner: vec![NO_ROW; count],
                corners,
                split: 0,
            };
        }
        let key = |c: u32| rows.iter().map(move |r| r[c as usize]);
        let vertex = |c: u32| corners[c as usize];
        let by_value = |a: &u32, b: &u32| vertex(*a).cmp(&vertex(*b)).then(key(*a).cmp(key(*b)));
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        order.sort_by(by_value);
        let mut alike = order
            .chunk_by(|a, b| by_value(a, b) == Ordering::Equal)
            .peekable();
        let mut seams = Self {
            source: Vec::with_capacity(count),
            corner: Vec::with_capacity(count),
            corners: vec![0; corners.len()],
            split: 0,
        };
        for v in 0..count as u32 {
            let first = seams.source.len();
            while let Some(of_vertex) = alike.next_if(|c| vertex(c[0]) == v) {
                seams.add(v, of_vertex);
            }
            match seams.source.len() - first {
                0 => seams.add(v, &[]),
                1 => {}
                _ => seams.split += 1,
            }
        }
        seams
    }

    fn add(&mut self, vertex: u32, corners: &[u32]) {
        let new = self.source.len() as u32;
        corners.iter().for_each(|&c| self.corners[c as usize] = new);
        self.source.push(vertex);
        self.corner.push(corners.first().copied().unwrap_or(NO_ROW));
    }
}

/// A number for each of `count` corners, the same where the values are the same.
fn rows(values: &Values, count: usize) -> Vec<u32> {
    let (Some(width), Some(numbers)) = (values.width(), values.numbers()) else {
        return vec![NO_ROW; count];
    };
    let bits = |row: u32| {
        let start = row as usize * width;
        (start..start + width).map(|k| numbers.get(k).to_bits())
    };
    let total = numbers.len() / width.max(1);
    let mut order: Vec<u32> = (0..total as u32).collect();
    order.sort_by(|&a, &b| bits(a).cmp(bits(b)));
    let mut first = vec![0; total];
    for alike in order.chunk_by(|&a, &b| bits(a).eq(bits(b))) {
        alike.iter().for_each(|&row| first[row as usize] = alike[0]);
    }
    let row = |c| values.row(c).map_or(NO_ROW, |row| first[row]);
    (0..count).map(row).collect()
}
