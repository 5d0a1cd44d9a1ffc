//! A drawing as a picture.

use resvg::tiny_skia::Color;

use crate::error::{Error, Result};
use crate::raster;

/// The bytes of a PNG picture of an SVG text on white, with the given length of its longer side,
/// pixels.
///
/// # Errors
/// [`Error::Unsupported`] where the renderer refuses the drawing.
pub(super) fn png(svg: &str, longer: u32) -> Result<Vec<u8>> {
    let page = raster::pixels(svg, Some(longer), Some(Color::WHITE))?;
    page.encode_png()
        .map_err(|e| Error::Unsupported(format!("the drawing cannot be written as PNG: {e}")))
}
