//! Files as such: round trips by extension, paths that cannot be read.

use std::path::Path;

use symmetrizer::Error;
use symmetrizer::shape::io::{self, Format};

use crate::common;
use crate::shared::*;

#[test]
fn exact_formats_keep_everything() {
    for format in [Format::Obj, Format::Off, Format::Ply] {
        let again = decoded(encoded(&pyramid(), format), format);
        assert_eq!(again, pyramid(), "{format:?}");
    }
}

#[test]
fn files_round_trip_by_extension() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.OBJ", "b.Ply", "c.off"] {
        let path = folder.path().join(name);
        io::write(&pyramid().into(), &path).unwrap();
        assert_eq!(io::read(&path).unwrap().mesh, pyramid());
    }
}

#[test]
fn one_shape_in_every_format() {
    let Some(folder) = common::data("formats") else {
        return;
    };
    let reference = io::read(&folder.join("spot.obj")).unwrap().mesh;
    for name in [
        "spot.off",
        "spot_ascii.ply",
        "spot_binary_le.ply",
        "spot_binary_be_double.ply",
    ] {
        let other = io::read(&folder.join(name)).unwrap().mesh;
        assert_eq!(other.polygons, reference.polygons, "{name}");
        for (a, b) in other.positions.iter().zip(&reference.positions) {
            assert!((a - b).norm() < 1e-6, "{name}");
        }
    }
    for name in ["spot_ascii.stl", "spot_binary.stl"] {
        let other = io::read(&folder.join(name)).unwrap().mesh;
        assert_eq!(other.positions.len(), reference.positions.len(), "{name}");
        for ((t, _), (r, _)) in other.triangles().zip(reference.triangles()) {
            for (v, w) in t.into_iter().zip(r) {
                let (a, b) = (other.positions[v as usize], reference.positions[w as usize]);
                assert!((a - b).norm() < 1e-6, "{name}");
            }
        }
    }
}

#[test]
fn paths_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let missing = io::read(&folder.path().join("none.obj")).unwrap_err();
    assert!(matches!(&missing, Error::Io { path, .. } if path.ends_with("none.obj")));
    let directory = io::read(folder.path()).unwrap_err();
    assert!(directory.to_string().contains("directory"));
    for name in ["a.fbx", "noextension"] {
        let error = io::read(Path::new(name)).unwrap_err();
        assert!(matches!(error, Error::Unsupported(_)));
        assert!(
            error
                .to_string()
                .contains(".obj, .ply, .off, .stl, .gltf, .glb, .3mf, .xyz")
        );
    }
    let empty = folder.path().join("empty.obj");
    std::fs::write(&empty, "").unwrap();
    let message = io::read(&empty).unwrap_err().to_string();
    assert!(
        message.contains("empty.obj: the file is empty"),
        "{message}"
    );
}

#[test]
fn damaged_meshes_are_not_written() {
    let mut bad = pyramid();
    bad.polygons.push(&[0, 1, 77]);
    for format in Format::ALL {
        assert!(io::encode(&bad.clone().into(), format, &mut Vec::new()).is_err());
    }
}
