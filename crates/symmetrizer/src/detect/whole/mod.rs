//! Symmetries of the whole: turns of any order about the axes that a shape suggests, what else leaves such an axis in its
//! place, and all that follows from these and from whole mirrors (`docs/decisions/0034-symmetries-of-the-whole.md`).
//!
//! Votes find them badly where much of the surface slides along itself, as the disc of a ratchet does, and a single motion is
//! believed only where it holds as well as a copy does by chance. What holds for the whole of a shape and comes round may hold
//! as roughly as a mirror.

mod about;
mod axes;
mod holds;
mod round;
mod slopes;

pub use round::revolution;

use crate::context::Context;
use crate::detect::Cloud;
use crate::detect::surroundings::{Surroundings, is_same};
use crate::error::Result;
use crate::group::{Within, fixed_together, point_group};
use crate::patch::Symmetry;
use crate::transform::{Isometry, Kind};
use holds::Whole;

/// Isometries that count as one, rms displacement over the surface, fraction of L.
const TOLERANCE: f64 = 0.02;
/// A product may hold worse than the worst of what it is made of by this factor: two errors add up.
const PRODUCT: f64 = 2.0;
/// What holds for the whole may miss more than the best of the others does by this factor and by this much, fraction of L: where a box is
/// exact what a cube would have besides is none of its symmetries, nor is a mirror that passes the teeth of a ratchet by.
const WORSE: f64 = 2.5;
const SLACK: f64 = 1e-3;
/// How roughly a product may hold in any case, fraction of L.
const ROUGH: f64 = 1e-3;
/// A group is worth the name from this order on.
const MIN_ORDER: usize = 3;

/// Adds to `symmetries` those of the whole surface that are not among them; `clouds` are the votes.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn whole(
    surroundings: &Surroundings<'_>,
    clouds: &[Cloud],
    symmetries: &mut Vec<Symmetry>,
    ctx: &mut Context<'_>,
) -> Result<()> {
    if !surroundings.params.wanted.has(Kind::Rotation) {
        return Ok(());
    }
    let whole = Whole::new(surroundings, clouds);
    let known = symmetries.iter().filter(|s| holds::is_whole(s)).cloned();
    let mut members = Members {
        list: known.map(|s| Member::new(&whole, s)).collect(),
        whole: &whole,
    };
    let known = members.list.len();
    members.close();
    for axis in axes::suggested(surroundings, symmetries) {
        ctx.progress(0.0)?;
        let known = |t: &Isometry| members.have(t);
        let Some(turn) = about::turn(&whole, &axis, &known) else {
            continue;
        };
        let beside = about::beside(&whole, &turn);
        let found = std::iter::once(turn.step).chain(beside);
        members.add_good(found.collect());
    }
    members.keep(symmetries, known);
    Ok(())
}

/// A symmetry of the whole.
struct Member {
    symmetry: Symmetry,
    /// By how much it misses, fraction of L.
    missed: f64,
    /// Whether it is in a group with others.
    grouped: bool,
}

impl Member {
    fn new(whole: &Whole<'_>, symmetry: Symmetry) -> Self {
        Self {
            missed: whole.missed_by_all(&symmetry.q_from_p),
            symmetry,
            grouped: false,
        }
    }
}

/// Symmetries of the whole.
struct Members<'a> {
    whole: &'a Whole<'a>,
    list: Vec<Member>,
}

impl Members<'_> {
    /// By how much a symmetry of the whole may miss, beside those that there are and `others`.
    fn most(&self, others: &[Member]) -> f64 {
        let all = self.list.iter().chain(others);
        let best = all.map(|m| m.missed).fold(f64::INFINITY, f64::min);
        WORSE * best + SLACK
    }

    /// Whether `t` or its inverse is there.
    fn have(&self, t: &Isometry) -> bool {
        let Surroundings { space, params, .. } = self.whole.surroundings;
        let near = 0.5 * params.cluster.bandwidth;
        let both = [*t, t.inverse()];
        let mut known = self.list.iter().map(|m| &m.symmetry.q_from_p);
        known.any(|k| both.iter().any(|t| space.distance(k, t) < near))
    }

    /// Says among `symmetries` which make the group of the whole, the first of the members being `known` of them, and adds the others in
    /// place of those that are about the same.
    fn keep(self, symmetries: &mut Vec<Symmetry>, known: usize) {
        let Surroundings { space, params, .. } = self.whole.surroundings;
        let near = 0.5 * params.cluster.bandwidth;
        let classes = params.wanted.classes();
        let wholes = symmetries.iter_mut().filter(|s| holds::is_whole(s));
        for (s, member) in wholes.zip(&self.list) {
            s.is_of_whole = member.grouped;
        }
        let new = self.list.into_iter().skip(known);
        let new = new.filter(|m| m.grouped && classes.contains(&m.symmetry.class));
        for mut s in new.map(|m| m.symmetry) {
            symmetries.retain(|k| k.is_of_whole || !is_same(k, &s, space, near));
            s.is_of_whole = true;
            symmetries.push(s);
        }
    }

    fn add(&mut self, member: Member) {
        if !self.have(&member.symmetry.q_from_p) {
            self.list.push(member);
        }
    }

    /// Adds those of the symmetries `found` that hold about as well as the best, and what follows from them.
    fn add_good(&mut self, found: Vec<Symmetry>) {
        let found = found.into_iter().map(|s| Member::new(self.whole, s));
        let found: Vec<Member> = found.collect();
        let most = self.most(&found);
        let before = self.list.len();
        for member in found.into_iter().filter(|m| m.missed <= most) {
            self.add(member);
        }
        if self.list.len() > before {
            self.close();
        }
    }

    /// Adds what follows from those that leave one point in its place and hold about as well as the best, and says which make a group.
    fn close(&mut self) {
        let within = Within {
            space: self.whole.surroundings.space,
            tolerance: TOLERANCE,
        };
        let most = self.most(&[]);
        let good = self.list.iter().filter(|m| m.missed <= most);
        let (isometries, rms): (Vec<Isometry>, Vec<f64>) =
            good.map(|m| (m.symmetry.q_from_p, m.symmetry.rms)).unzip();
        for set in fixed_together(&isometries, within) {
            let worst = set.iter().map(|&i| rms[i]).fold(0.0, f64::max);
            let generators: Vec<Isometry> = set.iter().map(|&i| isometries[i]).collect();
            let mut asked = Asked {
                whole: self.whole,
                within,
                most: PRODUCT * worst + ROUGH,
                known: generators.clone(),
                made: Vec::new(),
            };
            let group = point_group(&generators, within, &mut |t| asked.verify(t));
            let made = asked.made;
            let Some(group) = group.filter(|g| g.elements.len() >= MIN_ORDER) else {
                continue;
            };
            let has = |s: &Symmetry| {
                let near = |g: &Isometry| within.space.distance(g, &s.q_from_p) < TOLERANCE;
                group.elements.iter().any(near)
            };
            for s in made.into_iter().filter(has) {
                self.add(Member::new(self.whole, s));
            }
            for member in self.list.iter_mut().filter(|m| has(&m.symmetry)) {
                member.grouped = true;
            }
        }
    }
}

/// What a group asks the surface for.
struct Asked<'a> {
    whole: &'a Whole<'a>,
    within: Within<'a>,
    /// The rms residual at the most, fraction of L.
    most: f64,
    known: Vec<Isometry>,
    made: Vec<Symmetry>,
}

impl Asked<'_> {
    /// The isometry that is known to be `t`, or what fits the surface there.
    fn verify(&mut self, t: &Isometry) -> Option<Isometry> {
        let both = self.known.iter().flat_map(|k| [*k, k.inverse()]);
        let known = both
            .map(|k| (self.within.space.distance(&k, t), k))
            .filter(|(d, _)| *d < TOLERANCE)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, known)) = known {
            return Some(known);
        }
        let s = self.whole.symmetry(t).filter(|s| s.rms <= self.most)?;
        let t = s.q_from_p;
        self.known.push(t);
        self.made.push(s);
        Some(t)
    }
}
