//! SVG as pixels, by resvg: drawings, and what is drawn over the pictures of a page. What a file refers to outside
//! itself is not looked up.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{self, fontdb};

use crate::error::{Error, Result};

/// An SVG text as pixels, over `ground` where there is one: as large as it says, or with its longer side of
/// `longer` pixels.
///
/// # Errors
/// [`Error::Unsupported`] where the renderer refuses the text or it has no size.
pub fn pixels(svg: &str, longer: Option<u32>, ground: Option<Color>) -> Result<Pixmap> {
    let fail = |what: String| Error::Unsupported(format!("the drawing cannot be rendered: {what}"));
    let mut options = usvg::Options {
        fontdb: fonts(),
        font_family: "DejaVu Sans".into(),
        ..usvg::Options::default()
    };
    options.image_href_resolver.resolve_string = Box::new(|_, _| None);
    let tree = usvg::Tree::from_str(svg, &options).map_err(|e| fail(e.to_string()))?;
    let (width, height) = (tree.size().width(), tree.size().height());
    let scale = longer.map_or(1.0, |longer| longer as f32 / width.max(height));
    let most = longer.unwrap_or(u32::MAX).max(1);
    let count = |v: f32| ((v * scale).round() as u32).clamp(1, most);
    let mut page = Pixmap::new(count(width), count(height))
        .ok_or_else(|| fail("its size is out of range".into()))?;
    if let Some(ground) = ground {
        page.fill(ground);
    }
    let scaled = Transform::from_scale(scale, scale);
    resvg::render(&tree, scaled, &mut page.as_mut());
    Ok(page)
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
