//! Shapes to draw: generated ones, and real models where they are at hand.

use std::path::{Path, PathBuf};

use symmetrizer::geom::Point;

/// Vertices and triangles.
#[derive(Clone)]
pub struct Model {
    pub positions: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl Model {
    pub fn map(&self, f: impl Fn(&Point) -> Point) -> Self {
        Self {
            positions: self.positions.iter().map(f).collect(),
            triangles: self.triangles.clone(),
        }
    }

    /// Two models as one.
    pub fn and(mut self, other: &Self) -> Self {
        let first = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        let moved = other.triangles.iter().map(|t| t.map(|v| v + first));
        self.triangles.extend(moved);
        self
    }

    pub fn centroid(&self) -> Point {
        let sum: symmetrizer::geom::Vector = self.positions.iter().map(|p| p.coords).sum();
        Point::from(sum / self.positions.len() as f64)
    }

    pub fn radius_about(&self, center: &Point) -> f64 {
        let distances = self.positions.iter().map(|p| (p - center).norm());
        distances.fold(0.0, f64::max)
    }
}

/// The unit sphere, mirror-symmetric in x, y and z.
pub fn sphere(rings: u32) -> Model {
    let around = 2 * rings;
    let mut positions = Vec::new();
    for i in 0..=rings {
        let (s, c) = (std::f64::consts::PI * f64::from(i) / f64::from(rings)).sin_cos();
        for j in 0..around {
            let (y, x) = (std::f64::consts::TAU * f64::from(j) / f64::from(around)).sin_cos();
            positions.push(Point::new(s * x, c, s * y));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..rings {
        for j in 0..around {
            let [a, b] = [i * around + j, i * around + (j + 1) % around];
            let [c, d] = [a + around, b + around];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    Model {
        positions,
        triangles,
    }
}

/// A model of the shared data, or `None` with a loud word on standard error.
pub fn load(name: &str) -> Option<Model> {
    let folder = std::env::var_os("SYMMETRIZER_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
        PathBuf::from,
    );
    let path = folder.join("3d").join(name);
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(parse(&text)),
        Err(e) => {
            #[allow(clippy::print_stderr)]
            {
                eprintln!("SKIPPED: {}: {e} (set SYMMETRIZER_DATA)", path.display());
            }
            None
        }
    }
}

/// Vertices and fan-triangulated faces of an OBJ file; everything else is passed over.
fn parse(text: &str) -> Model {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let x: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
                positions.push(Point::new(x[0], x[1], x[2]));
            }
            Some("f") => {
                let index = |w: &str| w.split('/').next().unwrap().parse::<u32>().unwrap() - 1;
                let face: Vec<u32> = words.map(index).collect();
                triangles.extend((1..face.len() - 1).map(|k| [face[0], face[k], face[k + 1]]));
            }
            _ => {}
        }
    }
    Model {
        positions,
        triangles,
    }
}
