//! Faces and triangle strips: what lists of vertex numbers say.

use crate::error::{Error, Result};
use crate::shape::document::{NO_ROW, Numbers, Values};
use crate::shape::mesh::Polygons;

/// The polygons in a column of lists.
///
/// # Errors
/// [`Error::Input`] with the face that has a negative corner.
pub(super) fn polygons(values: Values) -> Result<Polygons> {
    let Values::Lists { starts, numbers } = values else {
        return Ok(Polygons::default());
    };
    let below = match &numbers {
        Numbers::U32(_) => None,
        Numbers::I32(v) => v.iter().position(|&v| v < 0),
        other => other.iter().position(|v| v < 0.0),
    };
    if let Some(i) = below {
        let f = starts.partition_point(|&s| s as usize <= i) - 1;
        return Err(negative(f, numbers.get(i)));
    }
    let corners = match numbers {
        Numbers::U32(v) => v,
        Numbers::I32(v) => v.into_iter().map(|v| v as u32).collect(),
        other => other.iter().map(|v| v as u32).collect(),
    };
    Ok(Polygons::from_lists(starts, corners))
}

fn negative(f: usize, v: f64) -> Error {
    Error::input(
        format!("face {f} (counted from 0) names vertex {v}"),
        "the file is damaged: indices count from 0",
    )
}

/// Appends the triangles of strips to `polygons`; their number. A list may hold several strips with
/// -1 between them. Every other triangle of a strip is turned round; one that names a vertex twice
/// only leads the strip elsewhere and is dropped.
///
/// # Errors
/// [`Error::Input`] where an index is no whole number or the corners would be too many to count.
pub(super) fn strips(values: &Values, polygons: &mut Polygons) -> Result<usize> {
    let Values::Lists { starts, numbers } = values else {
        return Ok(0);
    };
    let had = polygons.iter().map(<[u32]>::len).sum::<usize>();
    if had + 3 * numbers.len() > u32::MAX as usize {
        let what = "the triangle strips have too many triangles";
        return Err(Error::input(what, "simplify the mesh first"));
    }
    let before = polygons.len();
    let mut strip = Vec::new();
    for range in starts.windows(2) {
        for i in range[0]..range[1] {
            let v = numbers.get(i as usize);
            if v < 0.0 || v >= f64::from(u32::MAX) {
                triangles(&strip, polygons);
                strip.clear();
            } else if v.fract() != 0.0 {
                let what = format!("a triangle strip names vertex {v}");
                return Err(Error::input(what, "indices are whole numbers from 0"));
            } else {
                strip.push(v as u32);
            }
        }
        triangles(&strip, polygons);
        strip.clear();
    }
    Ok(polygons.len() - before)
}

fn triangles(strip: &[u32], polygons: &mut Polygons) {
    for (k, corners) in strip.windows(3).enumerate() {
        let [a, b, c] = [corners[0], corners[1], corners[2]];
        if a != b && b != c && c != a {
            polygons.push(&if k % 2 == 0 { [a, b, c] } else { [b, a, c] });
        }
    }
}

/// Two numbers for each corner, where the lists have just as many.
pub(super) fn two_per_corner(values: &Values, polygons: &Polygons) -> Option<Values> {
    let Values::Lists { starts, numbers } = values else {
        return None;
    };
    let lengths = starts.windows(2).map(|s| (s[1] - s[0]) as usize);
    let fits = lengths.eq(polygons.iter().map(|p| 2 * p.len()));
    fits.then(|| Values::Rows {
        width: 2,
        numbers: numbers.clone(),
    })
}

/// The values with `extra` elements more that have none.
pub(super) fn lengthened(values: Values, extra: usize) -> Values {
    match values {
        Values::Rows { width, numbers } if extra > 0 => {
            let rows = 0..(numbers.len() / width.max(1)) as u32;
            Values::Pool {
                width,
                rows: rows.chain(std::iter::repeat_n(NO_ROW, extra)).collect(),
                numbers,
            }
        }
        Values::Lists {
            mut starts,
            numbers,
        } => {
            let end = starts.last().copied().unwrap_or(0);
            starts.extend(std::iter::repeat_n(end, extra));
            Values::Lists { starts, numbers }
        }
        Values::Names { names, mut of } => {
            of.extend(std::iter::repeat_n(NO_ROW, extra));
            Values::Names { names, of }
        }
        other => other,
    }
}
