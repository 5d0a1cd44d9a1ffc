//! Rows: copies that follow each other by one step, a translation, screw, glide or rotation.
//!
//! Powers of a step name the symmetries of a row of n copies: T^k carries n - k copies onto
//! others. Orbits of one generator after Shi, Alliez, Desbrun, Bao, Huang 2016 (symmetry and orbit
//! detection).

use std::f64::consts::TAU;

use crate::group::step::{powers_of, refit};
use crate::group::{Verify, Within};
use crate::transform::{Elements, Isometry, Kind};

/// Copies that follow each other by one step.
#[derive(Debug, Clone)]
pub struct Row {
    /// From one copy to the next, the best for all powers.
    pub step: Isometry,
    /// The kind of the step, over the whole row: a translation, screw, glide or rotation.
    pub kind: Kind,
    /// How many copies there are: one more than the greatest power that holds.
    pub count: usize,
    /// Of a ring: how many copies it has room for. Other rows, arcs of no even division among
    /// them, have none.
    pub places: Option<usize>,
    /// T, T^2, ... as they hold on the shape.
    pub measured: Vec<Isometry>,
}

/// The greatest number of copies that is looked for.
const GREATEST_COUNT: usize = 256;

/// The row of `generator`, which holds: its powers are offered to `verify` one after the other
/// until one does not hold or they are back at the identity.
///
/// `verify` must ask for the row's first copy, that which T's patch has and its image has not: on
/// a ring of which four of seven are left T^4 carries the last copy back to the first. `None` for
/// kinds that make no rows: mirrors, inversions, rotoreflections, half-turns.
pub fn row(generator: &Isometry, within: Within<'_>, verify: &mut Verify<'_>) -> Option<Row> {
    let start = generator.elements(within.space, within.tolerance);
    let moves = matches!(start.kind, Kind::Translation | Kind::Screw | Kind::Glide)
        || (start.kind == Kind::Rotation && start.order.is_none_or(|n| n > 2));
    if !moves {
        return None;
    }
    let mut measured = vec![*generator];
    let mut step = *generator;
    let mut closed = false;
    while measured.len() + 1 < GREATEST_COUNT {
        let next = power(&step, measured.len() + 1);
        closed = within.same(&next, &Isometry::identity());
        if closed {
            break;
        }
        let Some(holds) = within.ask(&next, verify) else {
            break;
        };
        measured.push(holds);
        step = refit(&step, &measured, within.space);
    }
    Some(named(step, measured, closed, within))
}

impl Row {
    /// Whether it is a ring without gaps: then it is part of a point group.
    pub fn is_closed(&self) -> bool {
        self.places == Some(self.count)
    }

    /// Whether `t` is, to the tolerance, one of the row's own symmetries, forwards or backwards.
    pub(super) fn explains(&self, t: &Isometry, within: Within<'_>) -> bool {
        let powers = powers_of(&self.step, self.count);
        powers
            .iter()
            .any(|p| within.same(p, t) || within.same(&p.inverse(), t))
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let count = self.count;
        let text = match (self.kind, self.places) {
            (Kind::Screw, _) => format!("helix {count}"),
            (Kind::Glide, _) => format!("glide row {count}"),
            (Kind::Rotation, Some(places)) if places == count => format!("ring {count}"),
            (Kind::Rotation, Some(places)) => format!("ring {count} of {places}"),
            (Kind::Rotation, None) => format!("arc {count}"),
            _ => format!("row {count}"),
        };
        f.pad(&text)
    }
}

fn power(step: &Isometry, k: usize) -> Isometry {
    powers_of(step, k + 1).pop().unwrap_or(*step)
}

/// The row with the simplest step all powers of which are within the tolerance of the measured
/// ones.
fn named(step: Isometry, measured: Vec<Isometry>, closed: bool, within: Within<'_>) -> Row {
    let fits = |t: &Isometry| {
        let powers = powers_of(t, measured.len() + 1);
        let mut pairs = powers[1..].iter().zip(&measured);
        pairs.all(|(p, m)| within.same(p, m))
    };
    let count = measured.len() + 1;
    let nearest = |kind| step.nearest(kind, within.space);
    let rotation = || {
        Some(Elements::exactly(
            Kind::Rotation,
            &nearest(Kind::Rotation)?,
            within.space,
        ))
    };
    let divided = || {
        let mut turned = rotation()?;
        let places = (TAU / turned.angle.abs()).round();
        turned.angle = turned.angle.signum() * TAU / places;
        (places >= count as f64).then(|| (turned.isometry(), places as usize))
    };
    let (step, kind, places) = if step.is_improper() {
        let glide = nearest(Kind::Glide).filter(fits);
        (glide.unwrap_or(step), Kind::Glide, None)
    } else if let Some(t) = translation(&measured, within).filter(fits) {
        (t, Kind::Translation, None)
    } else if let Some((t, places)) =
        divided().filter(|(t, places)| fits(t) && (!closed || *places == count))
    {
        (t, Kind::Rotation, Some(places))
    } else if let Some(t) = rotation().map(|e| e.isometry()).filter(fits) {
        (t, Kind::Rotation, None)
    } else {
        (step, Kind::Screw, None)
    };
    Row {
        step,
        kind,
        count,
        places,
        measured,
    }
}

/// The translation t that minimises the sum over k of |k t - M_k|^2 in the space.
fn translation(measured: &[Isometry], within: Within<'_>) -> Option<Isometry> {
    let centre = within.space.centre();
    let mut sum = crate::geom::Vector::zeros();
    let mut squares = 0.0;
    for (k, t) in (1_u32..).zip(measured) {
        sum += (t.apply(&centre) - centre) * f64::from(k);
        squares += f64::from(k * k);
    }
    (squares > 0.0).then(|| Isometry {
        translation: sum / squares,
        ..Isometry::identity()
    })
}
