//! A bend: how far the local mirrors turn over the shape, and whether they are to be believed.

use rayon::prelude::*;

use crate::context::Context;
use crate::deform::control::{decimated, stiffness_on};
use crate::error::Result;
use crate::field::grow::{Land, grow};
use crate::field::trust::{Trust, Verdict};
use crate::field::{Mirrors, Partner, SymmetryField, candidates};
use crate::geom::{Matrix3, Vector, nearest_orthogonal, sorted_eigen};
use crate::shape::ClosestPoint;
use crate::straighten::blend::Blend;
use crate::straighten::rotations;
use crate::straighten::rotations::Evenness;
use crate::straighten::settle::Settler;

/// Local mirrors that turn less, degrees, are one mirror.
pub const LEAST: f64 = 4.0;
/// Share of the samples that are looked at for the largest turn: the rest may be anything.
const MOST: f64 = 0.98;
/// Faces of the copy that stands for a surface of many more.
const FACES: usize = 20_000;

/// A bend that was found on a shape.
pub struct Bend {
    /// Partners and local isometries, settled.
    pub settled: SymmetryField,
    /// Those that are trusted; all of them where the whole is refused.
    pub field: SymmetryField,
    /// How far they are to be trusted.
    pub trust: Trust,
    /// The rotation of each sample into the straight shape, which is turned as a whole as it likes.
    pub turns: Vec<Matrix3>,
    /// The largest angle between the turns of two places, degrees.
    pub degrees: f64,
}

impl Bend {
    /// Looks for the field that detection's `mirrors` grow into; `None` where there are none or they turn
    /// nowhere. A decimated copy stands for a fine surface: all that is asked of it are the places of samples.
    ///
    /// # Errors
    /// [`crate::Error::Numerical`], [`crate::Error::Cancelled`].
    pub fn find(land: &Land<'_>, mirrors: &Mirrors, ctx: &mut Context<'_>) -> Result<Option<Self>> {
        Self::find_unless(&|_| false, land, mirrors, ctx)
    }

    /// [`Bend::find`], which does not go on to make the field of a bend better that is `denied` by what is trusted of it.
    ///
    /// # Errors
    /// As [`Bend::find`].
    pub fn find_unless(
        denied: &dyn Fn(&Trust) -> bool,
        land: &Land<'_>,
        mirrors: &Mirrors,
        ctx: &mut Context<'_>,
    ) -> Result<Option<Self>> {
        if land.wall.is_some() {
            return Self::find_on(denied, land, mirrors, ctx);
        }
        if mirrors.sure.is_empty() {
            return Ok(None);
        }
        let Some(control) = decimated(land.surface, FACES)? else {
            return Self::find_on(denied, land, mirrors, ctx);
        };
        let surface = &control.surface;
        let closest = ClosestPoint::new(surface);
        let samples = land.samples.placed_on(&closest);
        let stiffness = land
            .stiffness
            .map(|s| stiffness_on(surface, land.surface, s));
        let coarse =
            Land::new(surface, &closest, &samples, land.reach).with_stiffness(stiffness.as_deref());
        let found = Self::find_on(denied, &coarse, mirrors, ctx)?;
        Ok(found.map(|bend| Self {
            settled: bend.settled.placed_on(land.closest),
            field: bend.field.placed_on(land.closest),
            ..bend
        }))
    }

    /// How far each vertex of the surface may be changed, 0 to 1, where the symmetry holds for a part only.
    pub fn region(&self, land: &Land<'_>) -> Vec<f64> {
        Blend::new(land.surface, land.samples).means(&self.trust.region(land))
    }

    fn find_on(
        denied: &dyn Fn(&Trust) -> bool,
        land: &Land<'_>,
        mirrors: &Mirrors,
        ctx: &mut Context<'_>,
    ) -> Result<Option<Self>> {
        let starts = candidates(land, mirrors, ctx)?;
        let Some(first) = starts.first() else {
            return Ok(None);
        };
        // An outline without a line that holds for it may have one all the same, only rougher.
        let known = land.wall.is_none() || !mirrors.sure.is_empty();
        if known && spread(land, first) < LEAST {
            return Ok(None);
        }
        let settler = Settler::new(land);
        let grown = promising(land, &settler, &starts, ctx)?;
        let first = settler.settle(grown, ctx)?;
        let (settled, trust) = regrown(denied, land, &settler, first, ctx)?;
        let field = match trust.verdict() {
            Verdict::Refuse => settled.clone(),
            Verdict::Uncertain if land.wall.is_none() => {
                settled.of(&within(&trust, &trust.region(land), &settled))
            }
            Verdict::Uncertain | Verdict::Accept => settled.of(&trust.trusted),
        };
        let others = settled.or(grown);
        let turns = rotations::solved(land, (&field, &others), Evenness::AtLast)?;
        let degrees = span(&shared(&turns, &field));
        Ok(Some(Self {
            settled,
            field,
            trust,
            turns,
            degrees,
        }))
    }
}

/// Fields that are looked at more closely, those first that seemed to be trusted most: one of the rest was the best of one bend in sixty, which
/// stays uncertain either way.
const GLIMPSED: usize = 4;

/// The one of several fields that is to be trusted most once it has settled a little: as they have grown they tell little.
fn promising<'a>(
    land: &Land<'_>,
    settler: &Settler<'_>,
    grown: &'a [SymmetryField],
    ctx: &Context<'_>,
) -> Result<&'a SymmetryField> {
    if grown.len() == 1 || land.wall.is_some() {
        return Ok(&grown[0]);
    }
    let cancel = ctx.token();
    let worth =
        |field: &SymmetryField| Ok(Trust::of(land, &settler.glimpse(field, cancel)?).worth());
    let first = &grown[..grown.len().min(GLIMPSED)];
    let worths: Vec<f64> = first.par_iter().map(worth).collect::<Result<_>>()?;
    // The first of several.
    let best = (0..worths.len())
        .rev()
        .max_by(|&a, &b| worths[a].total_cmp(&worths[b]));
    Ok(&grown[best.unwrap_or(0)])
}

/// Share of the samples without a partner that fits above which a field is grown once more.
const LOOSE: f64 = 0.03;
/// Times at the most.
const ROUNDS: usize = 3;

/// A field of which much is doubtful grown once more, from what is trusted of it, where the settled mirrors say: pairs that slid while
/// it grew are found anew. Whichever is to be trusted more; the first where that is `denied`.
fn regrown(
    denied: &dyn Fn(&Trust) -> bool,
    land: &Land<'_>,
    settler: &Settler<'_>,
    first: SymmetryField,
    ctx: &mut Context<'_>,
) -> Result<(SymmetryField, Trust)> {
    let mut trust = Trust::of(land, &first);
    let mut field = first;
    for _ in 0..ROUNDS {
        let loose = trust.verdict() != Verdict::Accept || trust.unfit > LOOSE;
        if !loose || land.wall.is_some() || denied(&trust) {
            break;
        }
        let seeds = field.of(&trust.trusted).partners;
        let again = settler.settle(&grow(land, seeds, ctx.token()), ctx)?;
        let sure = Trust::of(land, &again);
        if sure.worth() <= trust.worth() {
            break;
        }
        (field, trust) = (again, sure);
    }
    Ok((field, trust))
}

/// Which of the samples are trusted among others that are, and so their partners.
fn within(trust: &Trust, region: &[f64], field: &SymmetryField) -> Vec<bool> {
    let inside = |s: usize| region[s] >= 0.5;
    let both = |(s, q): (usize, &Option<Partner>)| {
        let partner = q.is_some_and(|q| inside(q.sample as usize));
        trust.trusted[s] && inside(s) && partner
    };
    field.partners.iter().enumerate().map(both).collect()
}

/// The turns that partners have in common: a place on the spine and its two sides turn as one.
pub fn shared(turns: &[Matrix3], field: &SymmetryField) -> Vec<Matrix3> {
    let both = |(turn, partner): (&Matrix3, &Option<Partner>)| {
        let other = partner.map_or(*turn, |q| turns[q.sample as usize]);
        nearest_orthogonal(&(turn + other), false)
    };
    turns.iter().zip(&field.partners).map(both).collect()
}

/// The largest angle between two of the rotations, degrees, the outermost left out.
fn span(turns: &[Matrix3]) -> f64 {
    let middle = nearest_orthogonal(&turns.iter().sum(), false);
    let outermost = |from: &Matrix3| {
        let mut angles: Vec<(f64, usize)> = turns
            .iter()
            .enumerate()
            .map(|(i, t)| (angle(from, t), i))
            .collect();
        let at = ((angles.len() as f64 * MOST) as usize).min(angles.len() - 1);
        *angles
            .select_nth_unstable_by(at, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .1
    };
    let (_, far) = outermost(&middle);
    outermost(&turns[far]).0
}

/// The angle of the rotation from `a` to `b`, degrees.
fn angle(a: &Matrix3, b: &Matrix3) -> f64 {
    let cos = ((a.transpose() * b).trace() - 1.0) / 2.0;
    cos.clamp(-1.0, 1.0).acos().to_degrees()
}

/// Twice the angle from the mean normal within which nearly all normals of the local mirrors lie, degrees.
fn spread(land: &Land<'_>, field: &SymmetryField) -> f64 {
    let samples = land.samples.list.iter().zip(&field.maps);
    let normals: Vec<Vector> = samples
        .filter_map(|(s, map)| Some(map.as_ref()?.nearest_mirror(&s.position).normal))
        .collect();
    let tensor: Matrix3 = normals.iter().map(|n| n * n.transpose()).sum();
    let mean = sorted_eigen(&tensor).1.column(2).into_owned();
    let mut angles: Vec<f64> = normals
        .iter()
        .map(|n| n.dot(&mean).abs().min(1.0).acos().to_degrees())
        .collect();
    if angles.is_empty() {
        return 0.0;
    }
    let at = ((angles.len() as f64 * MOST) as usize).min(angles.len() - 1);
    2.0 * *angles.select_nth_unstable_by(at, f64::total_cmp).1
}
