//! Faces and vertices one by one; place and scale.

use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::validate::{Findings, Kind, Place::One, Severity};

use crate::common;
use crate::{OUTWARDS, S, TETRAHEDRON, check, finding, mesh};

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
    assert!(far.what.contains("digits enough"), "{}", far.what);
    let size = finding(&found, Kind::ExtremeSize);
    assert!(size.action.contains("not affected") && far.action == size.action);
    let mut single = common::sphere(1);
    for p in &mut single.positions {
        *p = Point::from((p.coords + Vector::new(1e5, 0.0, 0.0)).map(|c| f64::from(c as f32)));
    }
    let found = Findings::of(&single);
    let far = finding(&found, Kind::FarAway);
    assert!(far.what.contains("single precision"), "{}", far.what);
    assert!(found.get(Kind::SinglePrecision).is_some());
    assert!(found.works());
}
