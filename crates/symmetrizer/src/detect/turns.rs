//! Turns of the whole of an outline about its centroid: all that a rotation of the plane can be that holds for it.

use crate::detect::groups::Group;
use crate::geom::{Ambient, Point, Vector, exp_rotation};
use crate::patch::ground::{image, touch};
use crate::patch::{Ground, PatchPair, Symmetry};
use crate::transform::{Class, Correspondence, Isometry, Plane, optimal::optimal_rigid};

/// Orders that are tried.
const ORDERS: std::ops::RangeInclusive<u32> = 2..=60;
/// Images may lie this far from the outline, fraction of L, where a turn is tried, and facing its way to within this
/// cosine.
const NEAR: f64 = 0.02;
const MIN_COS: f64 = 0.5;
/// What is further away counts as so far, fraction of L.
const FAR: f64 = 0.1;
/// Share of the outline that a turn must hold for, and the rms distance at the most, fraction of L.
const WHOLE: f64 = 0.95;
const RMS: f64 = 0.004;
/// The same beside the rms of turns by half a step more, and what that has at the least, fraction of L: a round shape
/// has every turn, and so none of its own.
const TELLING: f64 = 0.2;
const BETWEEN: f64 = 0.006;
/// Rounds of fitting.
const ROUNDS: usize = 6;

/// The turn of the highest order that holds for the whole outline.
pub fn turns(ground: &Ground<'_>) -> Option<Symmetry> {
    let list = &ground.samples.list;
    let sum: Vector = list.iter().map(|s| s.position.coords).sum();
    let centre = Point::from(sum / list.len().max(1) as f64);
    ORDERS.rev().find_map(|order| turn(ground, &centre, order))
}

fn turn(ground: &Ground<'_>, centre: &Point, order: u32) -> Option<Symmetry> {
    let step = std::f64::consts::TAU / f64::from(order);
    let t = fitted(ground, about(centre, step), step)?;
    let pairs = touched(ground, &t)?;
    let rms = rms(pairs.iter().map(|p| p.residual));
    let between = touch(ground, &about(&fixed_point(&t), 1.5 * step), FAR, -1.0);
    let other = self::rms(between.iter().map(|p| p.map_or(FAR, |p| p.residual)));
    let telling = other >= BETWEEN && rms <= TELLING * other;
    (rms <= RMS && telling).then(|| Symmetry {
        id: 0,
        class: Class::Proper,
        q_from_p: t,
        height: 1.0 - rms / other,
        image: image(ground, &pairs),
        area_fraction: pairs.len() as f64 / ground.samples.list.len() as f64,
        rms,
        confusion: 0.0,
        is_evident: true,
        doubt: rms / other,
        pairs,
    })
}

/// The turn `t` about the point where it fits best, its angle staying `step`, radians.
fn fitted(ground: &Ground<'_>, mut t: Isometry, step: f64) -> Option<Isometry> {
    for _ in 0..ROUNDS {
        let pairs = touched(ground, &t)?;
        let contact = |p: &PatchPair| Correspondence {
            p: ground.samples.list[p.sample as usize].position,
            q: ground.surface.point(&p.partner),
            weight: 1.0,
        };
        let contacts: Vec<Correspondence> = pairs.iter().map(contact).collect();
        let free = optimal_rigid(&contacts, None, Ambient::Plane)?.isometry;
        t = about(&fixed_point(&free), step);
    }
    Some(t)
}

/// The group that a turn of the whole outline makes with the lines of the whole among `symmetries`, exactly: the
/// turns alone (C) or with as many lines through their centre (D).
pub fn group(turn: &Symmetry, symmetries: &[Symmetry]) -> Group {
    let centre = fixed_point(&turn.q_from_p);
    let angle = f64::atan2(turn.q_from_p.linear[(1, 0)], turn.q_from_p.linear[(0, 0)]);
    let order = (std::f64::consts::TAU / angle.abs()).round().max(1.0);
    let step = std::f64::consts::TAU / order;
    let lines: Vec<&Symmetry> = symmetries
        .iter()
        .filter(|s| s.class == Class::Mirror && s.area_fraction >= WHOLE)
        .filter(|s| s.plane().signed_distance(&centre).abs() <= NEAR)
        .collect();
    let turns = (0..order as u32).map(|k| about(&centre, f64::from(k) * step));
    let mut elements: Vec<Isometry> = turns.collect();
    if !lines.is_empty() {
        // The angles of normals are the same modulo half a step: their mean on the circle that this makes.
        let whole =
            |s: &&Symmetry| std::f64::consts::TAU / (step / 2.0) * angle_of(&s.plane().normal);
        let sum = |f: fn(f64) -> f64| lines.iter().map(|s| f(whole(s))).sum::<f64>();
        let first = sum(f64::sin).atan2(sum(f64::cos)) * (step / 2.0) / std::f64::consts::TAU;
        let line = |k: u32| {
            let angle = first + f64::from(k) * step / 2.0;
            let normal = Vector::new(angle.cos(), angle.sin(), 0.0);
            Isometry::mirror(&Plane::through(&centre, normal))
        };
        elements.extend((0..order as u32).map(line));
    }
    let letter = if lines.is_empty() { 'C' } else { 'D' };
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

/// The pairs of a turn where it holds for the whole.
fn touched(ground: &Ground<'_>, t: &Isometry) -> Option<Vec<PatchPair>> {
    let pairs = touch(ground, t, NEAR, MIN_COS);
    let held = pairs.iter().flatten().count() as f64 / pairs.len().max(1) as f64;
    (held >= WHOLE).then(|| pairs.into_iter().flatten().collect())
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
fn fixed_point(t: &Isometry) -> Point {
    let linear = nalgebra::Matrix2::identity() - t.linear.fixed_view::<2, 2>(0, 0);
    let fixed = linear.try_inverse().map(|m| m * t.translation.xy());
    fixed.map_or_else(Point::origin, |x| Point::new(x.x, x.y, 0.0))
}
