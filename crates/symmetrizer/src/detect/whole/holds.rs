//! Whether an isometry holds for the whole of a surface.

use rayon::prelude::*;

use crate::detect::Cloud;
use crate::detect::surroundings::Surroundings;
use crate::geom::{Point, median};
use crate::patch::ground::{contacts, image, touch, touch_one};
use crate::patch::judge::confusion;
use crate::patch::refine::{refine, weigh};
use crate::patch::{PatchPair, Symmetry};
use crate::transform::{Axis, Class, Isometry};

/// The whole is this share of a surface at the least.
const WHOLE: f64 = 0.9;
/// Images further away than this count as so far, fraction of L, where isometries are compared; they face their way to within
/// this cosine.
pub const FAR: f64 = 0.06;
const FACING: f64 = 0.5;
/// Samples that comparing looks at.
const COMPARED: usize = 150;
/// An angle that is no fraction of a turn, nor are its first multiples near one; how many of them stand for any angle.
pub const ANY: f64 = 2.399_963;
pub const ANGLES: u32 = 6;
/// What any angle misses by at the least, fraction of L: a round shape has every turn, and so none of its own.
pub const LEAST: f64 = 0.008;
/// A turn that is the shape's own misses by this share of what others about its axis do, at the most.
pub const TELLING: f64 = 0.4;
/// Largest rms residual, in units of the tolerance: a surface that passes by evenly fills it to .58.
pub const FILLED: f64 = 0.3;
/// Rounds of fitting, each with its tolerance, in units of that of mirrors.
const ROUNDS: [f64; 4] = [2.5, 1.5, 1.0, 1.0];
const AXIS_ROUNDS: [f64; 5] = [3.0, 2.0, 1.5, 1.0, 1.0];
/// Residuals count less from this many times the median on.
const TYPICAL: f64 = 2.0;
/// An improper motion is a mirror when one moves the surface to within this of it, rms fraction of L.
const MIRROR: f64 = 0.01;

/// Whether a symmetry holds for the whole.
pub fn is_whole(s: &Symmetry) -> bool {
    s.area_fraction >= WHOLE && !s.leaves_its_place()
}

/// A surface as a whole.
pub struct Whole<'a> {
    pub surroundings: &'a Surroundings<'a>,
    clouds: &'a [Cloud],
    compared: Vec<u32>,
}

impl<'a> Whole<'a> {
    pub fn new(surroundings: &'a Surroundings<'a>, clouds: &'a [Cloud]) -> Self {
        let count = surroundings.ground.samples.list.len();
        let every = (count / COMPARED).max(1);
        Self {
            compared: (0..count as u32).step_by(every).collect(),
            surroundings,
            clouds,
        }
    }

    /// The rms distance of images from the surface, those far away counting as [`FAR`], fraction of L; as some of the samples tell.
    pub fn missed(&self, t: &Isometry) -> f64 {
        root_mean(self.compared.iter().map(|&s| self.miss(t, s)))
    }

    /// The same of all samples.
    pub fn missed_by_all(&self, t: &Isometry) -> f64 {
        let count = self.surroundings.ground.samples.list.len() as u32;
        let squares: Vec<f64> = (0..count)
            .into_par_iter()
            .map(|s| self.miss(t, s))
            .collect();
        root_mean(squares.into_iter())
    }

    /// The square of the distance of one image.
    pub fn miss(&self, t: &Isometry, sample: u32) -> f64 {
        let pair = touch_one(self.surroundings.ground, t, sample, FAR, FACING, None);
        pair.map_or(FAR, |p| p.residual).powi(2)
    }

    /// What [`Whole::missed`] says of each of several isometries.
    pub fn all_missed(&self, isometries: &[Isometry]) -> Vec<f64> {
        isometries.par_iter().map(|t| self.missed(t)).collect()
    }

    /// Which of several isometries miss by no more than `bound`, fraction of L.
    pub fn all_within(&self, isometries: &[Isometry], bound: f64) -> Vec<bool> {
        let missed = self.all_missed(isometries).into_iter();
        missed.map(|missed| missed <= bound).collect()
    }

    /// The mean by which turns about `axis` by any angle miss, each done after `first`, fraction of L.
    pub fn any_missed(&self, axis: &Axis, first: &Isometry) -> f64 {
        let turns = (1..=ANGLES).map(|k| axis.rotation(f64::from(k) * ANY).after(first));
        let turns: Vec<Isometry> = turns.collect();
        self.all_missed(&turns).iter().sum::<f64>() / f64::from(ANGLES)
    }

    /// Whether a rotation misses by clearly less than others about its axis do.
    fn is_telling(&self, t: &Isometry) -> bool {
        let Some(axis) = Axis::of(t) else {
            return false;
        };
        let any = self.any_missed(&axis, &Isometry::identity());
        any >= LEAST && self.missed(t) <= TELLING * any
    }

    /// `t` as it fits best.
    pub fn fitted(&self, t: &Isometry, class: Class) -> Isometry {
        ROUNDS
            .iter()
            .fold(*t, |t, bound| self.step(&t, class, *bound))
    }

    /// The axis about which a turn by `angle` fits best.
    pub fn fitted_axis(&self, axis: &Axis, angle: f64) -> Option<Axis> {
        AXIS_ROUNDS.iter().try_fold(*axis, |axis, bound| {
            Axis::of(&self.step(&axis.rotation(angle), Class::Proper, *bound))
        })
    }

    /// One step of fitting, to images within `bound` tolerances.
    fn step(&self, t: &Isometry, class: Class, bound: f64) -> Isometry {
        let pairs = self.touched(t, bound);
        if pairs.is_empty() {
            return *t;
        }
        let mut residuals: Vec<f64> = pairs.iter().map(|p| p.residual).collect();
        let typical = median(&mut residuals).unwrap_or(0.0);
        let mut contacts = contacts(self.surroundings.ground, &pairs);
        weigh(t, &mut contacts, TYPICAL * typical);
        refine(t, class, &contacts)
    }

    fn touched(&self, t: &Isometry, bound: f64) -> Vec<PatchPair> {
        let patch = &self.surroundings.params.patch;
        let touched = touch(
            self.surroundings.ground,
            t,
            bound * patch.tolerance,
            patch.min_cos,
        );
        touched.into_iter().flatten().collect()
    }

    /// `t`, fitted, as a symmetry of the whole; `None` where it holds for less, or is a turn as good as any other.
    pub fn symmetry(&self, t: &Isometry) -> Option<Symmetry> {
        let class = match t.is_improper() {
            false => Class::Proper,
            true if self.is_mirror(t) => Class::Mirror,
            true => Class::Improper,
        };
        let t = self.fitted(t, class);
        if class == Class::Proper && !self.is_telling(&t) {
            return None;
        }
        self.held(&t, class)
    }

    /// `t` as it is as a symmetry of the whole; `None` where it holds for less, or where its partners look alike no more than other
    /// places do.
    pub fn held(&self, t: &Isometry, class: Class) -> Option<Symmetry> {
        let Surroundings { ground, params, .. } = self.surroundings;
        let pairs = self.touched(t, 1.0);
        let area_fraction = pairs.len() as f64 / ground.samples.list.len().max(1) as f64;
        if area_fraction < WHOLE {
            return None;
        }
        let squares: f64 = pairs.iter().map(|p| p.residual.powi(2)).sum();
        let rms = (squares / pairs.len() as f64).sqrt();
        if rms > FILLED * params.patch.tolerance {
            return None;
        }
        let confusion = confusion(ground, &pairs);
        let doubt = rms / params.patch.tolerance + 2.0 * confusion;
        if doubt > params.patch.max_doubt {
            return None;
        }
        let q_from_p = match class {
            Class::Mirror => Isometry::mirror(&t.nearest_mirror(&Point::origin()).canonical()),
            Class::Proper | Class::Improper => *t,
        };
        let image = match class {
            Class::Mirror => pairs.iter().map(|p| p.sample).collect(),
            Class::Proper | Class::Improper => image(ground, &pairs),
        };
        Some(Symmetry {
            id: 0,
            class,
            q_from_p,
            height: self.height(t, class),
            area_fraction,
            rms,
            confusion,
            doubt,
            is_evident: true,
            is_of_whole: false,
            pairs,
            image,
        })
    }

    fn is_mirror(&self, t: &Isometry) -> bool {
        let mirror = Isometry::mirror(&t.nearest_mirror(&Point::origin()));
        self.surroundings.space.distance(t, &mirror) < MIRROR
    }

    /// The density of the votes at `t`.
    fn height(&self, t: &Isometry, class: Class) -> f64 {
        let cloud = self.clouds.iter().find(|c| c.class == class);
        let bandwidth = self.surroundings.params.cluster.bandwidth;
        let place = |t: &Isometry| self.surroundings.space.embed(t);
        cloud.map_or(0.0, |c| {
            let both = [*t, t.inverse()];
            both.map(|t| c.votes.density(&place(&t), bandwidth))
                .into_iter()
                .fold(0.0, f64::max)
        })
    }
}

/// The root of the mean of squares.
pub fn root_mean(squares: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = squares.len().max(1) as f64;
    (squares.sum::<f64>() / count).sqrt()
}
