//! What must hold for any bytes taken for a drawing: they are read or refused, what does not move keeps its bytes, and
//! what is bent is written so that it can be read again.

use symmetrizer::Drawing;
use symmetrizer::drawing::{Format, Reading, decode};
use symmetrizer::geom::Point;

/// Polylines begin with a bracket, bitmaps as theirs do; all else is taken for SVG.
fn format(bytes: &[u8]) -> Format {
    match bytes {
        [b'{' | b'[', ..] => Format::Json,
        [0x89, b'P', ..] => Format::Png,
        [0xff, 0xd8, ..] => Format::Jpeg,
        _ => Format::Svg,
    }
}

/// Reads `bytes`, moves the drawing not at all and then a little, and reads what is written.
///
/// # Panics
/// Where one of it does, or the drawing that did not move is written otherwise.
pub fn check(bytes: &[u8]) {
    let Ok(drawing) = decode(bytes.to_vec(), format(bytes), &Reading::default()) else {
        return;
    };
    let again =
        |drawing: &Drawing| decode(drawing.svg().into_bytes(), Format::Svg, &Reading::default());
    if let Ok(same) = drawing.deformed(&|x| x) {
        assert_eq!(same.svg(), drawing.svg(), "what does not move");
    }
    let (low, high) = drawing.outline().bounds();
    let size = (high - low).norm().max(f64::MIN_POSITIVE);
    let bent = |x: Point| Point::new(x.x + 0.1 * size * ((x.y - low.y) / size).sin(), x.y, 0.0);
    let Ok(moved) = drawing.deformed(&bent) else {
        return;
    };
    if let Err(error) = again(&moved) {
        panic!("what was written cannot be read: {error}");
    }
}
