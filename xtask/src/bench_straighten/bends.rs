//! Own bends: shapes that are bent and twisted by known amounts, and what of that is undone.

use symmetrizer::geom::Point;
use symmetrizer::shape::io;
use symmetrizer::{Mesh, Result};

use super::{Truth, look, similar};
use crate::data;
use crate::tables::{Table, number};

/// A shape to bend: its file, whether its rest is that of the truth beside it, and its axes: that of the spine, and
/// the one to bend towards.
struct Animal {
    name: &'static str,
    file: &'static str,
    along: usize,
    side: usize,
}

const ANIMALS: [Animal; 4] = [
    animal("cow", "3d/cow.obj", 0, 2),
    animal("homer", "3d/homer.obj", 1, 0),
    animal("human", "truth/human_rest_arm_spine.truth.json", 1, 0),
    animal("spot", "3d/spot_seams.obj", 2, 0),
];

const fn animal(name: &'static str, file: &'static str, along: usize, side: usize) -> Animal {
    Animal {
        name,
        file,
        along,
        side,
    }
}

/// How a shape is deformed, by this many degrees over its length.
#[derive(Clone, Copy)]
enum Kind {
    /// Sideways, evenly.
    Bend,
    /// One half to one side, the other to the other.
    S,
    /// About the spine.
    Twist,
}

const CASES: [(Kind, &str, &[f64]); 3] = [
    (Kind::Bend, "bend", &[30.0, 60.0, 90.0, 110.0, 130.0]),
    (Kind::S, "S", &[45.0, 90.0]),
    (Kind::Twist, "twist", &[30.0, 50.0, 60.0]),
];

/// Own bends of shapes with `only` in their names, such as "cow bend 90".
///
/// # Errors
/// Test data that is missing or damaged; those of the stages.
pub fn table(only: Option<&String>) -> Result<Table> {
    let mut table = Table::new([
        "own bend",
        "verdict",
        "score",
        "unfit",
        "found",
        "rms before",
        "undone",
    ]);
    for animal in &ANIMALS {
        let mesh = animal.mesh()?;
        for (kind, what, angles) in CASES {
            for degrees in angles {
                let name = format!("{} {what} {degrees}", animal.name);
                if only.is_none_or(|o| name.contains(o.as_str())) {
                    table.row(one(name, &mesh, &animal.deformed(&mesh, kind, *degrees))?);
                }
            }
        }
    }
    Ok(table)
}

fn one(name: String, mesh: &Mesh, bent: &Mesh) -> Result<[String; 7]> {
    let looked = look(bent)?;
    let before = similar(&bent.positions, &mesh.positions);
    let after = similar(&looked.positions(), &mesh.positions);
    let trust = looked.bend.as_ref().map(|b| &b.trust);
    Ok([
        name,
        trust.map_or_else(|| "none".into(), |t| format!("{:?}", t.verdict())),
        number(trust.map(|t| t.score()), 2),
        number(trust.map(|t| t.unfit), 3),
        number(looked.bend.as_ref().map(|b| b.degrees), 0),
        number(Some(before), 2),
        number(Some(1.0 - after / before), 3),
    ])
}

impl Animal {
    fn mesh(&self) -> Result<Mesh> {
        let path = data::root()?.join(self.file);
        if !self.file.ends_with(".json") {
            return Ok(io::read(&path)?.mesh);
        }
        let truth: Truth = data::json(&path)?;
        let mut mesh = io::read(&path.with_file_name(truth.file))?.mesh;
        let rest = truth.rest.unwrap_or_default();
        if rest.len() != mesh.positions.len() {
            return Err(data::damaged(&path, "it has another number of vertices"));
        }
        mesh.positions = rest.into_iter().map(Point::from).collect();
        Ok(mesh)
    }

    /// The mesh about the middle of its box, deformed.
    fn deformed(&self, mesh: &Mesh, kind: Kind, degrees: f64) -> Mesh {
        let first = mesh.positions[0];
        let ends = mesh.positions.iter().fold((first, first), |(a, b), p| {
            (
                Point::from(a.coords.inf(&p.coords)),
                b.coords.sup(&p.coords).into(),
            )
        });
        let middle = nalgebra::center(&ends.0, &ends.1);
        let length = (ends.1 - ends.0)[self.along];
        let mut bent = mesh.clone();
        for p in &mut bent.positions {
            let p0 = Point::from(*p - middle);
            *p = match kind {
                Kind::Bend => self.bent(p0, length / degrees.to_radians()),
                Kind::S => self.bent_twice(p0, length, degrees),
                Kind::Twist => self.twisted(p0, degrees.to_radians() / length),
            };
        }
        bent
    }

    /// On a circle of this radius.
    fn bent(&self, p: Point, radius: f64) -> Point {
        let (sin, cos) = (p[self.along] / radius).sin_cos();
        let mut q = p;
        q[self.side] = radius - (radius - p[self.side]) * cos;
        q[self.along] = (radius - p[self.side]) * sin;
        q
    }

    /// Its spine at slopes that go up by `degrees` to the middle and down again, along a cosine.
    fn bent_twice(&self, p: Point, length: f64, degrees: f64) -> Point {
        let steps = 200;
        let slope = |s: f64| {
            let wave = (std::f64::consts::PI * s / length).cos();
            degrees.to_radians() * wave
        };
        let to = p[self.along];
        let ds = to / f64::from(steps);
        let (mut along, mut side) = (0.0, 0.0);
        for k in 0..steps {
            let (sin, cos) = slope((f64::from(k) + 0.5) * ds).sin_cos();
            along += cos * ds;
            side += sin * ds;
        }
        let (sin, cos) = slope(to).sin_cos();
        let mut q = p;
        q[self.along] = along - p[self.side] * sin;
        q[self.side] = side + p[self.side] * cos;
        q
    }

    /// By this angle for each length along the spine.
    fn twisted(&self, p: Point, rate: f64) -> Point {
        let (sin, cos) = (rate * p[self.along]).sin_cos();
        let (a, b) = ((self.along + 1) % 3, (self.along + 2) % 3);
        let mut q = p;
        q[a] = cos * p[a] - sin * p[b];
        q[b] = sin * p[a] + cos * p[b];
        q
    }
}
