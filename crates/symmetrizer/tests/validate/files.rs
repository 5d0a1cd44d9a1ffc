//! The files of the collection, and meshes of any kind.

use proptest::collection::vec;
use proptest::prelude::*;
use symmetrizer::Mesh;
use symmetrizer::geom::Point;
use symmetrizer::report::to_json;
use symmetrizer::shape::Working;
use symmetrizer::shape::io;
use symmetrizer::shape::mesh::Polygons;
use symmetrizer::shape::validate::{FIRST, Findings, Kind};

use crate::common;

/// Kinds and counts in files of the collection; computed independently as well, with trimesh.
const FILES: [(&str, &[(Kind, usize)]); 11] = [
    (
        "boeing.off",
        &[
            (Kind::SamePlace, 1477),
            (Kind::Misoriented, 978),
            (Kind::Component, 1),
            (Kind::Closed, 2741),
        ],
    ),
    (
        "bones.off",
        &[
            (Kind::Component, 26),
            (Kind::Closed, 2154),
            (Kind::Crossing, 320),
        ],
    ),
    (
        "degtri_sliding.off",
        &[(Kind::ZeroArea, 4), (Kind::Border, 1)],
    ),
    (
        "elephant-with-holes.off",
        &[(Kind::Border, 106), (Kind::NonManifoldVertex, 65)],
    ),
    ("holes.off", &[(Kind::Border, 7), (Kind::Component, 1)]),
    (
        "mask_cone.off",
        &[
            (Kind::SamePlace, 30),
            (Kind::Border, 2),
            (Kind::Component, 2),
        ],
    ),
    (
        "quads_to_stitch.off",
        &[(Kind::SamePlace, 5), (Kind::Border, 1), (Kind::Quad, 8)],
    ),
    (
        "spot_dup_flip_degenerate.off",
        &[
            (Kind::RepeatedCorner, 20),
            (Kind::Duplicate, 50),
            (Kind::FlippedDuplicate, 30),
            (Kind::Closed, 2930),
        ],
    ),
    (
        "spot_mixed_orientation.ply",
        &[(Kind::Misoriented, 4367), (Kind::Closed, 2930)],
    ),
    (
        "spot_nan_inf.obj",
        &[(Kind::NonFinite, 6), (Kind::Border, 6)],
    ),
    (
        "spot_soup_unwelded.ply",
        &[
            (Kind::SamePlace, 14638),
            (Kind::Component, 1),
            (Kind::Closed, 17568),
        ],
    ),
];

#[test]
fn the_dirty_files_have_the_faults_that_they_are_known_for() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    for (name, expected) in FILES {
        let mesh = io::examine(&folder.join(name)).expect(name).mesh;
        let found = Findings::of(&mesh);
        for &(kind, count) in expected {
            let got = found.get(kind).map(|f| f.count);
            assert_eq!(got, Some(count), "{name}: {kind:?}");
        }
        assert!(found.works(), "{name}");
    }
}

#[test]
fn findings_agree_with_the_working_surface() {
    let Some(folder) = common::data("dirty") else {
        return;
    };
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .collect();
    files.sort();
    let mut judged = 0;
    for path in files {
        let Ok(document) = io::examine(&path) else {
            continue;
        };
        let found = Findings::of(&document.mesh);
        let working = Working::new(&document.mesh);
        assert_eq!(found.works(), working.is_ok(), "{}", path.display());
        if let Ok(working) = working {
            let count = working.surface.triangles.len();
            assert_eq!(found.triangles, count, "{}", path.display());
            judged += 1;
        }
    }
    assert!(judged > 30, "{judged}");
}

/// Coordinates of all sorts, few of them, so that places and faces coincide.
fn any_mesh() -> impl Strategy<Value = Mesh> {
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        1e-9,
        1e-300,
        1e300,
        f64::MAX,
        f64::NAN,
        f64::INFINITY,
    ];
    let usual = prop::sample::select(vec![0.0, 1.0, 2.0, 0.3]);
    let coordinate = prop_oneof![9 => usual, 1 => prop::sample::select(special.to_vec())];
    let positions = vec(prop::array::uniform3(coordinate), 0..12);
    let faces = vec(vec(0_u32..13, 0..6), 0..20);
    (positions, faces).prop_map(|(positions, faces)| {
        let mut polygons = Polygons::default();
        faces.iter().for_each(|f| polygons.push(f));
        Mesh {
            positions: positions.into_iter().map(Point::from).collect(),
            polygons,
        }
    })
}

proptest! {
    #[test]
    fn any_mesh_is_judged(mesh in any_mesh()) {
        let found = Findings::of(&mesh);
        prop_assert!(to_json(&found).is_ok());
        for finding in &found.findings {
            prop_assert!(finding.count > 0 || finding.kind == Kind::NoFaces);
            prop_assert!(finding.first.len() <= finding.count.min(FIRST));
            prop_assert!(!finding.action.is_empty());
        }
        if mesh.check().is_err() {
            prop_assert!(!found.works());
        }
        if let Ok(working) = Working::new(&mesh) {
            prop_assert!(found.works());
            prop_assert_eq!(found.triangles, working.surface.triangles.len());
        } else {
            prop_assert!(!found.works());
        }
    }
}
