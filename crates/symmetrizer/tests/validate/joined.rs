//! How the faces hang together.

use symmetrizer::Mesh;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::mesh::Polygons;
use symmetrizer::shape::validate::Place::{Edge, One};
use symmetrizer::shape::validate::{FIRST, Findings, Kind};

use crate::common;
use crate::{OUTWARDS, S, TETRAHEDRON, check, finding, mesh, told};

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

#[test]
fn a_seam_that_is_nearly_closed() {
    // Two squares side by side, their common edge there twice: once a hair apart.
    let square = |x: f64| {
        [
            [x, 0.0, 0.0],
            [x + S, 0.0, 0.0],
            [x + S, S, 0.0],
            [x, S, 0.0],
        ]
    };
    let faces: [&[u32]; 2] = [&[0, 1, 2, 3], &[4, 5, 6, 7]];
    let apart = |gap: f64| mesh(&[square(0.0), square(S + gap)].concat(), &faces);
    let near = Findings::of(&apart(1e-7));
    let found = finding(&near, Kind::NearSeam);
    assert_eq!(found.count, 4);
    assert!(Findings::of(&apart(0.0)).get(Kind::NearSeam).is_none());
    assert!(Findings::of(&apart(1e-3)).get(Kind::NearSeam).is_none());
}
