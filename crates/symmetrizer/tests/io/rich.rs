//! Documents with a bit of everything.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::shape::Document;
use symmetrizer::shape::document::{
    Kind, Layer, MorphPart, NO_ROW, NameList, Numbers, On, Role, Values,
};
use symmetrizer::shape::mesh::{Mesh, Polygons};

/// Draws a layer.
type Maker = Box<dyn FnMut(&mut Dice) -> Layer>;

/// A document with the layers that the bits of `mask` choose and values drawn from `seed`.
pub fn rich(mask: u32, seed: u64) -> Document {
    let mut dice = Dice(Pcg64Mcg::seed_from_u64(seed));
    let mesh = dice.mesh();
    let [vertices, faces] = [mesh.positions.len(), mesh.polygons.len()];
    let corners = mesh.polygons.iter().map(<[u32]>::len).sum();
    let mut makers: Vec<Maker> = vec![
        Box::new(move |d| layer(On::Vertex, Role::Normal, d.directions(vertices))),
        Box::new(move |d| layer(On::Vertex, Role::Color(0), d.rows(Kind::U8, 4, vertices))),
        Box::new(move |d| {
            layer(
                On::Vertex,
                Role::TexCoord(0),
                d.rows(Kind::F32, 2, vertices),
            )
        }),
        Box::new(move |d| layer(On::Corner, Role::TexCoord(0), d.pool(2, corners))),
        Box::new(move |d| layer(On::Corner, Role::Normal, d.pool(3, corners))),
        Box::new(move |d| layer(On::Face, Role::Color(0), d.rows(Kind::U8, 3, faces))),
        Box::new(move |d| layer(On::Vertex, Role::Joints(0), d.rows(Kind::U16, 4, vertices))),
        Box::new(move |d| layer(On::Vertex, Role::Weights(0), d.rows(Kind::F32, 4, vertices))),
        Box::new(move |d| {
            let role = Role::Morph(0, MorphPart::Position);
            layer(On::Vertex, role, d.rows(Kind::F32, 3, vertices))
        }),
        Box::new(move |d| other(On::Vertex, "quality", d.rows(Kind::F64, 1, vertices))),
        Box::new(move |d| other(On::Vertex, "tag", d.rows(Kind::I32, 1, vertices))),
        Box::new(move |d| other(On::Face, "level", d.rows(Kind::U16, 1, faces))),
        Box::new(move |d| other(On::Face, "list", d.lists(faces))),
    ];
    for role in [Role::Object, Role::Group, Role::Material, Role::Smoothing] {
        makers.push(Box::new(move |d| layer(On::Face, role, d.names(faces))));
    }
    let chosen = makers
        .iter_mut()
        .enumerate()
        .filter(|(k, _)| mask >> k & 1 == 1);
    let layers = chosen.map(|(_, make)| make(&mut dice)).collect();
    Document {
        mesh,
        layers,
        ..Document::default()
    }
}

fn layer(on: On, role: Role, values: Values) -> Layer {
    let name = String::new();
    Layer {
        name,
        on,
        role,
        values,
    }
}

fn other(on: On, name: &str, values: Values) -> Layer {
    Layer {
        name: name.into(),
        ..layer(on, Role::Other, values)
    }
}

struct Dice(Pcg64Mcg);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0.random_range(0..n)
    }

    fn unit(&mut self) -> f64 {
        self.0.random_range(0.0..1.0)
    }

    fn mesh(&mut self) -> Mesh {
        let count = 3 + self.below(9);
        let positions = (0..count).map(|_| Point::from([0; 3].map(|_| self.unit() * 2e3 - 1e3)));
        let positions = positions.collect();
        let mut polygons = Polygons::default();
        for _ in 0..1 + self.below(6) {
            let size = 3 + self.below(3);
            let polygon: Vec<u32> = (0..size).map(|_| self.below(count) as u32).collect();
            polygons.push(&polygon);
        }
        Mesh {
            positions,
            polygons,
        }
    }

    fn rows(&mut self, kind: Kind, width: usize, count: usize) -> Values {
        let mut numbers = Numbers::with_capacity(kind, width * count);
        for _ in 0..width * count {
            let value = match kind.is_float() {
                true => self.unit(),
                false => self.below(200) as f64,
            };
            numbers.push(value);
        }
        Values::Rows { width, numbers }
    }

    fn directions(&mut self, count: usize) -> Values {
        let mut numbers = Vec::with_capacity(3 * count);
        for _ in 0..count {
            let n = Vector::new(self.unit() - 0.5, self.unit() - 0.5, self.unit() + 0.1);
            numbers.extend(n.normalize().iter());
        }
        let numbers = Numbers::F64(numbers);
        Values::Rows { width: 3, numbers }
    }

    fn pool(&mut self, width: usize, count: usize) -> Values {
        let size = 1 + self.below(5);
        let numbers = Numbers::F64((0..width * size).map(|_| self.unit()).collect());
        let rows = (0..count).map(|_| match self.below(size + 1) {
            k if k == size => NO_ROW,
            k => k as u32,
        });
        let rows = rows.collect();
        Values::Pool {
            width,
            numbers,
            rows,
        }
    }

    fn lists(&mut self, count: usize) -> Values {
        let mut starts = vec![0];
        for _ in 0..count {
            let length = self.below(4) as u32;
            starts.push(starts[starts.len() - 1] + length);
        }
        let total = starts[starts.len() - 1] as usize;
        let numbers = Numbers::I16((0..total).map(|_| self.below(100) as i16).collect());
        Values::Lists { starts, numbers }
    }

    fn names(&mut self, count: usize) -> Values {
        let mut list = NameList::default();
        for f in 0..count {
            let name = [Some("a"), Some("b c"), Some("#d"), None][self.below(4)];
            // At least one name.
            list.push(if f == 0 { Some("first") } else { name });
        }
        list.finish().expect("a name")
    }
}
