//! What follows a deformation: directions turn with the surface, everything else stays.

mod common;

use nalgebra::Rotation3;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::document::{Kind, Layer, MorphPart, NO_ROW, Numbers, On, Role, Values};
use symmetrizer::shape::{Document, Mesh, Surface, Working};

fn layer(on: On, role: Role, values: Values) -> Layer {
    let name = String::new();
    Layer {
        name,
        on,
        role,
        values,
    }
}

fn rows(vectors: &[Vector]) -> Values {
    let numbers = vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
    Values::Rows {
        width: 3,
        numbers: Numbers::F64(numbers),
    }
}

fn vector(values: &Values, i: usize) -> Vector {
    Vector::from_fn(|k, _| values.get(i, k).expect("a row"))
}

/// Working positions after `motion` of the document's points.
fn moved(working: &Working, motion: impl Fn(Point) -> Point) -> Vec<Point> {
    let n = working.normalization;
    let one = |p: &Point| n.to_working(&motion(n.to_document(p)));
    working.surface.positions.iter().map(one).collect()
}

#[test]
fn directions_turn_with_a_turned_shape() {
    let mesh = common::sphere(2);
    let outwards: Vec<Vector> = mesh
        .positions
        .iter()
        .map(|p| p.coords.normalize())
        .collect();
    let across: Vec<Vector> = outwards
        .iter()
        .map(|n| n.cross(&Vector::z()) * 0.3)
        .collect();
    let mut colors = Numbers::with_capacity(Kind::U8, 0);
    mesh.positions.iter().for_each(|_| colors.push(7.0));
    let document = Document {
        layers: vec![
            layer(On::Vertex, Role::Normal, rows(&outwards)),
            layer(
                On::Vertex,
                Role::Morph(0, MorphPart::Position),
                rows(&across),
            ),
            layer(
                On::Vertex,
                Role::Color(0),
                Values::Rows {
                    width: 1,
                    numbers: colors,
                },
            ),
        ],
        ..mesh.into()
    };
    let working = Working::new(&document.mesh).unwrap();
    let turn = Rotation3::new(Vector::new(0.4, -0.7, 1.1));
    let after = document.deformed(&working, &moved(&working, |p| turn * p));
    for (v, (n, m)) in outwards.iter().zip(&across).enumerate() {
        assert!((vector(&after.layers[0].values, v) - turn * n).norm() < 1e-9);
        assert!((vector(&after.layers[1].values, v) - turn * m).norm() < 1e-9);
    }
    assert_eq!(after.layers[2], document.layers[2]);
}

#[test]
fn what_is_not_moved_keeps_its_bits() {
    let mesh = common::sphere(2);
    let odd: Vec<Vector> = mesh.positions.iter().map(|p| p.coords * 0.1).collect();
    let document = Document {
        layers: vec![layer(On::Vertex, Role::Normal, rows(&odd))],
        ..mesh.into()
    };
    let working = Working::new(&document.mesh).unwrap();
    assert_eq!(
        document.deformed(&working, &working.surface.positions),
        document
    );
    // The upper half is lifted: below the equator nothing has happened.
    let mut positions = working.surface.positions.clone();
    for p in positions.iter_mut().filter(|p| p.z > 0.01) {
        p.z += 0.3 * p.z;
    }
    let after = document.deformed(&working, &positions);
    let low = |p: &Point| p.z < -0.3;
    let below = document
        .mesh
        .positions
        .iter()
        .enumerate()
        .filter(|(_, p)| low(p));
    let mut seen = 0;
    for (v, p) in below {
        assert_eq!(after.mesh.positions[v], *p);
        assert_eq!(vector(&after.layers[0].values, v), odd[v]);
        seen += 1;
    }
    assert!(seen > 20);
}

/// Two squares that share an edge; all corners share one normal.
#[test]
fn a_shared_normal_is_parted_where_its_vertices_turn_differently() {
    let at = |x: f64, y: f64| Point::new(x, y, 0.0);
    let positions = vec![
        at(0., 0.),
        at(1., 0.),
        at(2., 0.),
        at(0., 1.),
        at(1., 1.),
        at(2., 1.),
    ];
    let triangles = vec![[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
    let pool = Values::Pool {
        width: 3,
        numbers: Numbers::F64(vec![0.0, 0.0, 1.0, 9.0, 9.0, 9.0]),
        rows: vec![0, 0, 0, 0, 0, 0, 0, 0, 0, 0, NO_ROW, 0],
    };
    let document = Document {
        layers: vec![layer(On::Corner, Role::Normal, pool)],
        ..Mesh::from_triangles(positions, triangles).into()
    };
    let working = Working::new(&document.mesh).unwrap();
    // The right square is folded upwards about the common edge.
    let fold = |p: Point| match p.x > 1.0 {
        true => Point::new(1.0, p.y, p.x - 1.0),
        false => p,
    };
    let after = document.deformed(&working, &moved(&working, fold));
    let normals = &after.layers[0].values;
    // Corner 7 is at vertex 2, at the folded end; corner 5 at vertex 3, at the end that stays.
    assert!((vector(normals, 7) - Vector::new(-1.0, 0.0, 0.0)).norm() < 1e-6);
    assert!((vector(normals, 5) - Vector::z()).norm() < 1e-9);
    assert_eq!(normals.row(10), None);
    // The row that nobody uses is as it was, the same vertex has the same row everywhere.
    let Values::Pool { numbers, .. } = normals else {
        panic!("still a pool");
    };
    assert_eq!([3, 4, 5].map(|i| numbers.get(i)), [9.0; 3]);
    assert_eq!(normals.row(2), normals.row(4));
}

#[test]
fn normals_of_a_deformed_shape_are_those_of_its_surface() {
    let mesh = common::sphere(4);
    let working = Working::new(&mesh).unwrap();
    let normal =
        |v: &Option<u32>| working.surface.vertex_normals[v.expect("a used vertex") as usize];
    let before: Vec<Vector> = working.vertex_of_document.iter().map(normal).collect();
    let document = Document {
        layers: vec![layer(On::Vertex, Role::Normal, rows(&before))],
        ..mesh.into()
    };
    let bend = |p: Point| Point::new(p.x * (0.6 * p.z).cos(), p.y, p.z + p.x * (0.6 * p.z).sin());
    let positions = moved(&working, bend);
    let after = document.deformed(&working, &positions);
    let surface = Surface::new(positions, working.surface.triangles.clone());
    let angles = working.vertex_of_document.iter().enumerate().map(|(v, w)| {
        let n = surface.vertex_normals[w.expect("a used vertex") as usize];
        n.angle(&vector(&after.layers[0].values, v)).to_degrees()
    });
    let worst = angles.fold(0.0, f64::max);
    // Rotation alone leaves the shear out; without it normals are off by up to 40 degrees.
    assert!(worst < 12.0, "{worst}");
}

/// Flat shading: each corner has the normal of its face, before and after.
#[test]
fn the_normal_of_a_face_stays_that_of_its_face() {
    let mesh = common::sphere(3);
    let of_face = |mesh: &Mesh, f: usize| {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[mesh.polygons.get(f)[k] as usize]);
        (b - a).cross(&(c - a)).normalize()
    };
    let count = mesh.polygons.len();
    let flat: Vec<Vector> = (0..count).map(|f| of_face(&mesh, f)).collect();
    let pool = Values::Pool {
        width: 3,
        numbers: Numbers::F64(flat.iter().flat_map(|n| [n.x, n.y, n.z]).collect()),
        rows: (0..count as u32).flat_map(|f| [f; 3]).collect(),
    };
    let document = Document {
        layers: vec![
            layer(On::Corner, Role::Normal, pool),
            layer(On::Face, Role::Normal, rows(&flat)),
        ],
        ..mesh.into()
    };
    let working = Working::new(&document.mesh).unwrap();
    let bend = |p: Point| Point::new(p.x * (0.6 * p.z).cos(), p.y, p.z + p.x * (0.6 * p.z).sin());
    let after = document.deformed(&working, &moved(&working, bend));
    for f in 0..count {
        let n = of_face(&after.mesh, f);
        for k in 0..3 {
            let angle = n.angle(&vector(&after.layers[0].values, 3 * f + k));
            assert!(angle < 1e-6, "{angle}");
        }
        assert!(n.angle(&vector(&after.layers[1].values, f)) < 1e-6);
    }
    // One row for each face, as before.
    assert_eq!(
        after.layers[0].values.numbers().map(Numbers::len),
        document.layers[0].values.numbers().map(Numbers::len)
    );
}
