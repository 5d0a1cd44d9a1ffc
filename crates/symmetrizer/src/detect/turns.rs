//! Turns of an outline about a centre: of the whole, or of rings that have them by themselves, such as the rim of a gear
//! around a letter, or the holes along it.

use rayon::prelude::*;

use crate::detect::groups::Group;
use crate::geom::{Ambient, Point, Vector, exp_rotation};
use crate::patch::ground::{image, touch_one};
use crate::patch::{Ground, PatchPair, Symmetry};
use crate::shape::wall::Wall;
use crate::transform::{Class, Correspondence, Isometry, Plane, optimal::optimal_rigid};

/// Orders that are tried.
const ORDERS: std::ops::RangeInclusive<u32> = 2..=60;
/// Images may lie this far from the outline, fraction of the size of what turns (L of the whole), where a turn is
/// tried, and facing its way to within this cosine.
const NEAR: f64 = 0.02;
const MIN_COS: f64 = 0.5;
/// What is further away counts as so far, fraction of the size.
const FAR: f64 = 0.1;
/// Share of what turns that a turn must hold for, and the rms distance at the most, fraction of the size.
const WHOLE: f64 = 0.95;
const RMS: f64 = 0.004;
/// The same beside the rms of turns by half a step more, and what that has at the least, fraction of the size: a round
/// shape has every turn, and so none of its own.
const TELLING: f64 = 0.2;
const BETWEEN: f64 = 0.006;
/// Rounds of fitting.
const ROUNDS: usize = 6;
/// Rings that turn by themselves have this share of the outline, and so many samples, at the least.
const SHARE: f64 = 0.1;
const SAMPLES: usize = 40;
/// Rings whose lengths differ by no more than this share may be each other's images. Two are no circle.
const ALIKE: f64 = 0.03;
const CIRCLE: usize = 3;
/// Lines through a centre that are tried, over what a turn leaves of them, and steps towards the best.
const LINES: u32 = 32;
const STEPS: usize = 14;

/// A turn that was found.
pub struct Turn {
    /// The turn of the highest order about its centre.
    pub symmetry: Symmetry,
    /// Unit normal of a line through the centre that what turns is symmetric about, looked for where it is not the
    /// whole.
    pub line: Option<Vector>,
}

/// The turn of the highest order that holds for the whole outline over which `wall` stands; where there is none, those of
/// rings alone.
pub fn turns(ground: &Ground<'_>, wall: &Wall) -> Vec<Turn> {
    let place = |samples, rings| Place::new(ground, wall, samples, rings);
    let all: Vec<u32> = (0..ground.samples.list.len() as u32).collect();
    let every = vec![true; wall.rings.len()];
    if let Some(symmetry) = place(all, every).and_then(|place| place.turn()) {
        return vec![Turn {
            symmetry,
            line: None,
        }];
    }
    let of_rings = |rings: Vec<bool>| {
        let on = |s: &u32| rings[ring(wall, ground, *s)];
        let samples: Vec<u32> = (0..ground.samples.list.len() as u32).filter(on).collect();
        let place = place(samples, rings)?;
        let symmetry = place.turn()?;
        let line = place.line(&symmetry);
        Some(Turn { symmetry, line })
    };
    sets(wall).into_iter().filter_map(of_rings).collect()
}

/// The ring that a sample lies on.
fn ring(wall: &Wall, ground: &Ground<'_>, sample: u32) -> usize {
    wall.along(&ground.samples.list[sample as usize].at).0
}

/// Rings that may turn by themselves, one alone or several as long as each other.
fn sets(wall: &Wall) -> Vec<Vec<bool>> {
    let count = wall.rings.len();
    if count < 2 {
        return Vec::new();
    }
    let only = |rings: &[usize]| (0..count).map(|r| rings.contains(&r)).collect();
    let mut sets: Vec<Vec<bool>> = (0..count).map(|r| only(&[r])).collect();
    let mut ordered: Vec<usize> = (0..count).collect();
    ordered.sort_by(|&a, &b| wall.length(a).total_cmp(&wall.length(b)));
    let alike = |a: &usize, b: &usize| wall.length(*b) <= (1.0 + ALIKE) * wall.length(*a);
    let runs = ordered.chunk_by(alike);
    let several = runs.filter(|run| run.len() >= CIRCLE && run.len() < count);
    sets.extend(several.map(only));
    sets
}

/// Samples of an outline that are to be each other's images.
struct Place<'a> {
    ground: &'a Ground<'a>,
    wall: &'a Wall,
    samples: Vec<u32>,
    /// Which rings they lie on.
    rings: Vec<bool>,
    centre: Point,
    /// Four times the rms distance from the centre, fraction of L: as L is of the whole.
    size: f64,
}

impl<'a> Place<'a> {
    /// Of `samples`, all those of their `rings`; `None` where they are too few.
    fn new(
        ground: &'a Ground<'a>,
        wall: &'a Wall,
        samples: Vec<u32>,
        rings: Vec<bool>,
    ) -> Option<Self> {
        let list = &ground.samples.list;
        let few = (samples.len() as f64) < SHARE * list.len() as f64;
        if few || samples.len() < SAMPLES {
            return None;
        }
        let places = || samples.iter().map(|&s| list[s as usize].position);
        let centre = places().map(|x| x.coords).sum::<Vector>() / samples.len() as f64;
        let squares: f64 = places().map(|x| (x.coords - centre).norm_squared()).sum();
        Some(Self {
            centre: centre.into(),
            size: 4.0 * (squares / samples.len() as f64).sqrt(),
            ground,
            wall,
            samples,
            rings,
        })
    }

    /// The turn of the highest order.
    fn turn(&self) -> Option<Symmetry> {
        ORDERS.rev().find_map(|order| self.turn_of(order))
    }

    fn turn_of(&self, order: u32) -> Option<Symmetry> {
        let step = std::f64::consts::TAU / f64::from(order);
        let t = self.fitted(about(&self.centre, step), step)?;
        let pairs = self.touched(&t)?;
        let rms = rms(pairs.iter().map(|p| p.residual));
        let other = self.missed(&about(&fixed_point(&t), 1.5 * step));
        let holds = |rms: f64| rms <= RMS * self.size && rms <= TELLING * other;
        // A step of one tooth too many misses by little, and half the way round by half a tooth.
        let half = about(&fixed_point(&t), f64::from(order / 2) * step);
        let far = self.touched(&half)?;
        let far = self::rms(far.iter().map(|p| p.residual));
        (other >= BETWEEN * self.size && holds(rms) && holds(far)).then(|| Symmetry {
            id: 0,
            class: Class::Proper,
            q_from_p: t,
            height: 1.0 - rms / other,
            image: image(self.ground, &pairs),
            area_fraction: pairs.len() as f64 / self.ground.samples.list.len() as f64,
            rms,
            confusion: 0.0,
            is_evident: true,
            is_of_whole: false,
            doubt: rms / other,
            pairs,
        })
    }

    /// The turn `t` about the point where it fits best, its angle staying `step`, radians.
    fn fitted(&self, mut t: Isometry, step: f64) -> Option<Isometry> {
        for _ in 0..ROUNDS {
            let pairs = self.touched(&t)?;
            let contact = |p: &PatchPair| Correspondence {
                p: self.ground.samples.list[p.sample as usize].position,
                q: self.ground.surface.point(&p.partner),
                weight: 1.0,
            };
            let contacts: Vec<Correspondence> = pairs.iter().map(contact).collect();
            let free = optimal_rigid(&contacts, None, Ambient::Plane)?.isometry;
            t = about(&fixed_point(&free), step);
        }
        Some(t)
    }

    /// The unit normal of a line through the centre of a `turn` that holds as that does.
    fn line(&self, turn: &Symmetry) -> Option<Vector> {
        let centre = fixed_point(&turn.q_from_p);
        let half = std::f64::consts::TAU / f64::from(order(turn)) / 2.0;
        let normal = |angle: f64| Vector::new(angle.cos(), angle.sin(), 0.0);
        let mirror = |angle: f64| Isometry::mirror(&Plane::through(&centre, normal(angle)));
        let missed = |angle: f64| self.missed(&mirror(angle));
        let tried = (0..LINES).map(|k| half * f64::from(k) / f64::from(LINES));
        let tried: Vec<(f64, f64)> = tried.map(|angle| (angle, missed(angle))).collect();
        let worst = tried.iter().map(|t| t.1).fold(0.0, f64::max);
        let (mut best, mut least) = tried.into_iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let mut step = half / f64::from(LINES);
        for _ in 0..STEPS {
            step /= 2.0;
            for angle in [best - step, best + step] {
                let miss = missed(angle);
                if miss < least {
                    (best, least) = (angle, miss);
                }
            }
        }
        let holds = least <= RMS * self.size && least <= TELLING * worst;
        (holds && self.touched(&mirror(best)).is_some()).then(|| normal(best))
    }

    /// The pairs of an isometry where it holds for all but a few.
    fn touched(&self, t: &Isometry) -> Option<Vec<PatchPair>> {
        let pairs = self.touch(t, NEAR * self.size, MIN_COS);
        let held = pairs.iter().flatten().count() as f64 / pairs.len().max(1) as f64;
        (held >= WHOLE).then(|| pairs.into_iter().flatten().collect())
    }

    /// The rms distance of all images.
    fn missed(&self, t: &Isometry) -> f64 {
        let far = FAR * self.size;
        let pairs = self.touch(t, far, -1.0);
        rms(pairs.iter().map(|p| p.as_ref().map_or(far, |p| p.residual)))
    }

    fn touch(&self, t: &Isometry, tolerance: f64, min_cos: f64) -> Vec<Option<PatchPair>> {
        let own = |p: &PatchPair| self.rings[self.wall.along(&p.partner).0];
        let samples = self.samples.par_iter();
        samples
            .map(|&s| touch_one(self.ground, t, s, tolerance, min_cos, None).filter(own))
            .collect()
    }
}

/// How often a turn makes a whole one.
pub fn order(turn: &Symmetry) -> u32 {
    let linear = &turn.q_from_p.linear;
    let angle = f64::atan2(linear[(1, 0)], linear[(0, 0)]);
    (std::f64::consts::TAU / angle.abs()).round().max(1.0) as u32
}

/// The group that a turn makes, exactly: the turns alone (C) or with as many lines through their centre (D), which are
/// those of the whole among `symmetries` or the one that was found with it.
pub fn group(turn: &Symmetry, line: Option<&Vector>, symmetries: &[Symmetry]) -> Group {
    let centre = fixed_point(&turn.q_from_p);
    let order = order(turn);
    let step = std::f64::consts::TAU / f64::from(order);
    let lines: Vec<&Symmetry> = symmetries
        .iter()
        .filter(|s| s.class == Class::Mirror && s.area_fraction >= WHOLE)
        .filter(|s| s.plane().signed_distance(&centre).abs() <= NEAR)
        .collect();
    let turns = (0..order).map(|k| about(&centre, f64::from(k) * step));
    let mut elements: Vec<Isometry> = turns.collect();
    let normals: Vec<Vector> = match line {
        Some(normal) => vec![*normal],
        None => lines.iter().map(|s| s.plane().normal).collect(),
    };
    if !normals.is_empty() {
        // The angles of normals are the same modulo half a step: their mean on the circle that this makes.
        let whole = |n: &Vector| std::f64::consts::TAU / (step / 2.0) * angle_of(n);
        let sum = |f: fn(f64) -> f64| normals.iter().map(|n| f(whole(n))).sum::<f64>();
        let first = sum(f64::sin).atan2(sum(f64::cos)) * (step / 2.0) / std::f64::consts::TAU;
        let line = |k: u32| {
            let angle = first + f64::from(k) * step / 2.0;
            let normal = Vector::new(angle.cos(), angle.sin(), 0.0);
            Isometry::mirror(&Plane::through(&centre, normal))
        };
        elements.extend((0..order).map(line));
    }
    let letter = if normals.is_empty() { 'C' } else { 'D' };
    let mut members: Vec<u32> = lines.iter().map(|s| s.id).collect();
    members.push(turn.id);
    Group {
        name: format!("{letter}{order}"),
        order: elements.len(),
        axis: Some(Vector::z()),
        point: centre,
        step: None,
        pattern: None,
        elements,
        symmetries: members,
        orbit: Vec::new(),
    }
}

fn angle_of(v: &Vector) -> f64 {
    v.y.atan2(v.x)
}

fn rms(distances: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = distances.len().max(1) as f64;
    (distances.map(|d| d * d).sum::<f64>() / count).sqrt()
}

/// The turn about a point of the plane.
fn about(centre: &Point, angle: f64) -> Isometry {
    let linear = exp_rotation(&(Vector::z() * angle));
    Isometry {
        linear,
        translation: centre.coords - linear * centre.coords,
    }
}

/// The point that a turn of the plane leaves in its place.
pub fn fixed_point(t: &Isometry) -> Point {
    let linear = nalgebra::Matrix2::identity() - t.linear.fixed_view::<2, 2>(0, 0);
    let fixed = linear.try_inverse().map(|m| m * t.translation.xy());
    fixed.map_or_else(Point::origin, |x| Point::new(x.x, x.y, 0.0))
}
