//! A scribble of a hundred thousand long strokes crosses itself a billion times. Sorting that out
//! would take hours, so it is refused before it is tried.

use i_overlay::i_float::int::point::IntPoint;

use super::region::Contours;
use crate::error::{Error, Result};

/// Pairs of edges whose boxes overlap: about this many are sorted out in a few seconds.
const MOST: usize = 4_000_000;

/// Cells of the grid at most, in each direction.
const CELLS: f64 = 2048.0;

/// Cells that all edges together may touch; edges beyond it are long and many.
const TOUCHED: usize = 40_000_000;

/// Pairs that are looked at: a second or two.
const LOOKS: usize = 1_000_000_000;

type Edge = (IntPoint<i32>, IntPoint<i32>);

/// Fails where the contours cross far too often.
///
/// # Errors
/// [`Error::Input`].
pub(super) fn check(contours: &Contours) -> Result<()> {
    let edges: Vec<Edge> = contours.iter().flat_map(|c| edges(c)).collect();
    let count = edges.len();
    // Fewer edges than this cannot have too many pairs.
    if count * count / 2 <= MOST || overlaps(&edges).is_some() {
        return Ok(());
    }
    Err(Error::input(
        format!("the {count} edges of its outlines cross each other too often to be sorted out"),
        "unite the shapes in a drawing program, or simplify them",
    ))
}

fn edges(contour: &[IntPoint<i32>]) -> impl Iterator<Item = Edge> {
    let next = contour.iter().cycle().skip(1);
    contour.iter().zip(next).map(|(&a, &b)| (a, b))
}

/// The number of pairs whose boxes overlap, once for each cell that both touch; `None` above the
/// limit.
fn overlaps(edges: &[Edge]) -> Option<usize> {
    let side = (2.0 * (edges.len() as f64).sqrt()).min(CELLS);
    let ends = || edges.iter().flat_map(|e| [e.0, e.1]);
    let low = [ends().map(|p| p.x).min()?, ends().map(|p| p.y).min()?];
    let high = [ends().map(|p| p.x).max()?, ends().map(|p| p.y).max()?];
    let size = (0..2)
        .map(|i| i64::from(high[i]) - i64::from(low[i]))
        .max()?
        + 1;
    let cell = |v: i32, axis: usize| {
        ((i64::from(v) - i64::from(low[axis])) as f64 * side / size as f64) as usize
    };
    let width = side as usize + 1;
    let mut cells: Vec<Vec<u32>> = vec![Vec::new(); width * width];
    let mut touched = 0;
    for (i, (a, b)) in edges.iter().enumerate() {
        let (x0, x1) = (cell(a.x.min(b.x), 0), cell(a.x.max(b.x), 0));
        let (y0, y1) = (cell(a.y.min(b.y), 1), cell(a.y.max(b.y), 1));
        touched += (x1 - x0 + 1) * (y1 - y0 + 1);
        if touched > TOUCHED {
            return None;
        }
        for y in y0..=y1 {
            cells[y * width + x0..=y * width + x1]
                .iter_mut()
                .for_each(|c| c.push(i as u32));
        }
    }
    let (mut pairs, mut looks) = (0, 0);
    for here in &cells {
        for (k, &i) in here.iter().enumerate() {
            looks += here.len() - k;
            let overlapping = |j: &&u32| boxes_overlap(&edges[i as usize], &edges[**j as usize]);
            pairs += here[k + 1..].iter().filter(overlapping).count();
            if pairs > MOST || looks > LOOKS {
                return None;
            }
        }
    }
    Some(pairs)
}

fn boxes_overlap(a: &Edge, b: &Edge) -> bool {
    let apart =
        |a0: i32, a1: i32, b0: i32, b1: i32| a0.max(a1) < b0.min(b1) || b0.max(b1) < a0.min(a1);
    !apart(a.0.x, a.1.x, b.0.x, b.1.x) && !apart(a.0.y, a.1.y, b.0.y, b.1.y)
}
