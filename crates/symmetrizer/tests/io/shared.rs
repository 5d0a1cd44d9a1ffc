//! Small documents and short calls.

use symmetrizer::geom::Point;
use symmetrizer::shape::Document;
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::mesh::{Mesh, Polygons};

pub fn mesh(positions: &[[f64; 3]], faces: &[&[u32]]) -> Mesh {
    let mut polygons = Polygons::default();
    for face in faces {
        polygons.push(face);
    }
    Mesh {
        positions: positions.iter().map(|&p| Point::from(p)).collect(),
        polygons,
    }
}

/// A pyramid over a square, with an awkward number and a vertex that no face uses.
pub fn pyramid() -> Mesh {
    mesh(
        &[
            [0.0, 0.0, 0.1 + 0.2],
            [1.0, 0.0, -1e-300],
            [1.0, 1.0, 1.0 / 3.0],
            [0.0, 1.0, 500_000.125],
            [9.0, 9.0, 9.0],
            [0.5, 0.5, 1.0],
        ],
        &[
            &[0, 3, 2, 1],
            &[0, 1, 5],
            &[1, 2, 5],
            &[2, 3, 5],
            &[3, 0, 5],
        ],
    )
}

pub fn encoded(mesh: &Mesh, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(&Document::from(mesh.clone()), format, &mut bytes).unwrap();
    bytes
}

pub fn faces(mesh: &Mesh) -> Vec<&[u32]> {
    mesh.polygons.iter().collect()
}

pub fn failure(format: Format, bytes: &[u8]) -> String {
    io::decode(bytes.to_vec(), format).unwrap_err().to_string()
}

#[track_caller]
pub fn fails_with(format: Format, text: &str, parts: &[&str]) {
    let message = failure(format, text.as_bytes());
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

/// The mesh in the bytes of a good file.
pub fn decoded(bytes: Vec<u8>, format: Format) -> Mesh {
    document(bytes, format).mesh
}

/// The document in the bytes of a good file.
pub fn document(bytes: Vec<u8>, format: Format) -> Document {
    io::decode(bytes, format).unwrap()
}

/// The bytes of a document in a format.
pub fn encoded_document(document: &Document, format: Format) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::encode(document, format, &mut bytes).unwrap();
    bytes
}
