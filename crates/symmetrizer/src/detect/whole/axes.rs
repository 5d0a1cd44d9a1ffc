//! Lines about which a shape may turn.

use crate::detect::surroundings::Surroundings;
use crate::geom::{Matrix3, Vector, any_orthogonal, sorted_eigen};
use crate::patch::Symmetry;
use crate::transform::{Axis, Class, Isometry};

/// A part that slides about an axis suggests it from this share of the surface on, and so does a motion that holds for as much.
const SLIDING: f64 = 0.1;
const HOLDING: f64 = 0.4;
/// Axes are one whose directions differ by less than this, radians, and which pass each other by no further than this, in
/// units of the shape's radius.
const ANGLE: f64 = 0.1;
const APART: f64 = 0.15;
/// Smallest sine of the turn that two mirrors make.
const WIDE: f64 = 0.3;
/// Axes at the most.
const MOST: usize = 8;
/// Of a tensor of inertia with trace 1: how far it takes the axis of a turn from its direction at the most, and by how much the moments
/// across that of a turn of more than half a round differ. Shapes that are nearly symmetric have .03.
const ASKEW: f64 = 0.06;
const UNEVEN: f64 = 0.12;

/// An axis, and whether there may be more than half-turns about it.
pub struct Suggested {
    pub axis: Axis,
    pub only_half: bool,
}

/// The axes that a shape suggests: of parts that slide about them, of motions among `symmetries`, and those of inertia. What turns the
/// whole leaves its centroid in its place, and its inertia.
pub fn suggested(surroundings: &Surroundings<'_>, symmetries: &[Symmetry]) -> Vec<Suggested> {
    let sliding = surroundings.continuous.iter();
    let sliding = sliding.filter(|c| c.area_fraction >= SLIDING);
    let of_slides = sliding.filter_map(|c| {
        let direction = c.axis?;
        Some(Axis {
            point: c.point,
            direction,
        })
    });
    let holding = |s: &&Symmetry| s.class == Class::Proper && s.area_fraction >= HOLDING;
    let of_motions = symmetries
        .iter()
        .filter(holding)
        .filter_map(|s| Axis::of(&s.q_from_p));
    let inertia = inertia(surroundings);
    let centre = surroundings.space.centre();
    let of_inertia = sorted_eigen(&inertia).1;
    let of_inertia = [0, 1, 2].map(|i| Axis {
        point: centre,
        direction: of_inertia.column(i).into_owned(),
    });
    let all = of_slides.chain(of_inertia).chain(of_motions);
    let mut axes: Vec<Suggested> = Vec::new();
    for axis in all.filter(|axis| through(surroundings, axis)) {
        let radius = surroundings.space.radius();
        let known = axes.iter().any(|k| is_same(&k.axis, &axis, radius));
        let askew = inertia * axis.direction;
        let askew = askew - axis.direction * axis.direction.dot(&askew);
        if !known && askew.norm() <= ASKEW && axes.len() < MOST {
            let only_half = unevenness(&inertia, &axis.direction) > UNEVEN;
            axes.push(Suggested { axis, only_half });
        }
    }
    axes
}

/// The lines in which two of the `mirrors` meet at an angle that tells where: each line that is like none before it.
pub fn meeting(surroundings: &Surroundings<'_>, mirrors: &[Isometry]) -> Vec<Axis> {
    let radius = surroundings.space.radius();
    let mut axes: Vec<Axis> = Vec::new();
    for (k, a) in mirrors.iter().enumerate() {
        for b in &mirrors[k + 1..] {
            let turn = a.after(b);
            let sine = (turn.linear - turn.linear.transpose()).norm() / 8.0_f64.sqrt();
            let axis = Axis::of(&turn).filter(|_| sine > WIDE);
            let new = axis.filter(|axis| axes.iter().all(|k| !is_same(k, axis, radius)));
            axes.extend(new.filter(|_| axes.len() < MOST));
        }
    }
    axes
}

/// Whether two axes are one, of a shape of that radius.
fn is_same(a: &Axis, b: &Axis, radius: f64) -> bool {
    let sine = a.direction.cross(&b.direction).norm();
    sine < ANGLE && (a.foot(&b.point) - b.point).norm() < APART * radius
}

/// Whether an axis passes the centroid.
fn through(surroundings: &Surroundings<'_>, axis: &Axis) -> bool {
    let (centre, radius) = (surroundings.space.centre(), surroundings.space.radius());
    (axis.foot(&centre) - centre).norm() < APART * radius
}

/// The second moments of the samples about their centroid, with trace 1.
fn inertia(surroundings: &Surroundings<'_>) -> Matrix3 {
    let centre = surroundings.space.centre();
    let list = &surroundings.ground.samples.list;
    let arms = list.iter().map(|s| s.position - centre);
    let tensor: Matrix3 = arms.map(|a| a * a.transpose()).sum();
    tensor / tensor.trace()
}

/// The difference of the moments across a direction.
fn unevenness(inertia: &Matrix3, direction: &Vector) -> f64 {
    let u = any_orthogonal(direction);
    let v = direction.cross(&u);
    let (a, b, c) = (
        u.dot(&(inertia * u)),
        v.dot(&(inertia * v)),
        u.dot(&(inertia * v)),
    );
    (a - b).hypot(2.0 * c)
}
