//! A drawing as pixels, by resvg. What a file refers to outside itself is not looked up.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, fontdb};

use crate::error::{Error, Result};

/// The bytes of a PNG picture of an SVG text on white, with the given length of its longer side,
/// pixels.
///
/// # Errors
/// [`Error::Unsupported`] where the renderer refuses the drawing.
pub(super) fn png(svg: &str, longer: u32) -> Result<Vec<u8>> {
    let fail = |what: String| Error::Unsupported(format!("the drawing cannot be rendered: {what}"));
    let mut options = usvg::Options {
        fontdb: fonts(),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| fail(e.to_string()))?;
    let size = tree.size();
    let scale = longer as f32 / size.width().max(size.height());
    let pixels = |v: f32| ((v * scale).round() as u32).clamp(1, longer.max(1));
    let mut page = Pixmap::new(pixels(size.width()), pixels(size.height()))
        .ok_or_else(|| fail("its size is out of range".into()))?;
    page.fill(Color::WHITE);
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut page.as_mut(),
    );
    page.encode_png().map_err(|e| fail(e.to_string()))
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
