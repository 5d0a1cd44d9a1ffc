//! A page of pictures, text, lines and circles that becomes an SVG document or a PNG file: one
//! layout, two outputs.

use image::RgbaImage;

use crate::error::Result;
use crate::picture::color::ColorScale;
use crate::picture::{raster, svg};

/// Dark grey for text, sRGB.
pub const INK: [u8; 3] = [34, 38, 46];
/// Lighter grey for captions and ticks.
pub const GREY: [u8; 3] = [110, 116, 128];
/// Light grey for frames.
pub const PALE: [u8; 3] = [208, 212, 220];

/// Where a text stands relative to its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts there.
    Start,
    /// The text's middle is there.
    Middle,
    /// The text ends there.
    End,
}

/// One line of text; lengths in pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// The words; any characters.
    pub content: String,
    /// Horizontal position of the anchor.
    pub x: f64,
    /// The baseline.
    pub y: f64,
    /// Font size.
    pub size: f64,
    /// Which part of the text is at `x`.
    pub anchor: Anchor,
    /// sRGB.
    pub color: [u8; 3],
    /// Whether the text is bold.
    pub bold: bool,
    /// Whether the text reads upwards.
    pub upwards: bool,
    /// Colour of a halo that keeps it legible on pictures.
    pub halo: Option<[u8; 3]>,
}

impl Text {
    /// Plain dark text that starts at (x, y).
    pub fn new(content: impl Into<String>, x: f64, y: f64, size: f64) -> Self {
        Self {
            content: content.into(),
            x,
            y,
            size,
            anchor: Anchor::Start,
            color: INK,
            bold: false,
            upwards: false,
            halo: None,
        }
    }

    /// The same text about another anchor.
    pub fn anchored(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// The same text in another colour.
    pub fn colored(self, color: [u8; 3]) -> Self {
        Self { color, ..self }
    }

    /// The same text in bold.
    pub fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    /// The same text, reading upwards.
    pub fn upwards(self) -> Self {
        Self {
            upwards: true,
            ..self
        }
    }

    /// The same text, smaller or shortened with an ellipsis where it is wider than `width` pixels.
    pub fn within(mut self, width: f64) -> Self {
        let shrink = (width / self.width()).clamp(0.75, 1.0);
        self.size *= shrink;
        if self.width() > width {
            while !self.content.is_empty() && self.width() + self.size > width {
                self.content.pop();
            }
            self.content.push('…');
        }
        self
    }

    /// The width, pixels, estimated from DejaVu Sans.
    pub fn width(&self) -> f64 {
        let heavy = if self.bold { 1.1 } else { 1.0 };
        let em: f64 = self.content.chars().map(advance).sum();
        heavy * em * self.size
    }
}

/// The advance of a character in em, rounded up by class.
fn advance(c: char) -> f64 {
    match c {
        ' ' | '.' | ',' | ':' | ';' | '\'' | '|' | 'i' | 'j' | 'l' | 'I' | '!' => 0.33,
        '(' | ')' | '[' | ']' | 'f' | 'r' | 't' | '-' | '/' => 0.4,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '→' | '…' => 0.95,
        'A'..='Z' => 0.71,
        c if c.is_ascii() => 0.63,
        _ => 1.0,
    }
}

/// Something drawn on top of the pictures; lengths in pixels.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Mark {
    Text(Text),
    Line {
        from: [f64; 2],
        to: [f64; 2],
        width: f64,
        color: [u8; 3],
    },
    Circle {
        center: [f64; 2],
        radius: f64,
        width: f64,
        color: [u8; 3],
    },
    /// What is inside an odd number of closed rings.
    Area {
        rings: Vec<Vec<[f64; 2]>>,
        color: [u8; 3],
    },
    /// Joined lines; closed ones end where they began.
    Path {
        points: Vec<[f64; 2]>,
        width: f64,
        color: [u8; 3],
    },
    /// The outline of a rectangle with corner (x, y) and size (w, h).
    Frame {
        rect: [f64; 4],
        color: [u8; 3],
    },
    /// A rectangle filled with a colour scale from left to right.
    Bar {
        rect: [f64; 4],
        scale: ColorScale,
    },
}

impl Mark {
    /// The same further down, pixels.
    fn lowered(mut self, by: f64) -> Self {
        match &mut self {
            Self::Text(text) => text.y += by,
            Self::Line { from, to, .. } => {
                from[1] += by;
                to[1] += by;
            }
            Self::Circle { center, .. } => center[1] += by,
            Self::Area { rings, .. } => rings.iter_mut().flatten().for_each(|x| x[1] += by),
            Self::Path { points, .. } => points.iter_mut().for_each(|x| x[1] += by),
            Self::Frame { rect, .. } | Self::Bar { rect, .. } => rect[1] += by,
        }
        self
    }
}

/// A picture with its top left corner, whole pixels.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub x: u32,
    pub y: u32,
    pub image: RgbaImage,
}

/// A white page; lengths in pixels from the top left. Pictures lie under everything else.
#[derive(Debug, Clone)]
pub struct Canvas {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) images: Vec<Placed>,
    pub(super) marks: Vec<Mark>,
}

impl Canvas {
    /// An empty page.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width: width.max(1),
            height: height.max(1),
            images: Vec::new(),
            marks: Vec::new(),
        }
    }

    /// Page width, pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Page height, pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Places a picture with its top left corner at (x, y).
    pub fn image(&mut self, x: u32, y: u32, image: RgbaImage) {
        if image.width() > 0 && image.height() > 0 {
            self.images.push(Placed { x, y, image });
        }
    }

    /// This page and `other` below it.
    pub fn above(mut self, other: Self) -> Self {
        let down = self.height;
        let images = other.images.into_iter();
        self.images
            .extend(images.map(|i| Placed { y: i.y + down, ..i }));
        let marks = other.marks.into_iter();
        self.marks.extend(marks.map(|m| m.lowered(down.into())));
        self.width = self.width.max(other.width);
        self.height += other.height;
        self
    }

    /// Writes a line of text.
    pub fn text(&mut self, text: Text) {
        self.marks.push(Mark::Text(text));
    }

    /// Draws a straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], width: f64, color: [u8; 3]) {
        self.marks.push(Mark::Line {
            from,
            to,
            width,
            color,
        });
    }

    /// Draws a ring.
    pub fn circle(&mut self, center: [f64; 2], radius: f64, width: f64, color: [u8; 3]) {
        self.marks.push(Mark::Circle {
            center,
            radius,
            width,
            color,
        });
    }

    /// Fills what is inside an odd number of closed rings.
    pub fn area(&mut self, rings: Vec<Vec<[f64; 2]>>, color: [u8; 3]) {
        self.marks.push(Mark::Area { rings, color });
    }

    /// Draws joined lines.
    pub fn path(&mut self, points: Vec<[f64; 2]>, width: f64, color: [u8; 3]) {
        self.marks.push(Mark::Path {
            points,
            width,
            color,
        });
    }

    /// Draws the outline of a rectangle: x, y, width, height.
    pub fn frame(&mut self, rect: [f64; 4], color: [u8; 3]) {
        self.marks.push(Mark::Frame { rect, color });
    }

    /// Draws a legend: the scale as a bar in the rectangle x, y, width, height, round numbers
    /// below it, and `label` above it.
    pub fn legend(&mut self, rect: [f64; 4], scale: ColorScale, label: &str) {
        let [x, y, width, height] = rect;
        self.marks.push(Mark::Bar { rect, scale });
        self.frame(rect, PALE);
        let middle = x + width / 2.0;
        self.text(
            Text::new(label, middle, y - 8.0, 14.0)
                .anchored(Anchor::Middle)
                .colored(GREY),
        );
        let ticks = crate::picture::ticks::labelled_ticks(scale.low, scale.high, 5);
        for (value, label) in ticks {
            let at = x + width * (value - scale.low) / (scale.high - scale.low);
            self.line([at, y + height], [at, y + height + 5.0], 1.0, GREY);
            let text = Text::new(label, at, y + height + 19.0, 13.0);
            self.text(text.anchored(Anchor::Middle).colored(GREY));
        }
    }

    /// The page as an SVG document, pictures included.
    ///
    /// # Errors
    /// [`crate::Error::Unsupported`] where a picture cannot be encoded.
    pub fn to_svg(&self) -> Result<String> {
        svg::document(self)
    }

    /// The page as the bytes of a PNG file.
    ///
    /// # Errors
    /// [`crate::Error::Unsupported`] where the page is too large to be drawn.
    pub fn to_png(&self) -> Result<Vec<u8>> {
        raster::png(&self.to_image()?)
    }

    /// The page as a picture, for use inside another one.
    ///
    /// # Errors
    /// As [`Canvas::to_png`].
    pub fn to_image(&self) -> Result<RgbaImage> {
        raster::image(self)
    }
}
