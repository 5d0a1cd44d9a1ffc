//! What a run must reach on shapes whose symmetry is more than one mirror, against their noise-free forms.

mod common;

use common::{data, load, placed};
use symmetrizer::geom::{Matrix3, Point, Vector};
use symmetrizer::job::pictures::before_after;
use symmetrizer::optimize::{Met, Outcome, Step};
use symmetrizer::report::ExactReport;
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{ClosestPoint, Mesh};
use symmetrizer::transform::Isometry;
use symmetrizer::{Context, Params, Symmetrized, symmetrize};

fn run(mesh: &Mesh, params: &Params) -> Symmetrized {
    symmetrize(mesh, params, &mut Context::new(0)).expect("a run")
}

fn goals(done: &Symmetrized) -> &[Met] {
    let goals = done.report.steps.iter().find_map(|step| match step {
        Step::Orbits { goals, .. } => Some(goals.as_slice()),
        _ => None,
    });
    goals.expect("orbits")
}

fn exact<'a>(done: &'a Symmetrized, name: &str) -> &'a ExactReport {
    let result = done.report.result.as_ref().expect("a result");
    let found = result.exact.iter().find(|e| e.name == name);
    found.expect("what was made exact is in the report")
}

fn isometry(m: &[[f64; 4]; 4]) -> Isometry {
    Isometry {
        linear: Matrix3::from_fn(|r, c| m[r][c]),
        translation: Vector::from_fn(|r, _| m[r][3]),
    }
}

/// rms distance of the images of the vertices of `mesh` from its surface under all `motions`, area-weighted, % of L.
fn residual(mesh: &Mesh, motions: &[Isometry]) -> f64 {
    let working = Working::new(mesh).expect("a usable mesh");
    let surface = &working.surface;
    let closest = ClosestPoint::new(surface);
    let mut sum = 0.0;
    for t in motions {
        for (x, a) in surface.positions.iter().zip(&surface.vertex_areas) {
            let image = t.apply(&working.normalization.to_document(x));
            let image = working.normalization.to_working(&image);
            let hit = closest.nearest(&image, f64::INFINITY).expect("a surface");
            sum += a * hit.distance * hit.distance;
        }
    }
    100.0 * (sum / surface.area() / motions.len() as f64).sqrt()
}

/// The shape of a truth file without its noise, in the file's coordinates, and the motion from rest to file.
fn truth(name: &str, mesh: &Mesh) -> (Mesh, serde_json::Value) {
    let path = data(name)
        .expect("beside the model")
        .with_extension("truth.json");
    let text = std::fs::read_to_string(path).expect("a truth file");
    let truth: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let number = |v: &serde_json::Value| v.as_f64().expect("a number");
    let place = |v: &serde_json::Value| {
        let x: [f64; 3] = std::array::from_fn(|c| number(&v[c]));
        let row = |r: usize| {
            let p = &truth["placement"][r];
            (0..3).map(|c| number(&p[c]) * x[c]).sum::<f64>() + number(&p[3])
        };
        Point::new(row(0), row(1), row(2))
    };
    let rest = truth["rest"]
        .as_array()
        .expect("vertices")
        .iter()
        .map(place);
    let clean = Mesh {
        positions: rest.collect(),
        ..mesh.clone()
    };
    (clean, truth)
}

/// rms distance of the vertices from those of the shape without noise, best rigidly placed, % of the diagonal.
fn to_clean(mesh: &Mesh, clean: &Mesh) -> f64 {
    let pairs: Vec<_> = mesh.positions.iter().zip(&clean.positions).collect();
    let pairs: Vec<symmetrizer::transform::Correspondence> = pairs
        .iter()
        .map(|(p, q)| symmetrizer::transform::Correspondence {
            p: **p,
            q: **q,
            weight: 1.0,
        })
        .collect();
    let ambient = symmetrizer::transform::Ambient::Space;
    let fit =
        symmetrizer::transform::optimal::optimal_rigid(&pairs, None, ambient).expect("a motion");
    let sum: f64 = pairs
        .iter()
        .map(|c| (fit.isometry.apply(&c.p) - c.q).norm_squared())
        .sum();
    100.0 * (sum / pairs.len() as f64).sqrt() / clean.diagonal()
}

/// rms distance of the vertices of two shapes along the normals of the second, area-weighted.
fn along_normals(mesh: &Mesh, from: &Mesh) -> f64 {
    let Working {
        surface,
        document_of_vertex,
        ..
    } = Working::new(from).expect("a usable mesh");
    let mut sum = 0.0;
    for (v, &d) in document_of_vertex.iter().enumerate() {
        let way = mesh.positions[d as usize] - from.positions[d as usize];
        sum += surface.vertex_areas[v] * surface.vertex_normals[v].dot(&way).powi(2);
    }
    (sum / surface.area()).sqrt()
}

/// A run moved no more than 1.2 times what equation 1 asks for with `count` copies of each place, and drew nothing in.
fn moved_little(name: &str, done: &Symmetrized, [mesh, clean]: [&Mesh; 2], count: usize) {
    let needed = along_normals(mesh, clean) * (1.0 - 1.0 / count as f64).sqrt();
    let moved = along_normals(&done.shape, mesh);
    assert!(
        moved <= 1.2 * needed,
        "{name}: {moved} moved, {needed} needed"
    );
    keeps_its_volume(name, done);
}

/// The flat faces of a curved surface draw nothing in: the volume is that of before to a thousandth.
fn keeps_its_volume(name: &str, done: &Symmetrized) {
    let result = done.report.result.as_ref().expect("a result");
    let ratio = result.distortion.volume_ratio.expect("a closed shape");
    assert!((ratio - 1.0).abs() < 1e-3, "{name}: {ratio} of its volume");
}

/// The products of a group's elements are elements, to rounding.
fn is_closed(elements: &[Isometry], size: f64) -> bool {
    let near = |a: &Isometry, b: &Isometry| {
        (a.linear - b.linear).norm() < 1e-9 && (a.translation - b.translation).norm() < 1e-9 * size
    };
    let all: Vec<Isometry> = elements
        .iter()
        .copied()
        .chain([Isometry::identity()])
        .collect();
    let product = |a: &Isometry, b: &Isometry| all.iter().any(|c| near(&a.after(b), c));
    all.iter().all(|a| all.iter().all(|b| product(a, b)))
}

#[test]
fn noisy_groups_are_made_exact_down_to_their_tessellation() {
    for (name, group, order) in [
        ("truth/rot5_chiral.ply", "C5", 5),
        ("truth/three_planes_superellipsoid.ply", "D2h", 8),
    ] {
        let Some(path) = data(name) else { return };
        let mesh = load(&path);
        let (clean, _) = truth(name, &mesh);
        let done = run(&mesh, &Params::default());
        assert_eq!(done.outcome, Outcome::Converged, "{name}");
        let [goal] = goals(&done) else {
            panic!("{name}: {:?}", goals(&done));
        };
        assert_eq!(
            (goal.name.as_str(), goal.order),
            (group, Some(order)),
            "{name}"
        );
        let elements: Vec<Isometry> = exact(&done, group).elements.iter().map(isometry).collect();
        assert!(is_closed(&elements, mesh.diagonal()), "{name}");
        let [before, after, floor] =
            [&mesh, &done.shape, &clean].map(|shape| residual(shape, &elements));
        assert!(
            after <= f64::max(before / 8.0, 1.5 * floor),
            "{name}: {before} -> {after}, floor {floor}"
        );
        let [was, is] = [&mesh, &done.shape].map(|shape| to_clean(shape, &clean));
        assert!(
            is < 0.8 * was,
            "{name}: {was} -> {is} from the shape without noise"
        );
        moved_little(name, &done, [&mesh, &clean], order);
    }
}

#[test]
fn a_row_of_copies_becomes_one_shape_at_even_steps() {
    let name = "truth/row5_translation.ply";
    let Some(path) = data(name) else { return };
    let mesh = load(&path);
    let (clean, _) = truth(name, &mesh);
    let done = run(&mesh, &Params::default());
    let row = goals(&done).first().expect("a goal");
    assert_eq!(
        (row.name.as_str(), row.order, row.kept),
        ("row 5", Some(5), true)
    );
    assert!(
        row.residual[1] < 0.4 * row.residual[0],
        "{:?}",
        row.residual
    );
    let motions: Vec<Isometry> = exact(&done, "row 5")
        .elements
        .iter()
        .map(isometry)
        .collect();
    for (k, t) in motions.iter().enumerate() {
        let step = motions[1].translation * k as f64;
        assert!((t.translation - step).norm() < 1e-9 * mesh.diagonal());
        assert!((t.linear - Matrix3::identity()).norm() < 1e-12);
    }
    let [was, is] = [&mesh, &done.shape].map(|shape| to_clean(shape, &clean));
    assert!(is < 0.8 * was, "{was} -> {is}");
    moved_little(name, &done, [&mesh, &clean], 5);
}

#[test]
fn six_elements_are_made_congruent_where_they_stand() {
    let name = "truth/design_six.obj";
    let Some(path) = data(name) else { return };
    let mesh = load(&path);
    let done = run(&mesh, &Params::default());
    let all = goals(&done).iter().find(|g| g.name == "6 copies");
    let copies = all.expect("six copies");
    assert!(copies.kept && copies.order == Some(6), "{copies:?}");
    assert!(
        copies.residual[1] < 0.85 * copies.residual[0],
        "{:?}",
        copies.residual
    );
    let result = done.report.result.as_ref().expect("a result");
    assert_eq!(result.distortion.new_crossings, 0);
    assert_eq!(result.distortion.inverted_faces, 0);
    // Each stays where it is: no vertex moves by more than a small part of an element.
    assert!(result.distortion.max < 0.6, "{}", result.distortion.max);
    keeps_its_volume(name, &done);
    let mirrored = exact(&done, "6 copies").elements.iter();
    assert_eq!(mirrored.filter(|m| isometry(m).is_improper()).count(), 3);
}

#[test]
fn exact_shapes_are_not_touched() {
    for (name, goal) in [
        ("truth/vase_continuous.ply", "revolution"),
        ("3d/bumpy_cube.obj", "Oh"),
    ] {
        let Some(path) = data(name) else { return };
        let mesh = load(&path);
        let done = run(&mesh, &Params::default());
        assert_eq!(goals(&done)[0].name, goal, "{name}");
        assert_eq!(done.shape.positions, mesh.positions, "{name}");
        assert_eq!(done.outcome, Outcome::Converged, "{name}");
    }
}

/// Nothing is found by votes then, and the page is without the plots of them.
#[test]
fn slides_alone_have_a_picture() {
    let Some(path) = data("truth/vase_continuous.ply") else {
        return;
    };
    let mut params = Params::default();
    params.detect.kinds = vec![symmetrizer::detect::Want::Continuous];
    let done = run(&load(&path), &params);
    assert!(done.after.is_some());
    let page = before_after(&done, "vase").expect("a page");
    assert!(page.height() > 0);
}

/// A mirror of the plate that drifts by some degrees passes by the elements on it: no bend is undone for it.
#[test]
fn a_plate_with_elements_that_stand_any_way_is_not_bent() {
    let Some(path) = data("truth/design_six_samemesh.obj") else {
        return;
    };
    let done = run(&load(&path), &Params::default());
    let bent = |step: &Step| matches!(step, Step::Straighten { .. } | Step::ContractWhole { .. });
    assert!(!done.report.steps.iter().any(bent));
    assert!(goals(&done).iter().any(|g| g.name == "6 copies"));
    let distortion = &done.report.result.as_ref().expect("a result").distortion;
    assert!(distortion.rms < 0.01, "moved by {} % of D", distortion.rms);
}

#[test]
fn a_dented_vase_gets_its_mean_profile() {
    let Some(path) = data("truth/vase_continuous.ply") else {
        return;
    };
    let clean = load(&path);
    let noisy = common::noisy(&clean, 0.002 * clean.diagonal(), 7);
    let done = run(&noisy, &Params::default());
    let goal = &goals(&done)[0];
    assert_eq!(goal.name, "revolution");
    assert!(
        goal.residual[1] < 0.4 * goal.residual[0],
        "{:?}",
        goal.residual
    );
    let [was, is] = [&noisy, &done.shape].map(|shape| to_clean(shape, &clean));
    assert!(is < 0.85 * was, "{was} -> {is}");
}

#[test]
fn only_what_is_asked_for_is_made_exact() {
    let name = "truth/three_planes_superellipsoid.ply";
    let Some(path) = data(name) else { return };
    let mesh = placed(
        &load(&path),
        Vector::new(0.3, 1.0, -0.4),
        40.0,
        Vector::new(9.0, 5.0, 1.0),
    );
    let mut params = Params::default();
    params.detect.kinds = vec![symmetrizer::detect::Want::Rotation];
    params.optimize.max_symmetries = Some(1);
    let done = run(&mesh, &params);
    let [goal] = goals(&done) else {
        panic!("{:?}", goals(&done));
    };
    let elements = &exact(&done, &goal.name).elements;
    assert!(
        elements.iter().all(|m| !isometry(m).is_improper()),
        "{}",
        goal.name
    );
    params.optimize.only = Some(vec![77]);
    let error = symmetrize(&mesh, &params, &mut Context::new(0))
        .err()
        .expect("an error");
    assert!(error.to_string().contains("no symmetry 77"), "{error}");
}

/// A column with five lobes, which wind about it or are mirror images of themselves, and a little noise, its middle bent by `degrees`.
fn column(winds: bool, degrees: f64) -> Mesh {
    let (n, m) = (70, 110);
    let (height, from, to) = (3.0, -0.3, 0.3);
    let k = degrees.to_radians() / (to - from);
    let mut state = 7_u64;
    let mut noise = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        0.004 * ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5)
    };
    let bent = |x: Vector| {
        let s = x.z.clamp(from, to);
        let (sine, cosine) = (k * (s - from)).sin_cos();
        let rest = x.z - s;
        let (way, up) = ((1.0 - cosine) / k, from + sine / k);
        Point::new(
            way + rest * sine + x.x * cosine,
            x.y,
            up + rest * cosine - x.x * sine,
        )
    };
    let mut positions = Vec::new();
    for j in 0..m {
        let t = j as f64 / (m - 1) as f64;
        let z = height * (t - 0.5);
        let closed = (1.0 - (2.0 * t - 1.0).abs().powi(8)).sqrt().max(0.02);
        let round = (0.55 + 0.15 * (10.7 * t + 0.4).sin() + 0.1 * t) * closed;
        let deep = 0.5 + 0.5 * (14.5 * t).sin().powi(2);
        for i in 0..n {
            let a = std::f64::consts::TAU * i as f64 / n as f64;
            let second = if winds { 0.12 } else { 0.0 };
            let lobes = 0.28 * (5.0 * a).cos() + second * (10.0 * a + 0.5).cos();
            let r = round * (1.0 + lobes * deep);
            let turned = a + if winds { 0.35 * z } else { 0.2 };
            let x = Vector::new(
                r * turned.cos() + noise(),
                r * turned.sin() + noise(),
                z + noise(),
            );
            positions.push(bent(x));
        }
    }
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    let at = |j: usize, i: usize| (j * n + i % n) as u32;
    for (j, i) in (1..m).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let [a, b, c, d] = [at(j - 1, i), at(j - 1, i + 1), at(j, i), at(j, i + 1)];
        triangles.extend([[a, b, d], [a, d, c]]);
    }
    for (j, z) in [(0, -height / 2.0), (m - 1, height / 2.0)] {
        let pole = positions.len() as u32;
        positions.push(bent(Vector::new(0.0, 0.0, z)));
        for i in 0..n {
            let side = [at(j, i), at(j, i + 1)];
            let [a, b] = if j == 0 { [side[1], side[0]] } else { side };
            triangles.push([pole, a, b]);
        }
    }
    Mesh {
        positions,
        polygons: triangles.into_iter().collect(),
    }
}

/// Each half of a bent column has five-fold rotations about an axis of its own. Merged they are those of all of it, with the column as long
/// along its axis as it was along its bend; where no bend is to be undone each half gets its own.
#[test]
fn rotations_about_a_bent_axis_are_merged() {
    let mesh = column(true, 30.0);
    let done = run(&mesh, &Params::default());
    let merged = done.report.steps.iter().any(|s| {
        matches!(s, Step::Merge { kept: true, coverage, .. } if coverage[0] < 0.6 && coverage[1] > 0.95)
    });
    assert!(merged, "{:?}", done.report.steps);
    let [met] = goals(&done) else {
        panic!("{:?}", goals(&done));
    };
    assert!(met.kept && met.order == Some(5) && met.area_fraction > 0.95);
    let motions: Vec<Isometry> = exact(&done, "C5").elements.iter().map(isometry).collect();
    let left = residual(&done.shape, &motions);
    let straight = column(true, 1e-6);
    let noise = residual(
        &straight,
        &(1..5)
            .map(|k| Isometry {
                linear: symmetrizer::geom::exp_rotation(
                    &(Vector::z() * (std::f64::consts::TAU * f64::from(k) / 5.0)),
                ),
                translation: Vector::zeros(),
            })
            .collect::<Vec<_>>(),
    );
    assert!(
        left < noise,
        "{left} % of L from its copies, the straight one {noise}"
    );
    let result = done.report.result.as_ref().expect("a result");
    assert_eq!(result.distortion.inverted_faces, 0);
    let poles = |mesh: &Mesh| {
        let [.., low, high] = mesh.positions.as_slice() else {
            panic!("a column has poles");
        };
        (high - low).norm()
    };
    let [now, wanted] = [&done.shape, &straight].map(poles);
    assert!(
        (now / wanted - 1.0).abs() < 0.02,
        "{now} long, not {wanted}"
    );
    // It shows what was made exact on the input, too.
    before_after(&done, "column").expect("a page");

    let mut params = Params::default();
    params.straighten.when = symmetrizer::straighten::When::Never;
    params.detect.kinds = vec![symmetrizer::detect::Want::Rotation];
    let apart = run(&mesh, &params);
    let fivefold = goals(&apart)
        .iter()
        .filter(|g| g.kept && g.order == Some(5));
    assert_eq!(fivefold.count(), 2);
}

/// A bent column whose lobes are mirror images of themselves is mirrored about its bent axis. Once it is straight it has all of C5v.
#[test]
fn a_bent_column_with_mirrors_gets_its_rotations_too() {
    let mesh = column(false, 30.0);
    let done = run(&mesh, &Params::default());
    let straightened = |s: &Step| matches!(s, Step::Straighten { .. });
    assert!(done.report.steps.iter().any(straightened));
    let motions: Vec<Isometry> = exact(&done, "C5v").elements.iter().map(isometry).collect();
    assert_eq!(motions.len(), 9);
    assert!(is_closed(&motions, done.shape.diagonal()));
    let left = residual(&done.shape, &motions);
    assert!(left < 0.06, "{left} % of L from its copies");
    let result = done.report.result.as_ref().expect("a result");
    assert_eq!(result.distortion.inverted_faces, 0);
}
