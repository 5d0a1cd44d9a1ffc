//! Wavefront OBJ, read and written by our own code: no library keeps order, double precision,
//! polygons and values per corner together (decision 0010).
//!
//! `v` with colours or a weight, `vt`, `vn`, `f`, and the state that faces stand under: `o`, `g`,
//! `usemtl`, `s`. Lines, points, material libraries and statements that are not known are kept as
//! they stand and written after the faces.

mod corners;
mod faces;
mod lines;
mod vertices;
mod write;

use self::faces::Faces;
use self::lines::Lines;
use self::vertices::{Pool, Vertices};
use super::Strictness;
use super::text::{at_line, label, one_line, plain};
use crate::error::{Error, Result};
use crate::shape::document::{Document, Kept, Layer, ObjKept, On, Role};
use crate::shape::mesh::Mesh;

pub(super) use write::{encode, losses};

/// The document in the text of an OBJ file.
pub(super) fn decode(bytes: &[u8], strictness: Strictness) -> Result<Document> {
    let mut reader = Reader::default();
    for (line, text) in Lines::new(&plain(bytes)?) {
        reader.statement(&text, line)?;
    }
    reader.finish(strictness)
}

#[derive(Default)]
struct Reader {
    vertices: Vertices,
    textures: Pool,
    normals: Pool,
    faces: Faces,
    kept: ObjKept,
    begun: bool,
}

impl Reader {
    fn statement(&mut self, text: &[u8], line: usize) -> Result<()> {
        let mut words = words(text);
        let Some(keyword) = words.next() else {
            self.comment(text);
            return Ok(());
        };
        self.begun = true;
        match keyword {
            b"v" => self.vertices.read(words, line),
            b"vt" => self.textures.read(words, line, 1..=3),
            b"vn" => self.normals.read(words, line, 3..=3),
            b"f" | b"fo" => self.faces.read(words, self.counts(), line),
            b"o" | b"g" | b"usemtl" | b"s" => {
                let role = match keyword {
                    b"o" => Role::Object,
                    b"g" => Role::Group,
                    b"s" => Role::Smoothing,
                    _ => Role::Material,
                };
                self.faces.name(role, &rest(text));
                Ok(())
            }
            b"mtllib" => {
                self.kept.libraries.push(rest(text));
                Ok(())
            }
            b"l" | b"p" => {
                let absolute = corners::absolute(words, self.counts());
                let keyword = String::from_utf8_lossy(keyword);
                let statement = one_line(&format!("{keyword} {absolute}"));
                self.kept.statements.push(statement);
                Ok(())
            }
            _ => {
                self.kept.statements.push(label(text));
                Ok(())
            }
        }
    }

    /// Comments at the head of a file say whose it is.
    fn comment(&mut self, text: &[u8]) {
        let text = label(text);
        if !self.begun && text.starts_with('#') {
            self.kept.comments.push(text);
        }
    }

    /// How many vertices, texture coordinates and normals there are so far.
    fn counts(&self) -> [usize; 3] {
        [self.vertices.len(), self.textures.len(), self.normals.len()]
    }

    fn finish(self, strictness: Strictness) -> Result<Document> {
        let counts = self.counts();
        if counts == [0; 3] && self.faces.is_empty() && !self.kept.statements.is_empty() {
            return Err(Error::input(
                "none of its lines is one of an OBJ file",
                "is this another kind of file?",
            ));
        }
        if let Some((line, what)) = self.faces.fault(counts[0]).filter(|_| strictness.refuses()) {
            return Err(at_line(
                line,
                what,
                "the file is cut off or its face list is damaged",
            ));
        }
        let (positions, mut layers) = self.vertices.finish();
        let (polygons, [texture_rows, normal_rows], names) = self.faces.finish(counts);
        layers.extend(self.textures.layer(Role::TexCoord(0), texture_rows));
        layers.extend(self.normals.layer(Role::Normal, normal_rows));
        layers.extend(names.into_iter().map(|(role, values)| Layer {
            name: String::new(),
            on: On::Face,
            role,
            values,
        }));
        Ok(Document {
            mesh: Mesh {
                positions,
                polygons,
            },
            layers,
            kept: match self.kept == ObjKept::default() {
                true => Kept::Nothing,
                false => Kept::Obj(self.kept),
            },
        })
    }
}

/// The words of a line up to a comment.
fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
        .take_while(|word| word[0] != b'#')
}

/// What follows the keyword: names may hold spaces and `#`.
fn rest(text: &[u8]) -> String {
    let text = text.trim_ascii_start();
    let keyword = text.iter().take_while(|b| !b.is_ascii_whitespace()).count();
    label(&text[keyword..])
}
