//! Files as such: round trips by extension, paths that cannot be read.

use std::path::Path;

use symmetrizer::Error;
use symmetrizer::shape::Mesh;
use symmetrizer::shape::document::{On, Role};
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

/// The files of `formats` that hold one shape.
const SPOTS: [&str; 10] = [
    "spot.obj",
    "spot.off",
    "spot.glb",
    "spot.gltf",
    "spot.3mf",
    "spot_ascii.ply",
    "spot_binary_le.ply",
    "spot_binary_be_double.ply",
    "spot_ascii.stl",
    "spot_binary.stl",
];

/// Triangle by triangle the same corners, to single precision.
#[track_caller]
fn assert_same_shape(other: &Mesh, reference: &Mesh, what: &str) {
    assert_eq!(other.positions.len(), reference.positions.len(), "{what}");
    assert_eq!(other.polygons.len(), reference.polygons.len(), "{what}");
    for ((t, _), (r, _)) in other.triangles().zip(reference.triangles()) {
        for (v, w) in t.into_iter().zip(r) {
            let (a, b) = (other.positions[v as usize], reference.positions[w as usize]);
            assert!((a - b).norm() < 1e-6, "{what}");
        }
    }
}

#[test]
fn one_shape_from_each_format_to_each() {
    let Some(folder) = common::data("formats") else {
        return;
    };
    let reference = io::read(&folder.join("spot.obj")).unwrap().mesh;
    for name in SPOTS {
        let read = io::read(&folder.join(name)).unwrap();
        assert_same_shape(&read.mesh, &reference, name);
        for format in Format::ALL.into_iter().filter(|f| *f != Format::Xyz) {
            let what = format!("{name} as {format:?}");
            let mut bytes = Vec::new();
            io::encode(&read, format, &mut bytes).unwrap();
            let again = io::decode(bytes, format).unwrap();
            assert_same_shape(&again.mesh, &reference, &what);
            if format != Format::Stl && !name.ends_with("stl") {
                assert_eq!(again.mesh.polygons, reference.polygons, "{what}");
            }
        }
        let mut bytes = Vec::new();
        io::encode(&read, Format::Xyz, &mut bytes).unwrap();
        let points = io::decode(bytes, Format::Xyz).unwrap().mesh;
        assert_eq!(points.positions, read.mesh.positions, "{name} as points");
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

/// Opening a pipe would wait for its other end, so these must be known without.
#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |path: &Path, part: &str| {
        let message = io::read(path).unwrap_err().to_string();
        assert!(message.contains(part), "{message:?} does not say {part:?}");
        message
    };
    let fifo = folder.path().join("fifo.obj");
    let made = std::process::Command::new("mkfifo").arg(&fifo).status();
    assert!(made.unwrap().success());
    let message = refused(&fifo, "this is a pipe");
    assert!(message.contains("fifo.obj") && message.contains("to a file"));
    let link = folder.path().join("link.obj");
    std::os::unix::fs::symlink(&fifo, &link).unwrap();
    refused(&link, "this is a pipe");
    let socket = folder.path().join("socket.ply");
    let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    refused(&socket, "this is a socket");
    refused(Path::new("/dev/zero"), "this is a device");
    assert!(refused(Path::new("-"), "standard input").contains("to a file"));
    refused(&folder.path().join("fifo.obj/a.obj"), "fifo.obj/a.obj: ");
}

#[test]
fn files_from_4_gib_on_are_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sparse.stl");
    std::fs::File::create(&path)
        .unwrap()
        .set_len(1 << 32)
        .unwrap();
    let message = io::read(&path).unwrap_err().to_string();
    assert!(
        message.contains("sparse.stl: the file is larger than 4 GiB"),
        "{message}"
    );
}

#[cfg(unix)]
#[test]
#[allow(clippy::print_stderr)] // A test that does nothing must not look like one that passed.
fn protected_files_are_not_read() {
    use std::os::unix::fs::PermissionsExt;

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.obj");
    std::fs::write(&path, "v 0 0 0").unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o000)).unwrap();
    if std::fs::File::open(&path).is_ok() {
        eprintln!("SKIPPED: the superuser may read everything");
        return;
    }
    let error = io::read(&path).unwrap_err();
    assert!(matches!(&error, Error::Io { path, .. } if path.ends_with("mine.obj")));
}

/// A disk with room for a few bytes.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.0 == 0 {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        let count = bytes.len().min(self.0);
        self.0 -= count;
        Ok(count)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_in_every_format() {
    for format in [
        Format::Obj,
        Format::Ply,
        Format::Off,
        Format::Stl,
        Format::ThreeMf,
        Format::Xyz,
    ] {
        let size = encoded(&pyramid(), format).len();
        for room in [0, 1, size / 2, size - 1] {
            let written = io::encode(&pyramid().into(), format, &mut Full(room));
            assert!(
                matches!(written, Err(Error::Io { .. })),
                "{format:?} {room}"
            );
        }
        io::encode(&pyramid().into(), format, &mut Full(size)).unwrap();
    }
}

#[test]
fn damaged_meshes_are_not_written() {
    let mut bad = pyramid();
    bad.polygons.push(&[0, 1, 77]);
    for format in Format::ALL {
        assert!(io::encode(&bad.clone().into(), format, &mut Vec::new()).is_err());
    }
}

#[test]
fn what_is_no_shape_file_at_all_is_recognised() {
    for (bytes, part) in [
        (&b"\n<!DOCTYPE html><title>404</title>"[..], "web page"),
        (
            b"version https://git-lfs.github.com/spec/v1\noid",
            "git lfs pull",
        ),
        (&[0x1f, 0x8b, 8, 0, 0, 0], "unpack it"),
        (b"PK\x03\x04 zipped", "unpack it"),
    ] {
        for format in Format::ALL {
            if format == Format::ThreeMf && bytes.starts_with(b"PK") {
                continue;
            }
            let message = failure(format, bytes);
            assert!(message.contains(part), "{format:?}: {message}");
        }
    }
    let message = failure(Format::Obj, b"\x7fELF and so on\nno line of it\n");
    assert!(message.contains("none of its lines"), "{message}");
}

#[test]
fn what_other_programs_may_refuse_is_named() {
    let mut unplaced = pyramid();
    unplaced.positions[4].x = f64::NAN;
    let document = unplaced.into();
    for format in [Format::Glb, Format::ThreeMf] {
        let lost = io::losses(&document, format).join("; ");
        assert!(
            lost.contains("1 vertex without a finite position"),
            "{lost}"
        );
    }
}

/// A dart: its notch must not be bridged.
#[test]
fn concave_polygons_are_cut_inside() {
    let dart = mesh(
        &[
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [0.0, 4.0, 0.0],
        ],
        &[&[1, 2, 3, 0]],
    );
    for format in [Format::Stl, Format::Glb, Format::ThreeMf] {
        let cut = decoded(encoded(&dart, format), format);
        let ups = cut.triangles().map(|(t, _)| {
            let [a, b, c] = t.map(|v| cut.positions[v as usize]);
            (b - a).cross(&(c - a)).z
        });
        let ups: Vec<f64> = ups.collect();
        assert!(ups.iter().all(|up| *up > 0.0), "{format:?}: {ups:?}");
    }
}

#[test]
fn corners_that_agree_become_vertices_where_a_format_has_no_corners() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvt 0 0.5\n\
                f 1/1/1 2/1/1 3/1/1\nf 2/1/1 4/1/1 3/1/1\n";
    let read = document(text.into(), Format::Obj);
    for format in [Format::Off, Format::Xyz, Format::Ply] {
        let lost = io::losses(&read, format).join("; ");
        assert!(!lost.contains("normals"), "{format:?}: {lost}");
        let again = document(encoded_document(&read, format), format);
        let normals = again.layer(On::Vertex, Role::Normal).expect("normals");
        assert_eq!(normals.values.get(3, 2), Some(1.0), "{format:?}");
    }
}
