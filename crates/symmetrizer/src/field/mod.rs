//! Symmetry fields: mirrors that vary slowly along the surface, as on a bent shape, whose votes form a ridge
//! in transformation space rather than a blob.
//!
//! Each sample has a partner on the surface and a local mirror that carries its surroundings there.

pub mod around;
pub mod cut;
pub mod grow;
pub mod local;
mod pieces;
pub mod reach;
pub mod seeds;
pub mod trust;

use rayon::prelude::*;

use crate::context::Context;
use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::shape::{ClosestPoint, SurfacePoint};
use crate::transform::Isometry;

pub use grow::grow;
pub use reach::Reach;
pub use seeds::Mirrors;

/// The partner of a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Partner {
    /// Where on the surface.
    pub at: SurfacePoint,
    /// Its position, working coordinates.
    pub position: Point,
    /// Unit normal of the surface there.
    pub normal: Vector,
    /// The sample nearest to it.
    pub sample: u32,
    /// Its distance from the image of the sample under the local mirror, fraction of L.
    pub residual: f64,
}

/// A symmetry field.
#[derive(Debug, Clone)]
pub struct SymmetryField {
    /// The partner of each sample, where it has one.
    pub partners: Vec<Option<Partner>>,
    /// The local isometry of each sample that has a partner: carries the sample's surroundings to the
    /// partner's.
    pub maps: Vec<Option<Isometry>>,
}

/// Worth of pairs all around an outline, which follow each other in order, beside that of those which grow from
/// one to the next: these slip where limbs are thin.
const IN_ORDER: f64 = 1.1;

/// Pairs around an outline of so much worth are not to be outdone.
const ENOUGH: f64 = 0.7;

/// The fields that detection's `mirrors` grow into on `land`, with or without the doubtful ones, from several starts: the one that
/// seems to be trusted most first, none twice.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn candidates(
    land: &grow::Land<'_>,
    mirrors: &Mirrors,
    ctx: &Context<'_>,
) -> Result<Vec<SymmetryField>> {
    let cancel = ctx.token();
    // Nearly all starts cover nearly all: what they have grown into tells them apart.
    let worth = |field: &SymmetryField| match land.wall {
        Some(_) => field.cover() * trust::likeness(land, field),
        None => trust::Trust::of(land, field).score(),
    };
    let images = images(land, mirrors);
    let is_one_of_two = |wall| around::is_one_of_two(wall, land.samples, &images);
    let main = mirrors.sure.first();
    let main = main.filter(|_| land.wall.is_some_and(is_one_of_two));
    let around = land.wall.filter(|_| main.is_none()).map(|wall| {
        let around = around::Around::of(wall, land.samples);
        let others = around::carried(wall, land.samples, &images);
        let pairs = around.partners.into_iter().zip(others);
        let pairs = pairs.map(|(own, other)| own.or(other)).collect();
        grow::fill(land, pairs, cancel)
    });
    let around = around.map(|filled| (worth(&filled), filled));
    if let Some((_, filled)) = around.as_ref().filter(|(worth, _)| *worth >= ENOUGH) {
        ctx.check()?;
        return Ok(vec![filled.clone()]);
    }
    let choices = main.map_or_else(|| mirrors.choices(), |main| vec![vec![*main]]);
    let claims = seeds::CLAIMS.iter();
    let starts: Vec<_> = claims
        .flat_map(|&claim| choices.iter().map(move |c| seeds::seeds(land, c, claim)))
        .collect();
    let mut grown: Vec<(f64, SymmetryField)> = starts
        .into_par_iter()
        .map(|seeds| grow(land, seeds, cancel))
        .map(|field| (worth(&field), field))
        .collect();
    ctx.check()?;
    grown.extend(around.map(|(worth, filled)| (IN_ORDER * worth, filled)));
    grown.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut fields: Vec<SymmetryField> = Vec::new();
    for (_, field) in grown {
        if !fields.iter().any(|known| known.is_like(&field)) {
            fields.push(field);
        }
    }
    Ok(fields)
}

/// In the plane, the partners of samples under the highest of the `mirrors`.
fn images(land: &grow::Land<'_>, mirrors: &Mirrors) -> Vec<Option<Partner>> {
    let [.., widest] = seeds::CLAIMS;
    match mirrors.sure.first().filter(|_| land.wall.is_some()) {
        Some(main) => seeds::seeds(land, &[*main], widest),
        None => vec![None; land.samples.list.len()],
    }
}

/// Partners nearer than this are one, fraction of L, and fields that are one differ in less than this share of theirs.
const SAME: f64 = 0.01;
const DIFFERENT: f64 = 0.05;

impl SymmetryField {
    /// The field over the `kept` samples only.
    pub fn of(&self, kept: &[bool]) -> Self {
        let partners = self.partners.iter().zip(kept);
        Self {
            partners: partners.map(|(q, kept)| q.filter(|_| *kept)).collect(),
            maps: self.maps.clone(),
        }
    }

    /// The same with the partners and local isometries of `others` where it has no partners.
    pub fn or(&self, others: &Self) -> Self {
        let mut all = self.clone();
        for (s, q) in others.partners.iter().enumerate() {
            if all.partners[s].is_none() {
                all.partners[s] = *q;
                all.maps[s] = others.maps[s];
            }
        }
        all
    }

    /// The same with every partner at the nearest place of another copy of the surface.
    pub fn placed_on(&self, closest: &ClosestPoint) -> Self {
        let placed = |q: &Partner| {
            let hit = closest.nearest_facing(&q.position, &q.normal, 0.0, f64::INFINITY)?;
            Some(Partner {
                at: hit.at,
                position: hit.point,
                ..*q
            })
        };
        let partners = self.partners.par_iter();
        Self {
            partners: partners.map(|q| q.as_ref().and_then(placed)).collect(),
            maps: self.maps.clone(),
        }
    }

    /// Whether another field on the same samples is hardly any other.
    fn is_like(&self, other: &Self) -> bool {
        let both = self.partners.iter().zip(&other.partners);
        let differ = |(p, q): &(&Option<Partner>, &Option<Partner>)| match (p, q) {
            (Some(p), Some(q)) => (p.position - q.position).norm() > SAME,
            (None, None) => false,
            _ => true,
        };
        both.filter(differ).count() as f64 <= DIFFERENT * self.partners.len() as f64
    }

    /// The share of the samples that have a partner.
    pub fn cover(&self) -> f64 {
        let paired = self.partners.iter().flatten().count();
        paired as f64 / self.partners.len().max(1) as f64
    }
}
