//! Mean shift with the Epanechnikov kernel: modes of the votes' density, and their heights.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::{SMatrix, SVector};
use rayon::prelude::*;

use crate::geom::PointIndex;
use crate::pair::Pair;
use crate::transform::TransformSpace;
use crate::transform::space::Phi;

/// How votes are clustered.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClusterParams {
    /// Kernel radius h as rms displacement, fraction of L. 0.1, ours: at half of it the bunny's
    /// body splits along a ridge.
    pub bandwidth: f64,
}

impl Default for ClusterParams {
    fn default() -> Self {
        Self { bandwidth: 0.1 }
    }
}

/// A mode of the density of votes.
#[derive(Debug, Clone)]
pub struct Cluster {
    /// The mode in transformation space.
    pub mode: Phi,
    /// Kernel density at the mode: the sum of w (1 - |phi - mode|^2 / h^2) over its votes.
    pub height: f64,
    /// Indices of the votes within h, increasing.
    pub votes: Vec<u32>,
}

/// Votes in transformation space with an index for range queries.
#[derive(Clone)]
pub struct Votes {
    phi: Vec<Phi>,
    weights: Vec<f64>,
    /// Leading principal axes of phi: distances along them never exceed those in all twelve, so a
    /// range query in them finds a superset, exactly filtered after.
    axes: SMatrix<f64, LEADING, 12>,
    /// A place is no start where another one within this share of the kernel's radius is denser.
    beside: f64,
    index: Arc<PointIndex<LEADING>>,
}

const LEADING: usize = 6;

/// Steps of a climb at the most, and the last step's length in units of the kernel's radius: where modes are told apart, and at
/// the end.
const STEPS: usize = 50;
const NEARLY: f64 = 1e-2;
const AT_REST: f64 = 1e-4;
/// How much further than the kernel's radius votes are looked for once steps are shorter than that, in units of it.
const SLACK: f64 = 0.12;
/// The share of the kernel's ball in which there is one start at the most, where it is densest: of many dimensions a ball of half the
/// radius holds next to nothing.
const BESIDE: f64 = 0.125;
/// Starts at the most, the densest: several times the modes that are looked at.
const STARTS: usize = 1500;
/// With fewer votes within the kernel's radius a place is no start: a mode of as many as a symmetry has is higher elsewhere.
const SOME: usize = 3;

impl Votes {
    /// Embeds the pairs' transformations, which have so many degrees of `freedom`, in `space`.
    pub fn new(pairs: &[Pair], space: &TransformSpace, freedom: u32) -> Self {
        let phi: Vec<Phi> = pairs.par_iter().map(|v| space.embed(&v.q_from_p)).collect();
        let weights = pairs.iter().map(|v| v.weight).collect();
        let axes: SMatrix<f64, LEADING, 12> = leading_axes(&phi);
        let short: Vec<[f64; LEADING]> = phi.iter().map(|x| (axes * x).into()).collect();
        Self {
            index: Arc::new(PointIndex::new(&short)),
            phi,
            weights,
            axes,
            beside: BESIDE.powf(1.0 / f64::from(freedom)).max(0.5),
        }
    }

    /// The same votes, those of `pairs`, with their first weights.
    pub fn anew(&self, pairs: &[Pair]) -> Self {
        Self {
            weights: pairs.iter().map(|v| v.weight).collect(),
            ..self.clone()
        }
    }

    /// The number of votes.
    pub fn len(&self) -> usize {
        self.phi.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.phi.is_empty()
    }

    /// The votes as points of transformation space.
    pub fn points(&self) -> &[Phi] {
        &self.phi
    }

    /// The votes' weights, 0 for those explained away.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Takes the votes for which `explained` holds out of every later count.
    pub fn explain_away(&mut self, explained: impl Fn(usize) -> bool) {
        for (i, w) in self.weights.iter_mut().enumerate() {
            if explained(i) {
                *w = 0.0;
            }
        }
    }

    /// The kernel density at a point: the sum of w (1 - |phi - x|^2 / h^2).
    pub fn density(&self, x: &Phi, h: f64) -> f64 {
        self.within(x, h)
            .map(|(i, d2)| self.weights[i] * (1.0 - d2 / (h * h)))
            .sum()
    }

    /// All modes, highest first: mean shift from every vote on a coarse net, modes closer than h
    /// made one; those that are left are climbed to the end.
    pub fn clusters(&self, params: &ClusterParams) -> Vec<Cluster> {
        let h = params.bandwidth;
        let starts = self.starts(h);
        let near = starts
            .into_par_iter()
            .map(|start| self.climb(self.phi[start], h, NEARLY));
        let near = apart(near.flatten().collect(), h);
        let modes = near.into_par_iter().map(|m| self.climb(m.mode, h, AT_REST));
        apart(modes.flatten().collect(), h)
    }

    /// Mean shift from `start` with kernel radius `h` until it moves by less than `rest` of that; `None` where no vote is left
    /// near it.
    fn climb(&self, start: Phi, h: f64, rest: f64) -> Option<Cluster> {
        let mut mode = start;
        let mut near = self.near(&mode, h);
        for _ in 0..STEPS {
            let (mut total, mut sum) = (0.0, Phi::zeros());
            for (i, _) in self.closer(&near, &mode, h) {
                total += self.weights[i];
                sum.axpy(self.weights[i], &self.phi[i], 1.0);
            }
            if total <= 0.0 {
                return None;
            }
            let mean = sum / total;
            let moved = (mean - mode).norm();
            mode = mean;
            if (mode - near.center).norm() + h > near.radius {
                // Where steps are short the next ones ask for hardly any others.
                let slack = if moved < SLACK * h { SLACK * h } else { 0.0 };
                near = self.near(&mode, h + slack);
            }
            if moved < rest * h {
                break;
            }
        }
        let mut height = 0.0;
        let mut votes = Vec::new();
        for (i, d2) in self.closer(&near, &mode, h) {
            height += self.weights[i] * (1.0 - d2 / (h * h));
            votes.push(i as u32);
        }
        votes.sort_unstable();
        Some(Cluster {
            mode,
            height,
            votes,
        })
    }

    /// The votes that count within `radius` of `x`, and some more.
    fn near(&self, x: &Phi, radius: f64) -> Near {
        let y: [f64; LEADING] = (self.axes * x).into();
        let all = self.index.around(&y, radius);
        Near {
            center: *x,
            radius,
            votes: all.filter(|&i| self.weights[i as usize] > 0.0).collect(),
        }
    }

    /// Those of them within `h` of `x`, with their squared distances.
    fn closer<'a>(
        &'a self,
        near: &'a Near,
        x: &Phi,
        h: f64,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let x = *x;
        let votes = near.votes.iter().map(|&i| i as usize);
        votes
            .map(move |i| (i, (self.phi[i] - x).norm_squared()))
            .filter(move |&(_, d2)| d2 < h * h)
    }

    /// Where to climb from, the densest first: of one vote per cell of side h/2 those that have some votes around them and that
    /// none of the others beside them exceeds in density. In fewer axes than the six of a motion a cell would hold several modes.
    fn starts(&self, h: f64) -> Vec<usize> {
        let mut cells = BTreeMap::new();
        let origin = self.axes * self.phi.iter().sum::<Phi>() / self.phi.len().max(1) as f64;
        for (i, x) in self.phi.iter().enumerate() {
            let y = self.axes * x - origin;
            let cell: [i64; LEADING] = std::array::from_fn(|k| (y[k] / (0.5 * h)).floor() as i64);
            if self.weights[i] > 0.0 {
                cells.entry(cell).or_insert(i);
            }
        }
        let net: Vec<usize> = cells.into_values().collect();
        let crowds: Vec<Option<Crowd>> = net.par_iter().map(|&i| self.crowd(i, h)).collect();
        let mut density = vec![f64::NEG_INFINITY; self.phi.len()];
        for (&i, crowd) in net.iter().zip(&crowds) {
            density[i] = crowd.as_ref().map_or(f64::NEG_INFINITY, |c| c.density);
        }
        let higher = |k: usize, i: usize| density[k].total_cmp(&density[i]).then(i.cmp(&k)).is_gt();
        let highest = |(i, crowd): (usize, Option<Crowd>)| {
            let next = crowd?.next;
            (!next.into_iter().any(|k| higher(k as usize, i))).then_some(i)
        };
        let mut starts: Vec<usize> = net.into_iter().zip(crowds).filter_map(highest).collect();
        starts.sort_by(|&a, &b| density[b].total_cmp(&density[a]).then(a.cmp(&b)));
        starts.truncate(STARTS);
        starts
    }

    /// The votes around one of them; `None` where there are hardly any.
    fn crowd(&self, vote: usize, h: f64) -> Option<Crowd> {
        let mut crowd = Crowd::default();
        let mut count = 0;
        for (i, d2) in self.within(&self.phi[vote], h) {
            count += 1;
            crowd.density += self.weights[i] * (1.0 - d2 / (h * h));
            if d2 < (self.beside * h).powi(2) {
                crowd.next.push(i as u32);
            }
        }
        (count >= SOME).then_some(crowd)
    }

    /// Votes within `h` of `x` that count, with their squared distances, in the order of the index.
    fn within(&self, x: &Phi, h: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
        let y: [f64; LEADING] = (self.axes * x).into();
        let x = *x;
        let counting = self.index.around(&y, h).map(|i| i as usize);
        let counting = counting.filter(|&i| self.weights[i] > 0.0);
        counting
            .map(move |i| (i, (self.phi[i] - x).norm_squared()))
            .filter(move |&(_, d2)| d2 < h * h)
    }
}

/// Votes near a place.
struct Near {
    center: Phi,
    /// None is left out that is closer than this.
    radius: f64,
    votes: Vec<u32>,
}

/// What is around a vote.
#[derive(Default)]
struct Crowd {
    /// The kernel density there.
    density: f64,
    /// The votes beside it.
    next: Vec<u32>,
}

/// The highest of `modes`, the highest first, and of those closer than `h` to it none.
fn apart(mut modes: Vec<Cluster>, h: f64) -> Vec<Cluster> {
    modes.sort_by(|a, b| b.height.total_cmp(&a.height));
    let mut kept: Vec<Cluster> = Vec::new();
    for m in modes {
        if kept.iter().all(|k| (k.mode - m.mode).norm() > h) {
            kept.push(m);
        }
    }
    kept
}

/// [`Votes::density`] of `pairs` at one point only, for which an index would not pay.
pub fn density_of(pairs: &[Pair], space: &TransformSpace, x: &Phi, h: f64) -> f64 {
    let share = |v: &Pair| {
        let d2 = (space.embed(&v.q_from_p) - x).norm_squared();
        (d2 < h * h).then(|| v.weight * (1.0 - d2 / (h * h)))
    };
    pairs.iter().filter_map(share).sum()
}

/// The principal axes of a set of phi, largest variance first, as rows.
pub(crate) fn leading_axes<const K: usize>(phi: &[Phi]) -> SMatrix<f64, K, 12> {
    let n = phi.len().max(1) as f64;
    let mean = phi.iter().sum::<Phi>() / n;
    let covariance = phi
        .iter()
        .map(|x| (x - mean) * (x - mean).transpose() / n)
        .sum::<SMatrix<f64, 12, 12>>();
    let eigen = covariance.symmetric_eigen();
    let mut order: Vec<usize> = (0..12).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
    let mut axes = SMatrix::<f64, K, 12>::zeros();
    for (row, &k) in order.iter().take(K).enumerate() {
        let column: SVector<f64, 12> = eigen.eigenvectors.column(k).into_owned();
        // An eigenvector's sign is arbitrary: the third moment fixes it, also when the shape is turned.
        let skew: f64 = phi.iter().map(|x| column.dot(&(x - mean)).powi(3)).sum();
        axes.set_row(row, &(column * skew.signum()).transpose());
    }
    axes
}
