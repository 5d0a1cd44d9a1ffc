//! Every odd, damaged and hostile file of the collection, and every format: what a run makes of it.

mod common;

use std::path::Path;
use std::sync::Mutex;

use common::{Desk, data};

/// What a run makes of a file.
#[derive(Debug, Clone, Copy)]
enum Comes {
    /// Exit 0: a result with the same number of vertices and faces.
    Out,
    /// Exit 1: no symmetry, and no file.
    Asymmetric,
    /// Exit 2, with this in the message besides the file's name, and no file.
    Refused(&'static str),
}

use Comes::{Asymmetric, Out, Refused};

const POINTS: Comes = Refused("but no faces (symmetries of a point cloud can be detected only");

const DIRTY: [(&str, Comes); 69] = [
    (
        "OutOfMemory.off",
        Refused("line 2: the header claims 353535235358 vertices"),
    ),
    ("P.off", Out),
    ("ballA.off", Out),
    ("blobby-shuffled.off", Asymmetric),
    ("boeing.off", Out),
    ("bones.off", Asymmetric),
    ("box.3mf", Out),
    ("box_UTF16BE.obj", Out),
    ("box_longline.obj", Out),
    ("busted.stl", Out),
    ("chair_model.obj", Out),
    ("comments.off", Out),
    ("concave_polygon.obj", Out),
    ("corner_poly.off", Out),
    ("cube_binary_crlf.ply", Out),
    ("degtri_sliding.off", Out),
    ("elephant-with-holes.off", Out),
    ("empty.obj", Refused("the mesh has no vertices")),
    ("empty.ply", Refused("the file is empty")),
    ("flat_square.obj", Out),
    ("fuze.ply", Out),
    ("hippo1_points.ply", POINTS),
    ("holes.off", Out),
    (
        "issue623.ply",
        Refused("line 15: vertex 0 (counted from 0): '7.941797'"),
    ),
    ("kitten_points.xyz", POINTS),
    ("malformed.obj", Refused("line 28: the face corner '0'")),
    ("malformed_index_oob.3mf", Asymmetric),
    ("mask_cone.off", Out),
    ("mirror.ply", Out),
    ("multibody.stl", Asymmetric),
    ("nancolor.obj", Out),
    ("negative_indices.obj", Out),
    ("nested.glb", Asymmetric),
    ("no_indices_3storybuilding.glb", Out),
    ("not_convex.obj", Out),
    (
        "notenoughindices.obj",
        Refused("line 9: a face with 2 corners"),
    ),
    (
        "number_formats.obj",
        Refused("line 11: '3.1+e2' is not a number"),
    ),
    ("obj_wireframe.obj", POINTS),
    ("one_triangle.off", Out),
    ("oni_points.ply", POINTS),
    ("ply_empty_header.ply", Refused("no element 'vertex'")),
    ("point_cloud.obj", POINTS),
    ("points_bin.ply", POINTS),
    ("polygonfaces.obj", Out),
    (
        "prim.off",
        Refused("line 24: '3' after the last of the 7 faces"),
    ),
    ("pyramids.3mf", Out),
    ("quad_skin.glb", Out),
    ("quads_to_stitch.off", Out),
    ("random_bytes.stl", Refused("byte 5000: the file ends")),
    ("soup.stl", Asymmetric),
    ("sphereWithHole.stl", Out),
    ("spider_ascii.stl", Out),
    ("spot_10pct_faces_missing.ply", Out),
    ("spot_dup_flip_degenerate.off", Out),
    ("spot_huge_coords.obj", Out),
    (
        "spot_index_oob.obj",
        Refused("line 103: the face corner '0'"),
    ),
    ("spot_mixed_orientation.ply", Out),
    ("spot_nan_inf.obj", Out),
    ("spot_points.xyz", POINTS),
    ("spot_single_view_scan.ply", Out),
    ("spot_soup_unwelded.ply", Out),
    ("spot_stl_starts_with_solid.stl", Out),
    (
        "spot_stl_truncated.stl",
        Refused("byte 146442: the file ends"),
    ),
    ("spot_tiny.ply", Out),
    (
        "spot_truncated.ply",
        Refused("the file ends within or before face 2425"),
    ),
    (
        "spot_wrong_count.ply",
        Refused("the file ends within or before face 5856"),
    ),
    ("two_solids.stl", Asymmetric),
    ("whitespace.off", Out),
    ("wuson.off", Out),
];

const FORMATS: [(&str, Comes); 13] = [
    ("cesium_man_skinned.glb", Out),
    (
        "gltf_buffer_0.bin",
        Refused("files of type .bin are not supported"),
    ),
    (
        "gltf_buffer_1.bin",
        Refused("files of type .bin are not supported"),
    ),
    ("spot.3mf", Out),
    ("spot.glb", Out),
    ("spot.gltf", Out),
    ("spot.obj", Out),
    ("spot.off", Out),
    ("spot_ascii.ply", Out),
    ("spot_ascii.stl", Out),
    ("spot_binary.stl", Out),
    ("spot_binary_be_double.ply", Out),
    ("spot_binary_le.ply", Out),
];

#[test]
fn every_file_comes_out_or_is_explained() {
    let (Some(dirty), Some(formats)) = (data("dirty"), data("formats")) else {
        return;
    };
    let all = DIRTY.map(|(name, comes)| (format!("{dirty}/{name}"), comes));
    let more = FORMATS.map(|(name, comes)| (format!("{formats}/{name}"), comes));
    let todo = Mutex::new(all.into_iter().chain(more).rev().collect::<Vec<_>>());
    let wrong = Mutex::new(Vec::new());
    let work = || {
        let next = || todo.lock().unwrap().pop();
        while let Some((path, comes)) = next() {
            if let Err(what) = run(&path, comes) {
                wrong.lock().unwrap().push(format!("{path}: {what}"));
            }
        }
    };
    std::thread::scope(|s| {
        s.spawn(work);
        s.spawn(work);
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_tables_hold_every_file() {
    for (folder, count) in [("dirty", DIRTY.len()), ("formats", FORMATS.len())] {
        if let Some(folder) = data(folder) {
            assert_eq!(std::fs::read_dir(folder).unwrap().count(), count);
        }
    }
}

/// Files whose bends are left: to look for them again and again would take a third of the time of all files.
const NOT_FOR_BENDS: [&str; 4] = [
    "busted.stl",
    "elephant-with-holes.off",
    "polygonfaces.obj",
    "spot_single_view_scan.ply",
];

/// Runs on a file with the defaults, on one thread, because two files are worked on at a time.
fn run(path: &str, comes: Comes) -> Result<(), String> {
    let desk = Desk::new();
    let extension = Path::new(path).extension().unwrap().to_str().unwrap();
    // Points and unknown types have no result to write: the extension must only be a good one.
    let output = match extension {
        "xyz" | "bin" => "out.ply".to_owned(),
        other => format!("out.{other}"),
    };
    let mut args = vec![
        "run",
        path,
        "-o",
        &output,
        "--report",
        "r.json",
        "--threads",
        "1",
    ];
    let name = Path::new(path).file_name().unwrap().to_str().unwrap();
    if NOT_FOR_BENDS.contains(&name) {
        args.push("--no-straighten");
    }
    let done = desk.symmetrize(&args).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    let written = desk.path(&output).exists();
    let as_expected = match comes {
        Out => done.status.code() == Some(0) && written,
        Asymmetric => done.status.code() == Some(1) && !written,
        Refused(part) => {
            let named = said.contains(part) && said.contains(name);
            done.status.code() == Some(2) && named && desk.files().is_empty()
        }
    };
    if !as_expected {
        return Err(format!("exit {:?}, {said}", done.status.code()));
    }
    match (comes, extension) {
        (Out, _) => same_structure(path, &desk.path(&output)),
        _ => Ok(()),
    }
}

/// The result has the input's vertices and faces, and everything else that it says.
fn same_structure(input: &str, output: &Path) -> Result<(), String> {
    let [before, after] = [Path::new(input), output].map(symmetrizer::shape::io::read);
    let (before, after) = (before.unwrap(), after.map_err(|e| e.to_string())?);
    if before.mesh.polygons != after.mesh.polygons {
        return Err("other faces".into());
    }
    if before.mesh.positions.len() != after.mesh.positions.len() {
        return Err("other vertices".into());
    }
    for (a, b) in before.layers.iter().zip(&after.layers) {
        // Debug output, because NaN is not equal to itself.
        if !a.role.turns() && format!("{a:?}") != format!("{b:?}") {
            return Err(format!("the layer {:?} {} differs", a.role, a.name));
        }
    }
    match before.layers.len() == after.layers.len() {
        true => Ok(()),
        false => Err("other layers".into()),
    }
}
