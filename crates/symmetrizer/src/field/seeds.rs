//! Where fields begin: what detection's mirrors hold for.

use crate::detect::Detection;
use crate::field::Partner;
use crate::field::grow::Land;
use crate::field::pieces::pieces;
use crate::patch::Symmetry;
use crate::transform::{Class, Isometry};

/// The mirrors that detection found.
#[derive(Debug, Clone, Default)]
pub struct Mirrors {
    /// Those that hold for a part of the surface.
    pub sure: Vec<Isometry>,
    /// Those that may.
    pub doubtful: Vec<Isometry>,
}

impl From<&Detection> for Mirrors {
    fn from(found: &Detection) -> Self {
        let mirrors = |all: &[Symmetry]| {
            let mirrors = all.iter().filter(|s| s.class == Class::Mirror);
            mirrors.map(|s| s.q_from_p).collect()
        };
        Self {
            sure: mirrors(&found.symmetries),
            doubtful: mirrors(&found.doubtful),
        }
    }
}

impl Mirrors {
    /// What a field may begin with: the sure ones, and where there are doubtful ones all of them. On roundish shapes these alone
    /// would grow into anything.
    pub fn choices(&self) -> Vec<Vec<Isometry>> {
        let mut choices = vec![self.sure.clone()];
        if !(self.sure.is_empty() || self.doubtful.is_empty()) {
            choices.push([&self.sure[..], &self.doubtful].concat());
        }
        choices
    }
}

/// Distances within which a mirror claims a sample, fractions of L, tried in turn.
pub const CLAIMS: [f64; 3] = [0.006, 0.01, 0.015];
/// Smaller pieces are no seeds.
const LEAST: usize = 8;

/// For each sample the partner under that of `mirrors` which fits it best, where it lies within `claim`
/// (fraction of L), in connected pieces.
pub fn seeds(land: &Land<'_>, mirrors: &[Isometry], claim: f64) -> Vec<Option<Partner>> {
    let count = land.samples.list.len();
    let mut best: Vec<Option<(usize, Partner)>> = vec![None; count];
    for (m, t) in mirrors.iter().enumerate() {
        for s in 0..count as u32 {
            let Some(found) = land.image(s, t, claim) else {
                continue;
            };
            let held = &mut best[s as usize];
            if held.is_none_or(|(_, q)| found.residual < q.residual) {
                *held = Some((m, found));
            }
        }
    }
    let mirror = |s: u32| best[s as usize].map(|(m, _)| m);
    let same = |a, b| mirror(a) == mirror(b);
    for piece in pieces(&land.reach.neighbors, |s| mirror(s).is_some(), same) {
        if piece.len() < LEAST {
            piece.iter().for_each(|&s| best[s as usize] = None);
        }
    }
    best.into_iter().map(|b| b.map(|(_, q)| q)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Doubtful mirrors are taken with sure ones only.
    #[test]
    fn doubtful_mirrors_join_sure_ones() {
        let one = || vec![Isometry::identity()];
        let choices = |sure, doubtful| Mirrors { sure, doubtful }.choices();
        let counts = |all: Vec<Vec<Isometry>>| all.iter().map(Vec::len).collect::<Vec<_>>();
        assert_eq!(counts(choices(one(), one())), [1, 2]);
        assert_eq!(counts(choices(one(), Vec::new())), [1]);
        assert_eq!(counts(choices(Vec::new(), one())), [0]);
    }
}
