//! The drawing's own coordinates: those of the file's content, y upwards.

use kurbo::{Affine, Rect, Size};
use roxmltree::{Document, Node};

use super::edit::Edit;
use super::scene::Spot;
use super::units::{Axis, length, view_box};
use crate::drawing::path::write;

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
        value
            .and_then(|_| length(node, name, axis, UNKNOWN))
            .filter(|v| *v > 0.0)
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

/// Of the shape's larger side: the room beside what leaves the window.
const ROOM: f64 = 0.01;

/// A window that holds what it has held before, at the same scale: where the drawing lies `after` beyond it,
/// and further than `before`, it is widened.
pub(super) fn widened(
    tree: &Document<'_>,
    before: Rect,
    after: Rect,
    precision: f64,
) -> Option<(Spot, Vec<Edit>)> {
    let element = tree.root_element();
    let window = root(element);
    let shown = window.shown?;
    let room = ROOM * after.width().max(after.height());
    let wide = Rect::new(
        if after.x0 < shown.x0.min(before.x0) {
            after.x0 - room
        } else {
            shown.x0
        },
        if after.y0 < shown.y0.min(before.y0) {
            after.y0 - room
        } else {
            shown.y0
        },
        if after.x1 > shown.x1.max(before.x1) {
            after.x1 + room
        } else {
            shown.x1
        },
        if after.y1 > shown.y1.max(before.y1) {
            after.y1 + room
        } else {
            shown.y1
        },
    );
    if wide == shown {
        return None;
    }
    let content = window.place.inverse().transform_rect_bbox(wide);
    let decimals = write::decimals(precision);
    let numbers = [content.x0, content.y0, content.width(), content.height()];
    let view_box = numbers.map(|v| write::number(v, decimals)).join(" ");
    let mut edits = vec![Edit::Attribute("viewBox", view_box)];
    let grown = [
        ("width", wide.width() / shown.width()),
        ("height", wide.height() / shown.height()),
    ];
    for (name, by) in grown {
        edits.extend(longer(element, name, by));
    }
    let spot = Spot {
        chain: Vec::new(),
        node: element.id().get(),
    };
    Some((spot, edits))
}

/// A length attribute times a factor, in its own unit; shares of the page stay.
fn longer(element: Node<'_, '_>, name: &'static str, by: f64) -> Option<Edit> {
    let value = element.attribute(name)?.trim();
    let unit = value.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | '+'));
    if unit == "%" {
        return None;
    }
    let number: f64 = value.strip_suffix(unit)?.parse().ok()?;
    Some(Edit::Attribute(name, write::number(number * by, 3) + unit))
}
