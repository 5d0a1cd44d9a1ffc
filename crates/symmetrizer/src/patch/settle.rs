//! A candidate's isometry comes to rest on the surface: refitted while its patch grows over
//! neighbouring samples, in the end to the part for which it holds best.

use crate::patch::ground::{Ground, contacts, touch};
use crate::patch::grow::Candidate;
use crate::patch::judge::too_small;
use crate::patch::params::PatchParams;
use crate::patch::reach::Reach;
use crate::patch::refine::{Contact, refine, weigh};
use crate::patch::symmetry::PatchPair;
use crate::transform::{Class, Isometry};

/// A growing round.
#[derive(Debug, Clone, Copy)]
struct Round {
    /// Tolerance, in units of the class's.
    tolerance: f64,
    /// How many neighbours away from the seeds it grows at the most.
    rings: u32,
}

impl Round {
    const fn far(tolerance: f64) -> Self {
        Self {
            tolerance,
            rings: u32::MAX,
        }
    }

    const fn near(tolerance: f64) -> Self {
        Self {
            tolerance,
            rings: 1,
        }
    }
}

/// Tolerances of the growing rounds, in units of the class's tolerance: wide first, while the
/// cluster's isometry is still rough.
const WIDE: [Round; 6] = [
    Round::far(2.5),
    Round::far(2.0),
    Round::far(1.5),
    Round::far(1.0),
    Round::far(1.0),
    Round::far(1.0),
];
/// For mirrors a second time, as if only what holds well were there: a part that moves as one piece is
/// not drawn towards its neighbours.
const NARROW: [Round; 4] = [
    Round::far(1.2),
    Round::far(0.8),
    Round::far(0.4),
    Round::far(0.4),
];
/// As a rigid motion has more freedom, its votes are rougher.
/// The first are fitted to the places that voted and what is next to them alone: plain ground around
/// an element, where most motions nearly hold, would draw the fit to itself.
const MOTION: [Round; 6] = [
    Round::near(5.0),
    Round::near(3.0),
    Round::near(2.0),
    Round::far(1.5),
    Round::far(1.0),
    Round::far(1.0),
];
/// Residual up to which a place speaks for one of two mirrors, in units of the tolerance.
const WELL: f64 = 0.4;
/// Share of the least area that a candidate must reach while it settles.
const HOPEFUL: f64 = 0.8;
/// The round after which a motion is refused that fills the tolerance to so many times what a symmetry does at the most.
const PASSING: usize = 1;
const PASSES: f64 = 1.25;
/// Settled: contacts move by less than this from round to round, fraction of L.
const SETTLED: f64 = 2e-5;

/// How far a candidate settles.
struct Settling {
    /// Rounds at the most.
    rounds: usize,
    /// Steps of each.
    steps: usize,
}

impl Settling {
    /// Of motions there are hundreds: while images move by a fraction of a triangle, the planes that they touched stand for the
    /// surface, and most of the way is taken on those. Mirrors are judged by what the surface says in each step.
    fn of(class: Class) -> Self {
        match class {
            Class::Mirror => Self {
                rounds: 12,
                steps: 1,
            },
            Class::Proper | Class::Improper => Self {
                rounds: 5,
                steps: 4,
            },
        }
    }
}

/// An isometry that has come to rest on the surface.
#[derive(Debug, Clone, Copy)]
pub struct Settled {
    /// The isometry.
    pub t: Isometry,
    /// How well it holds where it holds best, fraction of L.
    pub spread: f64,
}

/// Why a candidate that holds nowhere is refused.
pub const NOWHERE: &str = "its votes do not hold on the surface";

/// A candidate at rest: from near where it is near, else a mirror in two ways of which the better
/// supported counts, a motion from its votes outwards.
///
/// # Errors
/// The reason why nothing can come of it.
pub fn settled(
    ground: &Ground<'_>,
    candidate: &Candidate,
    params: &PatchParams,
) -> Result<Settled, String> {
    let within = |rounds: &[Round]| settle(ground, candidate, rounds, params);
    match candidate.class {
        Class::Mirror if candidate.near => within(&NARROW),
        Class::Mirror => {
            let (wide, narrow) = rayon::join(|| within(&WIDE), || within(&NARROW));
            best_supported(ground, wide, narrow, params)
        }
        Class::Proper | Class::Improper => within(&MOTION),
    }
}

/// Refits a candidate's isometry while its patch grows in `rounds`, then to where it holds best.
///
/// # Errors
/// The reason why nothing can come of it.
fn settle(
    ground: &Ground<'_>,
    candidate: &Candidate,
    rounds: &[Round],
    params: &PatchParams,
) -> Result<Settled, String> {
    let Candidate { class, seeds, .. } = candidate;
    let tolerance = params.tolerance_of(*class);
    let mut t = candidate.t;
    let mut reach = Reach::new(ground, candidate, params.min_cos);
    for round in rounds {
        let bound = round.tolerance * tolerance;
        let grown = reach.grow(&t, bound, round.rings);
        if round.tolerance <= 1.0 {
            hopeful(ground, &grown, params.least_area(*class))?;
        }
        let mut contacts = contacts(ground, &grown);
        if *class != Class::Mirror && !grown.is_empty() {
            weigh(&t, &mut contacts, scale(&grown, seeds, 0.5));
        }
        t = refine(&t, *class, &contacts);
    }
    let last = rounds.last().map_or(1.0, |r| r.tolerance) * tolerance;
    let mut spread = 0.0;
    let settling = Settling::of(*class);
    for round in 0..settling.rounds {
        let grown = reach.grow(&t, last, u32::MAX);
        if grown.is_empty() {
            return Err(NOWHERE.into());
        }
        hopeful(ground, &grown, params.least_area(*class))?;
        spread = scale(&grown, seeds, 0.25);
        if round == PASSING && *class != Class::Mirror && !candidate.near {
            let filled = filled(&grown, tolerance);
            // What holds better where it holds best ends before.
            let ends = params.end_of(*class) * spread < tolerance;
            if !ends && filled > PASSES * params.max_filled {
                return Err(passing(filled));
            }
        }
        let before = t;
        let mut contacts = contacts(ground, &grown);
        for _ in 0..settling.steps {
            weigh(&t, &mut contacts, spread);
            let next = refine(&t, *class, &contacts);
            let moved = moved(&t, &next, &contacts);
            t = next;
            if moved < SETTLED {
                break;
            }
            slide(&t, &mut contacts);
        }
        if moved(&before, &t, &contacts) < SETTLED {
            break;
        }
    }
    Ok(Settled { t, spread })
}

/// How far the images of contacts are from each other under two isometries, rms.
fn moved(from: &Isometry, to: &Isometry, contacts: &[Contact]) -> f64 {
    let squares = contacts
        .iter()
        .map(|c| (to.apply(&c.x) - from.apply(&c.x)).norm_squared());
    (squares.sum::<f64>() / contacts.len() as f64).sqrt()
}

/// Takes contacts along their planes to where their images are now.
fn slide(t: &Isometry, contacts: &mut [Contact]) {
    for c in contacts {
        let z = t.apply(&c.x);
        c.y = z - c.normal * c.normal.dot(&(z - c.y));
    }
}

/// The rms residual of what has grown to a tolerance, in units of that.
fn filled(grown: &[PatchPair], tolerance: f64) -> f64 {
    let squares = grown.iter().map(|p| p.residual.powi(2));
    (squares.sum::<f64>() / grown.len().max(1) as f64).sqrt() / tolerance
}

/// Why a motion is refused whose patch fills the tolerance to this share.
pub fn passing(filled: f64) -> String {
    format!(
        "its image passes by the surface rather than lies on it (rms {filled:.2} of the tolerance)"
    )
}

/// Refuses what has not come near the area of a patch: most candidates have not, and to settle them is
/// most of the work.
fn hopeful(ground: &Ground<'_>, grown: &[PatchPair], least: f64) -> Result<(), String> {
    let at_most = 2.0 * grown.len() as f64 / ground.samples.list.len() as f64;
    if at_most < HOPEFUL * least {
        return Err(too_small(at_most));
    }
    Ok(())
}

/// Of two the one that holds well for more of the surface.
fn best_supported(
    ground: &Ground<'_>,
    wide: Result<Settled, String>,
    narrow: Result<Settled, String>,
    params: &PatchParams,
) -> Result<Settled, String> {
    let well = WELL * params.tolerance;
    let support = |s: &Result<Settled, String>| {
        s.as_ref().map_or(0.0, |s| {
            let touched = touch(ground, &s.t, well, params.min_cos);
            let share = |p: PatchPair| 1.0 - (p.residual / well).powi(2);
            touched.into_iter().flatten().map(share).sum::<f64>()
        })
    };
    if support(&narrow) > support(&wide) {
        narrow
    } else {
        wide
    }
}

/// 1.5 times the `quantile` of the residuals of those pairs that the candidate was found by.
fn scale(grown: &[PatchPair], seeds: &[u32], quantile: f64) -> f64 {
    let seeded = grown
        .iter()
        .filter(|p| seeds.binary_search(&p.sample).is_ok());
    let mut residuals: Vec<f64> = seeded.map(|p| p.residual).collect();
    if residuals.is_empty() {
        residuals = grown.iter().map(|p| p.residual).collect();
    }
    let at = ((residuals.len() - 1) as f64 * quantile) as usize;
    1.5 * *residuals.select_nth_unstable_by(at, f64::total_cmp).1
}
