//! The generated animal: a closed, well-shaped mesh, symmetric at rest and not as posed.

use std::collections::BTreeMap;

use symmetrizer::Mesh;
use symmetrizer::geom::Point;
use symmetrizer::shape::models::Creature;
use symmetrizer::shape::{ClosestPoint, Surface};

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.triangles().map(|(t, _)| t).collect()
}

/// Vertices - edges + faces, where every edge has one face on each side.
fn euler_of_closed(mesh: &Mesh) -> i64 {
    let mut edges: BTreeMap<(u32, u32), (u32, u32)> = BTreeMap::new();
    for [a, b, c] in triangles(mesh) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let sides = edges.entry((from.min(to), from.max(to))).or_default();
            if from < to {
                sides.0 += 1
            } else {
                sides.1 += 1
            }
        }
    }
    for (edge, sides) in &edges {
        assert_eq!(*sides, (1, 1), "edge {edge:?}");
    }
    mesh.positions.len() as i64 - edges.len() as i64 + mesh.polygons.len() as i64
}

fn components(mesh: &Mesh) -> usize {
    let mut root: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    fn find(root: &mut [u32], mut v: u32) -> u32 {
        while root[v as usize] != v {
            root[v as usize] = root[root[v as usize] as usize];
            v = root[v as usize];
        }
        v
    }
    for [a, b, c] in triangles(mesh) {
        for other in [b, c] {
            let (r, s) = (find(&mut root, a), find(&mut root, other));
            root[r as usize] = s;
        }
    }
    (0..root.len()).filter(|&v| root[v] == v as u32).count()
}

/// The smallest angle of any triangle, degrees.
fn smallest_angle(mesh: &Mesh) -> f64 {
    let angle = |at: Point, b: Point, c: Point| (b - at).angle(&(c - at)).to_degrees();
    let angles = triangles(mesh).into_iter().map(|t| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        angle(a, b, c).min(angle(b, c, a)).min(angle(c, a, b))
    });
    angles.fold(180.0, f64::min)
}

/// Mean and greatest distance of the vertices, mirrored in y = 0, from the surface.
fn mirror_distance(mesh: &Mesh) -> (f64, f64) {
    let surface = Surface::new(mesh.positions.clone(), triangles(mesh).into());
    let closest = ClosestPoint::new(&surface);
    let distances: Vec<f64> = mesh
        .positions
        .iter()
        .map(|p| Point::new(p.x, -p.y, p.z))
        .map(|q| closest.nearest(&q, 10.0).unwrap().distance)
        .collect();
    let mean = distances.iter().sum::<f64>() / distances.len() as f64;
    (mean, distances.into_iter().fold(0.0, f64::max))
}

fn volume(mesh: &Mesh) -> f64 {
    let doubled = triangles(mesh).into_iter().map(|t| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize].coords);
        a.dot(&b.cross(&c))
    });
    doubled.sum::<f64>() / 6.0
}

#[test]
fn the_default_is_a_closed_mesh_of_good_triangles() {
    let mesh = Creature::default().mesh();
    mesh.check().unwrap();
    assert!(
        (20_000..30_000).contains(&mesh.polygons.len()),
        "{}",
        mesh.polygons.len()
    );
    assert_eq!(euler_of_closed(&mesh), 2);
    assert_eq!(components(&mesh), 1);
    assert!(smallest_angle(&mesh) > 5.0, "{}", smallest_angle(&mesh));
    assert!(volume(&mesh) > 0.0);
}

#[test]
fn it_is_closed_in_any_pose_and_resolution() {
    for (resolution, head_turn_deg, uneven) in [
        (0, -90.0, true),
        (83, 0.0, false),
        (87, f64::NAN, false),
        (94, 20.0, true),
        (120, 60.0, false),
    ] {
        let creature = Creature {
            head_turn_deg,
            uneven,
            resolution,
        };
        let mesh = creature.mesh();
        assert_eq!(euler_of_closed(&mesh), 2, "{creature:?}");
        assert_eq!(components(&mesh), 1, "{creature:?}");
    }
}

#[test]
fn at_rest_the_solid_is_symmetric_and_the_triangles_are_not() {
    let mesh = Creature::at_rest().mesh();
    let (mean, greatest) = mirror_distance(&mesh);
    let diagonal = mesh.diagonal();
    assert!(
        mean < 2e-4 * diagonal && greatest < 5e-3 * diagonal,
        "{mean} {greatest}"
    );
    let twins = mesh.positions.iter().filter(|p| p.y.abs() < 1e-9).count();
    assert!(twins < 20, "{twins} vertices lie in the plane of symmetry");
}

#[test]
fn the_pose_breaks_the_symmetry_of_the_head() {
    let (mean, greatest) = mirror_distance(&Creature::default().mesh());
    let diagonal = Creature::default().mesh().diagonal();
    assert!(
        mean > 5e-3 * diagonal && greatest > 0.05 * diagonal,
        "{mean} {greatest}"
    );
}

#[test]
fn the_same_creature_has_the_same_bits() {
    assert_eq!(Creature::default().mesh(), Creature::default().mesh());
}
