//! The step of a row from all its measured powers.

use nalgebra::{SMatrix, SVector};

use crate::geom::{Matrix3, Vector, exp_rotation, skew};
use crate::transform::{Isometry, TransformSpace};

type Matrix6 = SMatrix<f64, 6, 6>;
type Vector6 = SVector<f64, 6>;

/// Rounds of Gauss and Newton; the start is a measured step, the error of which three rounds
/// square below rounding.
const ROUNDS: usize = 4;

/// `step`^0, `step`^1, ..., `count` of them.
pub(super) fn powers_of(step: &Isometry, count: usize) -> Vec<Isometry> {
    let next = |t: &Isometry| Some(step.after(t));
    std::iter::successors(Some(Isometry::identity()), next)
        .take(count)
        .collect()
}

/// The step S, close to `start`, that minimises the sum over k of |S^k - M_k|^2 in `space`, for
/// the measured powers M_1, M_2, ...; `start` where they do not determine it.
///
/// With S turned into exp(xi) S, xi = (omega, v), the point S^k x moves by
/// sum over i < k of R^i (omega x S^(k-i) x + v), linear in xi.
pub(super) fn refit(start: &Isometry, measured: &[Isometry], space: &TransformSpace) -> Isometry {
    let mut step = *start;
    for _ in 0..ROUNDS {
        let (a, b) = normal_equations(&step, measured, space);
        let Some(xi) = a.cholesky().map(|c| c.solve(&b)) else {
            return *start;
        };
        let turn = exp_rotation(&Vector::new(xi[0], xi[1], xi[2]));
        step = Isometry {
            linear: turn * step.linear,
            translation: turn * step.translation + Vector::new(xi[3], xi[4], xi[5]),
        };
    }
    let finite = |t: &Isometry| {
        t.linear
            .iter()
            .chain(t.translation.iter())
            .all(|x| x.is_finite())
    };
    if finite(&step) { step } else { *start }
}

fn normal_equations(
    step: &Isometry,
    measured: &[Isometry],
    space: &TransformSpace,
) -> (Matrix6, Vector6) {
    let powers = powers_of(step, measured.len() + 1);
    let mut a = Matrix6::zeros();
    let mut b = Vector6::zeros();
    for x in space.probes() {
        for (k, target) in measured.iter().enumerate().map(|(i, m)| (i + 1, m)) {
            let mut by_omega = Matrix3::zeros();
            let mut by_v = Matrix3::zeros();
            for i in 0..k {
                let r = powers[i].linear;
                by_omega -= r * skew(&powers[k - i].apply(&x).coords);
                by_v += r;
            }
            let mut j = SMatrix::<f64, 3, 6>::zeros();
            j.fixed_columns_mut::<3>(0).copy_from(&by_omega);
            j.fixed_columns_mut::<3>(3).copy_from(&by_v);
            a += j.transpose() * j;
            b += j.transpose() * (target.apply(&x) - powers[k].apply(&x));
        }
    }
    (a, b)
}
