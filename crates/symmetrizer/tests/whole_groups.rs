//! Symmetries of the whole on shapes that are warped as a whole, so that no single motion holds as well as a copy does.

mod common;

use common::warped::{bumpy, detected, made_exact, ring, warped};
use symmetrizer::geom::Vector;
use symmetrizer::shape::Mesh;

/// The name of the group of most of the surface.
fn group(mesh: &Mesh) -> Option<String> {
    let found = detected(mesh);
    found.detection.groups.first().map(|g| g.name.clone())
}

fn tetrapod() -> Mesh {
    let at = |x: f64, y: f64, z: f64| (Vector::new(x, y, z).normalize(), 0.6, 0.35);
    let arms = [
        at(1.0, 1.0, 1.0),
        at(1.0, -1.0, -1.0),
        at(-1.0, 1.0, -1.0),
        at(-1.0, -1.0, 1.0),
    ];
    bumpy(5, 1.0, &arms)
}

/// Seven teeth, each with another one beside it, on a disc that slides along itself.
fn ratchet() -> Mesh {
    let mut teeth = ring(7, 0.0, 0.0, 0.35, 0.15);
    teeth.extend(ring(7, 0.35, 0.3, 0.3, 0.2));
    bumpy(6, 0.45, &teeth)
}

/// Three teeth above, turned against three below.
fn twisted() -> Mesh {
    let mut teeth = ring(3, 0.3, 0.15, 0.5, 0.25);
    teeth.extend(ring(3, -0.3, -0.15, 0.5, 0.25));
    bumpy(5, 0.7, &teeth)
}

#[test]
fn groups_of_the_whole_are_found_through_a_warp() {
    let star = ring(5, 0.0, 0.0, 0.6, 0.3);
    let mut above = star.clone();
    above.push((Vector::z(), 0.3, 0.4));
    for (name, mesh) in [
        ("C5v", bumpy(5, 0.5, &above)),
        ("Td", tetrapod()),
        ("D3", twisted()),
    ] {
        assert_eq!(group(&warped(&mesh)).as_deref(), Some(name));
    }
}

/// What is round about an axis, or about none, has no turn of its own.
#[test]
fn round_shapes_have_no_turns_of_their_own() {
    let potato = [
        (Vector::new(0.8, 0.6, 0.0), 0.25, 0.7),
        (Vector::new(-0.36, 0.48, 0.8), 0.2, 0.5),
        (Vector::new(0.1, -0.7, -0.7).normalize(), 0.3, 0.6),
    ];
    let pot = [(Vector::z(), 0.5, 0.5), (-Vector::z(), 0.2, 0.9)];
    for mesh in [bumpy(5, 1.0, &potato), bumpy(5, 0.8, &pot)] {
        let found = detected(&warped(&mesh));
        let turns = found.detection.groups.iter().filter(|g| g.order > 4);
        let names: Vec<&str> = turns.map(|g| g.name.as_str()).collect();
        assert!(names.is_empty(), "{names:?}");
    }
}

/// The whole is made exact under all of its group, not bent to a mirror of a part.
#[test]
fn a_warped_ratchet_is_made_exact() {
    let mesh = warped(&ratchet());
    let [before, after] = made_exact(&mesh, "C7");
    assert!(after < 0.125 * before, "{before} -> {after}");
}
