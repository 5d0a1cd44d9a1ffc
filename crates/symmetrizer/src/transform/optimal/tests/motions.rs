//! Rigid and improper motions, with and without frames.

use super::*;

#[test]
fn rigid_and_improper_equal_brute_force() {
    let mut rng = Pcg64::seed_from_u64(11);
    for trial in 0..12 {
        let noise = [0.02, 0.3, 2.0][trial % 3];
        let thickness = [1.0, 0.02][trial / 3 % 2];
        let motion = random_motion(&mut rng);
        let improper = trial >= 6;
        let t = if improper {
            motion.after(&flip())
        } else {
            motion
        };
        let pairs = noisy(&t, 15, thickness, noise, &mut rng);
        let (fit, r0) = if improper {
            (
                optimal_improper(&pairs, None, Ambient::Space),
                flip().linear,
            )
        } else {
            (
                optimal_rigid(&pairs, None, Ambient::Space),
                Matrix3::identity(),
            )
        };
        let fit = fit.unwrap();
        assert_eq!(fit.isometry.is_improper(), improper);
        let closed = cost(&pairs, &fit.isometry);
        let brute = brute_force(&|t| cost(&pairs, t), &r0, &mut rng);
        assert!((closed - fit.cost).abs() < 1e-9 * closed.max(1e-9));
        assert!(
            closed <= brute * (1.0 + 1e-9),
            "{trial}: {closed} > {brute}"
        );
        assert!(
            brute < closed * 1.001,
            "{trial}: the descent must get there"
        );
        let total: f64 = pairs.iter().map(|x| x.weight).sum();
        assert!((fit.rms - (2.0 * closed / total).sqrt()).abs() < 1e-9);
    }
}

#[test]
fn the_conditioning_is_that_of_the_singular_values() {
    let mut rng = Pcg64::seed_from_u64(12);
    for trial in 0..20 {
        let t = random_motion(&mut rng);
        let t = if trial % 2 == 0 { t } else { t.after(&flip()) };
        let pairs = noisy(&t, 6, 0.5, [0.1, 2.0][trial / 10], &mut rng);
        let total = total_weight(&pairs).unwrap();
        let (p, q) = means(&pairs, total);
        let h: Matrix3 = pairs
            .iter()
            .map(|x| x.weight * (x.p.coords - p) * (x.q.coords - q).transpose())
            .sum();
        let s = h.singular_values();
        let d = h.determinant().signum();
        for (fit, d) in [
            (optimal_rigid(&pairs, None, Ambient::Space), d),
            (optimal_improper(&pairs, None, Ambient::Space), -d),
        ] {
            let fit = fit.unwrap();
            assert!((fit.conditioning - (s[1] + d * s[2]) / s[0]).abs() < 1e-6);
            // The value: sum |p~|^2 + |q~|^2 - 2 (S1 + S2 + d S3), halved.
            let squares: f64 = pairs
                .iter()
                .map(|x| {
                    let (p, q) = (x.p.coords - p, x.q.coords - q);
                    x.weight * (p.norm_squared() + q.norm_squared())
                })
                .sum();
            let value = 0.5 * squares - (s[0] + s[1] + d * s[2]);
            assert!((fit.cost - value).abs() < 1e-6 * squares);
        }
    }
}

#[test]
fn frames_decide_where_points_cannot_and_their_signs_mean_nothing() {
    let mut rng = Pcg64::seed_from_u64(14);
    for trial in 0..40 {
        let improper = trial % 2 == 1;
        let motion = random_motion(&mut rng);
        let t = if improper {
            motion.after(&flip())
        } else {
            motion
        };
        let pairs = noisy(&t, 2, 1.0, 0.0, &mut rng);
        let frames: Vec<FramePair> = pairs
            .iter()
            .map(|_| {
                let p = exp_rotation(&vector(&mut rng, 3.0));
                let hand = if improper { -1.0 } else { 1.0 };
                let sign = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
                let turned = t.linear * p;
                let columns = [
                    turned.column(0).into_owned(),
                    turned.column(1) * sign,
                    turned.column(2) * (sign * hand),
                ];
                let q = Matrix3::from_columns(&columns);
                FramePair { p, q }
            })
            .collect();
        let lambda = 0.05;
        let given = Some(Frames {
            pairs: &frames,
            lambda,
        });
        let fitted = if improper {
            optimal_improper(&pairs, given, Ambient::Space)
        } else {
            optimal_rigid(&pairs, given, Ambient::Space)
        };
        let fit = fitted.unwrap();
        assert!((fit.isometry.linear - t.linear).norm() < 1e-7, "{trial}");
        assert!(fit.is_well_conditioned);
        let alone = optimal_rigid(&pairs, None, Ambient::Space).unwrap();
        assert!(
            !alone.is_well_conditioned,
            "two points turn about their line"
        );
        let short = Frames {
            pairs: &frames[..1],
            lambda,
        };
        assert!(optimal_rigid(&pairs, Some(short), Ambient::Space).is_none());
    }
}

#[test]
fn frames_at_the_optimum_equal_brute_force() {
    let mut rng = Pcg64::seed_from_u64(15);
    let t = random_motion(&mut rng);
    let pairs = noisy(&t, 8, 1.0, 0.3, &mut rng);
    let lambda = 0.4;
    let frames: Vec<FramePair> = pairs
        .iter()
        .map(|_| {
            let p = exp_rotation(&vector(&mut rng, 3.0));
            let q = exp_rotation(&vector(&mut rng, 0.2)) * t.linear * p;
            FramePair { p, q }
        })
        .collect();
    let goal = |t: &Isometry| {
        let turned: f64 = pairs
            .iter()
            .zip(&frames)
            .map(|(x, f)| 0.5 * lambda * x.weight * (t.linear * f.p - f.q).norm_squared())
            .sum();
        cost(&pairs, t) + turned
    };
    let given = Some(Frames {
        pairs: &frames,
        lambda,
    });
    let fit = optimal_rigid(&pairs, given, Ambient::Space).unwrap();
    let brute = brute_force(&goal, &Matrix3::identity(), &mut rng);
    assert!(goal(&fit.isometry) <= brute * (1.0 + 1e-9));
    assert!(brute < goal(&fit.isometry) * 1.001);
}
