//! Damaged, odd and hostile files of the collection: each is read or explained, none panics.

mod common;

use symmetrizer::shape::io::{self, Format};

/// What each dirty file must come to: the number of its polygons, or a part of the message.
/// Files that are not listed must only not panic.
const DIRTY: [(&str, std::result::Result<usize, &str>); 33] = [
    ("OutOfMemory.off", Err("353535235358 vertices")),
    ("P.off", Ok(25)),
    ("boeing.off", Ok(2564)),
    ("box_UTF16BE.obj", Err("UTF-16")),
    ("box_longline.obj", Ok(6)),
    ("busted.stl", Ok(3878)),
    ("comments.off", Ok(6)),
    ("corner_poly.off", Ok(8)),
    ("cube_binary_crlf.ply", Ok(12)),
    ("empty.obj", Err("no vertices")),
    ("empty.ply", Err("the file is empty")),
    ("fuze.ply", Ok(1000)),
    ("hippo1_points.ply", Ok(0)),
    ("issue623.ply", Err("vertex 0")),
    ("malformed.obj", Err("'0'")),
    ("multibody.stl", Ok(32)),
    ("nancolor.obj", Ok(12)),
    ("negative_indices.obj", Ok(6)),
    ("notenoughindices.obj", Err("line 9: a face with 2 corners")),
    ("number_formats.obj", Err("'3.1+e2'")),
    ("obj_wireframe.obj", Err("no faces")),
    ("ply_empty_header.ply", Err("no element 'vertex'")),
    ("polygonfaces.obj", Ok(1)),
    ("prim.off", Err("after the last of the 7 faces")),
    ("random_bytes.stl", Err("byte 5000")),
    ("spot_index_oob.obj", Err("line ")),
    ("spot_nan_inf.obj", Err("line 8")),
    ("spot_stl_starts_with_solid.stl", Ok(5856)),
    ("spot_stl_truncated.stl", Err("the file ends")),
    ("spot_truncated.ply", Err("the file ends")),
    ("spot_wrong_count.ply", Err("face 5856")),
    ("two_solids.stl", Ok(2)),
    ("whitespace.off", Ok(6)),
];

#[test]
fn dirty_files_are_read_or_explained() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    for (name, expected) in DIRTY {
        match (io::read(&folder.join(name)), expected) {
            (Ok(read), Ok(count)) => assert_eq!(read.mesh.polygons.len(), count, "{name}"),
            (Err(error), Err(part)) => {
                let message = error.to_string();
                assert!(
                    message.contains(part) && message.contains(name),
                    "{message}"
                );
            }
            (got, _) => panic!("{name}: {:?}", got.map(|d| d.mesh.polygons.len())),
        }
    }
}

#[test]
fn no_file_of_the_collection_panics() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    let files: Vec<_> = std::fs::read_dir(folder).unwrap().collect();
    assert!(files.len() >= DIRTY.len());
    for file in files {
        let path = file.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let _ = io::read(&path);
        // Under a wrong extension too.
        for format in Format::ALL {
            let _ = io::decode(bytes.clone(), format);
        }
    }
}
