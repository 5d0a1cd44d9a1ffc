//! Every family of point groups, in random frames.

use super::*;
use crate::geom::Matrix3;
use crate::group::{Name, PointGroup, point_group};
use std::f64::consts::TAU;

fn inversion() -> Isometry {
    Isometry {
        linear: -Matrix3::identity(),
        translation: Vector::zeros(),
    }
}

/// Generators of a group about the origin with the z axis as principal axis.
fn generators(name: Name) -> Vec<Isometry> {
    let c = |n: u32| rotation(Vector::z(), TAU / f64::from(n));
    let half = |n: u32| rotation(Vector::z(), TAU / f64::from(2 * n));
    let across = mirror(Vector::z());
    let upright = mirror(Vector::y());
    let turned = rotation(Vector::x(), TAU / 2.0);
    let cube = rotation(Vector::new(1.0, 1.0, 1.0), TAU / 3.0);
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let five = rotation(Vector::new(0.0, 1.0, golden), TAU / 5.0);
    match name {
        Name::C(1) => vec![],
        Name::C(n) => vec![c(n)],
        Name::Cs => vec![across],
        Name::Ci => vec![inversion()],
        Name::Cv(n) => vec![c(n), upright],
        Name::Ch(n) => vec![c(n), across],
        Name::S(n) => vec![rotation(Vector::z(), TAU / f64::from(n)).after(&across)],
        Name::D(n) => vec![c(n), turned],
        Name::Dh(n) => vec![c(n), turned, across],
        Name::Dd(n) => vec![half(n).after(&across), turned],
        Name::T => vec![c(2), cube],
        Name::Td => vec![mirror(Vector::new(1.0, 1.0, 0.0)), cube, c(2)],
        Name::Th => vec![inversion(), cube, c(2)],
        Name::O => vec![c(4), cube],
        Name::Oh => vec![c(4), cube, inversion()],
        Name::I => vec![five, cube],
        Name::Ih => vec![five, cube, inversion()],
    }
}

fn families() -> Vec<Name> {
    let mut all = vec![Name::C(1), Name::Cs, Name::Ci, Name::T, Name::Td, Name::Th];
    all.extend([Name::O, Name::Oh, Name::I, Name::Ih]);
    for n in [2, 3, 4, 5, 6, 9, 12] {
        all.extend([Name::C(n), Name::Cv(n), Name::Ch(n), Name::S(2 * n)]);
        all.extend([Name::D(n), Name::Dh(n), Name::Dd(n)]);
    }
    // S2 is the inversion and has no other name.
    all.retain(|name| *name != Name::S(2));
    all
}

/// All products, exact but for rounding.
fn closed(generators: &[Isometry], space: &TransformSpace) -> Vec<Isometry> {
    let mut all = vec![Isometry::identity()];
    let mut next = 0;
    while next < all.len() {
        for g in generators {
            let product = all[next].after(g);
            if all.iter().all(|t| space.distance(t, &product) > 1e-6) {
                all.push(product);
            }
        }
        next += 1;
    }
    all
}

fn greatest_opening(group: &PointGroup) -> f64 {
    let n = group.elements.len();
    let mut worst: f64 = 0.0;
    for g in 0..n {
        for h in 0..n {
            let product = group.elements[g].after(&group.elements[h]);
            let named = &group.elements[group.table.product(g, h)];
            worst = worst.max((product.linear - named.linear).amax());
            worst = worst.max((product.translation - named.translation).amax());
        }
    }
    worst
}

#[test]
fn every_family_is_named_and_exact() {
    let mut rng = rng(31);
    for name in families() {
        let frame = random_frame(&mut rng);
        let off = vector(&mut rng, 0.2);
        let space = space_at(frame.translation + off, &mut rng);
        let truth: Vec<Isometry> = closed(&generators(name), &space);
        let truth: Vec<Isometry> = truth.iter().map(|t| seen_from(&frame, t)).collect();
        assert_eq!(truth.len(), name.order(), "{name}");
        let given: Vec<Isometry> = generators(name)
            .iter()
            .map(|t| noisy(&seen_from(&frame, t), &space, &mut rng))
            .collect();
        let mut answers = shape(&truth, &space, &mut rng);
        let group = point_group(&given, within(&space), &mut answers).expect("a group");
        assert_eq!(group.name, name);
        assert_eq!(group.elements.len(), name.order(), "{name}");
        assert_eq!(group.table.order(), name.order());
        assert!(greatest_opening(&group) < 1e-12, "{name}");
        for (exact, measured) in group.elements.iter().zip(&group.measured) {
            assert!(space.distance(exact, measured) < 4.0 * NOISE, "{name}");
        }
        for exact in &group.elements {
            assert!((exact.apply(&group.centre) - group.centre).norm() < 1e-12);
            let nearest = truth.iter().map(|t| space.distance(t, exact));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest < 3.0 * NOISE, "{name}: {nearest}");
        }
        check_axis(&group, &frame);
    }
}

/// The z axis of the frame, where there is one principal axis.
fn check_axis(group: &PointGroup, frame: &Isometry) {
    let name = group.name;
    let none = name.is_polyhedral() || matches!(name, Name::C(1) | Name::Ci);
    assert_eq!(group.axis.is_none(), none, "{name}");
    if let Some(axis) = group.axis {
        let z = frame.rotate(&Vector::z());
        // Of the three axes of D2 any is the first.
        let any = matches!(name, Name::D(2) | Name::Dh(2));
        assert!(any || axis.dot(&z).abs() > 1.0 - 1e-3, "{name}");
        assert!((axis.norm() - 1.0).abs() < 1e-12 && axis[axis.iamax()] > 0.0);
    }
}

/// Averaging over the group takes noise away: the more elements, the more.
#[test]
fn exact_elements_are_nearer_to_the_truth_than_measured_ones() {
    let mut rng = rng(32);
    let space = space_at(Vector::zeros(), &mut rng);
    let truth = closed(&generators(Name::Oh), &space);
    let given: Vec<Isometry> = generators(Name::Oh)
        .iter()
        .map(|t| noisy(t, &space, &mut rng))
        .collect();
    let mut answers = shape(&truth, &space, &mut rng);
    let group = point_group(&given, within(&space), &mut answers).expect("a group");
    let error = |t: &Isometry| {
        let distances = truth.iter().map(|s| space.distance(s, t));
        distances.fold(f64::INFINITY, f64::min)
    };
    let exact: f64 = group.elements.iter().map(error).sum();
    let measured: f64 = group.measured.iter().map(error).sum();
    assert!(exact < 0.5 * measured, "{exact} {measured}");
}

#[test]
fn the_same_input_gives_the_same_bits() {
    let once = || {
        let mut rng = rng(33);
        let space = space_at(Vector::zeros(), &mut rng);
        let truth = closed(&generators(Name::Td), &space);
        let given: Vec<Isometry> = generators(Name::Td)
            .iter()
            .map(|t| noisy(t, &space, &mut rng))
            .collect();
        let mut answers = shape(&truth, &space, &mut rng);
        point_group(&given, within(&space), &mut answers).expect("a group")
    };
    let (a, b) = (once(), once());
    assert_eq!(a.elements, b.elements);
    assert_eq!(a.centre, b.centre);
    assert_eq!(a.table, b.table);
}

#[test]
fn names_print_as_chemists_write_them() {
    let names = [
        Name::C(3),
        Name::Cv(2),
        Name::Ch(5),
        Name::S(6),
        Name::Dd(3),
        Name::Ih,
    ];
    let text: Vec<String> = names.iter().map(Name::to_string).collect();
    assert_eq!(text, ["C3", "C2v", "C5h", "S6", "D3d", "Ih"]);
    assert_eq!(serde_json::to_string(&Name::Dh(4)).unwrap(), "\"D4h\"");
}
