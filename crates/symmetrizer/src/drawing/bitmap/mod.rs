//! Bitmaps: the outline of what is darker, lighter or more opaque than its surroundings, to a
//! fraction of a pixel.

mod contour;
mod grey;
mod threshold;

use image::ImageReader;
use std::io::Cursor;

use super::outline::Outline;
use super::{Format, region};
use crate::error::{Error, Result};

/// Pixels on a side.
const LONGEST: u32 = 20_000;

/// Pixels in all.
const PIXELS: u64 = 50_000_000;

/// Bytes that decoding may take.
const MEMORY: u64 = 1 << 30;

/// Of the whole region: smaller pieces and holes are specks.
const SPECK: f64 = 1e-4;

/// Pixels: smaller pieces and holes are specks, too.
const DOT: f64 = 4.0;

/// How much of the grey values' spread must lie between dark and light; photographs have less.
const SILHOUETTE: f64 = 0.85;

/// What is read from a file.
pub(super) struct Read {
    pub outline: Outline,
    /// How exactly the picture tells where the outline is, pixels.
    pub grain: f64,
    pub warnings: Vec<String>,
}

/// Reads the bytes of a picture. Drawing units are pixels; the upper left corner is the origin and
/// the picture lies below it.
///
/// # Errors
/// [`Error::Input`] where the picture is damaged, too large, or of one colour.
pub(super) fn read(bytes: &[u8], format: Format, threshold: Option<f64>) -> Result<Read> {
    let picture = decoded(bytes, format)?;
    let grey = grey::of(&picture);
    let split = threshold::split(&grey, threshold)?;
    let mut warnings = Vec::new();
    if threshold.is_none() && split.separation < SILHOUETTE {
        warnings.push(format!(
            "light and dark hardly differ ({:.0} % of the spread lies between them): is this a \
             silhouette? The threshold is {:.2}; set another one if the outline is wrong",
            100.0 * split.separation,
            split.threshold
        ));
    }
    let edges = split.edges(&grey);
    let smooth = grey.blurred(edges.blur);
    let mut outline = region::of_rings(&contour::rings(&smooth, &split))?;
    let dropped = drop_specks(&mut outline);
    if outline.is_empty() {
        return Err(Error::input(
            "the picture shows no shape larger than a speck",
            "set another threshold, or use a larger picture",
        ));
    }
    if dropped > 0 {
        let plural = if dropped == 1 { "speck" } else { "specks" };
        warnings.push(format!("{dropped} {plural} left out"));
    }
    Ok(Read {
        outline,
        grain: edges.grain,
        warnings,
    })
}

fn decoded(bytes: &[u8], format: Format) -> Result<image::DynamicImage> {
    let kind = match format {
        Format::Jpeg => image::ImageFormat::Jpeg,
        _ => image::ImageFormat::Png,
    };
    let damaged = |e: image::ImageError| {
        Error::input(format!("the picture cannot be read: {e}"), "save it again")
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), kind);
    let mut limits = image::Limits::default();
    limits.max_image_width = Some(LONGEST);
    limits.max_image_height = Some(LONGEST);
    limits.max_alloc = Some(MEMORY);
    reader.limits(limits.clone());
    let (width, height) = reader.into_dimensions().map_err(damaged)?;
    if u64::from(width) * u64::from(height) > PIXELS || width.max(height) > LONGEST {
        let what = format!("the picture has {width} x {height} pixels");
        return Err(Error::input(what, "scale it down; 2000 pixels are plenty"));
    }
    let mut reader = ImageReader::with_format(Cursor::new(bytes), kind);
    reader.limits(limits);
    reader.decode().map_err(damaged)
}

/// Removes specks and counts them.
fn drop_specks(outline: &mut Outline) -> usize {
    let least = DOT.max(SPECK * outline.area());
    let before = outline.rings.len();
    outline.rings.retain(|r| r.area().abs() >= least);
    before - outline.rings.len()
}
