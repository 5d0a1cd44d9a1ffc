//! Drawings: the region of the plane that a file shows, and the file itself, so that it can be
//! written deformed with all else as it was.
//!
//! SVG, bitmaps, JSON polylines and flat meshes become a [`Drawing`]. Its [`Outline`] is what the
//! stages see; [`Drawing::deformed`] takes the result home. Drawing coordinates are those of the
//! file's content with y upwards: SVG's user units inside the view box and pixels of a bitmap, both
//! with y negated.

mod bitmap;
mod crossings;
mod exact;
mod flat;
mod format;
mod fresh;
pub mod outline;
mod path;
mod region;
mod render;
mod rings;
mod svg;
mod trace;

use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result, Warning};
use crate::geom::Point;
use crate::shape::document::Document;
use crate::shape::io as shapes;

pub use exact::Turns;
pub use format::Format;
pub use outline::{Outline, Ring, Source};

/// Pixels, over which a bitmap's corners are told from its steps.
const REACH: f64 = 3.0;

/// Of the diagonal: how near bent outlines lie to their true image; in large bitmaps also how near
/// curves lie to the outline.
const FINE: f64 = 1e-4;

/// Pixels of the longer side of a written picture.
const PICTURE: u32 = 1024;

/// How files are read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reading {
    /// For bitmaps: values beyond this belong to the shape, 0 (black, see-through) to 1. Default:
    /// the middle between light and dark (Otsu 1979).
    pub threshold: Option<f64>,
}

/// A region of the plane, with the file it came from.
#[derive(Debug, Clone)]
pub struct Drawing {
    outline: Outline,
    kept: Kept,
    warnings: Vec<Warning>,
}

/// What the file was.
#[derive(Debug, Clone)]
enum Kept {
    Svg(svg::Svg),
    /// With how near curves may follow its outline, pixels.
    Bitmap(f64),
    Rings,
    Flat(Box<flat::Flat>),
}

/// Reads the drawing in the file `path`, in the format that its extension names. Nothing else is
/// opened, whatever the file refers to.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read; [`Error::Unsupported`] for an unknown extension;
/// [`Error::Params`] for a threshold out of range; [`Error::Input`] with the place in the file where
/// its content cannot be used.
pub fn read(path: &Path, reading: &Reading) -> Result<Drawing> {
    let format = Format::of_path(path)?;
    let bytes = shapes::file_bytes(path)?;
    decode(bytes, format, reading).map_err(|e| e.in_file(path))
}

/// The drawing in the bytes of a file.
///
/// # Errors
/// As for [`read`], without the file's name.
pub fn decode(bytes: Vec<u8>, format: Format, reading: &Reading) -> Result<Drawing> {
    if bytes.is_empty() {
        return Err(Error::input(
            "the file is empty",
            "export it again; it may have been cut off",
        ));
    }
    let (outline, kept, warnings) = match format.told_by(&bytes) {
        Format::Svg => {
            let read = svg::read(bytes)?;
            (read.outline, Kept::Svg(read.svg), read.warnings)
        }
        format @ (Format::Png | Format::Jpeg) => {
            let read = bitmap::read(&bytes, format, reading.threshold)?;
            (read.outline, Kept::Bitmap(read.grain), read.warnings)
        }
        Format::Json => (rings::read(&bytes)?, Kept::Rings, Vec::new()),
        Format::Obj => {
            let (flat, outline) = flat::read(bytes)?;
            (outline, Kept::Flat(Box::new(flat)), Vec::new())
        }
    };
    Ok(Drawing {
        outline,
        kept,
        warnings: warnings.into_iter().map(Warning).collect(),
    })
}

impl Drawing {
    /// The drawing that a flat mesh is; `None` where it is not flat, or has no boundary around an area.
    pub fn of_flat(document: &Document) -> Option<Self> {
        let (flat, outline) = flat::of_document(document.clone()).ok()?;
        Some(Self {
            outline,
            kept: Kept::Flat(Box::new(flat)),
            warnings: Vec::new(),
        })
    }

    /// The mesh of a drawing that came from a flat one.
    pub fn document(&self) -> Option<&Document> {
        match &self.kept {
            Kept::Flat(flat) => Some(flat.document()),
            _ => None,
        }
    }

    /// Where the vertices of a drawing that came from a flat mesh are, drawing coordinates.
    pub fn vertices(&self) -> Option<Vec<Point>> {
        match &self.kept {
            Kept::Flat(flat) => Some(flat.vertices()),
            _ => None,
        }
    }

    /// Whether its file has paths, painted one after the other.
    pub fn has_paths(&self) -> bool {
        matches!(self.kept, Kept::Svg(_))
    }

    /// Whether y runs downwards in its file, and upwards here.
    pub fn is_upside_down(&self) -> bool {
        matches!(self.kept, Kept::Svg(_) | Kept::Bitmap(_))
    }

    /// The region, in drawing coordinates.
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// What the user should know of how the file was read, in a sentence each.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// The drawing with everything in it moved by `map`, which acts on drawing coordinates (z = 0,
    /// and stays so). The map must be defined around the region, too: strokes and loose lines go along.
    ///
    /// Of an SVG file only path data changes, and of texts, images, gradients and patterns the
    /// transform; basic shapes that bend become paths, and uses that differ from what they use
    /// become groups. Curves lie within 1e-4 of the drawing's diagonal of their true image. What does
    /// not move keeps its bytes.
    ///
    /// # Errors
    /// [`Error::Numerical`] where `map` leads to what is no number.
    pub fn deformed(&self, map: &dyn Fn(Point) -> Point) -> Result<Self> {
        let kept = match &self.kept {
            Kept::Svg(svg) => Kept::Svg(svg.deformed(&self.outline, map)?),
            Kept::Flat(flat) => Kept::Flat(Box::new(flat.deformed(map)?)),
            other => other.clone(),
        };
        let outline = match self.kept {
            // The edges of a mesh stay edges.
            Kept::Flat(_) => self.outline.mapped(map),
            _ => self.outline.bent(map, FINE * self.outline.diagonal()),
        };
        if let Some(ring) = outline.rings.iter().position(|r| !r.area().is_finite()) {
            return Err(Error::Numerical {
                stage: "drawing",
                step: ring,
                what: "the deformation leads to points that are no numbers".into(),
            });
        }
        Ok(Self {
            outline,
            kept,
            warnings: self.warnings.clone(),
        })
    }

    /// The drawing's outline alone, exactly symmetric about the line n.x = offset (drawing coordinates, `normal` of
    /// length 1, z = 0): what lies on its far side is left out, and what lies on its near side is there twice, to the
    /// last digit of a written file. The line is x = 0 then.
    ///
    /// # Errors
    /// [`Error::Input`] where nothing lies on the near side.
    pub fn exact(&self, normal: crate::geom::Vector, offset: f64) -> Result<Self> {
        let text = exact::svg(&self.outline, normal, offset)?;
        decode(text.into_bytes(), Format::Svg, &Reading::default())
    }

    /// The drawing's outline alone, exactly its own copy under all of a group: of each ring the shortest stretch whose
    /// copies are all of it, and those. The centre is the origin then and one of the lines, where there are any, x = 0.
    /// Under quarter turns and lines at half a right angle to each other the digits of a written file are the same;
    /// under other turns they are those nearest to the images.
    ///
    /// # Errors
    /// [`Error::Input`] where a ring does not meet its own lines as its images would.
    pub fn exact_under(&self, group: &Turns) -> Result<Self> {
        let text = exact::svg_of_group(&self.outline, group)?;
        decode(text.into_bytes(), Format::Svg, &Reading::default())
    }

    /// The text of an SVG file: the drawing's own if it came from one, else a new one with the
    /// outline, of smooth curves if it came from a bitmap.
    pub fn svg(&self) -> String {
        let manner = match &self.kept {
            Kept::Svg(svg) => return svg.text().to_owned(),
            Kept::Bitmap(grain) => fresh::Manner::Curves {
                tolerance: grain.max(FINE * self.outline.diagonal()),
                reach: REACH,
            },
            Kept::Rings | Kept::Flat(_) => fresh::Manner::Polygons,
        };
        fresh::svg(&self.outline, manner)
    }

    /// Writes the bytes of a file in `format`: SVG as [`Drawing::svg`]; JSON, the rings in drawing
    /// coordinates; PNG, a picture of the SVG; OBJ, the mesh of a drawing that came from one.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for JPEG, for OBJ of what was no mesh, and for pictures that cannot be
    /// drawn; [`Error::Io`] without a path where `w` fails.
    pub fn encode(&self, format: Format, w: &mut dyn Write) -> Result<()> {
        let bytes = match (format, &self.kept) {
            (Format::Svg, _) => self.svg().into_bytes(),
            (Format::Json, _) => rings::text(&self.outline).into_bytes(),
            (Format::Png, _) => render::png(&self.svg(), PICTURE)?,
            (Format::Obj, Kept::Flat(flat)) => {
                return shapes::encode(flat.document(), shapes::Format::Obj, w);
            }
            (Format::Obj, _) => {
                let what = "the drawing did not come from a mesh; write .svg, .json or .png";
                return Err(Error::Unsupported(what.into()));
            }
            (Format::Jpeg, _) => {
                let what = "pictures are written as PNG; use .png";
                return Err(Error::Unsupported(what.into()));
            }
        };
        w.write_all(&bytes).map_err(|e| Error::io("", e))
    }
}

/// Writes the file `path`, in the format that its extension names; the file appears whole or not at
/// all.
///
/// # Errors
/// [`Error::Unsupported`] for an unknown extension; otherwise as for [`Drawing::encode`] and
/// [`shapes::Output`].
pub fn write(drawing: &Drawing, path: &Path) -> Result<()> {
    let format = Format::of_path(path)?;
    let mut output = shapes::Output::create(path)?;
    output.write(|w| drawing.encode(format, w))?;
    output.commit()
}
