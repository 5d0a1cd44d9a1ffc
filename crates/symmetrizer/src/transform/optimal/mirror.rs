//! The mirror of appendix A.
//!
//! n* is the eigenvector of the algebraically smallest eigenvalue of M (`Swaps`) and
//! E = 1/2 sum w |p - q|^2 + lambda_1: midpoints should lie in the plane, differences along n.

use crate::geom::Point;
use crate::transform::isometry::Plane;
use crate::transform::optimal::{
    Ambient, Correspondence, SMALLEST_EXPLAINED, SMALLEST_GAP, Swaps, eigen_in, relative_gap,
};

/// The optimal mirror of a set of pairs and how well it is determined.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MirrorFit {
    /// The optimal plane n.x = d.
    pub plane: Plane,
    /// The symmetry cost E = sum w (|d_p|^2 + |d_q|^2) at the optimum (section 3).
    pub cost: f64,
    /// Explained fraction 1 - E / E(p = q) = -2 lambda_1 / sum w |p - q|^2: 1 for a perfect
    /// mirror, about .35 for antipodal pairs of a sphere, about .1 for random pairs.
    pub explained: f64,
    /// (lambda_2 - lambda_1) / max |lambda|: 0 where the normal is undetermined.
    pub gap: f64,
}

impl MirrorFit {
    /// The conditioning test: the normal is determined and the pairs do speak for a mirror.
    pub fn is_well_conditioned(&self) -> bool {
        self.gap > SMALLEST_GAP && self.explained > SMALLEST_EXPLAINED
    }
}

/// The mirror that minimises sum w (|d_p|^2 + |d_q|^2) over all planes (appendix A, reflection);
/// `None` without pairs of positive total weight, or where every pair is one and the same point.
pub fn optimal_mirror(pairs: &[Correspondence], ambient: Ambient) -> Option<MirrorFit> {
    let swaps = Swaps::of(pairs)?;
    let (lambda, vectors) = eigen_in(swaps.m, ambient);
    let normal = vectors.column(0).into_owned();
    let spread = swaps.spread;
    Some(MirrorFit {
        plane: Plane::through(&Point::from(swaps.centre), normal).canonical(),
        cost: (0.5 * spread + lambda[0]).max(0.0),
        explained: if spread > 0.0 {
            -2.0 * lambda[0] / spread
        } else {
            0.0
        },
        gap: relative_gap(&lambda, 0, 1),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::transform::{Isometry, displacements};
    use rand::RngExt;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::SeedableRng;

    fn cost(pairs: &[Correspondence], plane: &Plane) -> f64 {
        let t = Isometry::mirror(plane);
        pairs
            .iter()
            .map(|x| {
                let (d_p, d_q) = displacements(&x.p, &x.q, &t);
                x.weight * (d_p.norm_squared() + d_q.norm_squared())
            })
            .sum()
    }

    fn random_pairs(rng: &mut Pcg64, planar: bool, noise: f64) -> Vec<Correspondence> {
        let mut vector = |s: f64| {
            let z = if planar { 0.0 } else { 1.0 };
            Vector::new(
                s * rng.random_range(-1.0..1.0),
                s * rng.random_range(-1.0..1.0),
                z * s * rng.random_range(-1.0..1.0),
            )
        };
        let plane = Plane {
            normal: vector(1.0).normalize(),
            offset: 0.3,
        };
        let t = Isometry::mirror(&plane);
        (0..12)
            .map(|i| {
                let p = Point::from(vector(1.0));
                Correspondence {
                    p,
                    q: t.apply(&p) + vector(noise),
                    weight: 0.5 + f64::from(i % 3),
                }
            })
            .collect()
    }

    /// A descent from many starts that knows nothing of the closed form.
    fn brute_force(pairs: &[Correspondence], planar: bool, rng: &mut Pcg64) -> f64 {
        let mut best = f64::INFINITY;
        for _ in 0..40 {
            let z = if planar { 0.0 } else { 1.0 };
            let mut n = Vector::new(
                rng.random_range(-1.0..1.0),
                rng.random_range(-1.0..1.0),
                z * rng.random_range(-1.0..1.0),
            )
            .normalize();
            let mut d = rng.random_range(-1.0..1.0);
            let mut step = 0.5;
            let mut here = cost(
                pairs,
                &Plane {
                    normal: n,
                    offset: d,
                },
            );
            while step > 1e-9 {
                let mut improved = false;
                for axis in 0..(if planar { 3 } else { 4 }) {
                    for sign in [1.0, -1.0] {
                        let mut m = n;
                        let mut e = d;
                        match axis {
                            0 => e += sign * step,
                            k => m[k - 1] += sign * step,
                        }
                        let plane = Plane {
                            normal: m.normalize(),
                            offset: e,
                        };
                        let there = cost(pairs, &plane);
                        if there < here {
                            (n, d, here, improved) = (plane.normal, e, there, true);
                        }
                    }
                }
                if !improved {
                    step /= 2.0;
                }
            }
            best = best.min(here);
        }
        best
    }

    #[test]
    fn equals_brute_force_in_space_and_in_the_plane() {
        let mut rng = Pcg64::seed_from_u64(7);
        for trial in 0..12 {
            let planar = trial % 2 == 1;
            // The last third has no symmetry at all.
            let noise = [0.05, 0.4, 3.0][trial / 4];
            let pairs = random_pairs(&mut rng, planar, noise);
            let ambient = if planar {
                Ambient::Plane
            } else {
                Ambient::Space
            };
            let fit = optimal_mirror(&pairs, ambient).unwrap();
            let closed = cost(&pairs, &fit.plane);
            let brute = brute_force(&pairs, planar, &mut rng);
            assert!((closed - fit.cost).abs() < 1e-9, "the value formula");
            assert!(closed <= brute + 1e-7, "trial {trial}: {closed} > {brute}");
        }
    }

    #[test]
    fn keeps_its_digits_far_from_the_origin() {
        let mut rng = Pcg64::seed_from_u64(3);
        let pairs = random_pairs(&mut rng, false, 0.0);
        let near = optimal_mirror(&pairs, Ambient::Space).unwrap();
        let shift = Vector::new(1e6, -2e6, 5e5);
        let moved: Vec<_> = pairs
            .iter()
            .map(|x| Correspondence {
                p: x.p + shift,
                q: x.q + shift,
                ..*x
            })
            .collect();
        let far = optimal_mirror(&moved, Ambient::Space).unwrap();
        assert!(near.plane.normal.dot(&far.plane.normal) > 1.0 - 1e-15);
    }

    /// Figure 4: the optimum costs less than the centroid of the pairs' own transformations
    /// (there 69.4 against 142.6), here over many sets of five noisy pairs in the plane.
    #[test]
    fn figure_4_the_optimum_beats_the_centroid() {
        let mut rng = Pcg64::seed_from_u64(4);
        let mut worst_ratio: f64 = 1.0;
        for _ in 0..50 {
            let pairs: Vec<_> = random_pairs(&mut rng, true, 0.3)
                .into_iter()
                .take(5)
                .map(|x| Correspondence { weight: 1.0, ..x })
                .collect();
            let fit = optimal_mirror(&pairs, Ambient::Plane).unwrap();
            let centroid = theta_d_centroid(&pairs);
            let (optimum, centroid) = (cost(&pairs, &fit.plane), cost(&pairs, &centroid));
            assert!(optimum <= centroid * (1.0 + 1e-12));
            worst_ratio = worst_ratio.max(centroid / optimum);
        }
        assert!(worst_ratio > 1.5, "the comparison must be able to fail");
    }

    /// The mean of (theta, d) over the pairs' own lines, theta doubled because a line has no sign.
    fn theta_d_centroid(pairs: &[Correspondence]) -> Plane {
        let lines: Vec<Plane> = pairs
            .iter()
            .map(|x| {
                let n = (x.p - x.q).normalize();
                Plane::through(&nalgebra::center(&x.p, &x.q), n)
            })
            .collect();
        let (mut s, mut c) = (0.0, 0.0);
        for l in &lines {
            let theta = l.normal.y.atan2(l.normal.x);
            s += (2.0 * theta).sin();
            c += (2.0 * theta).cos();
        }
        let theta = s.atan2(c) / 2.0;
        let normal = Vector::new(theta.cos(), theta.sin(), 0.0);
        let offset = lines
            .iter()
            .map(|l| l.offset * l.normal.dot(&normal).signum())
            .sum::<f64>()
            / lines.len() as f64;
        Plane { normal, offset }
    }

    #[test]
    fn degenerate_sets_are_refused() {
        let same = |p: Point| Correspondence {
            p,
            q: p,
            weight: 1.0,
        };
        assert!(optimal_mirror(&[], Ambient::Space).is_none());
        assert!(optimal_mirror(&[same(Point::origin())], Ambient::Space).is_none());
        // Pure translation pairs do not speak for a mirror.
        let shifted: Vec<_> = [Vector::x(), Vector::y(), Vector::z(), Vector::zeros()]
            .iter()
            .map(|v| Correspondence {
                p: Point::from(*v * 3.0),
                q: Point::from(*v * 3.0 + Vector::new(0.2, 0.1, 0.3)),
                weight: 1.0,
            })
            .collect();
        let fit = optimal_mirror(&shifted, Ambient::Space).unwrap();
        assert!(!fit.is_well_conditioned());
        // Nor do antipodal pairs of a sphere: any plane would do.
        let mut rng = Pcg64::seed_from_u64(1);
        let antipodal: Vec<_> = (0..200)
            .map(|_| {
                let v = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0)).normalize();
                Correspondence {
                    p: Point::from(v),
                    q: Point::from(-v),
                    weight: 1.0,
                }
            })
            .collect();
        let fit = optimal_mirror(&antipodal, Ambient::Space).unwrap();
        assert!(!fit.is_well_conditioned());
    }
}
