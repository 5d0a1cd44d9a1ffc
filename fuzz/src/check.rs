//! What must hold for any bytes: they are read or refused, and what is read can be written in its own
//! format, reads back as the same shape, and makes a surface to work on or an error.

use std::io::{Cursor, Write};

use symmetrizer::Mesh;
use symmetrizer::shape::io::{self, Format};
use symmetrizer::shape::{Document, Working};

/// Reads `bytes`, writes what it has read, reads that again.
///
/// # Panics
/// Where reading or writing does, or where the second reading differs from the first.
pub fn check(bytes: &[u8], format: Format) {
    let Ok(document) = io::decode(packed(bytes, format), format) else {
        return;
    };
    let _ = io::losses(&document, format);
    let mut written = Vec::new();
    if io::encode(&document, format, &mut written).is_err() || written.is_empty() {
        return;
    }
    match io::decode(written, format) {
        Ok(again) => compare(&document, &again),
        Err(error) => panic!("what was written cannot be read: {error}"),
    }
    let _ = Working::new(&document.mesh);
}

/// A 3MF file is a package whose checksums no chance change gets past: bytes that are none are taken
/// for the model inside of one.
fn packed(bytes: &[u8], format: Format) -> Vec<u8> {
    if format != Format::ThreeMf || bytes.starts_with(b"PK") {
        return bytes.to_vec();
    }
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    archive
        .start_file("3D/3dmodel.model", options)
        .expect("a package in memory");
    archive.write_all(bytes).expect("a package in memory");
    archive.finish().expect("a package in memory").into_inner()
}

/// Bits are compared, because NaN is not equal to itself; -0 counts as 0.
fn compare(first: &Document, second: &Document) {
    let bits = |mesh: &Mesh| -> Vec<u64> {
        let coordinates = mesh.positions.iter().flat_map(|p| [p.x, p.y, p.z]);
        let one_nan = |c: f64| if c.is_nan() { f64::NAN } else { c + 0.0 };
        coordinates.map(|c| one_nan(c).to_bits()).collect()
    };
    assert_eq!(bits(&first.mesh), bits(&second.mesh), "positions");
    assert_eq!(first.mesh.polygons, second.mesh.polygons, "faces");
    assert_eq!(first.layers.len(), second.layers.len(), "layers");
    for (a, b) in first.layers.iter().zip(&second.layers) {
        assert_eq!((a.on, a.role), (b.on, b.role), "layers");
    }
}
