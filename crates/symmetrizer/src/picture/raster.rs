//! A canvas as pixels: the pictures copied as they are, the rest drawn over them.
//!
//! Copying keeps every pixel of a picture, and spares encoding each one only to decode it again.

use std::io::Cursor;

use image::{ImageFormat, Rgba, RgbaImage};

use crate::error::{Error, Result};
use crate::picture::canvas::Canvas;
use crate::picture::svg;
use crate::raster::pixels;

/// The largest page, pixels.
const MAX_AREA: u64 = 1 << 28;

/// The bytes of a PNG file with `image`.
pub(super) fn png(image: &RgbaImage) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, ImageFormat::Png)
        .map_err(|e| Error::Unsupported(format!("the picture cannot be written as PNG: {e}")))?;
    Ok(bytes.into_inner())
}

/// The drawn page.
pub(super) fn image(canvas: &Canvas) -> Result<RgbaImage> {
    let (width, height) = (canvas.width, canvas.height);
    if u64::from(width) * u64::from(height) > MAX_AREA {
        let what = format!("a picture of {width} x {height} pixels is too large to be drawn");
        return Err(Error::Unsupported(what));
    }
    let mut page = RgbaImage::from_pixel(width, height, Rgba([255; 4]));
    for placed in &canvas.images {
        image::imageops::overlay(&mut page, &placed.image, placed.x.into(), placed.y.into());
    }
    let drawn = pixels(&svg::overlay(canvas), None, None)?;
    for (below, above) in page.pixels_mut().zip(drawn.pixels()) {
        // Premultiplied colours of resvg over the opaque page.
        let through = 255 - u32::from(above.alpha());
        let mix = |a: u8, b: u8| (u32::from(a) + (u32::from(b) * through + 127) / 255).min(255);
        let [r, g, b, _] = below.0;
        below.0 = [
            mix(above.red(), r) as u8,
            mix(above.green(), g) as u8,
            mix(above.blue(), b) as u8,
            255,
        ];
    }
    Ok(page)
}
