//! Lengths, view boxes and transforms of elements.

use kurbo::{Affine, Rect, Size, Vec2};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, Transform, ViewBox};

/// What a percentage refers to.
#[derive(Clone, Copy)]
pub(super) enum Axis {
    X,
    Y,
    Diagonal,
}

/// The size of a font where a length is given in it; fonts themselves are not read.
const FONT: f64 = 16.0;

/// The value of a length attribute in user units; `None` where it is absent, `auto` or damaged.
pub(super) fn length(node: Node<'_, '_>, name: &str, axis: Axis, view: Size) -> Option<f64> {
    let Length { number, unit } = node.attribute(name)?.trim().parse().ok()?;
    let whole = match axis {
        Axis::X => view.width,
        Axis::Y => view.height,
        Axis::Diagonal => {
            (view.width.powi(2) + view.height.powi(2)).sqrt() / std::f64::consts::SQRT_2
        }
    };
    let user_units = match unit {
        LengthUnit::None | LengthUnit::Px => 1.0,
        LengthUnit::Em => FONT,
        LengthUnit::Ex => FONT / 2.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        LengthUnit::Percent => whole / 100.0,
    };
    Some(number * user_units)
}

/// The `viewBox` of an element.
pub(super) fn view_box(node: Node<'_, '_>) -> Option<Rect> {
    let ViewBox { x, y, w, h } = node.attribute("viewBox")?.parse().ok()?;
    Some(Rect::new(x, y, x + w, y + h))
}

/// What puts the content of a view box into a viewport of a size, by `preserveAspectRatio`.
pub(super) fn fitted(node: Node<'_, '_>, content: Rect, viewport: Size) -> Affine {
    let aspect = node.attribute("preserveAspectRatio");
    let aspect: Option<AspectRatio> = aspect.and_then(|a| a.parse().ok());
    let (align, slice) = aspect.map_or((Align::XMidYMid, false), |a| (a.align, a.slice));
    let (sx, sy) = (
        viewport.width / content.width(),
        viewport.height / content.height(),
    );
    let (fx, fy) = match align {
        Align::None => {
            return Affine::scale_non_uniform(sx, sy)
                * Affine::translate(-content.origin().to_vec2());
        }
        Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    };
    let s = if slice { sx.max(sy) } else { sx.min(sy) };
    let room = Vec2::new(
        fx * (viewport.width - s * content.width()),
        fy * (viewport.height - s * content.height()),
    );
    Affine::translate(room) * Affine::scale(s) * Affine::translate(-content.origin().to_vec2())
}

/// The transform in an attribute or property; `None` where it is damaged.
pub(super) fn transform(value: &str) -> Option<Affine> {
    // Properties have units where attributes have none.
    let plain = value.replace("px", "").replace("deg", "");
    let t: Transform = plain.parse().ok()?;
    Some(Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]))
}

/// A transform as an attribute has it, to nine significant digits or so of a coordinate.
pub(super) fn matrix(transform: Affine, decimals: u32) -> String {
    let c = transform.as_coeffs();
    let linear = c[..4]
        .iter()
        .map(|&v| crate::drawing::path::write::number(v, 8));
    let moved = c[4..]
        .iter()
        .map(|&v| crate::drawing::path::write::number(v, decimals));
    let numbers: Vec<String> = linear.chain(moved).collect();
    format!("matrix({})", numbers.join(" "))
}
