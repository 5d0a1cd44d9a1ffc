//! JSON: `{"rings": [[[x, y], ...], ...]}`, y upwards, each ring closed without repeating its first
//! point. A point is inside if an odd number of rings is around it.

use serde::{Deserialize, Serialize};

use super::outline::Outline;
use super::region;
use crate::error::{Error, Result};
use crate::geom::Point;

#[derive(Serialize, Deserialize)]
struct Rings {
    rings: Vec<Vec<[f64; 2]>>,
}

/// Reads the bytes of a file; other members than `rings` are passed over.
///
/// # Errors
/// [`Error::Input`] where it is no such JSON, or a ring has fewer than three points.
pub(super) fn read(bytes: &[u8]) -> Result<Outline> {
    const FORM: &str = "the form is {\"rings\": [[[x, y], [x, y], ...], ...]}";
    let file: Rings =
        serde_json::from_slice(bytes).map_err(|e| Error::input(format!("JSON: {e}"), FORM))?;
    if let Some(i) = file.rings.iter().position(|r| r.len() < 3) {
        let what = format!(
            "ring {i} (counted from 0) has {} points",
            file.rings[i].len()
        );
        return Err(Error::input(what, "a ring needs at least three"));
    }
    let point = |p: &[f64; 2]| Point::new(p[0], p[1], 0.0);
    let rings: Vec<Vec<Point>> = file
        .rings
        .iter()
        .map(|r| r.iter().map(point).collect())
        .collect();
    let outline = region::of_rings(&rings)?;
    if outline.is_empty() {
        let what = format!("{} rings without any area", rings.len());
        return Err(Error::input(what, FORM));
    }
    Ok(outline)
}

/// The text of a file.
pub(super) fn text(outline: &Outline) -> String {
    let ring = |r: &super::outline::Ring| r.points.iter().map(|p| [p.x, p.y]).collect();
    let file = Rings {
        rings: outline.rings.iter().map(ring).collect(),
    };
    // Numbers and lists cannot fail to be written.
    serde_json::to_string(&file).unwrap_or_default() + "\n"
}
