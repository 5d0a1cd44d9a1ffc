//! A canvas as pixels: the pictures copied as they are, the rest drawn over them by resvg.
//!
//! Copying keeps every pixel of a picture, and spares encoding each one only to decode it again.

use std::io::Cursor;
use std::sync::{Arc, OnceLock};

use image::{ImageFormat, Rgba, RgbaImage};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, fontdb};

use crate::error::{Error, Result};
use crate::picture::canvas::Canvas;
use crate::picture::svg;

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
    let drawn = overlay(canvas)?;
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

fn overlay(canvas: &Canvas) -> Result<Pixmap> {
    let options = usvg::Options {
        fontdb: fonts(),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    let fail = |what: String| Error::Unsupported(format!("the page cannot be drawn: {what}"));
    let tree =
        usvg::Tree::from_str(&svg::overlay(canvas), &options).map_err(|e| fail(e.to_string()))?;
    let mut pixmap = Pixmap::new(canvas.width, canvas.height)
        .ok_or_else(|| fail("its size is out of range".into()))?;
    resvg::render(&tree, Transform::identity(), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// DejaVu Sans, which comes with the library, so that pictures are the same on every machine.
fn fonts() -> Arc<fontdb::Database> {
    static FONTS: OnceLock<Arc<fontdb::Database>> = OnceLock::new();
    let load = || {
        let mut fonts = fontdb::Database::new();
        fonts.load_font_data(dejavu::sans::regular().to_vec());
        fonts.load_font_data(dejavu::sans::bold().to_vec());
        fonts.set_sans_serif_family("DejaVu Sans");
        Arc::new(fonts)
    };
    FONTS.get_or_init(load).clone()
}
