//! SVG: its geometry read, its text kept and edited in place.
//!
//! The scene is read by our own walk rather than from a renderer's tree: what is bent must be found
//! again in the text, and a renderer has turned it into single precision, unfolded copies and arcs
//! of a fixed accuracy by then. The renderer is what the tests compare with.

mod deform;
mod edit;
mod motion;
mod scene;
mod shapes;
mod silhouette;
mod source;
mod style;
mod units;
mod viewport;

use super::outline::Outline;
use crate::error::Result;
use crate::geom::Point;

/// The text of a drawing that has been read without fault.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Svg {
    text: String,
}

/// What is read from a file.
pub(super) struct Read {
    pub svg: Svg,
    pub outline: Outline,
    pub warnings: Vec<String>,
}

/// Reads the bytes of a file.
///
/// # Errors
/// [`crate::Error::Input`].
pub(super) fn read(bytes: Vec<u8>) -> Result<Read> {
    let text = source::text(bytes)?;
    let (outline, warnings) = {
        let tree = source::tree(&text)?;
        let mut scene = scene::scene(&tree)?;
        let outline = silhouette::outline(&mut scene)?;
        warn_of_wholes(&mut scene);
        (outline, scene.warnings)
    };
    Ok(Read {
        svg: Svg { text },
        outline,
        warnings,
    })
}

fn warn_of_wholes(scene: &mut scene::Scene) {
    for name in ["text", "image", "foreign object"] {
        let count = scene.wholes.iter().filter(|w| w.name == name).count();
        if count > 0 {
            let plural = if count == 1 { "" } else { "s" };
            let text = format!("{count} {name}{plural}: moved and turned as a whole, not bent");
            scene.warnings.push(text);
        }
    }
}

impl Svg {
    /// The text as it stands in a file.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The document with its drawing, the region inside `outline`, deformed.
    ///
    /// # Errors
    /// [`crate::Error::Numerical`] where the map leads to points that are no numbers;
    /// [`crate::Error::Unsupported`] where unfolded uses would make too large a file.
    pub fn deformed(&self, outline: &Outline, map: &dyn Fn(Point) -> Point) -> Result<Self> {
        let tree = source::tree(&self.text)?;
        let mut scene = scene::scene(&tree)?;
        silhouette::mark_background(&mut scene);
        let flat = |p: kurbo::Point| {
            let q = map(Point::new(p.x, p.y, 0.0));
            kurbo::Point::new(q.x, q.y)
        };
        let edits = deform::edits(&tree, &scene, outline, &flat)?;
        Ok(Self {
            text: edit::edited(&self.text, &tree, &edits, &scene)?,
        })
    }
}
