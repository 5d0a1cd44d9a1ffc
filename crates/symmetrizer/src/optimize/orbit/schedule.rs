//! The schedule over orbits (section 4.2): what is far from its copies is contracted, then all is drawn to the means
//! at full resolution; goals that others exclude are given up, those of less of the surface first.

use crate::context::Context;
use crate::detect::Detection;
use crate::error::Result;
use crate::optimize::orbit::contract::contract;
use crate::optimize::orbit::goal::Goal;
use crate::optimize::orbit::rounds::{Drawn, Fitted, Limit, draw};
use crate::optimize::outcome::{Met, Optimized, Outcome, Step, next_id};
use crate::optimize::schedule::{Settings, moving, prepared};
use crate::shape::Surface;

/// Copies that lie further from the surface than this (rms, fraction of L) are contracted first: the finish at full
/// resolution moves the surface along its normals only.
const ROUGH: f64 = 0.003;
/// A goal is not met that leaves more than this share of its residual, and more than this of L.
const UNMET: f64 = 0.4;
const FLOOR: f64 = 7e-4;
/// A goal is met from the start where equation 1 moves its places by less than this share of the distances that are
/// measured, or than this, fraction of L: the rest is the flat faces of a curved surface and what nobody sees.
const FLAT: f64 = 0.3;
const EXACT: f64 = 5e-5;
/// A goal that is this near to being met, fraction of L, is let be for one that it touches and that is further by this factor.
const QUIET: f64 = 4e-4;
const LOUDER: f64 = 3.0;
/// They have this share of the smaller one's samples in common at the least: the ground that elements stand on is its rim.
const TOUCHING: f64 = 0.02;
/// Goals that find fewer of their copies than this share are let be: short extrusions, of which a shift leaves little,
/// and what only begins to come again.
const HELD: f64 = 0.5;
/// A goal that keeps this share of its residual gains nothing worth the change: it is as exact as its triangles let it
/// be.
const GAINED: f64 = 0.9;
/// The same where there is hardly anything to be gained.
const GAINED_OF_LITTLE: f64 = 0.7;
/// A goal that was met and is further now by this factor, and by more than [`FLOOR`], was spoiled by others.
const SPOILED: f64 = 2.0;
/// Goals share ground where this share of the smaller one's samples is in both.
const SHARED: f64 = 0.2;

/// Makes `goals` exact on `surface`, where `detection` found them; those of most of the surface come first.
///
/// # Errors
/// [`crate::Error::Params`], [`crate::Error::Numerical`], [`crate::Error::Cancelled`].
pub fn orbits(
    surface: &Surface,
    detection: &Detection,
    goals: &[Goal],
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Optimized> {
    settings.optimize.check()?;
    let mut wanted: Vec<Goal> = goals.to_vec();
    let mut left = Vec::new();
    loop {
        let made = made(surface, detection, &wanted, settings, ctx)?;
        match given_up(&wanted, &made) {
            Some((loser, winner)) if made.outcome == Outcome::Converged => {
                let goal = wanted.remove(loser);
                if let Some(winner) = winner {
                    ctx.warn(format!(
                        "{} cannot be made exact together with {winner}, which holds for more of the shape: it is \
                         left",
                        goal.name
                    ));
                }
                let residual = made.before.rms[loser];
                left.push(Met::left(&goal, [residual; 2], made.before.held[loser]));
            }
            _ => return Ok(made.finished(surface, detection, left)),
        }
    }
}

/// What became of the goals.
struct Made {
    drawn: Drawn,
    before: Fitted,
    steps: usize,
    energy: f64,
    outcome: Outcome,
}

fn made(
    surface: &Surface,
    detection: &Detection,
    goals: &[Goal],
    settings: Settings<'_>,
    ctx: &mut Context<'_>,
) -> Result<Made> {
    let most = settings.optimize.max_deformation;
    let samples = &detection.samples;
    let mut before = ctx.stage("fit", |_| Fitted::of(surface, samples, goals))?;
    for (k, goal) in before.goals.iter_mut().enumerate() {
        let exact = before.halves[k] < (FLAT * before.rms[k]).max(EXACT);
        goal.is_met = exact || before.held[k] < HELD;
    }
    let quiet = quiet(&before, goals);
    for (goal, quiet) in before.goals.iter_mut().zip(quiet) {
        goal.is_met |= quiet;
    }
    let open = || (0..goals.len()).filter(|&k| !before.goals[k].is_met);
    let mut body = ctx.stage("prepare", |_| prepared(surface, settings))?;
    let steps = match open().any(|k| before.rms[k] > ROUGH) {
        true => settings.optimize.contract_steps,
        false => 0,
    };
    let mut moving = moving(surface, detection, settings, body.as_mut());
    let contracted = ctx.stage("contract", |ctx| {
        contract(&mut moving, &before.goals, steps, most, ctx)
    })?;
    let now = match contracted.steps {
        0 => surface.clone(),
        _ => surface.with_positions(body.positions()),
    };
    let limit = Limit {
        body: body.as_ref(),
        most,
    };
    let drawn = ctx.stage("finish", |ctx| {
        let rounds = match contracted.limited {
            true => 0,
            false if open().next().is_none() => 0,
            false => settings.optimize.orbit_rounds,
        };
        draw(
            &now,
            samples,
            &contracted.goals,
            rounds,
            settings.stiffness,
            &limit,
            ctx,
        )
    })?;
    let limited = contracted.limited || drawn.limited;
    Ok(Made {
        energy: body.energy_at(&drawn.positions),
        before,
        steps: contracted.steps,
        outcome: if limited {
            Outcome::EnergyLimit
        } else {
            Outcome::Converged
        },
        drawn,
    })
}

/// Which of the `goals` are so nearly met that they are let be for others on the same ground that are not: a plate that is exact but
/// for its triangles would only hold the elements on it.
fn quiet(before: &Fitted, goals: &[Goal]) -> Vec<bool> {
    let open = |k: usize| !before.goals[k].is_met;
    let is_louder = |k: usize, other: usize| {
        let louder = open(other) && before.rms[other] > LOUDER * before.rms[k];
        louder && goals[k].shared(&goals[other]) >= TOUCHING
    };
    let all = 0..goals.len();
    let quiet = |k| before.rms[k] < QUIET && all.clone().any(|other| is_louder(k, other));
    all.clone().map(quiet).collect()
}

/// A goal to give up: one that gains nothing, those first that are as exact as their triangles let them be, so that they do not hold
/// others back; or one that is not met where one that was wanted more, which has this name, lies on the same ground. The last one
/// first.
fn given_up(goals: &[Goal], made: &Made) -> Option<(usize, Option<String>)> {
    let pursued = || {
        let all = (0..goals.len()).rev();
        all.filter(|&k| !made.before.goals[k].is_met)
    };
    let gains = |k: usize| {
        let before = made.before.rms[k];
        let kept = if before < QUIET {
            GAINED_OF_LITTLE
        } else {
            GAINED
        };
        made.drawn.rms[k] <= kept * before
    };
    // What is met moves nothing, and only may have been spoiled.
    let hinders = |k: usize| {
        let spoiled = made.drawn.rms[k] > (SPOILED * made.before.rms[k]).max(FLOOR);
        !made.before.goals[k].is_met || spoiled
    };
    let fine = |k: usize| made.drawn.rms[k] <= FLOOR;
    let least = |a: &usize, b: &usize| made.before.rms[*a].total_cmp(&made.before.rms[*b]);
    let exact = pursued().filter(|&k| !gains(k) && fine(k)).min_by(least);
    if let Some(k) = exact {
        return Some((k, None));
    }
    pursued().find_map(|k| {
        let unmet = !gains(k) || made.drawn.rms[k] > (UNMET * made.before.rms[k]).max(FLOOR);
        let mut larger = 0..k;
        let winner = larger.find(|&g| hinders(g) && goals[g].shared(&goals[k]) >= SHARED);
        let name = winner.map(|g| goals[g].name.clone());
        let spoils = winner.is_some_and(|g| made.before.goals[g].is_met);
        (spoils || unmet && (name.is_some() || !gains(k))).then_some((k, name))
    })
}

/// The goals that are exact now: not those that were let be because they find few of their copies, nor those that were met and were
/// spoiled by others.
fn exact(before: &Fitted, drawn: &Drawn) -> Vec<Goal> {
    let holds = |k: &usize| before.held[*k] >= HELD;
    let spoiled = |k: usize| drawn.rms[k] > SPOILED * before.rms[k] && drawn.rms[k] > EXACT;
    let kept = |k: &usize| !(drawn.goals[*k].is_met && spoiled(*k));
    let all = (0..drawn.goals.len()).filter(holds).filter(kept);
    all.map(|k| drawn.goals[k].clone()).collect()
}

impl Made {
    fn finished(self, surface: &Surface, detection: &Detection, left: Vec<Met>) -> Optimized {
        let drawn = self.drawn;
        let exact = exact(&self.before, &drawn);
        let met = drawn.goals.iter().enumerate().map(|(k, goal)| {
            let (residual, held) = ([self.before.rms[k], drawn.rms[k]], self.before.held[k]);
            match held < HELD {
                true => Met::left(goal, residual, held),
                false => Met::new(goal, residual, held),
            }
        });
        let step = Step::Orbits {
            goals: met.chain(left).collect(),
            steps: self.steps,
            rounds: drawn.rounds,
            predicted: self.before.predicted,
            energy: self.energy,
        };
        Optimized {
            positions: drawn.positions,
            outcome: self.outcome,
            steps: vec![step],
            energy: self.energy,
            next_id: next_id(detection),
            goals: exact,
            ..Optimized::unmoved(surface, detection, self.outcome)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optimize::orbit::goal::Orbit;
    use crate::transform::Ambient;

    /// Of three goals that are met the first finds few of its copies, and the second was spoiled.
    #[test]
    fn what_was_let_be_is_not_called_exact() {
        let goals: Vec<Goal> = ["scarce", "spoiled", "kept"]
            .map(|name| Goal {
                name: name.into(),
                symmetries: Vec::new(),
                orbit: Orbit::Group(Vec::new()),
                places: Vec::new(),
                area_fraction: 0.5,
                reach: 0.01,
                ambient: Ambient::Space,
                is_met: true,
            })
            .into();
        let before = Fitted {
            rms: vec![2e-3, 1e-4, 1e-4],
            halves: vec![0.0; 3],
            held: vec![0.4, 0.9, 0.9],
            predicted: 0.0,
            goals: goals.clone(),
        };
        let drawn = Drawn {
            positions: Vec::new(),
            rounds: 1,
            rms: vec![2e-3, 4e-4, 1e-4],
            limited: false,
            goals,
        };
        let names: Vec<String> = exact(&before, &drawn).into_iter().map(|g| g.name).collect();
        assert_eq!(names, ["kept"]);
    }
}
