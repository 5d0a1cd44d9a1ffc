//! The kinds of findings and their words.

use serde::Serialize;

/// How much a finding matters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Severity {
    /// A run cannot work on the file.
    Refused,
    /// A run mends it for its own work; the file keeps it.
    Mended,
    /// A run works with it as it is, but the result may surprise.
    Note,
    /// As it should be, or of no consequence.
    Fine,
}

/// What can be found in a mesh. Faces "as welded" are those whose corners in equal places count as
/// one corner, as they do in a run. Those of one severity are told in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// There are no faces. Of this and other kinds that concern the whole, the vertices are counted.
    NoFaces,
    /// There are faces, but none has an area.
    NoSurface,
    /// Faces that name vertices which are not there.
    OutOfRange,
    /// Faces with fewer than three corners.
    TooFewCorners,
    /// Vertices with a coordinate that is infinite or not a number.
    NonFinite,
    /// Faces with two corners in one place.
    RepeatedCorner,
    /// Faces with all corners on a line, to the rounding of the coordinates.
    ZeroArea,
    /// Faces as welded that are an earlier one again.
    Duplicate,
    /// Faces as welded that are an earlier one again, the other way round.
    FlippedDuplicate,
    /// Faces, else sound, one of whose triangles is that of an earlier face.
    Overlap,
    /// Edges whose two faces run the same way along them.
    Misoriented,
    /// Used vertices in the same place as an earlier one.
    SamePlace,
    /// Components joined by edges that cannot be oriented, as a Moebius strip.
    OneSided,
    /// Closed components joined by edges whose volume is negative.
    InsideOut,
    /// Edges with more than two faces.
    NonManifoldEdge,
    /// Vertices whose faces do not hang together by edges.
    NonManifoldVertex,
    /// Rims of the surface, each all round.
    Border,
    /// Vertices of rims that all but meet another one.
    NearSeam,
    /// There is no rim: every edge has a face on both sides.
    Closed,
    /// Faces that pass through others with which they share no vertex.
    Crossing,
    /// Triangles that were too many to be looked at for crossings.
    CrossingSkipped,
    /// Components joined by vertices.
    Component,
    /// Those of them with less than a thousandth of the area.
    TinyComponent,
    /// Vertices that no face uses.
    Loose,
    /// Faces of four and more corners that bend by more than a hundredth of their size.
    Bent,
    /// Faces that overlap themselves when cut into triangles.
    Folded,
    /// The whole stands far away from the origin in coordinates of few digits.
    FarAway,
    /// The whole is very small or very large.
    ExtremeSize,
    /// Faces with more than four corners.
    Polygon,
    /// Faces with four corners.
    Quad,
    /// All coordinates have the digits of single precision.
    SinglePrecision,
}

impl Kind {
    /// How much it matters, unless the finding says otherwise.
    pub(super) fn severity(self) -> Severity {
        match self {
            Self::NoFaces | Self::NoSurface | Self::OutOfRange | Self::TooFewCorners => {
                Severity::Refused
            }
            Self::NonFinite
            | Self::RepeatedCorner
            | Self::ZeroArea
            | Self::Duplicate
            | Self::FlippedDuplicate
            | Self::Overlap
            | Self::Misoriented
            | Self::SamePlace => Severity::Mended,
            Self::Polygon | Self::Quad | Self::SinglePrecision | Self::Closed => Severity::Fine,
            _ => Severity::Note,
        }
    }

    /// Whether it concerns the whole shape and is not a number of things in it.
    pub fn is_whole(self) -> bool {
        matches!(
            self,
            Self::NoFaces
                | Self::NoSurface
                | Self::Closed
                | Self::FarAway
                | Self::ExtremeSize
                | Self::SinglePrecision
        )
    }

    /// What is counted, and what the places are.
    pub(super) fn units(self) -> (&'static str, &'static str) {
        match self {
            Self::NonFinite
            | Self::SamePlace
            | Self::NonManifoldVertex
            | Self::NearSeam
            | Self::Loose => ("vertices", "vertices"),
            _ if self.is_whole() => ("vertices", "vertices"),
            Self::Misoriented | Self::NonManifoldEdge => ("edges", "edges"),
            Self::Border => ("borders", "edges"),
            Self::OneSided | Self::InsideOut | Self::Component | Self::TinyComponent => {
                ("components", "faces")
            }
            Self::CrossingSkipped => ("triangles", "faces"),
            _ => ("faces", "faces"),
        }
    }

    /// What follows the count; for the whole, a name without a count.
    pub fn noun(self, count: usize) -> &'static str {
        let [one, many] = self.nouns();
        if count == 1 { one } else { many }
    }

    fn nouns(self) -> [&'static str; 2] {
        match self {
            Self::NoFaces => ["no faces"; 2],
            Self::NoSurface => ["no area"; 2],
            Self::OutOfRange => ["face with missing vertices", "faces with missing vertices"],
            Self::TooFewCorners => ["face of too few corners", "faces of too few corners"],
            Self::NonFinite => ["vertex without a place", "vertices without a place"],
            Self::RepeatedCorner => ["face with a corner twice", "faces with a corner twice"],
            Self::ZeroArea => ["face without area", "faces without area"],
            Self::Duplicate => ["duplicate face", "duplicate faces"],
            Self::FlippedDuplicate => ["duplicate face, flipped", "duplicate faces, flipped"],
            Self::Overlap => ["face on top of another", "faces on top of others"],
            Self::Misoriented => ["edge between flipped faces", "edges between flipped faces"],
            Self::SamePlace => ["vertex in a place taken", "vertices in a place taken"],
            Self::OneSided => ["one-sided part", "one-sided parts"],
            Self::InsideOut => ["part inside out", "parts inside out"],
            Self::NonManifoldEdge => [
                "edge of three or more faces",
                "edges of three or more faces",
            ],
            Self::NonManifoldVertex => ["pinched vertex", "pinched vertices"],
            Self::Border => ["border", "borders"],
            Self::NearSeam => ["vertex at an open seam", "vertices at open seams"],
            Self::Crossing => ["face through another", "faces through others"],
            Self::CrossingSkipped => ["triangle not looked at", "triangles, too many to look at"],
            Self::Component => ["connected part", "separate parts"],
            Self::TinyComponent => ["tiny part", "tiny parts"],
            Self::Loose => ["loose vertex", "loose vertices"],
            Self::Bent => ["face that is not flat", "faces that are not flat"],
            Self::Folded => ["face that folds over", "faces that fold over"],
            Self::FarAway => ["far from the origin"; 2],
            Self::ExtremeSize => ["unusual scale"; 2],
            Self::Polygon => [
                "face of five or more corners",
                "faces of five or more corners",
            ],
            Self::Quad => ["face of four corners", "faces of four corners"],
            Self::SinglePrecision => ["single precision"; 2],
            Self::Closed => ["closed surface"; 2],
        }
    }

    /// What it means, in a sentence; empty where the finding has figures to tell instead.
    pub(super) fn what(self) -> &'static str {
        match self {
            Self::NoFaces => "There are no faces, so there is no surface: a point cloud at best.",
            Self::NoSurface => "No face that can be used has an area.",
            Self::OutOfRange => "A corner names a vertex that the file does not have.",
            Self::TooFewCorners => "A face needs at least three corners.",
            Self::NonFinite => "A coordinate is infinite or not a number.",
            Self::RepeatedCorner => "Two corners lie in the same place.",
            Self::ZeroArea => "All corners lie on a line.",
            Self::Duplicate => "The corners are those of an earlier face, in the same order.",
            Self::FlippedDuplicate => {
                "The corners are those of an earlier face in the opposite order: the back of it."
            }
            Self::Overlap => "Three of the corners are a triangle of an earlier face too.",
            Self::Misoriented => {
                "The faces on the two sides are wound in opposite senses: one shows its front \
                 where the other shows its back."
            }
            Self::SamePlace => "An earlier vertex has exactly the same coordinates.",
            Self::OneSided => "No choice of front and back fits all faces, as on a Moebius strip.",
            Self::InsideOut => {
                "The surface is closed and its fronts look inwards. Right for a hollow inside \
                 another part, otherwise it is inside out."
            }
            Self::NonManifoldEdge => {
                "More than two faces meet there, as where a wall meets a floor."
            }
            Self::NonManifoldVertex => {
                "Two or more pieces of surface touch there in a single point, as the halves of an \
                 hourglass."
            }
            Self::NearSeam => {
                "It is on a border and within 1e-5 of D of another border vertex, but not in its place: \
                 the seam is not closed."
            }
            Self::Crossing => "A face passes through another one that is not its neighbour.",
            Self::CrossingSkipped => "Whether faces pass through each other was not looked at.",
            Self::TinyComponent => "Less than a thousandth of the area each.",
            Self::Loose => "No face uses such a vertex.",
            Self::Bent => "The corners are off a common plane by more than 1 % of the face's size.",
            Self::Folded => {
                "Cut into triangles, such a face lies on top of itself: it is not flat or crosses itself."
            }
            Self::Border
            | Self::Component
            | Self::FarAway
            | Self::ExtremeSize
            | Self::Polygon
            | Self::Quad => "",
            Self::Closed => "Every edge has a face on both sides.",
            Self::SinglePrecision => {
                "All coordinates have about seven digits, as many as single precision holds."
            }
        }
    }

    /// What a run does about it; follows "a run".
    pub(super) fn action(self) -> &'static str {
        match self {
            Self::NoFaces => "refuses the file: a point cloud must be meshed first",
            Self::NoSurface => "refuses the file: check its coordinates",
            Self::OutOfRange => "refuses the file: export it again, or remove such faces",
            Self::TooFewCorners => "refuses the file: remove such faces",
            Self::NonFinite => {
                "works without the triangles at such a vertex; the file keeps everything as it is"
            }
            Self::RepeatedCorner => "leaves out the parts without area; the file keeps the face",
            Self::ZeroArea => {
                "gives such a face no weight, for it has no area; the file keeps the face"
            }
            Self::Duplicate | Self::FlippedDuplicate | Self::Overlap => {
                "works with the first of equal triangles only; the file keeps all"
            }
            Self::Misoriented => {
                "turns faces for its own work until neighbours agree; the file keeps the order of \
                 corners"
            }
            Self::SamePlace => {
                "takes vertices in one place for one and moves them together; the file keeps all"
            }
            Self::OneSided => "works on it, with a line along which front and back meet",
            Self::InsideOut => "does not ask what is inside and works on it as it is",
            Self::NonManifoldEdge | Self::NonManifoldVertex => {
                "keeps the faces joined there as they are"
            }
            Self::Border | Self::Closed => "closes no hole and makes none",
            Self::NearSeam => "leaves the seam open; weld it with a small distance beforehand",
            Self::Crossing | Self::CrossingSkipped => {
                "leaves crossings as they are; its report counts those it adds"
            }
            Self::Component => "works on all parts together",
            Self::TinyComponent => "moves tiny parts along with the rest; remove debris beforehand",
            Self::Loose => "leaves loose vertices where they are",
            Self::Bent | Self::Polygon | Self::Quad => {
                "cuts such a face into triangles for its own work; the file keeps the face"
            }
            Self::Folded => {
                "works on the overlapping triangles; cut such faces beforehand for exact figures"
            }
            Self::FarAway => {
                "works with the digits there are; move the shape to the origin at its source"
            }
            Self::ExtremeSize => "measures everything relative to the shape and is not affected",
            Self::SinglePrecision => {
                "works in double precision and writes the digits that the format holds"
            }
        }
    }
}
