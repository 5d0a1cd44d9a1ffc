//! Contracting orbits (section 4.2 for any number of copies): the samples of all places are pulled to the means of
//! their copies, and the rest of the shape follows as the deformation model lets it.

use crate::context::Context;
use crate::deform::Pull;
use crate::error::Result;
use crate::geom::Vector;
use crate::optimize::moving::{Moving, Snapshot};
use crate::optimize::orbit::goal::Goal;
use crate::optimize::orbit::ground::{Member, members_of_samples};
use crate::optimize::orbit::means::{Means, Scene};

/// What was done.
pub struct Contracted {
    /// The goals, their motions where they were at the end.
    pub goals: Vec<Goal>,
    /// Steps taken.
    pub steps: usize,
    /// Whether the energy limit ended it.
    pub limited: bool,
}

/// Contracts the orbits of `goals` in up to `steps` steps, no further than the energy `most`.
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn contract(
    moving: &mut Moving<'_>,
    goals: &[Goal],
    steps: usize,
    most: Option<f64>,
    ctx: &mut Context<'_>,
) -> Result<Contracted> {
    let members = members_of_samples(moving.samples.list.len(), goals);
    let mut goals = goals.to_vec();
    let mut means = looked(&moving.snapshot(), &members, &goals, 0);
    let mut done = 0;
    let mut limited = false;
    for step in 0..steps {
        ctx.progress(step as f64 / steps as f64)?;
        let state = moving.deformer.state();
        let pulls = pulls(moving, &means);
        let deformed = moving.deformer.deform(&pulls, ctx)?;
        if most.is_some_and(|most| deformed.energy > most) {
            moving.deformer.restore(&state);
            limited = true;
            break;
        }
        done += 1;
        let now = moving.snapshot();
        goals = adjusted(&goals, &looked(&now, &members, &goals, done));
        means = looked(&now, &members, &goals, done);
    }
    Ok(Contracted {
        goals,
        steps: done,
        limited,
    })
}

fn looked(now: &Snapshot, members: &[Vec<Member>], goals: &[Goal], round: usize) -> Means {
    let area = now.samples.area;
    let points = now.samples.list.iter();
    let points: Vec<_> = points.map(|s| (s.position, s.normal, area)).collect();
    let scene = Scene {
        surface: &now.surface,
        closest: &now.closest,
        points: &points,
        members,
    };
    Means::at(&scene, goals, round)
}

fn adjusted(goals: &[Goal], means: &Means) -> Vec<Goal> {
    let fitted = goals.iter().zip(&means.tallies);
    fitted.map(|(g, t)| g.adjusted(&t.equations)).collect()
}

/// Each sample pulled towards the mean of its copies; a sample of area A with A / l^2 over dt, as in a contraction.
fn pulls(moving: &Moving<'_>, means: &Means) -> Vec<Pull> {
    let unit = moving.samples.area / (moving.length * moving.length * moving.step);
    let at: Vec<_> = moving.samples.list.iter().map(|s| s.at).collect();
    let places = moving.deformer.places(&at);
    let ways = means.targets.iter().zip(&means.confidence);
    let all = at.iter().zip(&places).zip(ways);
    all.filter(|(_, (_, c))| **c > 0.0)
        .map(|((at, x), (way, confidence)): (_, (&Vector, &f64))| Pull {
            at: *at,
            target: x + way * moving.step,
            weight: unit * confidence,
        })
        .collect()
}
