//! The rod between two vertices with a rotation each (Levi & Gotsman 2015).
//!
//! E_ij = |x_ij - R_i p_ij|^2 / 2 + |x_ij - R_j p_ij|^2 / 2 + a |R_i - R_j|^2: two springs, each from where one
//! vertex thinks that the other is, and one that turns both alike.

use crate::deform::elastic::{Blocks, Motion, Spring};
use crate::deform::primo::joint::axial;
use crate::deform::solver::{Coupling, Twist};
use crate::geom::{Matrix3, Vector};

/// A rod between vertices `i` and `j`.
#[derive(Debug, Clone)]
pub struct Rod {
    /// One vertex.
    pub i: usize,
    /// The other vertex.
    pub j: usize,
    /// k_ij with the stiffness of both in it.
    pub weight: f64,
    /// a, L^2.
    pub smoothing: f64,
}

impl Rod {
    /// The gaps (x_i - x_j) - R_i p_ij and - R_j p_ij, with R_i p_ij and R_j p_ij.
    fn gaps(&self, motions: &[Motion]) -> [(Vector, Vector); 2] {
        let (i, j) = (&motions[self.i], &motions[self.j]);
        let p = i.rest_center - j.rest_center;
        let x = i.center - j.center;
        [i, j].map(|m| {
            let turned = m.rotation * p;
            (x - turned, turned)
        })
    }
}

impl Spring for Rod {
    fn ends(&self) -> [usize; 2] {
        [self.i, self.j]
    }

    fn weight(&self) -> f64 {
        self.weight
    }

    fn set_weight(&mut self, weight: f64) {
        self.weight = weight;
    }

    fn energy(&self, motions: &[Motion]) -> f64 {
        let gaps = self.gaps(motions);
        let strain: f64 = gaps.iter().map(|(e, _)| 0.5 * e.norm_squared()).sum();
        let turn = motions[self.i].rotation - motions[self.j].rotation;
        self.weight * (strain + self.smoothing * turn.norm_squared())
    }

    fn blocks(&self, motions: &[Motion]) -> Blocks {
        let (r_i, r_j) = (&motions[self.i].rotation, &motions[self.j].rotation);
        let [(e_i, at_i), (e_j, at_j)] = self.gaps(motions);
        let (half, alike) = (0.5 * self.weight, self.weight * self.smoothing);
        let (none, zero) = (Matrix3::zeros(), Vector::zeros());
        let across = alike * r_j * r_i.transpose();
        let own = Matrix3::identity() * alike;
        // Vertex i's spring ends at arm -R_i p_ij from i and at j itself; that of j at i and at R_j p_ij.
        let (p, q) = (-at_i, at_j);
        let mut hessian = [
            Coupling::new(half, &own, &p, &p),
            Coupling::new(half, &own, &q, &q),
            -Coupling::new(half, &across, &p, &zero),
        ];
        hessian[0] += Coupling::new(half, &none, &zero, &zero);
        hessian[1] += Coupling::new(half, &none, &zero, &zero);
        hessian[2] += -Coupling::new(half, &none, &zero, &q);
        let torque = axial(&across);
        let force = half * (e_i + e_j);
        let wrench = |m: Vector, f: Vector| Twist::new(m.x, m.y, m.z, f.x, f.y, f.z);
        Blocks {
            hessian,
            gradient: [
                wrench(half * p.cross(&e_i) - torque, force),
                wrench(torque - half * q.cross(&e_j), -force),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn the_gradient_equals_finite_differences() {
        let mut rng = Pcg64::seed_from_u64(7);
        let rod = Rod {
            i: 0,
            j: 1,
            weight: 0.7,
            smoothing: 0.02,
        };
        let ends = [Point::new(0.1, 0.2, -0.1), Point::new(0.3, 0.1, 0.2)];
        for _ in 0..20 {
            let motions = ends.map(|x| {
                let twist = Twist::from_fn(|_, _| 0.5 * rng.random_range(-1.0..1.0));
                Motion::rest(x).moved(&twist)
            });
            let gradient = rod.blocks(&motions).gradient;
            for (which, axis) in (0..12).map(|k| (k / 6, k % 6)) {
                let at = |h: f64| {
                    let mut moved = motions;
                    let mut twist = Twist::zeros();
                    twist[axis] = h;
                    moved[which] = moved[which].moved(&twist);
                    rod.energy(&moved)
                };
                // The blocks belong to half the energy.
                let numeric = (at(1e-6) - at(-1e-6)) / 4e-6;
                let exact = gradient[which][axis];
                assert!((numeric - exact).abs() < 1e-7, "{numeric} {exact}");
            }
        }
    }
}
