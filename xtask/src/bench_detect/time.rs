//! How long detection takes, by what it looks for and by the number of triangles.

use std::path::Path;
use std::time::Instant;

use serde_json::json;
use symmetrizer::detect::Wanted;
use symmetrizer::geom::Point;
use symmetrizer::shape::io;
use symmetrizer::{Context, Mesh, Params, Result, detect_in};

use crate::tables::{Section, Table, median, number};
use crate::terminal;

/// Runs of which the median counts.
const RUNS: usize = 5;

/// Times the bunny is divided, each time into four times as many triangles.
const DIVISIONS: usize = 2;

/// Times of detection in the model of `path`, file reading not included.
///
/// # Errors
/// A file that is missing or damaged; those of detection.
pub fn section(path: &Path, params: &Params) -> Result<Section> {
    let mesh = io::read(path)?.mesh;
    let mut kinds = Table::new(["bunny", "triangles", "seconds"]);
    let mut by_kind = Vec::new();
    let mirrors = Params {
        detect: Wanted::mirrors(),
        ..params.clone()
    };
    for (name, params) in [("mirrors", &mirrors), ("all kinds", params)] {
        let seconds = time(&mesh, params)?;
        by_kind.push(json!({ "looked_for": name, "seconds": seconds }));
        let count = mesh.triangles().count().to_string();
        kinds.row([name.into(), count, number(Some(seconds), 3)]);
    }
    let (growth, figures) = growth(mesh, params)?;
    Ok(Section {
        title: format!("time of detection, median of {RUNS}"),
        tables: vec![kinds, growth],
        notes: Vec::new(),
        verdicts: Vec::new(),
        figures: json!({ "kinds": by_kind, "growth": figures }),
    })
}

/// Times on ever finer copies of `mesh`, also by n log n.
fn growth(mut mesh: Mesh, params: &Params) -> Result<(Table, Vec<serde_json::Value>)> {
    let mut table = Table::new(["divided", "triangles", "seconds", "ns per n log2 n"]);
    let mut figures = Vec::new();
    for division in 0..=DIVISIONS {
        if division > 0 {
            mesh = divided(&mesh);
        }
        let n = mesh.triangles().count();
        let seconds = time(&mesh, params)?;
        let per = 1e9 * seconds / (n as f64 * (n as f64).log2());
        terminal::note(&format!("{n} triangles  {seconds:.2} s"));
        table.row([
            division.to_string(),
            n.to_string(),
            number(Some(seconds), 3),
            number(Some(per), 1),
        ]);
        figures.push(json!({ "triangles": n, "seconds": seconds, "ns_per_n_log_n": per }));
    }
    Ok((table, figures))
}

/// The median time of detection, seconds.
fn time(mesh: &Mesh, params: &Params) -> Result<f64> {
    let mut seconds = Vec::with_capacity(RUNS);
    for _ in 0..RUNS {
        let start = Instant::now();
        detect_in(mesh, params, &mut Context::new(0))?;
        seconds.push(Some(start.elapsed().as_secs_f64()));
    }
    Ok(median(seconds.into_iter()).unwrap_or_default())
}

/// `mesh` with each triangle divided into four at the midpoints of its sides.
pub fn divided(mesh: &Mesh) -> Mesh {
    let triangles: Vec<[u32; 3]> = mesh.triangles().map(|(t, _)| t).collect();
    let sorted = |[u, v]: [u32; 2]| [u.min(v), u.max(v)];
    let sides = |[a, b, c]: [u32; 3]| [[a, b], [b, c], [c, a]].map(sorted);
    let mut edges: Vec<[u32; 2]> = triangles.iter().flat_map(|&t| sides(t)).collect();
    edges.sort_unstable();
    edges.dedup();
    let mut positions = mesh.positions.clone();
    let first = positions.len();
    let middle = |&[u, v]: &[u32; 2]| {
        let [u, v] = [u, v].map(|i| mesh.positions[i as usize].coords);
        Point::from(0.5 * (u + v))
    };
    positions.extend(edges.iter().map(middle));
    let at = |edge: [u32; 2]| (first + edges.partition_point(|e| *e < edge)) as u32;
    let four = |t: [u32; 3]| {
        let [ab, bc, ca] = sides(t).map(at);
        let [a, b, c] = t;
        [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
    };
    let fine = triangles.into_iter().flat_map(four).collect();
    Mesh::from_triangles(positions, fine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn division_shares_midpoints() {
        let corners = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
        ];
        let square =
            Mesh::from_triangles(corners.map(Point::from).into(), vec![[0, 1, 2], [0, 2, 3]]);
        let fine = divided(&square);
        assert_eq!(fine.positions.len(), 4 + 5);
        assert_eq!(fine.triangles().count(), 8);
        assert_eq!(fine.diagonal(), square.diagonal());
    }
}
