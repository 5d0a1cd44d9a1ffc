//! What is tangled gets its own form back, where the rest has gone.
mod common;

use common::{placed, sphere, union, working};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::optimize::ease::eased;
use symmetrizer::optimize::mend::mend;
use symmetrizer::shape::{Mesh, Surface};

fn moved(surface: &Surface, motion: impl Fn(&Point) -> Point) -> Surface {
    surface.with_positions(surface.positions.iter().map(motion).collect())
}

/// A ball with hills, so that its form says how it is turned.
fn ball() -> Surface {
    let ball = working(&sphere(5)).0.surface;
    moved(&ball, |p| {
        let hills = (7.0 * p.x).sin() * (5.0 * p.y + 1.0).cos() * (6.0 * p.z).sin();
        p * (1.0 + 0.1 * hills)
    })
}

fn some_motion(p: &Point) -> Point {
    let shift = Vector::new(0.3, 0.1, -2.0);
    let one = Mesh::from_triangles(vec![*p], vec![]);
    placed(&one, Vector::new(1.0, -0.4, 0.7), 1.0, shift).positions[0]
}

#[test]
fn what_is_not_tangled_stays_to_the_last_bit() {
    let rest = ball();
    let after = moved(&rest, |p| Point::new(p.x + 0.3 * p.y * p.y, p.y, 1.2 * p.z));
    let mended = mend(&rest, after.clone()).expect("solvable");
    assert_eq!(mended.share, 0.0);
    assert_eq!(mended.surface.positions, after.positions);
}

#[test]
fn a_fold_goes_and_the_form_comes_back_where_the_rest_went() {
    let rest = ball();
    let place = rest.positions[0];
    let near = |p: &Point| (p - place).norm() < 0.04;
    // A cap is turned through the surface, all of it goes to another place.
    let after = moved(&rest, |p| {
        let folded = if near(p) {
            place + 2.0 * (place - p)
        } else {
            *p
        };
        some_motion(&folded)
    });
    let mended = mend(&rest, after.clone()).expect("solvable");
    assert!(
        mended.share > 0.0 && mended.share < 0.15,
        "{}",
        mended.share
    );
    let wanted = moved(&rest, some_motion);
    let missed = |(p, q): (&Point, &Point)| (p - q).norm();
    let both = |surface: &Surface| {
        let all = surface.positions.iter().zip(&wanted.positions);
        all.map(missed).fold(0.0, f64::max)
    };
    assert!(both(&after) > 0.05);
    assert!(both(&mended.surface) < 1e-6, "{}", both(&mended.surface));
}

#[test]
fn what_ran_through_itself_before_may_go_on_to() {
    let other = placed(
        &sphere(4),
        Vector::new(0.2, 0.3, 0.4),
        0.5,
        Vector::new(0.9, 0.0, 0.0),
    );
    let rest = working(&union(&sphere(4), &other)).0.surface;
    // The line along which they cross slides by less than a face.
    let after = moved(&rest, |p| {
        if p.x > 0.1 {
            p + Vector::new(0.002, 0.0, 0.001)
        } else {
            *p
        }
    });
    let mended = mend(&rest, after.clone()).expect("solvable");
    assert_eq!(mended.share, 0.0);
    assert_eq!(mended.surface.positions, after.positions);
}

#[test]
fn a_loose_part_that_nothing_holds_stays() {
    let other = placed(
        &sphere(3),
        Vector::new(0.2, 0.3, 0.4),
        0.1,
        Vector::new(1.4, 0.0, 0.0),
    );
    let rest = working(&union(&sphere(4), &other)).0.surface;
    let edge = rest.positions.iter().map(|p| p.x).fold(0.0, f64::max);
    let small = |p: &Point| p.x > 0.75 * edge && p.coords.yz().norm() < 0.1 * edge;
    let gap = Vector::new(0.35 * edge, 0.0, 0.0);
    let after = moved(&rest, |p| if small(p) { p - gap } else { *p });
    let mended = mend(&rest, after).expect("solvable");
    assert!(
        mended
            .surface
            .positions
            .iter()
            .all(|p| p.coords.norm() < 2.0 * edge)
    );
}

/// A single vertex pushed through the surface next to it is too little for anything around it to change: its own neighbours carry it back.
#[test]
fn slivers_follow_what_lies_around() {
    let rest = ball();
    let mut after = moved(&rest, some_motion);
    let place = after.positions[0];
    let near = rest.next_to_vertices();
    let far = near[near[0][0] as usize]
        .iter()
        .find(|v| !near[0].contains(v) && **v != 0);
    let beyond = after.positions[*far.expect("a ball goes on") as usize];
    let mut positions = after.positions.clone();
    positions[0] = place + 1.3 * (beyond - place);
    after = after.with_positions(positions);
    let mut freed = vec![false; rest.positions.len()];
    freed[0] = true;
    let eased = eased(&rest, &after, &freed, &near);
    assert!((eased.positions[0] - place).norm() < 0.2 * (beyond - place).norm());
    assert_eq!(eased.positions[1..], after.positions[1..]);
}
