//! Rows and the grids that two of them make.

use nalgebra::{Matrix2, Matrix2x3};

use crate::geom::Vector;
use crate::group::row::{Row, row};
use crate::group::step::powers_of;
use crate::group::{Verify, Within};
use crate::transform::{Isometry, Kind};

/// Copies in two directions.
#[derive(Debug, Clone)]
pub struct Grid {
    /// From one copy to the next along each direction, the best for all copies.
    pub steps: [Isometry; 2],
    /// How many copies there are along each.
    pub counts: [usize; 2],
}

/// Copies that follow each other.
#[derive(Debug, Clone)]
pub enum Pattern {
    /// In one direction.
    Row(Row),
    /// In two.
    Grid(Grid),
}

impl std::fmt::Display for Pattern {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Row(row) => row.fmt(f),
            Self::Grid(Grid { counts: [n, m], .. }) => f.pad(&format!("grid {n}x{m}")),
        }
    }
}

/// The rows and grids of `generators`, which hold; shortest steps first, and what an earlier one
/// explains makes none of its own. Rings without gaps are left to the point groups, and what makes
/// no rows is passed over. `verify` as for [`row`].
pub fn patterns(
    generators: &[Isometry],
    within: Within<'_>,
    verify: &mut Verify<'_>,
) -> Vec<Pattern> {
    let step = |t: &Isometry| within.space.distance(t, &Isometry::identity());
    let mut sorted: Vec<&Isometry> = generators.iter().collect();
    sorted.sort_by(|a, b| step(a).total_cmp(&step(b)));
    let mut found: Vec<Pattern> = Vec::new();
    for t in sorted {
        if found.iter().any(|p| p.explains(t, within)) {
            continue;
        }
        let Some(new) = row(t, within, verify) else {
            continue;
        };
        let crossed = found.iter().enumerate().find_map(|(i, p)| match p {
            Pattern::Row(old) => grid(old, &new, within, verify).map(|g| (i, g)),
            Pattern::Grid(_) => None,
        });
        match crossed {
            Some((i, grid)) => found[i] = Pattern::Grid(grid),
            None => found.push(Pattern::Row(new)),
        }
    }
    found.retain(|p| !matches!(p, Pattern::Row(row) if row.is_closed()));
    found
}

impl Pattern {
    /// The step of a row, the two of a grid.
    pub fn steps(&self) -> Vec<Isometry> {
        match self {
            Self::Row(row) => vec![row.step],
            Self::Grid(grid) => grid.steps.to_vec(),
        }
    }

    /// The motions from the first copy to each, those along the first step of a grid following each other.
    pub fn elements(&self) -> Vec<Isometry> {
        match self {
            Self::Row(row) => powers_of(&row.step, row.count),
            Self::Grid(Grid { steps, counts }) => {
                let [a, b] = [0, 1].map(|i| powers_of(&steps[i], counts[i]));
                let along = |y: &Isometry| a.iter().map(|x| y.after(x)).collect::<Vec<_>>();
                b.iter().flat_map(along).collect()
            }
        }
    }

    fn explains(&self, t: &Isometry, within: Within<'_>) -> bool {
        match self {
            Self::Row(row) => row.explains(t, within),
            Self::Grid(Grid { steps, counts }) => {
                let [n, m] = counts.map(|n| n as i32);
                let places = (1 - n..n).flat_map(|i| (1 - m..m).map(move |j| (i, j)));
                let [a, b] = steps.map(|s| s.translation);
                let shift = |(i, j)| a * f64::from(i) + b * f64::from(j);
                places.map(shift).any(|s| within.same(&shifted(s), t))
            }
        }
    }
}

/// Steps along both directions, and the isometry that takes them on the shape.
type Placed = (usize, usize, Isometry);

/// The least sine between the directions of a grid, about 6 degrees.
const LEAST_SINE: f64 = 0.1;

/// The grid of two rows of translations: the largest full block of copies at the corner where both
/// begin. `None` where the rows are of another kind or parallel, or where not even the first
/// product holds.
fn grid(a: &Row, b: &Row, within: Within<'_>, verify: &mut Verify<'_>) -> Option<Grid> {
    let (s, t) = (a.step.translation, b.step.translation);
    let straight = a.kind == Kind::Translation && b.kind == Kind::Translation;
    if !straight || s.cross(&t).norm() < LEAST_SINE * s.norm() * t.norm() {
        return None;
    }
    let (mut held, [n, m]) = block([a, b], within, verify);
    if n < 2 || m < 2 {
        return None;
    }
    let along = |row: &Row, limit: usize| row.measured[..limit - 1].to_vec();
    held.retain(|(i, j, _)| *i < n && *j < m);
    held.extend((1..).zip(along(a, n)).map(|(i, t)| (i, 0, t)));
    held.extend((1..).zip(along(b, m)).map(|(j, t)| (0, j, t)));
    Some(Grid {
        steps: steps(&held, within)?.map(shifted),
        counts: [n, m],
    })
}

/// The products i s + j t, i and j from 1, that hold, and the counts of the largest full block.
fn block(
    [a, b]: [&Row; 2],
    within: Within<'_>,
    verify: &mut Verify<'_>,
) -> (Vec<Placed>, [usize; 2]) {
    let (s, t) = (a.step.translation, b.step.translation);
    let mut held = Vec::new();
    let mut best = [1, 1];
    let mut width = a.count;
    for j in 1..b.count {
        let mut reached = 1;
        while reached < width {
            let product = shifted(s * reached as f64 + t * j as f64);
            let Some(holds) = within.ask(&product, verify) else {
                break;
            };
            held.push((reached, j, holds));
            reached += 1;
        }
        width = reached;
        if width * (j + 1) > best[0] * best[1] {
            best = [width, j + 1];
        }
    }
    (held, best)
}

/// The two translations s, t that minimise the sum of |i s + j t - M_ij|^2 in the space.
fn steps(held: &[Placed], within: Within<'_>) -> Option<[Vector; 2]> {
    let centre = within.space.centre();
    let mut a = Matrix2::zeros();
    let mut b = Matrix2x3::zeros();
    for (i, j, t) in held {
        let at = nalgebra::Vector2::new(*i as f64, *j as f64);
        a += at * at.transpose();
        b += at * (t.apply(&centre) - centre).transpose();
    }
    let x = a.try_inverse()? * b;
    Some([x.row(0).transpose(), x.row(1).transpose()])
}

fn shifted(translation: Vector) -> Isometry {
    Isometry {
        translation,
        ..Isometry::identity()
    }
}
