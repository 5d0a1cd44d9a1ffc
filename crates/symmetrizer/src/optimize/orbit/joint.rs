//! Two parts of a bent shape that are one group of rotations once it is straight.

use crate::deform::elastic::Motion;
use crate::geom::{Point, Vector};
use crate::optimize::orbit::goal::{Goal, Orbit};
use crate::optimize::params::OptimizeParams;
use crate::patch::ground::{Ground, touch};
use crate::sample::Samples;
use crate::shape::SurfacePoint;
use crate::transform::{Ambient, Axis, Isometry, Jointed, Plane, TransformSpace};

/// Both parts together are this share of the surface at the least: two flanges are not the pipe between them.
const MOST: f64 = 0.5;
/// They have less than this share of the smaller one in common.
const SHARED: f64 = 0.2;
/// Their axes pass each other by no more than this share of the way from part to part.
const GAP: f64 = 0.15;
/// On the straight shape images lie within this of the surface, fraction of L, and face its way to within this cosine: what lay in the
/// bend has to come a long way.
const REACH: f64 = 0.03;
const MIN_COS: f64 = 0.4;

/// The two parts.
pub struct Parts {
    parts: [Part; 2],
    /// The order of their rotations.
    order: usize,
    /// Ids of the symmetries of both.
    symmetries: Vec<u32>,
}

/// One of them.
struct Part {
    /// The places of its samples on the surface, and where they were at rest.
    at: Vec<SurfacePoint>,
    rest: Vec<Point>,
    /// Its axis at rest.
    axis: Axis,
}

/// The two of `goals` for `samples`, those of most of the surface first, that are one group of rotations but for a bend between them: of the
/// same order, one after the other along axes that meet, nearly at least, and make no larger angle than `params` allow; and their parts. None where
/// the whole has a symmetry.
pub fn jointed<'a>(
    goals: &'a [Goal],
    samples: &Samples,
    params: &OptimizeParams,
) -> Option<([&'a Goal; 2], Parts)> {
    if goals.iter().any(Goal::is_of_the_whole) {
        return None;
    }
    let largest = params.merge_angle.to_radians();
    let is_jointed = |parts: &Parts| {
        let joint = parts.joint(&parts.parts.each_ref().map(|part| part.rest.clone()));
        joint.angle() <= largest && joint.aslant() <= largest && joint.gap() <= GAP
    };
    let later = |(i, a)| goals[i + 1..].iter().map(move |b| [a, b]);
    let mut pairs = goals.iter().enumerate().flat_map(later);
    pairs.find_map(|pair @ [a, b]| {
        let most = a.area_fraction + b.area_fraction >= MOST;
        let parts = Parts::of(pair, samples).filter(|_| most && a.shared(b) < SHARED)?;
        is_jointed(&parts).then_some((pair, parts))
    })
}

impl Parts {
    /// What two `goals` for `samples` hold for; `None` where they are not groups of rotations of the same order.
    pub fn of(goals: [&Goal; 2], samples: &Samples) -> Option<Self> {
        let [(order, first), (other, second)] = [goals[0].cyclic()?, goals[1].cyclic()?];
        let part = |goal: &Goal, axis| {
            let own = goal.places.iter().flatten();
            let own: Vec<_> = own.map(|&i| &samples.list[i as usize]).collect();
            Part {
                at: own.iter().map(|s| s.at).collect(),
                rest: own.iter().map(|s| s.position).collect(),
                axis,
            }
        };
        (order == other).then(|| Self {
            parts: [part(goals[0], first), part(goals[1], second)],
            order,
            symmetries: goals.iter().flat_map(|g| g.symmetries.clone()).collect(),
        })
    }

    /// The places of the samples of each on the surface.
    pub fn at(&self) -> [&[SurfacePoint]; 2] {
        self.parts.each_ref().map(|part| part.at.as_slice())
    }

    /// How they stand to each other with their samples at these `places`: an axis moves as its part does.
    pub fn joint(&self, places: &[Vec<Point>; 2]) -> Jointed {
        let now = [0, 1].map(|k| self.parts[k].now(&places[k]));
        Jointed::new(now.map(|(axis, _)| axis), now.map(|(_, middle)| middle))
    }

    /// The distance of the smallest turns of both, over both, fraction of L.
    pub fn apart(&self, joint: &Jointed, places: &[Vec<Point>; 2]) -> f64 {
        let support = places.iter().flatten();
        let space = TransformSpace::new(support.map(|x| (*x, 1.0)));
        let turn = std::f64::consts::TAU / self.order as f64;
        let [a, b] = joint.axes.map(|axis| axis.rotation(turn));
        space.distance(&a, &b)
    }

    /// The goal that they are where they have a common `axis`, on all of the `ground` that comes near itself by most of the group; with the
    /// mirrors through the axis where one of them is known.
    pub fn goal(&self, axis: &Axis, mirror: Option<&Plane>, ground: &Ground<'_>) -> Goal {
        let axis = mirror.map_or(*axis, |plane| axis.within(plane));
        let turn = std::f64::consts::TAU / self.order as f64;
        let turns = (0..self.order).map(|k| axis.rotation(k as f64 * turn));
        let turns: Vec<Isometry> = turns.collect();
        let mirrors = mirror.map(Isometry::mirror);
        let mirrors = mirrors
            .iter()
            .flat_map(|m| turns.iter().map(|t| t.after(m)));
        let elements: Vec<Isometry> = turns[1..].iter().copied().chain(mirrors).collect();
        let count = ground.samples.list.len();
        let mut copies = vec![0; count];
        for t in &elements {
            for pair in touch(ground, t, REACH, MIN_COS).into_iter().flatten() {
                copies[pair.sample as usize] += 1;
            }
        }
        let most = |i: &u32| 2 * copies[*i as usize] > elements.len();
        let place: Vec<u32> = (0..count as u32).filter(most).collect();
        Goal {
            name: format!("C{}{}", self.order, if mirror.is_some() { "v" } else { "" }),
            symmetries: self.symmetries.clone(),
            area_fraction: place.len() as f64 / count.max(1) as f64,
            orbit: Orbit::Group(elements),
            places: vec![place],
            reach: REACH,
            ambient: Ambient::Space,
            is_met: false,
        }
    }
}

impl Part {
    /// Its axis and its middle with its samples at these `places`.
    fn now(&self, places: &[Point]) -> (Axis, Point) {
        let motion = Motion::between(&self.rest, places, &vec![1.0; places.len()]);
        let axis = self.axis.carried(&Isometry {
            linear: motion.rotation,
            translation: motion.apply(&Point::origin()).coords,
        });
        let sum: Vector = places.iter().map(|x| x.coords).sum();
        (axis, Point::from(sum / places.len().max(1) as f64))
    }
}
