//! What is found in meshes whose faults are known, kind by kind, with counts and places.

mod common;

use symmetrizer::Mesh;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::validate::{FIRST, Finding, Findings, Kind, Place, Severity};
use symmetrizer::shape::{io, mesh::Polygons};

use Place::{Edge, One};

fn mesh(positions: &[[f64; 3]], faces: &[&[u32]]) -> Mesh {
    let mut polygons = Polygons::default();
    faces.iter().for_each(|f| polygons.push(f));
    Mesh {
        positions: positions.iter().map(|p| Point::from(*p)).collect(),
        polygons,
    }
}

/// Digits beyond single precision, so that the finding on precision stays out of the way.
const S: f64 = 1.000_000_000_1;
const TETRAHEDRON: [[f64; 3]; 4] = [[0.0; 3], [S, 0.0, 0.0], [0.0, S, 0.0], [0.0, 0.0, S]];
const OUTWARDS: [&[u32]; 4] = [&[0, 2, 1], &[0, 1, 3], &[0, 3, 2], &[1, 2, 3]];

/// Kinds and counts in the order in which they are told.
fn told(found: &Findings) -> Vec<(Kind, usize)> {
    found.findings.iter().map(|f| (f.kind, f.count)).collect()
}

#[track_caller]
fn finding(found: &Findings, kind: Kind) -> &Finding {
    found
        .get(kind)
        .unwrap_or_else(|| panic!("no {kind:?} in {:?}", told(found)))
}

#[track_caller]
fn check(mesh: &Mesh, expected: &[(Kind, usize)]) -> Findings {
    let found = Findings::of(mesh);
    assert_eq!(told(&found), expected);
    found
}

#[test]
fn nothing_is_wrong_with_a_tetrahedron() {
    let found = check(
        &mesh(&TETRAHEDRON, &OUTWARDS),
        &[(Kind::Closed, 4), (Kind::Component, 1)],
    );
    assert!(found.works());
    assert!(found.findings.iter().all(|f| f.severity == Severity::Fine));
    assert_eq!((found.vertices, found.faces, found.triangles), (4, 4, 4));
}

#[test]
fn without_faces_there_is_nothing_to_work_on() {
    for positions in [&TETRAHEDRON[..], &[]] {
        let found = check(&mesh(positions, &[]), &[(Kind::NoFaces, positions.len())]);
        assert!(!found.works());
        assert_eq!(found.size.is_some(), !positions.is_empty());
    }
}

#[test]
fn faces_that_name_nothing_are_refused() {
    let faces: Vec<&[u32]> = [
        &OUTWARDS[..],
        &[&[0, 1, 4], &[u32::MAX, 1, 2, 3], &[2, 3], &[]],
    ]
    .concat();
    let found = Findings::of(&mesh(&TETRAHEDRON, &faces));
    let missing = finding(&found, Kind::OutOfRange);
    assert_eq!(
        (missing.count, &missing.first[..]),
        (2, &[One(4), One(5)][..])
    );
    let short = finding(&found, Kind::TooFewCorners);
    assert_eq!((short.count, &short.first[..]), (2, &[One(6), One(7)][..]));
    assert_eq!(found.refusals().count(), 2);
    assert_eq!((found.faces, found.triangles), (8, 4));
    assert!(found.get(Kind::Closed).is_some(), "the rest is looked at");
}

#[test]
fn only_unusable_faces_make_no_surface() {
    let found = check(
        &mesh(&TETRAHEDRON, &[&[0, 1, 9]]),
        &[
            (Kind::NoSurface, 1),
            (Kind::OutOfRange, 1),
            (Kind::Loose, 2),
        ],
    );
    assert_eq!(found.triangles, 0);
}

#[test]
fn vertices_without_a_place_take_their_triangles_along() {
    let mut broken = mesh(&TETRAHEDRON, &OUTWARDS);
    broken.positions[3].y = f64::NAN;
    broken.positions.push(Point::new(f64::INFINITY, 0.0, 0.0));
    let found = check(
        &broken,
        &[
            (Kind::NonFinite, 2),
            (Kind::Border, 1),
            (Kind::Loose, 1),
            (Kind::Component, 1),
        ],
    );
    let what = finding(&found, Kind::NonFinite);
    assert_eq!(what.first, [One(3), One(4)]);
    assert_eq!(what.severity, Severity::Mended);
    assert!(what.what.contains("3 faces touch"), "{}", what.what);
    assert_eq!(found.triangles, 1);
    assert!(found.works());
    let size = found.size.unwrap();
    assert_eq!((size.low, size.high), ([0.0; 3], [S, S, 0.0]));
}

#[test]
fn a_broken_vertex_that_no_face_uses_is_only_noted() {
    let mut broken = mesh(&TETRAHEDRON, &OUTWARDS);
    broken.positions.push(Point::new(0.0, f64::NAN, 0.0));
    let found = Findings::of(&broken);
    assert_eq!(finding(&found, Kind::NonFinite).severity, Severity::Note);
}

#[test]
fn faces_without_area_and_faces_that_are_there_already() {
    let mut positions = TETRAHEDRON.to_vec();
    // 4 is where 1 is, 5 in the middle of 0 and 1.
    positions.extend([[S, 0.0, 0.0], [0.5 * S, 0.0, 0.0]]);
    let more: [&[u32]; 5] = [&[1, 4, 2], &[0, 5, 1], &[2, 4, 0], &[4, 2, 0], &[3, 0, 1]];
    let faces = [&OUTWARDS[..], &more].concat();
    let found = Findings::of(&mesh(&positions, &faces));
    let first = |kind| finding(&found, kind).first.clone();
    assert_eq!(first(Kind::RepeatedCorner), [One(4)]);
    assert_eq!(first(Kind::ZeroArea), [One(5)]);
    assert_eq!(first(Kind::FlippedDuplicate), [One(7)]);
    assert_eq!(first(Kind::Duplicate), [One(6), One(8)]);
    assert_eq!(first(Kind::SamePlace), [One(4)]);
    assert_eq!(found.triangles, 5);
}

#[test]
fn a_face_that_covers_part_of_another_is_told() {
    // A square, and a triangle that is half of it.
    let square = [[0.0; 3], [S, 0.0, 0.0], [S, S, 0.0], [0.0, S, 0.0]];
    let found = check(
        &mesh(&square, &[&[0, 1, 2, 3], &[2, 0, 1]]),
        &[
            (Kind::Overlap, 1),
            (Kind::Border, 1),
            (Kind::Component, 1),
            (Kind::Quad, 1),
        ],
    );
    assert_eq!(finding(&found, Kind::Overlap).first, [One(1)]);
}

#[test]
fn seams_are_told_with_what_welding_closes() {
    let mut soup = Mesh::default();
    for corners in OUTWARDS {
        let base = soup.positions.len() as u32;
        let at = corners
            .iter()
            .map(|&v| Point::from(TETRAHEDRON[v as usize]));
        soup.positions.extend(at);
        soup.polygons.push(&[base, base + 1, base + 2]);
    }
    let found = check(
        &soup,
        &[
            (Kind::SamePlace, 8),
            (Kind::Closed, 12),
            (Kind::Component, 1),
        ],
    );
    let seam = finding(&found, Kind::SamePlace);
    assert!(seam.what.contains("12 open edges, all"), "{}", seam.what);
    // 0, 2, 1; then 0, 1, 3: the first two are there again.
    assert_eq!(seam.first[..2], [One(3), One(4)]);
    assert_eq!(seam.first.len(), FIRST);
}

#[test]
fn a_turned_face_disagrees_with_its_three_neighbours() {
    let mut faces = OUTWARDS;
    faces[1] = &[1, 0, 3];
    let found = check(
        &mesh(&TETRAHEDRON, &faces),
        &[
            (Kind::Misoriented, 3),
            (Kind::Closed, 4),
            (Kind::Component, 1),
        ],
    );
    let edges = &finding(&found, Kind::Misoriented).first;
    assert_eq!(edges, &[Edge([1, 0]), Edge([0, 3]), Edge([3, 1])]);
}

#[test]
fn all_faces_turned_is_inside_out() {
    let inwards: [&[u32]; 4] = [&[0, 1, 2], &[0, 3, 1], &[0, 2, 3], &[1, 3, 2]];
    let mut far = mesh(&TETRAHEDRON, &inwards);
    for p in &mut far.positions {
        *p += Vector::new(100.0, -50.0, 3.0);
    }
    let found = check(
        &far,
        &[
            (Kind::InsideOut, 1),
            (Kind::Closed, 4),
            (Kind::Component, 1),
        ],
    );
    assert_eq!(finding(&found, Kind::InsideOut).first, [One(0)]);
}

#[test]
fn a_moebius_strip_has_one_side() {
    // Five quads; the last joins the strip's ends upside down.
    let ring = |k: u32, turn: f64| {
        let angle = f64::from(k) * std::f64::consts::TAU / 5.0;
        let out = 2.0 + 0.5 * (0.5 * angle).cos() * turn;
        [
            out * angle.cos(),
            out * angle.sin(),
            0.5 * (0.5 * angle).sin() * turn,
        ]
    };
    let positions: Vec<[f64; 3]> = (0..5).flat_map(|k| [ring(k, 1.0), ring(k, -1.0)]).collect();
    let quads: Vec<[u32; 4]> = (0..4)
        .map(|k| [2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2])
        .collect();
    let mut faces: Vec<&[u32]> = quads.iter().map(|q| &q[..]).collect();
    faces.push(&[8, 9, 0, 1]);
    let found = Findings::of(&mesh(&positions, &faces));
    assert_eq!(finding(&found, Kind::OneSided).first, [One(0)]);
    assert_eq!(finding(&found, Kind::Misoriented).first, [Edge([0, 1])]);
    let rim = finding(&found, Kind::Border);
    assert_eq!(rim.count, 1);
    assert!(rim.what.starts_with("10 edges"), "{}", rim.what);
}

#[test]
fn three_faces_on_an_edge() {
    let positions = [TETRAHEDRON.to_vec(), vec![[0.0, -S, 0.0]]].concat();
    let found = check(
        &mesh(&positions, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]),
        &[
            (Kind::NonManifoldEdge, 1),
            (Kind::Border, 1),
            (Kind::Component, 1),
        ],
    );
    assert_eq!(finding(&found, Kind::NonManifoldEdge).first, [Edge([0, 1])]);
}

#[test]
fn two_fans_at_a_vertex_are_a_pinch() {
    let mirrored: Vec<[f64; 3]> = TETRAHEDRON.iter().map(|p| p.map(|c| -c)).collect();
    let positions = [&TETRAHEDRON[..], &mirrored[1..]].concat();
    let other: [&[u32]; 4] = [&[0, 4, 5], &[0, 6, 4], &[0, 5, 6], &[4, 6, 5]];
    let faces = [OUTWARDS, other].concat();
    let found = check(
        &mesh(&positions, &faces),
        &[
            (Kind::NonManifoldVertex, 1),
            (Kind::Closed, 7),
            (Kind::Component, 1),
        ],
    );
    assert_eq!(finding(&found, Kind::NonManifoldVertex).first, [One(0)]);
}

#[test]
fn holes_loose_vertices_and_tiny_parts() {
    let grid = common::planar_grid(6);
    let mut holed = Mesh {
        positions: grid.positions.clone(),
        polygons: Polygons::default(),
    };
    // Two of the inner squares are missing.
    let kept = grid
        .polygons
        .iter()
        .enumerate()
        .filter(|(f, _)| ![7, 10].contains(f));
    kept.for_each(|(_, p)| holed.polygons.push(p));
    let base = holed.positions.len() as u32;
    let speck = [
        [5.0, 0.0, 0.0],
        [5.001, 0.0, 0.0],
        [5.0, 0.001, 0.0],
        [7.0, 7.0, 7.0],
    ];
    holed.positions.extend(speck.map(Point::from));
    holed.polygons.push(&[base, base + 1, base + 2]);
    let found = Findings::of(&holed);
    let borders = finding(&found, Kind::Border);
    assert_eq!(borders.count, 4);
    assert!(borders.what.starts_with("35 edges") && borders.what.ends_with("has 24."));
    assert_eq!(finding(&found, Kind::Component).first, [One(0), One(34)]);
    assert_eq!(finding(&found, Kind::TinyComponent).first, [One(34)]);
    assert_eq!(finding(&found, Kind::Loose).first, [One(base + 3)]);
    assert_eq!(finding(&found, Kind::Quad).count, 34);
}

#[test]
fn faces_that_pass_through_others() {
    let mut positions = TETRAHEDRON.to_vec();
    positions.extend([[0.1, 0.1, -S], [0.2, 0.1, -S], [0.1, 0.2, 0.1]]);
    let faces = [&OUTWARDS[..], &[&[4, 5, 6]]].concat();
    let found = Findings::of(&mesh(&positions, &faces));
    // It enters through face 0 and ends inside.
    assert_eq!(finding(&found, Kind::Crossing).first, [One(0), One(4)]);
}

#[test]
fn faces_that_are_not_flat_or_fold() {
    let bent = [[0.0; 3], [S, 0.0, 0.0], [S, S, 0.1], [0.0, S, 0.0]];
    let found = Findings::of(&mesh(&bent, &[&[0, 1, 2, 3]]));
    assert_eq!(finding(&found, Kind::Bent).first, [One(0)]);
    assert!(found.get(Kind::Folded).is_none());
    // Its sides cross: however it is cut, one triangle lies upside down.
    let bow = [
        [0.0; 3],
        [2.0 * S, 2.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let found = Findings::of(&mesh(&bow, &[&[0, 1, 2, 3]]));
    assert_eq!(finding(&found, Kind::Folded).first, [One(0)]);
    assert!(found.get(Kind::Bent).is_none());
}

#[test]
fn place_and_scale_are_told_but_harmless() {
    let mut moved = mesh(&TETRAHEDRON, &OUTWARDS);
    for p in &mut moved.positions {
        *p = Point::from(p.coords * 1e-8 + Vector::new(1.0, 0.0, 0.0));
    }
    let found = Findings::of(&moved);
    let far = finding(&found, Kind::FarAway);
    assert_eq!(far.severity, Severity::Fine, "double precision");
    assert_eq!(finding(&found, Kind::ExtremeSize).severity, Severity::Fine);
    let mut single = common::sphere(1);
    for p in &mut single.positions {
        *p = Point::from((p.coords + Vector::new(1e5, 0.0, 0.0)).map(|c| f64::from(c as f32)));
    }
    let found = Findings::of(&single);
    assert_eq!(finding(&found, Kind::FarAway).severity, Severity::Note);
    assert!(found.get(Kind::SinglePrecision).is_some());
    assert!(found.works());
}

#[test]
fn a_mesh_is_judged_the_same_however_it_is_placed() {
    let both = common::union(&common::sphere(2), &common::planar_grid(3));
    let kinds = |m: &Mesh| {
        let scale = [Kind::ExtremeSize, Kind::FarAway, Kind::SinglePrecision];
        let mut told = told(&Findings::of(m));
        told.retain(|(kind, _)| !scale.contains(kind));
        told
    };
    let moved = common::placed(&both, Vector::zeros(), 1e-7, Vector::zeros());
    assert_eq!(kinds(&both), kinds(&moved));
}

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
    use symmetrizer::shape::surface::Working;
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
        if found.get(Kind::NonFinite).is_none() {
            let works = Working::new(&document.mesh).is_ok();
            assert_eq!(found.works(), works, "{}", path.display());
            judged += 1;
        }
    }
    assert!(judged > 30, "{judged}");
}
