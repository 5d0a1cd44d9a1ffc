//! The figures of a run.

use symmetrizer::Report;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::Step;

use crate::tables::number;

/// What is told of a drawing.
pub struct Figures {
    /// rms distance of the corners from those at rest, after the best similarity, before and after, % of D.
    pub rms: [Option<f64>; 2],
    pub seconds: f64,
    pub report: Report,
}

impl Figures {
    pub const HEADS: [&'static str; 12] = [
        "drawing",
        "verdict",
        "score",
        "rival",
        "bend",
        "rms before",
        "after",
        "asymmetry",
        "after",
        "crossings",
        "area",
        "s",
    ];

    pub fn cells(&self, name: &str) -> [String; 12] {
        let report = &self.report;
        let bend = report.bend.as_ref();
        let result = report.result.as_ref();
        let asymmetry = report.input.shape.asymmetry.as_ref();
        let group = report.steps.iter().find_map(|step| match step {
            Step::Orbits { goals, .. } => goals.first().map(|g| g.name.clone()),
            _ => None,
        });
        let verdict = match (bend, result) {
            _ if group.is_some() => group.unwrap_or_default(),
            (None, None) => "nothing".into(),
            (None, Some(_)) => "mirror".into(),
            (Some(bend), done) => {
                let left = if done.is_some() { "" } else { ", left" };
                format!("{:?}{left}", bend.verdict).to_lowercase()
            }
        };
        [
            name.into(),
            verdict,
            number(bend.map(|b| b.score), 2),
            number(bend.and_then(|b| b.rival), 2),
            number(bend.map(|b| b.degrees), 0),
            number(self.rms[0], 3),
            number(self.rms[1], 3),
            number(asymmetry.map(|a| a.mean), 3),
            number(result.map(|r| r.asymmetry.mean), 3),
            number(result.map(|r| r.distortion.new_crossings as f64), 0),
            number(result.map(|r| r.distortion.area_ratio), 3),
            number(Some(self.seconds), 2),
        ]
    }
}

/// The rms distance of points from others after the similarity of the plane that takes them nearest, % of the
/// others' diagonal; mirrored or not. Points without a place do not count.
pub fn similar(points: &[Option<Point>], others: &[Point]) -> Option<f64> {
    let pairs: Vec<(Point, Point)> = points
        .iter()
        .zip(others)
        .filter_map(|(x, y)| Some(((*x)?, *y)))
        .collect();
    if pairs.is_empty() {
        return None;
    }
    let low = others.iter().fold(others[0], |m, x| m.inf(x));
    let high = others.iter().fold(others[0], |m, x| m.sup(x));
    let flipped: Vec<(Point, Point)> = pairs
        .iter()
        .map(|(x, y)| (Point::new(-x.x, x.y, 0.0), *y))
        .collect();
    Some(100.0 * missed(&pairs).min(missed(&flipped)) / (high - low).norm())
}

fn missed(pairs: &[(Point, Point)]) -> f64 {
    let count = pairs.len() as f64;
    let mean = |of: fn(&(Point, Point)) -> Point| {
        pairs.iter().map(|p| of(p).coords).sum::<Vector>() / count
    };
    let (p, q) = (mean(|p| p.0), mean(|p| p.1));
    let (mut re, mut im, mut size) = (0.0, 0.0, 0.0);
    let centred: Vec<(Vector, Vector)> = pairs
        .iter()
        .map(|(x, y)| (x.coords - p, y.coords - q))
        .collect();
    for (x, y) in &centred {
        re += x.dot(y);
        im += x.x * y.y - x.y * y.x;
        size += x.norm_squared();
    }
    let (c, s) = (re / size, im / size);
    let squares = centred.iter().map(|(x, y)| {
        let moved = Vector::new(c * x.x - s * x.y, s * x.x + c * x.y, 0.0);
        (moved - y).norm_squared()
    });
    (squares.sum::<f64>() / count).sqrt()
}
