//! Shapes that are nearly round: lumps of which any mirror holds to a few hundredths, and pots that are no longer quite round.

mod common;

use common::warped::{Bump, bumpy, detected, made_exact, ring, warped};
use symmetrizer::geom::Vector;
use symmetrizer::shape::Mesh;
use symmetrizer::slip::{Continuous, Slip};

/// The parts of revolution of at least nine tenths of the surface.
fn round(mesh: &Mesh) -> Vec<Continuous> {
    let mut found = detected(mesh).detection.continuous;
    found.retain(|c| c.slip == Slip::Revolution && c.area_fraction >= 0.9);
    found
}

fn bump(x: f64, y: f64, z: f64, high: f64, wide: f64) -> Bump {
    (Vector::new(x, y, z).normalize(), high, wide)
}

/// A pot with a wide foot.
fn pot() -> Vec<Bump> {
    vec![(Vector::z(), 0.5, 0.5), (-Vector::z(), 0.2, 0.9)]
}

/// Each has mirrors where these are judged in units of the tolerance alone.
#[test]
fn lumps_without_symmetry_have_none() {
    let lumps = [
        [
            bump(0.1, -0.1, 0.6, -0.14, 0.81),
            bump(0.4, 1.3, 0.9, 0.04, 0.87),
            bump(-0.6, 0.0, -2.3, -0.14, 0.76),
            bump(-0.7, -0.5, -0.3, -0.05, 0.61),
            bump(-0.1, 1.4, -0.7, 0.08, 0.71),
            bump(0.1, -0.7, -0.9, 0.09, 0.73),
        ],
        [
            bump(2.0, -2.6, 0.4, 0.05, 0.45),
            bump(-0.2, -2.0, -0.2, 0.11, 0.46),
            bump(0.2, -0.4, -0.3, 0.06, 0.77),
            bump(-0.4, 0.5, -0.2, 0.09, 0.55),
            bump(0.0, 1.5, 0.5, -0.04, 0.85),
            bump(0.5, 1.9, -0.3, -0.14, 0.75),
        ],
        [
            bump(-0.8, 0.2, -1.7, 0.12, 0.76),
            bump(-0.5, 0.4, 0.3, -0.14, 0.62),
            bump(-2.0, 1.4, 0.0, 0.14, 0.89),
            bump(0.3, -0.7, 1.4, -0.05, 0.77),
            bump(-0.4, 0.2, -1.5, 0.2, 0.84),
            bump(-0.4, 0.8, -0.9, 0.17, 0.44),
        ],
    ];
    for (k, lump) in lumps.iter().enumerate() {
        let found = detected(&bumpy(5, 1.0, lump)).detection.symmetries;
        assert!(found.is_empty(), "lump {k}: {} symmetries", found.len());
    }
}

/// A cube with rounded corners is as roundish, and has all of its mirrors.
#[test]
fn roundish_shapes_keep_their_mirrors() {
    let at = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let corners = at.iter().flat_map(|&(y, z)| [(1.0, y, z), (-1.0, y, z)]);
    let corners = corners.map(|(x, y, z)| bump(x, y, z, 0.25, 0.4));
    let cube = bumpy(5, 1.0, &corners.collect::<Vec<Bump>>());
    let groups = detected(&warped(&cube)).detection.groups;
    let name = groups.first().map(|g| g.name.clone());
    assert_eq!(name.as_deref(), Some("Oh"));
}

#[test]
fn a_warped_pot_is_made_round() {
    let mesh = warped(&bumpy(5, 0.8, &pot()));
    let [before, after] = made_exact(&mesh, "revolution");
    assert!(after < 0.125 * before, "{before} -> {after}");
}

/// What stands on a pot is no warp: it would be lost.
#[test]
fn a_carved_pot_is_not_made_round() {
    let mut bumps = pot();
    bumps.extend(ring(11, 0.25, 0.0, 0.04, 0.12));
    bumps.extend(ring(11, 0.0, 0.2, 0.04, 0.12));
    bumps.extend(ring(11, -0.25, 0.4, 0.04, 0.12));
    let mesh = bumpy(6, 0.8, &bumps);
    assert!(round(&mesh).is_empty());
    assert!(round(&warped(&mesh)).is_empty());
    assert_eq!(round(&warped(&bumpy(6, 0.8, &pot()))).len(), 1);
}
