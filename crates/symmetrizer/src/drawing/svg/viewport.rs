//! The drawing's own coordinates: those of the file's content, y upwards.

use kurbo::{Affine, Rect, Size};
use roxmltree::Node;

use super::units::{Axis, length, view_box};

/// The outermost window.
pub(super) struct Window {
    /// From the content's coordinates to the drawing's.
    pub place: Affine,
    /// What percentages refer to.
    pub view: Size,
    /// What is shown, in the drawing's coordinates, if the file says so.
    pub shown: Option<Rect>,
}

/// Where nothing says how large the window is.
const UNKNOWN: Size = Size::new(100.0, 100.0);

/// The window of the root element. Lengths are those of its content; only where width and height
/// squeeze it (`preserveAspectRatio="none"`) is y squeezed along.
pub(super) fn root(node: Node<'_, '_>) -> Window {
    let size = |name, axis| {
        let value = node.attribute(name).filter(|v| !v.trim().ends_with('%'));
        value.and_then(|_| length(node, name, axis, UNKNOWN)).filter(|v| *v > 0.0)
    };
    let size = size("width", Axis::X).zip(size("height", Axis::Y));
    let size = size.map(|(w, h)| Size::new(w, h));
    let content = view_box(node);
    let squeezes = node
        .attribute("preserveAspectRatio")
        .is_some_and(|a| a.trim().starts_with("none"));
    let squeeze = match (size, content) {
        (Some(s), Some(c)) if squeezes => (s.height / c.height()) / (s.width / c.width()),
        _ => 1.0,
    };
    let place = Affine::scale_non_uniform(1.0, -squeeze);
    let shown = content.or_else(|| size.map(|s| s.to_rect()));
    Window {
        place,
        view: shown.map_or(UNKNOWN, |r| r.size()),
        shown: shown.map(|r| place.transform_rect_bbox(r)),
    }
}
