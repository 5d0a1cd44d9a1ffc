//! Another program on the same exhibit.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use symmetrizer::geom::Point;
use symmetrizer::{Error, Result};

use super::exhibit::{Exhibit, PARTS};
use super::result::Deformed;
use crate::constraints::{Target, write};
use crate::data;

/// The peer's methods: as rigid as possible in three variants.
const METHODS: [&str; 3] = ["arap", "spokes_and_rims", "sre_arap"];

/// Iterations of a peer that does not say how many it made.
const ITERATIONS: usize = 10;

/// One line that the peer prints.
#[derive(Deserialize)]
struct Line {
    tool: String,
    wall_min: f64,
    iterations: Option<usize>,
}

/// What each of the peer's methods makes of `exhibit`.
///
/// # Errors
/// A program that does not start, fails, or writes something else than positions.
pub fn deformed(program: &Path, exhibit: &Exhibit) -> Result<Vec<Deformed>> {
    let folder = std::env::temp_dir();
    // The whole motion first: a program that knows one block only makes it at once.
    let parts = std::iter::once(PARTS).chain(1..PARTS);
    let all: Vec<Vec<Target>> = parts.map(|part| exhibit.part(part)).collect();
    let blocks: Vec<&[Target]> = all.iter().map(Vec::as_slice).collect();
    let files = write(&folder, exhibit.name, &exhibit.surface, &blocks)?;
    METHODS
        .into_iter()
        .map(|method| run(program, &files, method))
        .collect()
}

fn run(program: &Path, [mesh, constraints]: &[PathBuf; 2], method: &str) -> Result<Deformed> {
    let out = mesh.with_extension("out");
    let mut call = Command::new(program);
    call.arg("deform").arg(mesh).arg(constraints);
    call.args([method, "1"]).arg(&out);
    let printed = call.output().map_err(|e| Error::io(program, e))?.stdout;
    let lines = lines(&String::from_utf8_lossy(&printed));
    let Some(line) = lines.first() else {
        let what = format!("{} printed no times", program.display());
        return Err(Error::input(what, "see --help"));
    };
    let iterations = lines.iter().find_map(|l| l.iterations);
    Ok(Deformed {
        method: line.tool.clone(),
        positions: positions(&out)?,
        steps: iterations.unwrap_or(ITERATIONS),
        seconds: lines.iter().map(|l| l.wall_min).sum(),
        peer: true,
    })
}

fn lines(printed: &str) -> Vec<Line> {
    let line = |l| serde_json::from_str(l).ok();
    printed.lines().filter_map(line).collect()
}

/// A vertex a line.
fn positions(path: &Path) -> Result<Vec<Point>> {
    let bad = || Error::input("not three numbers a line", "see --help").in_file(path);
    let point = |line: &str| {
        let numbers: Option<Vec<f64>> = line.split(' ').map(|w| w.parse().ok()).collect();
        match numbers.as_deref() {
            Some(&[x, y, z]) => Ok(Point::new(x, y, z)),
            _ => Err(bad()),
        }
    };
    data::text(path)?.lines().map(point).collect()
}
