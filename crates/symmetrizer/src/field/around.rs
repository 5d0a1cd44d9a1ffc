//! Pairs around an outline, all at once: where a field begins on shapes of the plane, and whether there is one.
//!
//! The mirror image of an outline runs round the other way, so partners follow each other in reverse order,
//! outwards from the place where the line of symmetry leaves the shape. Dynamic programming over all stretches of
//! the outline, each with its ends paired, finds the pairing whose partners are most alike, however the line
//! bends, from all such places at once.

use crate::field::Partner;
use crate::sample::{Sample, Samples};
use crate::shape::wall::Wall;

/// What a sample without a partner of its own costs, beside the squared gap of signatures (asinh k r).
const ALONE: f64 = 0.02;
/// Weight of the normals' disagreement about the mirror.
const NORMALS: f64 = 0.5;
/// Partners nearer than this, fraction of L, have no mirror of their own.
const NEAR: f64 = 0.03;
/// Share of the ring within which two pairings begin at the same place.
const SAME: f64 = 0.06;
/// A mirror carries a ring as a whole where it does this share of its samples.
const CARRIED: f64 = 0.8;

/// The best pairing of an outline with itself.
pub struct Around {
    /// The samples of the longest ring with their partners there; nothing for the others.
    pub partners: Vec<Option<Partner>>,
    /// What it costs beside the best pairing from other places: 0 where it is perfect, 1 where others do as well.
    pub rival: f64,
}

impl Around {
    /// Of the longest ring of `wall`.
    pub fn of(wall: &Wall, samples: &Samples) -> Self {
        let ring = longest(wall, samples);
        let mut partners = vec![None; samples.list.len()];
        if ring.len() < 3 {
            return Self {
                partners,
                rival: 1.0,
            };
        }
        let matching = Matching::over(&ring, samples);
        let pairs = matching.pairs();
        for &[i, j] in &pairs {
            for (p, q) in [(i, j), (j, i)] {
                let s = &samples.list[ring[q]];
                partners[ring[p]] = Some(Partner {
                    at: s.at,
                    position: s.position,
                    normal: s.normal,
                    sample: ring[q] as u32,
                    residual: 0.0,
                });
            }
        }
        Self {
            partners,
            rival: matching.rival(&pairs),
        }
    }
}

/// Whether the longest ring of `wall` has most of its `partners` on other rings: one of two wings, say. Then it is not to be
/// paired with itself, however well it could be.
pub fn is_one_of_two(wall: &Wall, samples: &Samples, partners: &[Option<Partner>]) -> bool {
    let ring = longest(wall, samples);
    let on_it = |q: &&Partner| ring.binary_search(&(q.sample as usize)).is_ok();
    let paired = || ring.iter().filter_map(|&s| partners[s].as_ref());
    2 * paired().filter(on_it).count() < paired().count()
}

/// Those of `partners` that one mirror gives to rings which it carries onto the outline as a whole: how these stand to each other is
/// not to be told by what grows from one to the next, which begins with any of them.
pub fn carried(
    wall: &Wall,
    samples: &Samples,
    partners: &[Option<Partner>],
) -> Vec<Option<Partner>> {
    let mut kept = vec![None; partners.len()];
    for ring in rings(wall, samples) {
        let paired = ring.iter().filter(|&&s| partners[s].is_some()).count();
        if paired as f64 >= CARRIED * ring.len() as f64 {
            ring.iter().for_each(|&s| kept[s] = partners[s]);
        }
    }
    kept
}

/// The samples of the longest ring, increasing.
fn longest(wall: &Wall, samples: &Samples) -> Vec<usize> {
    let rings = rings(wall, samples);
    // The first of several.
    let longest = rings.into_iter().rev().max_by_key(Vec::len);
    longest.unwrap_or_default()
}

/// The samples of each ring, increasing.
fn rings(wall: &Wall, samples: &Samples) -> Vec<Vec<usize>> {
    let mut rings = vec![Vec::new(); wall.rings.len()];
    for (k, s) in samples.list.iter().enumerate() {
        rings[wall.along(&s.at).0].push(k);
    }
    rings
}

/// How a stretch became as long as it is.
#[derive(Clone, Copy)]
enum Step {
    /// Both ends moved on.
    Both,
    /// The first alone.
    First,
    /// The last alone.
    Last,
}

/// The best pairings of all stretches of a ring.
struct Matching {
    /// By length, a sample less, and first place: the last step to it.
    steps: Vec<Vec<Step>>,
    /// What the whole ring costs, cut open before each place.
    whole: Vec<f64>,
}

impl Matching {
    /// Of a `ring` of samples, three at least.
    fn over(ring: &[usize], samples: &Samples) -> Self {
        let n = ring.len();
        let sample = |k: usize| &samples.list[ring[k % n]];
        let mut steps = vec![vec![Step::Both; n]];
        // Of stretches one and two samples shorter.
        let mut shorter = [vec![0.0; n], vec![0.0; n]];
        for length in 1..n {
            let longer = |first: usize| {
                let own = unlike(sample(first), sample(first + length));
                let next = (first + 1) % n;
                // Two neighbours begin a pairing as well as one sample does.
                let both = if length > 1 { shorter[1][next] } else { 0.0 };
                let [without_first, without_last] =
                    [shorter[0][next], shorter[0][first]].map(|cost| cost + ALONE);
                let (step, before) = if both <= without_first.min(without_last) {
                    (Step::Both, both)
                } else if without_first <= without_last {
                    (Step::First, without_first)
                } else {
                    (Step::Last, without_last)
                };
                (step, before + own)
            };
            let (taken, costs): (Vec<Step>, Vec<f64>) = (0..n).map(longer).unzip();
            steps.push(taken);
            let [last, _] = shorter;
            shorter = [costs, last];
        }
        let [whole, _] = shorter;
        Self { steps, whole }
    }

    /// The pairs of the best one, places in the ring, from the ends of the cut inwards.
    fn pairs(&self) -> Vec<[usize; 2]> {
        let n = self.whole.len();
        let best = (0..n).min_by(|&a, &b| self.whole[a].total_cmp(&self.whole[b]));
        let (mut first, mut length) = (best.unwrap_or_default(), n - 1);
        let mut pairs = Vec::with_capacity(n);
        loop {
            pairs.push([first % n, (first + length) % n]);
            let step = self.steps[length][first % n];
            let fewer = if matches!(step, Step::Both) { 2 } else { 1 };
            if length < fewer {
                return pairs;
            }
            length -= fewer;
            first += usize::from(!matches!(step, Step::Last));
        }
    }

    /// The cost of the best pairing, `pairs`, beside that of the best which begins and ends elsewhere.
    fn rival(&self, pairs: &[[usize; 2]]) -> f64 {
        let n = self.whole.len();
        let apart = |a: usize, b: usize| {
            let way = (a + n - b) % n;
            way.min(n - way) as f64 > SAME * n as f64
        };
        let ends = [pairs[0][0], pairs[pairs.len() - 1][0]];
        let others = (0..n).filter(|&a| ends.iter().all(|&end| apart(a, end)));
        let other = others.map(|a| self.whole[a]).fold(f64::INFINITY, f64::min);
        let best = self.whole.iter().copied().fold(f64::INFINITY, f64::min);
        best / other.max(f64::MIN_POSITIVE)
    }
}

/// How little two samples look like partners.
fn unlike(p: &Sample, q: &Sample) -> f64 {
    let gap = p.signature.distance(&q.signature).unwrap_or_default();
    let way = q.position - p.position;
    let square = way.norm_squared();
    let image = p.normal - 2.0 * way * (way.dot(&p.normal) / square.max(f64::MIN_POSITIVE));
    let say = square / (square + NEAR * NEAR);
    gap * gap + NORMALS * say * (image - q.normal).norm_squared()
}
