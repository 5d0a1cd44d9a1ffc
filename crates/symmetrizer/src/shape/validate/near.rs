//! Rims that nearly meet: seams whose two sides differ in the last digits.

use crate::geom::PointIndex;
use crate::shape::validate::finding::{Finding, Tally};
use crate::shape::validate::joined::Joined;
use crate::shape::validate::kind::Kind;

/// Rim vertices closer than this nearly meet, fraction of the bounding-box diagonal D: some digits
/// more than single precision holds.
const NEAR: f64 = 1e-5;

impl Joined<'_> {
    /// The vertices on a rim that nearly meet another one, along no common edge of the rim.
    pub(super) fn near_seams(&self) -> Finding {
        let mesh = self.faces.mesh;
        let mut along: Vec<[u32; 2]> = self.rim().map(|side| self.edge(side)).collect();
        along.iter_mut().for_each(|e| e.sort_unstable());
        along.sort_unstable();
        let mut rim: Vec<u32> = along.iter().flatten().copied().collect();
        rim.sort_unstable();
        rim.dedup();
        let places: Vec<[f64; 3]> = rim
            .iter()
            .map(|v| mesh.positions[*v as usize].into())
            .collect();
        let index = PointIndex::new(&places);
        let reach = NEAR * mesh.diagonal();
        let meets = |v: u32, w: u32| {
            let is_place = |v: u32| self.faces.places[v as usize];
            is_place(v) != is_place(w) && along.binary_search(&[v.min(w), v.max(w)]).is_err()
        };
        let near = rim.iter().zip(&places).filter(|(v, x)| {
            let others = index.within(x, reach);
            others.into_iter().any(|k| meets(**v, rim[k as usize]))
        });
        let tally: Tally = near.map(|(v, _)| *v).collect();
        Finding::new(Kind::NearSeam, tally)
    }
}
