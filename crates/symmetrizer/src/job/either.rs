//! A shape whose bend is not sure: made symmetric as a whole under one mirror, or about its bent axis as far as that is
//! trusted, whichever leaves less.

use crate::context::Context;
use crate::error::Result;
use crate::field::trust::Verdict;
use crate::job::Detected;
use crate::job::bent::{Looked, unbend_part};
use crate::job::further::further;
use crate::job::guard::{mended, spoiled, tangled};
use crate::job::otherwise::unbend_otherwise;
use crate::job::state::State;
use crate::optimize::outcome::mirrors;
use crate::optimize::schedule::Settings;
use crate::optimize::{Optimized, Step, optimize};
use crate::straighten::StraightenParams;

/// Where one way leaves more than this share of the mean asymmetry the other one is tried, too.
const MUCH: f64 = 0.3;

/// The shape with the mirrors that are to become one, and how to work on it.
pub(super) struct Either<'a> {
    pub before: &'a Detected,
    /// Its mean asymmetry, fraction of L.
    pub asymmetry: f64,
    pub params: &'a StraightenParams,
    pub settings: Settings<'a>,
}

/// What came of a shape.
pub(super) struct Made {
    pub done: Optimized,
    /// Whether it is no more than a part of it that is symmetric.
    pub part: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    /// Under the mirror that holds for most of it (section 4.2: contract, merge).
    Straight,
    /// About its bent axis.
    Bent,
}

/// What came of one way.
struct Tried {
    made: Made,
    /// The mean asymmetry that is left, fraction of L.
    left: f64,
}

impl Either<'_> {
    /// The better of both ways for the shape whose bend was `looked` at and not undone; where neither comes to anything, what its
    /// main mirror holds for.
    ///
    /// # Errors
    /// Those of detection, measuring and the deformation.
    pub fn made(&self, looked: &mut Looked, ctx: &mut Context<'_>) -> Result<Made> {
        let ways = match self.is_rather_bent(looked) {
            true => [Way::Bent, Way::Straight],
            false => [Way::Straight, Way::Bent],
        };
        let mut best: Option<(Way, Tried)> = None;
        for way in ways {
            if best
                .as_ref()
                .is_some_and(|(_, b)| self.is_enough(looked, b))
            {
                break;
            }
            let tried = match way {
                Way::Straight => self.straight(ctx)?,
                Way::Bent => self.bent(looked, ctx)?,
            };
            let better = |g: &Tried| best.as_ref().is_none_or(|(_, b)| g.left < b.left);
            if let Some(tried) = tried.filter(better) {
                best = Some((way, tried));
            }
        }
        if best.as_ref().is_none_or(|(way, _)| *way != Way::Bent) {
            looked.stays();
        }
        match best {
            Some((_, tried)) => Ok(tried.made),
            None => self.part(ctx),
        }
    }

    /// Whether what is left of one way is not worth the other: it is little, or the other has next to nothing for it.
    fn is_enough(&self, looked: &Looked, tried: &Tried) -> bool {
        let uncertain = verdict(looked) == Some(Verdict::Uncertain);
        tried.left <= MUCH * self.asymmetry || !uncertain
    }

    /// Whether more of the shape is trusted to be symmetric about a bent axis than one mirror holds for: as a whole it will
    /// hardly be had under that.
    fn is_rather_bent(&self, looked: &Looked) -> bool {
        let areas = mirrors(&self.before.detection).map(|m| m.area_fraction);
        let held = areas.fold(0.0, f64::max);
        let trusted = looked.report.as_ref().map_or(0.0, |bend| bend.trusted);
        verdict(looked) == Some(Verdict::Uncertain) && trusted > held
    }

    /// `None` where the result is tangled, or no more symmetric than the shape was.
    fn straight(&self, ctx: &mut Context<'_>) -> Result<Option<Tried>> {
        let Detected {
            working, detection, ..
        } = self.before;
        let done = optimize(&working.surface, detection, self.settings, ctx)?;
        let done = mended(self.before, done, ctx)?;
        if spoiled(self.before, &done) {
            return Ok(None);
        }
        let left = self.left(&done, ctx)?;
        let made = Made { done, part: false };
        Ok((left < self.asymmetry).then_some(Tried { made, left }))
    }

    /// `None` where nothing is undone.
    fn bent(&self, looked: &mut Looked, ctx: &mut Context<'_>) -> Result<Option<Tried>> {
        let Self {
            before,
            asymmetry,
            params,
            settings,
        } = *self;
        let done = match unbend_part(before, asymmetry, looked, params, settings, ctx)? {
            Some(done) => done,
            None => match unbend_otherwise(self, looked, ctx)? {
                Some((done, otherwise)) => {
                    *looked = otherwise;
                    done
                }
                None => return Ok(None),
            },
        };
        let done = mended(before, done, ctx)?;
        // What stays of a bend stands where it was found, and is not measured by one mirror.
        let (done, whole, mean) = match params.share < 1.0 {
            true => (done, false, 0.0),
            false => {
                let further = further((before, asymmetry), done, params, settings, ctx)?;
                (further.done, further.whole, further.mean)
            }
        };
        let left = match tangled(before, &done) {
            true => f64::INFINITY,
            false => mean,
        };
        let part = !whole;
        let made = Made { done, part };
        Ok(Some(Tried { made, left }))
    }

    /// What the main mirror holds for.
    fn part(&self, ctx: &mut Context<'_>) -> Result<Made> {
        let Detected {
            working, detection, ..
        } = self.before;
        let settings = Settings {
            part: true,
            ..self.settings
        };
        let done = optimize(&working.surface, detection, settings, ctx)?;
        let done = mended(self.before, done, ctx)?;
        Ok(Made { done, part: true })
    }

    /// The mean asymmetry that is left of what was `done`, fraction of L: measured where the finish does not say that it is little.
    fn left(&self, done: &Optimized, ctx: &mut Context<'_>) -> Result<f64> {
        let finished = done.steps.iter().rev().find_map(|step| match step {
            Step::Finish { asymmetry, .. } => Some(asymmetry[1]),
            _ => None,
        });
        match finished.filter(|left| *left <= MUCH * self.asymmetry) {
            Some(left) => Ok(left),
            None => Ok(State::of(self.before, done, self.settings, ctx)?.mean),
        }
    }
}

fn verdict(looked: &Looked) -> Option<Verdict> {
    looked.report.as_ref().map(|bend| bend.verdict)
}
