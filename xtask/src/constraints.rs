//! Vertices with targets, as soft constraints and as files for other programs.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use symmetrizer::deform::Pull;
use symmetrizer::geom::Point;
use symmetrizer::shape::{Surface, SurfacePoint};
use symmetrizer::{Error, Result};

/// A vertex and where it is to go, working coordinates.
pub type Target = (u32, Point);

/// Each target as a soft constraint with the weight of its share of the surface over `length` squared.
pub fn pulls(surface: &Surface, targets: &[Target], length: f64) -> Vec<Pull> {
    let mut corner = vec![None; surface.positions.len()];
    for (face, corners) in (0..).zip(surface.triangles.iter()) {
        for (k, &v) in corners.iter().enumerate() {
            corner[v as usize].get_or_insert((face, k));
        }
    }
    let weight = surface.area() / targets.len() as f64 / (length * length);
    targets
        .iter()
        .filter_map(|&(v, target)| {
            let (face, k) = corner[v as usize]?;
            let bary = std::array::from_fn(|i| f64::from(u8::from(i == k)));
            let at = SurfacePoint { face, bary };
            Some(Pull { at, target, weight })
        })
        .collect()
}

/// Writes `NAME.off`, the mesh, and `NAME.txt`, blocks of a count and as many lines of vertex and target.
///
/// # Errors
/// [`Error::Io`].
pub fn write(
    folder: &Path,
    name: &str,
    surface: &Surface,
    blocks: &[&[Target]],
) -> Result<[PathBuf; 2]> {
    let lines: String = blocks.iter().map(|b| block(b)).collect();
    let paths = ["off", "txt"].map(|e| folder.join(name).with_extension(e));
    std::fs::create_dir_all(folder).map_err(|e| Error::io(folder, e))?;
    for (path, text) in paths.iter().zip([off(surface), lines]) {
        std::fs::write(path, text).map_err(|e| Error::io(path, e))?;
    }
    Ok(paths)
}

fn off(surface: &Surface) -> String {
    let counts = (surface.positions.len(), surface.triangles.len());
    let mut off = format!("OFF\n{} {} 0\n", counts.0, counts.1);
    for x in &surface.positions {
        let _ = writeln!(off, "{} {} {}", x.x, x.y, x.z);
    }
    for [a, b, c] in surface.triangles.iter() {
        let _ = writeln!(off, "3 {a} {b} {c}");
    }
    off
}

fn block(targets: &[Target]) -> String {
    let mut lines = format!("{}\n", targets.len());
    for (v, x) in targets {
        let _ = writeln!(lines, "{v} {} {} {}", x.x, x.y, x.z);
    }
    lines
}
