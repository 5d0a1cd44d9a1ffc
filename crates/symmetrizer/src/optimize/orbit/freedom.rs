//! How the motions of an orbit may be adjusted and stay what they are, and the adjustment that fits best.
//!
//! The unknowns are twists (omega, v), x -> x + omega x x + v: one that carries a whole group or slide, one that
//! changes the step of a row, one for each copy in free positions. Elements of a group, angles of rings and the kind
//! of a row keep their exact form whatever the twists are. The fit is point to plane (Chen and Medioni 1992),
//! linear in the twists.

use nalgebra::{DMatrix, DVector, Vector6};

use crate::geom::{Matrix3, Point, Vector, exp_rotation};
use crate::group::Pattern;
use crate::optimize::orbit::goal::{Goal, Link, Orbit};
use crate::transform::{Ambient, Isometry, Kind};

/// Directions that contacts do not determine are left by this much of damping, beside the mean of the others.
const DAMPING: f64 = 1e-6;

/// A sample of the surface and the place where its image should lie.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// The sample.
    pub x: Point,
    /// Its image.
    pub y: Point,
    /// The unit normal of the surface there.
    pub n: Vector,
    /// The way of the image to the surface, along `n`.
    pub gap: f64,
    /// How much it counts.
    pub weight: f64,
}

/// The normal equations of a goal's twists.
#[derive(Debug, Clone)]
pub struct Equations {
    a: DMatrix<f64>,
    b: DVector<f64>,
}

impl Equations {
    /// Those of no contact.
    pub fn new(goal: &Goal) -> Self {
        let n = 6 * goal.twists();
        Self {
            a: DMatrix::zeros(n, n),
            b: DVector::zeros(n),
        }
    }

    /// Adds a contact of a `link` of the goal.
    pub fn add(&mut self, goal: &Goal, link: &Link, contact: &Contact) {
        let rows = goal.rows(link, contact);
        let rows = rows.iter().flatten();
        for (i, row) in rows.clone() {
            let mut b = self.b.fixed_rows_mut::<6>(6 * i);
            b += row * (contact.weight * contact.gap);
            for (j, other) in rows.clone() {
                let mut a = self.a.fixed_view_mut::<6, 6>(6 * i, 6 * j);
                a += row * other.transpose() * contact.weight;
            }
        }
    }

    /// Adds those of other contacts of the same goal.
    pub fn join(&mut self, other: &Self) {
        self.a += &other.a;
        self.b += &other.b;
    }

    /// The twists; none where there is no contact.
    fn solution(&self) -> Option<DVector<f64>> {
        let n = self.b.len();
        let damping = DAMPING * self.a.trace() / n as f64;
        let a = &self.a + DMatrix::identity(n, n) * damping;
        Some(a.cholesky()?.solve(&self.b))
    }
}

impl Goal {
    /// The goal with its motions where they fit the contacts best.
    pub fn adjusted(&self, equations: &Equations) -> Self {
        let Some(x) = equations.solution() else {
            return self.clone();
        };
        self.moved(|i| moved_by(&x.fixed_rows::<6>(6 * i).into_owned()))
    }

    /// The goal with its motions moved by the motion of each twist.
    fn moved(&self, twist: impl Fn(usize) -> Isometry) -> Self {
        let orbit = match &self.orbit {
            Orbit::Group(elements) => {
                Orbit::Group(elements.iter().map(|g| carried(&twist(0), g)).collect())
            }
            Orbit::Slide(slide, extent) => {
                let mut slide = slide.clone();
                let e = twist(0);
                slide.axis = slide.axis.map(|axis| e.rotate(&axis).normalize());
                slide.point = e.apply(&slide.point);
                Orbit::Slide(slide, *extent)
            }
            Orbit::Free(frames) => {
                let frames = frames.iter().enumerate();
                let moved: Vec<Isometry> = frames.map(|(i, f)| twist(i).after(f)).collect();
                // The first is the identity: the motions are seen from there.
                let back = moved[0].inverse();
                let seen = |f: &Isometry| f.after(&back);
                let mut moved: Vec<Isometry> = moved.iter().map(seen).collect();
                moved[0] = Isometry::identity();
                Orbit::Free(moved)
            }
            Orbit::Regular(pattern) => Orbit::Regular(stepped(pattern, twist)),
        };
        Self {
            orbit,
            ..self.clone()
        }
    }

    /// The number of twists.
    fn twists(&self) -> usize {
        match &self.orbit {
            Orbit::Group(_) | Orbit::Slide(..) | Orbit::Regular(Pattern::Row(_)) => 1,
            Orbit::Regular(Pattern::Grid(_)) => 2,
            Orbit::Free(frames) => frames.len(),
        }
    }

    /// How far the image of a contact moves along its normal by each twist that has a say: at most two.
    fn rows(&self, link: &Link, contact: &Contact) -> [Option<(usize, Vector6<f64>)>; 2] {
        let Contact { x, y, n, .. } = contact;
        let row = |omega: Vector, v: Vector| match self.ambient {
            Ambient::Space => Vector6::new(omega.x, omega.y, omega.z, v.x, v.y, v.z),
            Ambient::Plane => Vector6::new(0.0, 0.0, omega.z, v.x, v.y, 0.0),
        };
        let at = |point: &Point, n: &Vector| row(point.coords.cross(n), *n);
        // n . (R xi(x)) is (R^T n) . xi(x): the normal as the sample sees it.
        let seen = link.t.linear.transpose() * n;
        let carries = || at(y, n) - at(x, &seen);
        let (i, j) = (link.from, link.to);
        match &self.orbit {
            Orbit::Group(_) | Orbit::Slide(..) => [Some((0, carries())), None],
            Orbit::Free(_) => [Some((j, at(y, n))), Some((i, -at(x, &seen)))],
            Orbit::Regular(Pattern::Grid(grid)) => {
                let width = grid.counts[0];
                let steps = |k: usize| (k % width) as f64;
                let along = steps(j) - steps(i);
                let across = (j / width) as f64 - (i / width) as f64;
                let shift = |by: f64| row(Vector::zeros(), n * by);
                [Some((0, shift(along))), Some((1, shift(across)))]
            }
            Orbit::Regular(Pattern::Row(r)) => {
                let steps = j as i64 - i as i64;
                let row = match r.kind {
                    Kind::Translation => row(Vector::zeros(), n * steps as f64),
                    Kind::Rotation if r.places.is_some() => carries(),
                    _ => {
                        let (omega, v) = by_step(&r.step, steps, x, y, n);
                        row(omega, v)
                    }
                };
                [Some((0, row)), None]
            }
        }
    }
}

/// How far y = S^k x moves along `n` as S becomes exp(xi) S, as the factors of omega and v: S^k x moves by
/// sum over m < k of R^m xi(S^(k-m) x); of a negative power, its inverse by as much the other way.
fn by_step(step: &Isometry, k: i64, x: &Point, y: &Point, n: &Vector) -> (Vector, Vector) {
    let (start, mut seen, sign) = if k > 0 {
        (*x, *n, 1.0)
    } else {
        let back = (0..-k).fold(Matrix3::identity(), |r, _| step.linear * r);
        (*y, back * n, -1.0)
    };
    let count = k.unsigned_abs() as usize;
    let mut passed: Vec<Point> = Vec::with_capacity(count);
    let mut at = start;
    for _ in 0..count {
        at = step.apply(&at);
        passed.push(at);
    }
    let (mut omega, mut v) = (Vector::zeros(), Vector::zeros());
    for at in passed.iter().rev() {
        omega += at.coords.cross(&seen);
        v += seen;
        seen = step.linear.transpose() * seen;
    }
    (omega * sign, v * sign)
}

/// The pattern with its steps moved by their twists.
fn stepped(pattern: &Pattern, twist: impl Fn(usize) -> Isometry) -> Pattern {
    let mut pattern = pattern.clone();
    match &mut pattern {
        Pattern::Grid(grid) => {
            for (i, step) in grid.steps.iter_mut().enumerate() {
                step.translation += twist(i).translation;
            }
        }
        Pattern::Row(row) => match row.kind {
            Kind::Translation => row.step.translation += twist(0).translation,
            Kind::Rotation if row.places.is_some() => row.step = carried(&twist(0), &row.step),
            _ => row.step = twist(0).after(&row.step),
        },
    }
    pattern
}

/// The rigid motion of a twist.
fn moved_by(twist: &Vector6<f64>) -> Isometry {
    Isometry {
        linear: exp_rotation(&Vector::new(twist[0], twist[1], twist[2])),
        translation: Vector::new(twist[3], twist[4], twist[5]),
    }
}

/// `t` carried along by `e`.
fn carried(e: &Isometry, t: &Isometry) -> Isometry {
    e.after(t).after(&e.inverse())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::group::{Grid, Row};

    fn turn(axis: Vector, angle: f64, translation: Vector) -> Isometry {
        Isometry {
            linear: exp_rotation(&(axis.normalize() * angle)),
            translation,
        }
    }

    fn goal(orbit: Orbit, places: usize) -> Goal {
        Goal {
            name: String::new(),
            symmetries: Vec::new(),
            orbit,
            places: vec![Vec::new(); places],
            area_fraction: 1.0,
            reach: 0.1,
            ambient: Ambient::Space,
            is_met: false,
        }
    }

    fn row(step: Isometry, kind: Kind, places: Option<usize>) -> Goal {
        let count = 4;
        let row = Row {
            step,
            kind,
            count,
            places,
            measured: Vec::new(),
        };
        goal(Orbit::Regular(Pattern::Row(row)), count)
    }

    fn goals() -> Vec<Goal> {
        let shift = Vector::new(0.3, -0.1, 0.2);
        let free = turn(Vector::new(1.0, 2.0, -1.0), 0.7, shift);
        let ring = turn(Vector::z(), std::f64::consts::TAU / 7.0, Vector::zeros());
        let along = |v: Vector| turn(Vector::z(), 0.0, v);
        let grid = Grid {
            steps: [along(shift), along(Vector::new(-0.1, 0.4, 0.0))],
            counts: [3, 2],
        };
        let plane = crate::transform::Plane {
            normal: Vector::new(0.6, 0.0, 0.8),
            offset: 0.1,
        };
        vec![
            goal(Orbit::Group(vec![ring, Isometry::mirror(&plane)]), 1),
            goal(Orbit::Free(vec![Isometry::identity(), free, ring]), 3),
            goal(Orbit::Regular(Pattern::Grid(grid)), 6),
            row(along(shift), Kind::Translation, None),
            row(ring, Kind::Rotation, Some(7)),
            row(free, Kind::Screw, None),
        ]
    }

    /// The image of a link of a goal, found again by its places or, of a group, its index.
    fn image(goal: &Goal, from: usize, k: usize, x: &Point) -> Point {
        goal.links(0)[from][k].t.apply(x)
    }

    #[test]
    fn rows_are_derivatives_of_images() {
        let (x, n) = (
            Point::new(0.4, -0.3, 0.6),
            Vector::new(0.5, 0.5, -0.2).normalize(),
        );
        let h = 1e-6;
        for (which, goal) in goals().iter().enumerate() {
            for (from, links) in goal.links(0).iter().enumerate() {
                for (k, link) in links.iter().enumerate() {
                    let contact = Contact {
                        x,
                        y: link.t.apply(&x),
                        n,
                        gap: 0.0,
                        weight: 1.0,
                    };
                    let rows = goal.rows(link, &contact);
                    for twist in 0..goal.twists() {
                        for c in 0..6 {
                            let by = |h: f64| {
                                let mut unit = Vector6::zeros();
                                unit[c] = h;
                                let bent = goal.moved(|i| match i == twist {
                                    true => moved_by(&unit),
                                    false => Isometry::identity(),
                                });
                                n.dot(&image(&bent, from, k, &x).coords)
                            };
                            let measured = (by(h) - by(-h)) / (2.0 * h);
                            let of = rows.iter().flatten().filter(|(i, _)| *i == twist);
                            let row: f64 = of.map(|(_, row)| row[c]).sum();
                            let free = matches!(goal.orbit, Orbit::Free(_)) && from != 0;
                            let kept = matches!(&goal.orbit, Orbit::Regular(p) if {
                                let first = matches!(p, Pattern::Grid(_));
                                first || matches!(p, Pattern::Row(r) if r.kind == Kind::Translation)
                            });
                            if kept && c < 3 || free {
                                // Translations do not turn; free copies are seen from the first one.
                                continue;
                            }
                            assert!(
                                (measured - row).abs() < 1e-6,
                                "{which} {from} {k} {twist} {c}"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_fit_finds_the_motions_back_and_keeps_groups_exact() {
        let ring = turn(Vector::z(), std::f64::consts::TAU / 5.0, Vector::zeros());
        let powers: Vec<Isometry> = (1..5)
            .map(|k| (1..k).fold(ring, |t, _| ring.after(&t)))
            .collect();
        let truth = goal(Orbit::Group(powers), 1);
        let off = turn(
            Vector::new(1.0, 0.3, 0.0),
            0.02,
            Vector::new(0.01, -0.02, 0.0),
        );
        let mut found = truth.moved(|_| off);
        for _ in 0..6 {
            let mut equations = Equations::new(&found);
            for i in 0..60 {
                let t = f64::from(i);
                let x = Point::new((3.1 * t).sin(), (1.7 * t).cos(), (0.9 * t + 0.3).sin());
                let n = Vector::new((2.3 * t).cos(), (4.1 * t).sin(), (1.3 * t).cos()).normalize();
                for (k, link) in found.links(0)[0].iter().enumerate() {
                    let y = link.t.apply(&x);
                    let gap = n.dot(&(image(&truth, 0, k, &x) - y));
                    let contact = Contact {
                        x,
                        y,
                        n,
                        gap,
                        weight: 1.0,
                    };
                    equations.add(&found, link, &contact);
                }
            }
            found = found.adjusted(&equations);
        }
        let elements = found.elements();
        for (a, b) in elements.iter().zip(truth.elements()) {
            assert!(
                (a.linear - b.linear).norm() < 1e-6
                    && (a.translation - b.translation).norm() < 1e-6
            );
        }
        let square = elements[0].after(&elements[0]);
        assert!((square.linear - elements[1].linear).norm() < 1e-12);
    }
}
