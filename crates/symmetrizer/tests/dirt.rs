//! Dirt on a shape changes nothing: soup, seams, flipped and double faces, loose and lost vertices, any
//! place and size give the result of the clean shape.

mod common;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::Mesh;
use symmetrizer::{Context, Outcome, Params, symmetrize};

fn run(mesh: &Mesh) -> Mesh {
    let job = symmetrize(mesh, &Params::default(), &mut Context::new(0)).unwrap();
    assert_eq!(job.outcome, Outcome::Converged);
    job.shape
}

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.triangles().map(|(t, _)| t).collect()
}

/// Root mean square distance of vertices, in percent of D.
fn rms(clean: &Mesh, other: impl Iterator<Item = (u32, Point)>) -> f64 {
    let squares: Vec<f64> = other
        .map(|(v, p)| (p - clean.positions[v as usize]).norm_squared())
        .collect();
    100.0 * (squares.iter().sum::<f64>() / squares.len() as f64).sqrt() / clean.diagonal()
}

#[test]
fn dirt_changes_nothing() {
    let Some(path) = common::data("truth/spot_headturn30.obj") else {
        return;
    };
    let mesh = common::load(&path);
    let clean = run(&mesh);
    let moved = rms(&mesh, (0..).zip(clean.positions.iter().copied()));
    assert!(moved > 1.0, "the head turns: {moved}");
    let faces = triangles(&mesh);
    let mut dice = Pcg64Mcg::seed_from_u64(1);

    // Every triangle with vertices of its own.
    let soup = faces.iter().flatten().map(|v| mesh.positions[*v as usize]);
    let own: Vec<[u32; 3]> = (0..faces.len() as u32)
        .map(|f| [3 * f, 3 * f + 1, 3 * f + 2])
        .collect();
    let soup = run(&Mesh::from_triangles(soup.collect(), own));
    let of_soup = faces.iter().flatten().copied().zip(soup.positions);
    assert!(rms(&clean, of_soup) < 0.1);

    // Half of the faces the other way round.
    let mut flipped = faces.clone();
    for t in &mut flipped {
        if dice.random_bool(0.5) {
            t.swap(0, 1);
        }
    }
    let flipped = run(&Mesh::from_triangles(mesh.positions.clone(), flipped));
    // Samples lie elsewhere in a triangle that begins with another corner: as with another seed.
    assert!(rms(&clean, (0..).zip(flipped.positions)) < 0.4);

    // Faces twice, flipped and not, degenerate ones, loose vertices, one that is nowhere.
    let mut messy = faces.clone();
    for f in 0..60 {
        let [a, b, c] = faces[f * 70];
        messy.push([b, c, a]);
        messy.push([c, b, a]);
        messy.push([a, a, b]);
    }
    let mut positions = mesh.positions.clone();
    positions.extend([Point::new(1e3, 0.0, 0.0), Point::new(f64::NAN, 0.0, 0.0)]);
    let messy = run(&Mesh::from_triangles(positions, messy));
    assert!(messy.positions.last().unwrap().x.is_nan());
    let known = mesh.positions.len();
    assert!(rms(&clean, (0..).zip(messy.positions).take(known)) < 0.1);

    // As small as an atom, as far away as a map.
    for (scale, shift) in [
        (1e-7, Vector::zeros()),
        (1.0, Vector::new(5e5, 5.6e6, 300.0)),
    ] {
        let placed = |p: &Point| Point::from(p.coords * scale + shift);
        let mut there = mesh.clone();
        there.positions = mesh.positions.iter().map(placed).collect();
        let there = run(&there);
        let back = |p: Point| Point::from((p.coords - shift) / scale);
        let back = there.positions.into_iter().map(back);
        assert!(rms(&clean, (0..).zip(back)) < 0.1);
    }
}

/// The middle of the bounding box.
fn middle(mesh: &Mesh) -> Point {
    let low = mesh
        .positions
        .iter()
        .fold(mesh.positions[0], |a, p| a.inf(p));
    let high = mesh
        .positions
        .iter()
        .fold(mesh.positions[0], |a, p| a.sup(p));
    nalgebra::center(&low, &high)
}

fn nearest(mesh: &Mesh, p: &Point) -> u32 {
    let near = |v: &u32| (mesh.positions[*v as usize] - p).norm_squared();
    let all = 0..mesh.positions.len() as u32;
    all.min_by(|a, b| near(a).total_cmp(&near(b)))
        .expect("a vertex")
}

#[test]
fn spots_of_the_collection_come_out_as_the_clean_one() {
    let (Some(clean), Some(folder)) = (common::data("formats/spot.obj"), common::data("")) else {
        return;
    };
    let mesh = common::load(&clean);
    let clean = run(&mesh);
    for name in [
        "3d/spot_seams.obj",
        "dirty/spot_soup_unwelded.ply",
        "dirty/spot_mixed_orientation.ply",
        "dirty/spot_dup_flip_degenerate.off",
        "dirty/spot_tiny.ply",
        "dirty/spot_huge_coords.obj",
    ] {
        let dirty = common::load(&folder.join(name));
        let done = run(&dirty);
        let scale = mesh.diagonal() / dirty.diagonal();
        let shift = middle(&mesh).coords - middle(&dirty).coords * scale;
        let placed = |p: &Point| Point::from(p.coords * scale + shift);
        let partner = |p: &Point| nearest(&mesh, &placed(p));
        let partners: Vec<u32> = dirty.positions.iter().map(partner).collect();
        let moved = done.positions.iter().map(placed);
        let error = rms(&clean, partners.into_iter().zip(moved));
        assert!(error < 0.1, "{name}: {error} % of D");
    }
}

#[test]
fn an_exactly_symmetric_shape_keeps_every_bit() {
    let Some(path) = common::data("truth/spot_exact.obj") else {
        return;
    };
    let mesh = common::load(&path);
    assert_eq!(run(&mesh), mesh);
}
