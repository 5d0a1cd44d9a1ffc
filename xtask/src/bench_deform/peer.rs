//! Another program on the same work.

use std::path::Path;
use std::process::Command;

use serde::Deserialize;
use symmetrizer::{Error, Result};

use super::work::Work;
use crate::tables::number;

/// The peer's methods: as rigid as possible in three variants.
const METHODS: [&str; 3] = ["arap", "spokes_and_rims", "sre_arap"];

/// One line that the peer prints.
#[derive(Deserialize)]
struct Line {
    task: String,
    tool: String,
    cpu_min: f64,
}

/// A row for each of the peer's methods: set-up with factorisation, ten iterations.
///
/// # Errors
/// A program that does not start.
pub fn rows(program: &Path, work: &Work, runs: usize) -> Result<Vec<[String; 7]>> {
    let folder = std::env::temp_dir();
    let [mesh, constraints] = work.write(&folder)?;
    let mut rows = Vec::new();
    for method in METHODS {
        let mut call = Command::new(program);
        call.arg("deform").arg(&mesh).arg(&constraints);
        call.args([method, &runs.to_string(), ""]);
        let out = call.output().map_err(|e| Error::io(program, e))?;
        let text = String::from_utf8_lossy(&out.stdout);
        let lines: Vec<Line> = text
            .lines()
            .filter_map(|l| serde_json::from_str(l).ok())
            .collect();
        let seconds = |task: &str| {
            let of = lines.iter().filter(|l| l.task == task);
            of.map(|l| l.cpu_min).sum::<f64>()
        };
        let set_up = seconds("deform_setup") + seconds("deform_factor");
        let iterations = seconds("deform_10it");
        let triangles = work.surface.triangles.len().to_string();
        let Some(line) = lines.first() else {
            // It does not take every mesh.
            let [a, b, c, d, e] = ["-"; 5].map(String::from);
            let name = format!("{method}: no times");
            rows.push([triangles, name, a, b, c, d, e]);
            continue;
        };
        let both = number(Some(set_up + iterations), 3);
        rows.push([
            triangles,
            line.tool.clone(),
            number(Some(set_up), 3),
            "10".into(),
            number(Some(iterations), 3),
            both.clone(),
            both,
        ]);
    }
    Ok(rows)
}
