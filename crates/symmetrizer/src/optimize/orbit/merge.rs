//! Merging rotations (section 4.2): of a shape that is bent, two parts with the same rotations about axes of their own turn until one axis
//! serves both.

use crate::context::Context;
use crate::deform::Pull;
use crate::deform::elastic::Motion;
use crate::error::Result;
use crate::geom::{Point, Vector};
use crate::optimize::moving::Moving;
use crate::optimize::orbit::goal::{Goal, Orbit};
use crate::optimize::params::OptimizeParams;
use crate::patch::ground::{Ground, touch};
use crate::shape::SurfacePoint;
use crate::transform::{Ambient, Axis, Isometry, Jointed, TransformSpace};

/// Both parts together are this share of the surface at the least: two flanges are not the pipe between them.
const MOST: f64 = 0.5;
/// They have less than this share of the smaller one in common.
const SHARED: f64 = 0.2;
/// Once they are merged, images lie within this of the surface, fraction of L, and face its way to within this cosine: what lay in the bend
/// has to come a long way.
const REACH: f64 = 0.03;
const MIN_COS: f64 = 0.4;
/// Their axes pass each other by no more than this share of the way from part to part.
const GAP: f64 = 0.15;

/// What a merge did.
#[derive(Debug, Clone, Copy)]
pub struct Merged {
    /// Steps taken.
    pub steps: usize,
    /// Distance of the rotations in transformation space before and after, fraction of L.
    pub distance: [f64; 2],
    /// Deformation energy at the end.
    pub energy: f64,
    /// Whether the energy limit ended it.
    pub limited: bool,
    /// The common axis, and the order of the rotations about it.
    axis: Axis,
    order: usize,
}

/// One of the two parts.
struct Part {
    /// The places of its samples on the surface, and where they were at rest.
    at: Vec<SurfacePoint>,
    rest: Vec<Point>,
    /// Its axis at rest, and the order of the rotations about it.
    axis: Axis,
    order: usize,
}

/// The two of `goals`, those of most of the surface first, that are one group of rotations but for a bend between them: of the same
/// order, one after the other along axes that meet, nearly at least, and make no larger angle than `params` allow. None where the whole has a group.
pub fn jointed(goals: &[Goal], moving: &Moving<'_>, params: &OptimizeParams) -> Option<[usize; 2]> {
    if goals.iter().any(Goal::is_of_the_whole) {
        return None;
    }
    let largest = params.merge_angle.to_radians();
    let is_jointed = |a: &Goal, b: &Goal| {
        let orders = [a, b].map(|goal| goal.cyclic().map(|(order, _)| order));
        if orders[0].is_none() || orders[0] != orders[1] {
            return false;
        }
        let (Some(one), Some(other)) = (Part::of(a, moving), Part::of(b, moving)) else {
            return false;
        };
        let joint = joint(&[one, other], moving);
        joint.angle() <= largest && joint.aslant() <= largest && joint.gap() <= GAP
    };
    let all = 0..goals.len();
    let mut pairs = all
        .clone()
        .flat_map(|i| (i + 1..goals.len()).map(move |j| [i, j]));
    pairs.find(|&[i, j]| {
        let (a, b) = (&goals[i], &goals[j]);
        let most = a.area_fraction + b.area_fraction >= MOST;
        most && a.shared(b) < SHARED && is_jointed(a, b)
    })
}

/// Carries the parts of two `goals` with the same rotations to a common axis, step by step: about the place where their axes meet, along
/// arcs, so that nothing is squeezed (as mirrors are carried, decision 0003).
///
/// `None` where they are not groups of rotations.
///
/// # Errors
/// As [`crate::deform::Deformer::deform`].
pub fn merge(
    moving: &mut Moving<'_>,
    goals: [&Goal; 2],
    params: &OptimizeParams,
    ctx: &mut Context<'_>,
) -> Result<Option<Merged>> {
    let [Some(a), Some(b)] = goals.map(|goal| Part::of(goal, moving)) else {
        return Ok(None);
    };
    let parts = [a, b];
    let order = parts[0].order;
    let mut joint = joint(&parts, moving);
    let mut done = Merged {
        steps: 0,
        distance: [apart(&joint, order, &parts, moving); 2],
        energy: moving.deformer.energy(),
        limited: false,
        axis: joint.common(),
        order,
    };
    for k in 0..params.merge_steps {
        ctx.progress(k as f64 / params.merge_steps as f64)?;
        if done.distance[1] < params.merged_distance {
            break;
        }
        let pulls = pulls(moving, &parts, &joint);
        let before = moving.deformer.state();
        let energy = moving.deformer.deform(&pulls, ctx)?.energy;
        if params.max_deformation.is_some_and(|most| energy > most) {
            moving.deformer.restore(&before);
            done.limited = true;
            break;
        }
        done.steps += 1;
        done.energy = energy;
        joint = self::joint(&parts, moving);
        done.distance[1] = apart(&joint, order, &parts, moving);
        done.axis = joint.common();
    }
    Ok(Some(done))
}

impl Merged {
    /// The goal that two `goals` are now, on all of the `ground` that comes near itself by most of its rotations.
    pub fn goal(&self, goals: [&Goal; 2], ground: &Ground<'_>) -> Goal {
        let turn = std::f64::consts::TAU / self.order as f64;
        let elements: Vec<Isometry> = (1..self.order)
            .map(|k| self.axis.rotation(k as f64 * turn))
            .collect();
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
            name: format!("C{}", self.order),
            symmetries: goals.iter().flat_map(|g| g.symmetries.clone()).collect(),
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
    /// What a goal holds for.
    fn of(goal: &Goal, moving: &Moving<'_>) -> Option<Self> {
        let (order, axis) = goal.cyclic()?;
        let samples = goal.places.iter().flatten();
        let samples: Vec<_> = samples.map(|&i| &moving.samples.list[i as usize]).collect();
        Some(Self {
            at: samples.iter().map(|s| s.at).collect(),
            rest: samples.iter().map(|s| s.position).collect(),
            axis,
            order,
        })
    }

    /// Where the part is now: its samples, their middle and the axis, which moves as they do.
    fn now(&self, moving: &Moving<'_>) -> (Vec<Point>, Point, Axis) {
        let places = moving.deformer.places(&self.at);
        let motion = Motion::between(&self.rest, &places, &vec![1.0; places.len()]);
        let axis = self.axis.carried(&Isometry {
            linear: motion.rotation,
            translation: motion.apply(&Point::origin()).coords,
        });
        let sum: Vector = places.iter().map(|x| x.coords).sum();
        let middle = Point::from(sum / places.len().max(1) as f64);
        (places, middle, axis)
    }
}

fn joint(parts: &[Part; 2], moving: &Moving<'_>) -> Jointed {
    let now = [0, 1].map(|k| parts[k].now(moving));
    Jointed::new([now[0].2, now[1].2], [now[0].1, now[1].1])
}

/// The distance of the smallest turns of both parts, over both.
fn apart(joint: &Jointed, order: usize, parts: &[Part; 2], moving: &Moving<'_>) -> f64 {
    let support = parts.iter().flat_map(|part| part.now(moving).0);
    let space = TransformSpace::new(support.map(|x| (x, 1.0)));
    let turn = std::f64::consts::TAU / order as f64;
    let [a, b] = joint.axes.map(|axis| axis.rotation(turn));
    space.distance(&a, &b)
}

/// Each sample pulled as its part is carried; a sample of area A with A / l^2 over dt, as in a contraction.
fn pulls(moving: &Moving<'_>, parts: &[Part; 2], joint: &Jointed) -> Vec<Pull> {
    let weight = moving.samples.area / (moving.length * moving.length * moving.step);
    let carries = joint.carries().map(|carry| carry.part(moving.step));
    let both = parts.iter().zip(&carries);
    both.flat_map(|(part, carry)| {
        let places = moving.deformer.places(&part.at);
        let pull = |(at, x): (&SurfacePoint, &Point)| Pull {
            at: *at,
            target: carry.apply(x),
            weight,
        };
        part.at.iter().zip(&places).map(pull).collect::<Vec<_>>()
    })
    .collect()
}
