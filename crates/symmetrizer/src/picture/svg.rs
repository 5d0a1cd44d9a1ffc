//! A canvas as SVG text.

use std::fmt::Write;

use base64::Engine;

use crate::error::Result;
use crate::picture::canvas::{Anchor, Canvas, Mark, Placed, Text};
use crate::picture::color::{ColorScale, Hex};
use crate::picture::raster;

/// Colour stops of a legend bar.
const STOPS: u32 = 32;

/// The whole page.
pub(super) fn document(canvas: &Canvas) -> Result<String> {
    let mut out = head(canvas);
    out.push_str("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
    for placed in &canvas.images {
        image(&mut out, placed)?;
    }
    marks(&mut out, canvas);
    out.push_str("</svg>\n");
    Ok(out)
}

/// The page without background and pictures, to be drawn over them.
pub(super) fn overlay(canvas: &Canvas) -> String {
    let mut out = head(canvas);
    marks(&mut out, canvas);
    out.push_str("</svg>\n");
    out
}

fn head(canvas: &Canvas) -> String {
    let (w, h) = (canvas.width, canvas.height);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
         viewBox=\"0 0 {w} {h}\" font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n"
    )
}

fn image(out: &mut String, placed: &Placed) -> Result<()> {
    let png = raster::png(&placed.image)?;
    let data = base64::engine::general_purpose::STANDARD.encode(png);
    let (width, height) = placed.image.dimensions();
    let (x, y) = (placed.x, placed.y);
    push(
        out,
        format_args!(
            "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
             href=\"data:image/png;base64,{data}\"/>\n"
        ),
    );
    Ok(())
}

fn marks(out: &mut String, canvas: &Canvas) {
    for (id, mark) in canvas.marks.iter().enumerate() {
        match mark {
            Mark::Text(t) => text(out, t),
            Mark::Line {
                from,
                to,
                width,
                color,
            } => push(
                out,
                format_args!(
                    "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\" \
                     stroke-width=\"{}\"/>\n",
                    Length(from[0]),
                    Length(from[1]),
                    Length(to[0]),
                    Length(to[1]),
                    Hex(*color),
                    Length(*width),
                ),
            ),
            Mark::Circle {
                center,
                radius,
                width,
                color,
            } => push(
                out,
                format_args!(
                    "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"none\" stroke=\"{}\" \
                     stroke-width=\"{}\"/>\n",
                    Length(center[0]),
                    Length(center[1]),
                    Length(*radius),
                    Hex(*color),
                    Length(*width),
                ),
            ),
            Mark::Area { rings, color } => {
                let data: Vec<String> = rings.iter().map(|r| joined(r) + "Z").collect();
                let (data, color) = (data.concat(), Hex(*color));
                push(
                    out,
                    format_args!("<path d=\"{data}\" fill=\"{color}\" fill-rule=\"evenodd\"/>\n"),
                );
            }
            Mark::Path {
                points,
                width,
                color,
            } => push(
                out,
                format_args!(
                    "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
                     stroke-linejoin=\"round\"/>\n",
                    joined(points),
                    Hex(*color),
                    Length(*width),
                ),
            ),
            Mark::Frame { rect, color } => rectangle(
                out,
                rect,
                format_args!("fill=\"none\" stroke=\"{}\"", Hex(*color)),
            ),
            Mark::Bar { rect, scale } => bar(out, id, rect, scale),
        }
    }
}

/// Points as path data.
fn joined(points: &[[f64; 2]]) -> String {
    let mut data = String::new();
    for (k, [x, y]) in points.iter().enumerate() {
        let letter = if k == 0 { 'M' } else { 'L' };
        push(
            &mut data,
            format_args!("{letter}{} {}", Length(*x), Length(*y)),
        );
    }
    data
}

fn rectangle(out: &mut String, [x, y, w, h]: &[f64; 4], style: std::fmt::Arguments<'_>) {
    push(
        out,
        format_args!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {style}/>\n",
            Length(*x),
            Length(*y),
            Length(*w),
            Length(*h),
        ),
    );
}

fn bar(out: &mut String, id: usize, rect: &[f64; 4], scale: &ColorScale) {
    push(out, format_args!("<linearGradient id=\"scale{id}\">"));
    for i in 0..=STOPS {
        let t = f64::from(i) / f64::from(STOPS);
        let color = Hex(scale.map.at(t));
        push(
            out,
            format_args!("<stop offset=\"{t}\" stop-color=\"{color}\"/>"),
        );
    }
    out.push_str("</linearGradient>\n");
    rectangle(out, rect, format_args!("fill=\"url(#scale{id})\""));
}

fn text(out: &mut String, t: &Text) {
    let anchor = match t.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let (x, y) = (Length(t.x), Length(t.y));
    push(
        out,
        format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"",
            Length(t.size),
            Hex(t.color),
        ),
    );
    if t.bold {
        out.push_str(" font-weight=\"bold\"");
    }
    if t.upwards {
        push(out, format_args!(" transform=\"rotate(-90 {x} {y})\""));
    }
    if let Some(halo) = t.halo {
        let color = Hex(halo);
        push(
            out,
            format_args!(
                " stroke=\"{color}\" stroke-width=\"3\" stroke-linejoin=\"round\" \
                 paint-order=\"stroke\""
            ),
        );
    }
    push(out, format_args!(">{}</text>\n", escaped(&t.content)));
}

/// Text as XML character data: special characters as entities, characters that XML forbids as
/// the replacement character.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A length in pixels, to a hundredth; 0 where it is not finite.
struct Length(f64);

impl std::fmt::Display for Length {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let v = if self.0.is_finite() { self.0 } else { 0.0 };
        // Adding 0.0 turns -0.0 into 0.0.
        write!(f, "{}", (v.clamp(-1e6, 1e6) * 100.0).round() / 100.0 + 0.0)
    }
}

fn push(out: &mut String, text: std::fmt::Arguments<'_>) {
    // Writing to a string does not fail.
    let _ = out.write_fmt(text);
}
