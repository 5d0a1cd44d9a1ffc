//! What is told about a mesh: one finding for each kind of thing found.

use serde::Serialize;

use super::kind::{Kind, Severity};

/// How many places a finding names.
pub const FIRST: usize = 5;

/// Where something is, in the file's own numbering, all counted from 0: vertices as they stand in
/// the file, faces as they stand in the file (polygons, not triangles).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(untagged)]
pub enum Place {
    /// A vertex or a face.
    One(u32),
    /// The two vertices of an edge.
    Edge([u32; 2]),
}

/// Something about a mesh: what, how often, where, and what a run does about it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// What it is.
    pub kind: Kind,
    /// How much it matters.
    pub severity: Severity,
    /// How many there are.
    pub count: usize,
    /// What is counted: "vertices", "faces", "edges", "components", "borders", "triangles".
    pub of: &'static str,
    /// The first [`FIRST`] of them, in the file's order. A component is named by its first face, a
    /// border by its first edge.
    pub first: Vec<Place>,
    /// What `first` names: "vertices", "faces" or "edges".
    pub at: &'static str,
    /// What that means, in a sentence.
    pub what: String,
    /// What a run does about it: a sentence that begins after "a run".
    pub action: String,
}

impl Finding {
    /// The finding of `tally`, in the words of its kind.
    pub(super) fn new(kind: Kind, tally: Tally) -> Self {
        let (of, at) = kind.units();
        Self {
            kind,
            severity: kind.severity(),
            count: tally.count,
            of,
            first: tally.first,
            at,
            what: kind.what().to_owned(),
            action: kind.action().to_owned(),
        }
    }

    /// The same with more said about what it means.
    pub(super) fn adding(mut self, sentence: &str) -> Self {
        self.what = [self.what.as_str(), sentence].join(" ").trim().to_owned();
        self
    }

    /// The count with its noun, "1 duplicate face", or the noun alone for the whole: "no faces".
    pub fn title(&self) -> String {
        let noun = self.kind.noun(self.count);
        if self.kind.is_whole() {
            noun.to_owned()
        } else {
            format!("{} {noun}", grouped(self.count))
        }
    }
}

/// 12345 as 12,345.
pub fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(c);
    }
    text
}

/// A count with the first few places.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Tally {
    pub count: usize,
    first: Vec<Place>,
}

impl Tally {
    /// A count of what has no place of its own.
    pub fn of(count: usize) -> Self {
        Self {
            count,
            first: Vec::new(),
        }
    }

    /// Counts one more.
    pub fn add(&mut self, place: Place) {
        self.count += 1;
        if self.first.len() < FIRST {
            self.first.push(place);
        }
    }
}

impl FromIterator<u32> for Tally {
    fn from_iter<I: IntoIterator<Item = u32>>(places: I) -> Self {
        let mut tally = Self::default();
        for place in places {
            tally.add(Place::One(place));
        }
        tally
    }
}

impl FromIterator<[u32; 2]> for Tally {
    fn from_iter<I: IntoIterator<Item = [u32; 2]>>(places: I) -> Self {
        let mut tally = Self::default();
        for place in places {
            tally.add(Place::Edge(place));
        }
        tally
    }
}
