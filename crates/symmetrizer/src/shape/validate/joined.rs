//! How the faces hang together: edges, fans, borders, components.

use super::edges::{Side, components, edges, odd_edges, sides, vertex};
use super::faces::Faces;
use super::finding::{Finding, Tally, grouped};
use super::kind::{Kind, Severity};
use super::sets::Sets;
use crate::geom::Point;

/// A part of the area below which a component is tiny.
const TINY: f64 = 1e-3;
/// A part of the volume swept below which a volume is rounding.
const ROUNDING: f64 = 1e-9;

/// The joined surface.
pub(super) struct Joined<'a> {
    pub(super) faces: &'a Faces<'a>,
    sides: Vec<Side>,
}

impl<'a> Joined<'a> {
    /// The surface that `faces` form.
    pub fn new(faces: &'a Faces<'a>) -> Self {
        Self {
            faces,
            sides: sides(&faces.triangles),
        }
    }

    /// The findings on the whole.
    pub fn findings(&self) -> Vec<Finding> {
        let mut found = vec![self.same_place(), self.misoriented()];
        found.extend(self.oriented_parts());
        found.push(self.non_manifold_edges());
        let mut fans = self.fans();
        found.push(self.pinched(&mut fans));
        found.push(self.borders(fans));
        found.push(self.near_seams());
        found.extend(self.parts());
        found
    }

    /// The vertices, as the file names them, at the ends of a side.
    pub(super) fn edge(&self, side: Side) -> [u32; 2] {
        [side.corner, side.next_corner()].map(|c| vertex(&self.faces.as_filed, c))
    }

    /// The edges that begin at these sides, in the order of the file.
    fn tally(&self, mut these: Vec<Side>) -> Tally {
        these.sort_unstable_by_key(|s| s.corner);
        these.into_iter().map(|s| self.edge(s)).collect()
    }

    /// The sides of the edges with one triangle.
    pub(super) fn rim(&self) -> impl Iterator<Item = Side> {
        edges(&self.sides).filter(|e| e.len() == 1).map(|e| e[0])
    }

    fn runs_up(&self, side: Side) -> bool {
        side.runs_up(&self.faces.triangles)
    }

    fn same_place(&self) -> Finding {
        let places = self.faces.places.iter().enumerate();
        let later = places.filter(|(v, place)| *v as u32 != **place);
        let found = Finding::new(Kind::SamePlace, later.map(|(v, _)| v as u32).collect());
        if found.count == 0 {
            return found;
        }
        let [open, left] = [
            odd_edges(&sides(&self.faces.as_filed)).0,
            odd_edges(&self.sides).0,
        ];
        let joined = match (open.saturating_sub(left), left) {
            (0, _) => "No open edge closes by taking them for one.".to_owned(),
            (n, 0) => format!(
                "The faces around them are not joined in the file: that leaves {} open edges, all \
                 of which close when the vertices count as one.",
                grouped(n)
            ),
            (n, _) => format!(
                "The faces around them are not joined in the file: of its {} open edges {} close \
                 when the vertices count as one.",
                grouped(open),
                grouped(n)
            ),
        };
        found.adding(&joined)
    }

    fn misoriented(&self) -> Finding {
        let same_way = |e: &&[Side]| e.len() == 2 && self.runs_up(e[0]) == self.runs_up(e[1]);
        let these = edges(&self.sides).filter(same_way).map(|e| e[0]);
        Finding::new(Kind::Misoriented, self.tally(these.collect()))
    }

    fn non_manifold_edges(&self) -> Finding {
        let these = edges(&self.sides).filter(|e| e.len() > 2).map(|e| e[0]);
        Finding::new(Kind::NonManifoldEdge, self.tally(these.collect()))
    }

    /// The parts that hang together by edges of two triangles: those that cannot be oriented, and
    /// those that are closed, oriented and inside out.
    fn oriented_parts(&self) -> [Finding; 2] {
        let count = self.faces.triangles.len() as u32;
        // Each triangle stands for itself as it is, and `count` above for itself turned over.
        let mut sets = Sets::new(2 * count as usize);
        for edge in edges(&self.sides).filter(|e| e.len() == 2) {
            let [t, u] = [edge[0].triangle(), edge[1].triangle()];
            let turned = u32::from(self.runs_up(edge[0]) == self.runs_up(edge[1]));
            sets.join(t, u + turned * count);
            sets.join(t + count, u + (1 - turned) * count);
        }
        let part = |sets: &mut Sets, t: u32| sets.root(t).min(sets.root(t + count));
        let mut parts = vec![Part::default(); count as usize];
        for t in 0..count {
            let home = part(&mut sets, t);
            let part = &mut parts[home as usize];
            part.one_sided |= sets.root(t) == sets.root(t + count);
            let volume = self.volume(t, home);
            part.volume += volume;
            part.swept += volume.abs();
            part.there = true;
        }
        for edge in edges(&self.sides) {
            let closed = edge.len() == 2 && self.runs_up(edge[0]) != self.runs_up(edge[1]);
            if !closed {
                for side in edge {
                    parts[part(&mut sets, side.triangle()) as usize].open = true;
                }
            }
        }
        let these = |wanted: fn(&Part) -> bool| -> Tally {
            let parts = parts.iter().zip(&self.faces.face_of);
            let wanted = parts.filter(|(p, _)| p.there && wanted(p));
            wanted.map(|(_, &face)| face).collect()
        };
        [
            Finding::new(Kind::OneSided, these(|p| p.one_sided)),
            Finding::new(
                Kind::InsideOut,
                these(|p| !p.open && p.volume < -ROUNDING * p.swept),
            ),
        ]
    }

    /// Six times the volume of the cone from the first corner of triangle `home` to triangle `t`.
    fn volume(&self, t: u32, home: u32) -> f64 {
        let origin = self.corner(3 * home);
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(3 * t + k) - origin);
        a.cross(&b).dot(&c)
    }

    fn corner(&self, corner: u32) -> Point {
        self.faces.mesh.positions[vertex(&self.faces.triangles, corner) as usize]
    }

    /// The corners in sets: those of one fan, at one vertex and joined by edges, are together.
    fn fans(&self) -> Sets {
        let mut fans = Sets::new(3 * self.faces.triangles.len());
        for edge in edges(&self.sides) {
            let [low, high] = edge[0].corners(&self.faces.triangles);
            for side in &edge[1..] {
                let [l, h] = side.corners(&self.faces.triangles);
                fans.join(low, l);
                fans.join(high, h);
            }
        }
        fans
    }

    /// The vertices with more than one fan.
    fn pinched(&self, fans: &mut Sets) -> Finding {
        let mut count = vec![0_u32; self.faces.places.len()];
        for corner in 0..3 * self.faces.triangles.len() as u32 {
            if fans.root(corner) == corner {
                count[vertex(&self.faces.triangles, corner) as usize] += 1;
            }
        }
        let pinched = count.iter().enumerate().filter(|(_, n)| **n > 1);
        Finding::new(
            Kind::NonManifoldVertex,
            pinched.map(|(v, _)| v as u32).collect(),
        )
    }

    /// The rims: boundary edges that follow each other around a fan.
    fn borders(&self, mut fans: Sets) -> Finding {
        let mut rim: Vec<Side> = self.rim().collect();
        rim.sort_unstable_by_key(|s| s.corner);
        for side in &rim {
            fans.join(side.corner, side.next_corner());
        }
        let mut length = vec![0_usize; 3 * self.faces.triangles.len()];
        let mut tally = Vec::new();
        for side in &rim {
            let length = &mut length[fans.root(side.corner) as usize];
            if *length == 0 {
                tally.push(self.edge(*side));
            }
            *length += 1;
        }
        if rim.is_empty() {
            let vertices = Tally::of(self.faces.mesh.positions.len());
            return Finding::new(Kind::Closed, vertices);
        }
        let longest = length.into_iter().max().unwrap_or(0);
        Finding::new(Kind::Border, tally.into_iter().collect()).adding(&format!(
            "{} edges have a face on one side only: the rim of an open surface, or holes in it; \
             the longest border has {}.",
            grouped(rim.len()),
            grouped(longest)
        ))
    }

    /// The components joined by vertices, and the tiny ones among them.
    fn parts(&self) -> [Finding; 2] {
        let count = self.faces.triangles.len();
        let of = components(&self.faces.triangles, self.faces.places.len());
        let mut areas = vec![0.0; count];
        let mut sizes = vec![0_usize; count];
        for (t, &part) in of.iter().enumerate() {
            areas[part as usize] += self.area(t as u32);
            let again = t > 0 && self.faces.face_of[t] == self.faces.face_of[t - 1];
            sizes[part as usize] += usize::from(!again);
        }
        let total: f64 = areas.iter().sum();
        let face = |t: &usize| self.faces.face_of[*t];
        let there = (0..count).filter(|&t| sizes[t] > 0);
        let tiny = there.clone().filter(|&t| areas[t] < TINY * total);
        let mut parts = Finding::new(Kind::Component, there.map(|t| face(&t)).collect());
        if parts.count == 1 {
            parts.severity = Severity::Fine;
            parts = parts.adding("All faces hang together.");
        } else {
            let largest = sizes.iter().max().copied().unwrap_or(0);
            parts = parts.adding(&format!(
                "No vertex joins one to another. The largest has {} of the {} faces.",
                grouped(largest),
                grouped(sizes.iter().sum())
            ));
        }
        [
            parts,
            Finding::new(Kind::TinyComponent, tiny.map(|t| face(&t)).collect()),
        ]
    }

    fn area(&self, t: u32) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(3 * t + k));
        0.5 * (b - a).cross(&(c - a)).norm()
    }
}

/// A part of the surface that hangs together by edges, gathered at its first triangle.
#[derive(Clone, Copy, Default)]
struct Part {
    there: bool,
    one_sided: bool,
    open: bool,
    /// Six times the volume inside.
    volume: f64,
    /// The same, with what is subtracted added.
    swept: f64,
}
