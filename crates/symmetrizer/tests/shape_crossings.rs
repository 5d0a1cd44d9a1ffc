//! Self-crossings: against brute force, and what must not count.
mod common;

use common::{load, model, placed, sphere, union, working};
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::crossings::{crossing_faces, new_crossings};
use symmetrizer::shape::{Mesh, Surface};

fn two_spheres(shift: Vector) -> Mesh {
    let unit = sphere(4);
    union(
        &unit,
        &placed(&unit, Vector::new(0.3, 0.2, 0.1), 1.0, shift),
    )
}

/// Whether an edge of one triangle strictly pierces the other: signs of five volumes, another
/// way to the same answer for triangles in general position.
fn pierces(a: &[Point; 3], b: &[Point; 3]) -> bool {
    let volume = |p: Point, q: Point, r: Point, s: Point| (q - p).dot(&(r - p).cross(&(s - p)));
    (0..3).any(|i| {
        let (s, t) = (a[i], a[(i + 1) % 3]);
        let ends = volume(s, b[0], b[1], b[2]) * volume(t, b[0], b[1], b[2]);
        let around: [f64; 3] = std::array::from_fn(|k| volume(s, t, b[k], b[(k + 1) % 3]));
        ends < 0.0 && (around.iter().all(|&v| v > 0.0) || around.iter().all(|&v| v < 0.0))
    })
}

fn by_brute_force(surface: &Surface) -> Vec<u32> {
    let count = surface.triangles.len() as u32;
    let apart = |f: u32, g: u32| {
        let mine = surface.triangles[f as usize];
        !surface.triangles[g as usize]
            .iter()
            .any(|v| mine.contains(v))
    };
    (0..count)
        .filter(|&f| {
            (0..count).any(|g| {
                let (a, b) = (surface.corners(f), surface.corners(g));
                apart(f, g) && (pierces(&a, &b) || pierces(&b, &a))
            })
        })
        .collect()
}

#[test]
fn a_clean_sphere_crosses_nowhere() {
    assert!(crossing_faces(&working(&sphere(5)).0.surface).is_empty());
}

#[test]
fn two_spheres_cross_along_their_circle() {
    let w = working(&two_spheres(Vector::new(1.1, 0.17, -0.23))).0;
    let found = crossing_faces(&w.surface);
    assert!(found.len() > 100, "{}", found.len());
    assert_eq!(found, by_brute_force(&w.surface));
    // Far apart, and one inside the other, they do not cross.
    let apart = working(&two_spheres(Vector::new(2.5, 0.0, 0.0))).0;
    assert!(crossing_faces(&apart.surface).is_empty());
    let unit = sphere(4);
    let inside = placed(&unit, Vector::zeros(), 0.5, Vector::zeros());
    assert!(crossing_faces(&working(&union(&unit, &inside)).0.surface).is_empty());
}

#[test]
fn crossings_that_were_there_are_not_new() {
    let before = working(&two_spheres(Vector::new(2.5, 0.1, 0.0))).0.surface;
    let touched = working(&two_spheres(Vector::new(1.9, 0.1, 0.0))).0.surface;
    let deeper = working(&two_spheres(Vector::new(1.1, 0.1, 0.0))).0.surface;
    let [none, few, many] = [before, touched, deeper].map(|s| crossing_faces(&s));
    assert_eq!(new_crossings(&none, &many), many);
    assert!(new_crossings(&many, &many).is_empty());
    let new = new_crossings(&few, &many);
    assert!(new.iter().all(|f| !few.contains(f) && many.contains(f)));
}

fn pair(b: [[f64; 3]; 3]) -> Surface {
    let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let positions = a.into_iter().chain(b).map(Point::from).collect();
    Surface::new(positions, vec![[0, 1, 2], [3, 4, 5]].into())
}

#[test]
fn touching_is_not_crossing() {
    for (b, crosses) in [
        // Through the middle; a corner on the plane; two triangles that share a plane.
        ([[0.3, 0.3, -1.0], [0.3, 0.2, 1.0], [0.2, 0.3, 1.0]], true),
        ([[0.2, 0.2, 0.0], [0.9, 0.9, 1.0], [0.9, 0.9, -1.0]], true),
        ([[0.1, 0.1, 0.0], [0.9, 0.1, 0.0], [0.1, 0.9, 0.0]], false),
        // A corner on the face; an edge on the face; an edge through an edge; beside it.
        ([[0.2, 0.2, 0.0], [0.2, 0.3, 1.0], [0.3, 0.2, 1.0]], false),
        ([[0.1, 0.1, 0.0], [0.4, 0.2, 0.0], [0.3, 0.2, 1.0]], false),
        ([[0.5, 0.0, -1.0], [0.5, 0.0, 1.0], [0.5, -1.0, 0.0]], false),
        ([[0.9, 0.9, -1.0], [0.9, 0.8, 1.0], [0.8, 0.9, 1.0]], false),
        // No area.
        ([[0.2, 0.2, -1.0], [0.2, 0.2, 0.0], [0.2, 0.2, 1.0]], false),
    ] {
        for turn in 0..3 {
            let b = [b[turn], b[(turn + 1) % 3], b[(turn + 2) % 3]];
            let expected: &[u32] = if crosses { &[0, 1] } else { &[] };
            assert_eq!(crossing_faces(&pair(b)), expected, "{b:?}");
        }
    }
}

#[test]
fn models_cross_where_brute_force_says_so() {
    for name in [
        "3d/suzanne.obj",
        "truth/suzanne_exact_open.off",
        "truth/spot_headturn30.obj",
    ] {
        let Some(path) = model(name) else { continue };
        let w = working(&load(&path)).0;
        assert_eq!(
            crossing_faces(&w.surface),
            by_brute_force(&w.surface),
            "{name}"
        );
    }
}

#[test]
fn the_scanned_bunny_is_clean() {
    let Some(path) = model("3d/bunny.obj") else {
        return;
    };
    let start = std::time::Instant::now();
    let found = crossing_faces(&working(&load(&path)).0.surface);
    assert!(found.len() < 20, "{found:?} in {:?}", start.elapsed());
}
