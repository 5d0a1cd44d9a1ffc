//! The finish at full resolution: what the deformer's control mesh is too coarse to carry.
//!
//! Each vertex is drawn half of the way, along its normal, to its mirrored closest point; the field of
//! these displacements is smoothed by a screened Laplacian, so that the surface moves as cloth and
//! not as dust. The smoothing length falls from round to round and the rounds end as soon as the
//! shape is symmetric enough: detail is rubbed out no further than that takes.

use crate::context::Context;
use crate::deform::carry;
use crate::deform::control::decimated;
use crate::error::Result;
use crate::geom::Point;
use crate::optimize::aim::Aim;
use crate::optimize::rounds::{Changed, Rounds};
use crate::optimize::schedule::Settings;
use crate::optimize::untangle::untangle;
use crate::shape::{ClosestPoint, Surface};
use crate::transform::{Ambient, Plane};

/// What the finish did.
#[derive(Debug, Clone)]
pub struct Finished {
    /// Vertex positions, working coordinates.
    pub positions: Vec<Point>,
    /// The mirror at the end, working coordinates.
    pub plane: Plane,
    /// Rounds run.
    pub rounds: usize,
    /// Mean distance of mirrored vertices from the surface before and after, area-weighted, fraction
    /// of L.
    pub asymmetry: [f64; 2],
    /// Share of the area where it was undone because the surface would have crossed itself.
    pub undone: f64,
}

/// The rounds are run on a copy of about this many faces where the surface has many more, and the rest is
/// carried along: finer triangles add detail, not asymmetry.
const FULL: usize = 100_000;
/// Those of long smoothing lengths on one of about so many, down to this many of its edges.
const COARSE: (usize, f64) = (20_000, 1.5);

/// Runs the rounds of the finish on `surface` under the mirror `plane` until the mean asymmetry is
/// `goal` (fraction of L) or falls no further.
///
/// # Errors
/// [`crate::Error::Numerical`], [`crate::Error::Cancelled`].
pub fn finish(
    surface: &Surface,
    plane: Plane,
    goal: f64,
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Finished> {
    // Walls are as fine as they need to be.
    let coarser = |surface: &Surface, faces: usize| match settings.wall {
        Some(_) => Ok(None),
        None => decimated(surface, faces),
    };
    let full = coarser(surface, FULL)?;
    let rest = full.as_ref().map_or(surface, |f| &f.surface);
    let changed = Changed {
        ambient: match settings.wall {
            Some(_) => Ambient::Plane,
            None => Ambient::Space,
        },
        stiffness: settings.stiffness.map(<[f64]>::to_vec),
        region: settings.region.map(<[f64]>::to_vec),
    };
    let changed = full
        .as_ref()
        .map_or_else(|| changed.clone(), |full| changed.on(surface, full));
    let mut rounds = Rounds::new(settings.optimize, goal, plane);
    let mut now = rest.clone();
    if let Some(coarse) = coarser(rest, COARSE.0)? {
        let control = &coarse.surface;
        let until = COARSE.1 * control.mean_edge();
        let moved = rounds.run(control, &changed.on(rest, &coarse), until, ctx)?;
        now = rest.with_positions(carry(rest, control, &moved.positions));
    }
    now = rounds.run(&now, &changed, 0.0, ctx)?;
    if full.is_some() {
        now = surface.with_positions(carry(surface, rest, &now.positions));
    }
    let (now, undone) = untangle(surface, now);
    if undone > 0.0 {
        let seen = full.map_or_else(|| now.clone(), |f| f.following(&now));
        let closest = ClosestPoint::new(&seen);
        rounds.note(&Aim::at(&seen, rounds.plane, &closest, &changed, None));
    }
    Ok(Finished {
        undone,
        positions: now.positions,
        plane: rounds.plane,
        rounds: rounds.done,
        asymmetry: rounds.asymmetry.unwrap_or_default(),
    })
}
