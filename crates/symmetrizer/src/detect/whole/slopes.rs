//! How a surface that is nearly one of revolution rises and falls as it is turned: a warp does so gently over long ways, relief, flutes
//! and knurls steeply or over short ones.

use crate::detect::whole::holds::root_mean;
use crate::geom::PointIndex;
use crate::patch::Ground;
use crate::sample::Sample;
use crate::transform::Axis;

/// Points nearer to the axis than this, fraction of L, hardly turn.
const NEAR: f64 = 0.02;
/// Largest slope of what has warped, upper quartile, radians: .06 where the warp is .6 % of D.
const STEEP: f64 = 0.1;
/// Where half of the samples around one are steeper than this, radians, there is something that is to stay.
const RUGGED: f64 = 0.3;
/// Samples are compared that are apart by a length within the first, and by one within the second, fractions of L.
const LENGTHS: [[f64; 2]; 2] = [[0.025, 0.05], [0.05, 0.075]];
/// Of what slopes have in common at the first length so much is left at the second: .6 and more of warps, nothing of relief whose waves
/// are as long as a fifth of L.
const LEFT: f64 = 0.4;
/// What slopes have in common by chance, in units of their variance.
const CHANCE: f64 = 0.02;
/// Slopes count up to this many times the median: a few places, as a ragged rim, do not speak for all.
const TYPICAL: f64 = 2.0;

/// The slopes of the samples along the way in which they turn about an axis.
pub struct Slopes<'a> {
    ground: &'a Ground<'a>,
    /// For each sample, radians; outwards is positive.
    list: Vec<f64>,
}

impl<'a> Slopes<'a> {
    pub fn new(ground: &'a Ground<'a>, axis: &Axis) -> Self {
        let slope = |s: &Sample| {
            let way = axis.direction.cross(&(s.position - axis.point));
            match way.norm() > NEAR {
                true => s.crisp.dot(&way.normalize()).clamp(-1.0, 1.0).asin(),
                false => 0.0,
            }
        };
        Self {
            ground,
            list: ground.samples.list.iter().map(slope).collect(),
        }
    }

    /// Whether most of what is around a sample is not steep.
    pub fn is_even(&self, sample: u32) -> bool {
        let near = &self.ground.samples.neighbors[sample as usize];
        self.quantile(&[&near[..], &[sample]].concat(), 0.5) <= RUGGED
    }

    /// Whether the `samples` rise and fall as what has warped does.
    pub fn are_gentle(&self, samples: &[u32]) -> bool {
        let [near, far] = self.common(samples);
        self.quantile(samples, 0.75) <= STEEP && far + CHANCE >= LEFT * near
    }

    /// The rms slope of `samples`, radians.
    pub fn rms(&self, samples: &[u32]) -> f64 {
        root_mean(samples.iter().map(|&i| self.list[i as usize].powi(2)))
    }

    /// The size below which a share of the slopes of `samples` lies; 0 of none.
    fn quantile(&self, samples: &[u32], share: f64) -> f64 {
        let mut sizes: Vec<f64> = samples
            .iter()
            .map(|&i| self.list[i as usize].abs())
            .collect();
        if sizes.is_empty() {
            return 0.0;
        }
        let at = ((share * sizes.len() as f64) as usize).min(sizes.len() - 1);
        *sizes.select_nth_unstable_by(at, f64::total_cmp).1
    }

    /// The covariance of the slopes of `samples` on one side of a wall that are apart by each of the [`LENGTHS`], in units of their
    /// variance.
    fn common(&self, samples: &[u32]) -> [f64; 2] {
        let list = &self.ground.samples.list;
        let most = TYPICAL * self.quantile(samples, 0.5);
        let slope = |i: u32| self.list[i as usize].clamp(-most, most);
        let places: Vec<[f64; 3]> = samples
            .iter()
            .map(|&i| list[i as usize].position.coords.into())
            .collect();
        let index = PointIndex::new(&places);
        let mut sums = [(0.0, 0_u32); 2];
        let mut variance = 0.0;
        for (&i, place) in samples.iter().zip(&places) {
            let s = &list[i as usize];
            variance += slope(i).powi(2) / samples.len() as f64;
            for j in index.within(place, LENGTHS[1][1]) {
                let j = samples[j as usize];
                let t = &list[j as usize];
                let apart = (t.position - s.position).norm();
                let of_length = |[least, most]: &[f64; 2]| *least <= apart && apart < *most;
                if let Some(k) = LENGTHS.iter().position(of_length)
                    && s.crisp.dot(&t.crisp) > 0.5
                {
                    sums[k].0 += slope(i) * slope(j);
                    sums[k].1 += 1;
                }
            }
        }
        let mean = |(sum, count): (f64, u32)| sum / f64::from(count.max(1));
        sums.map(|sum| mean(sum) / variance.max(f64::MIN_POSITIVE))
    }
}
