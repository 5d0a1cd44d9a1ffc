//! Half-turns, glides, translations, inversions, and the plane.

use super::*;
use crate::transform::kind::{Kind, turn_of};

#[test]
fn half_turn_glide_translation_and_inversion_are_optimal_within_their_kind() {
    let mut rng = Pcg64::seed_from_u64(16);
    for trial in 0..12 {
        let noise = [0.01, 0.2, 1.0][trial % 3];
        let n = vector(&mut rng, 1.0).normalize();
        let mirror = Isometry::mirror(&Plane {
            normal: n,
            offset: 0.4,
        });
        let turn = Isometry {
            linear: -mirror.linear,
            translation: vector(&mut rng, 0.3),
        };
        let half_turn = Isometry {
            translation: turn.translation - n * n.dot(&turn.translation),
            ..turn
        };
        let along = vector(&mut rng, 1.0);
        let glide = Isometry {
            translation: mirror.translation + along - n * n.dot(&along),
            ..mirror
        };
        for (t, kind) in [(half_turn, Kind::Rotation), (glide, Kind::Glide)] {
            let pairs = noisy(&t, 10, 1.0, noise, &mut rng);
            let fit = match kind {
                Kind::Rotation => optimal_half_turn(&pairs, Ambient::Space),
                _ => optimal_glide(&pairs, Ambient::Space),
            }
            .unwrap();
            assert!((cost(&pairs, &fit.isometry) - fit.cost).abs() < 1e-9);
            for _ in 0..200 {
                let near = perturbed(&fit.isometry, kind, &mut rng);
                assert!(cost(&pairs, &near) >= fit.cost - 1e-12, "{trial} {kind}");
            }
            if noise < 0.1 {
                assert!((fit.isometry.linear - t.linear).norm() < 0.1);
                assert!(fit.is_well_conditioned);
            }
        }
        let pairs = noisy(&turn, 10, 1.0, noise, &mut rng);
        let shift = optimal_translation(&pairs).unwrap();
        let inversion = optimal_inversion(&pairs).unwrap();
        for fit in [shift, inversion] {
            for _ in 0..50 {
                let mut near = fit.isometry;
                near.translation += vector(&mut rng, 0.05);
                assert!(cost(&pairs, &near) >= fit.cost);
            }
        }
    }
}

/// A half-turn or glide close to `t`.
fn perturbed(t: &Isometry, kind: Kind, rng: &mut Pcg64) -> Isometry {
    let half = kind == Kind::Rotation;
    let axis = turn_of(&if half { t.linear } else { -t.linear }).0;
    let axis = (axis + vector(rng, 0.05)).normalize();
    let linear = 2.0 * axis * axis.transpose() - Matrix3::identity();
    let linear = if half { linear } else { -linear };
    // Any translation is a glide's; a half-turn's is across the axis.
    let mean = Vector::new(2.0, -1.0, 3.0);
    let moved = t.linear * mean + t.translation + vector(rng, 0.05) - linear * mean;
    let pitch = if half {
        axis * axis.dot(&moved)
    } else {
        Vector::zeros()
    };
    Isometry {
        linear,
        translation: moved - pitch,
    }
}

#[test]
fn in_the_plane_the_z_axis_is_kept() {
    let mut rng = Pcg64::seed_from_u64(17);
    for _ in 0..20 {
        let angle: f64 = rng.random_range(-3.0..3.0);
        let linear = exp_rotation(&(Vector::z() * angle));
        let translation = Vector::new(0.3, -0.2, 0.0);
        let turned = Isometry {
            linear,
            translation,
        };
        let mirrored = turned.after(&Isometry::mirror(&Plane {
            normal: Vector::x(),
            offset: 0.2,
        }));
        let flat = |t: &Isometry, rng: &mut Pcg64| -> Vec<Correspondence> {
            noisy(t, 2, 0.0, 0.0, rng)
                .into_iter()
                .map(|x| {
                    let p = Point::new(x.p.x, x.p.y, 0.0);
                    Correspondence {
                        p,
                        q: t.apply(&p),
                        ..x
                    }
                })
                .collect()
        };
        // Two points are enough in the plane.
        let pairs = flat(&turned, &mut rng);
        let fit = optimal_rigid(&pairs, None, Ambient::Plane).unwrap();
        assert!((fit.isometry.linear - linear).norm() < 1e-12);
        assert!(fit.is_well_conditioned);
        let pairs = flat(&mirrored, &mut rng);
        for fit in [
            optimal_improper(&pairs, None, Ambient::Plane).unwrap(),
            optimal_glide(&pairs, Ambient::Plane).unwrap(),
        ] {
            assert!((fit.isometry.linear - mirrored.linear).norm() < 1e-12);
            assert!(fit.rms < 1e-12);
        }
        let half = Isometry {
            linear: Matrix3::from_diagonal(&Vector::new(-1.0, -1.0, 1.0)),
            translation,
        };
        let fit = optimal_half_turn(&flat(&half, &mut rng), Ambient::Plane).unwrap();
        assert!((fit.isometry.linear - half.linear).norm() < 1e-12 && fit.rms < 1e-12);
        assert!(fit.is_well_conditioned);
    }
}
