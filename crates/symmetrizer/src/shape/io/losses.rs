//! What a format cannot hold, in phrases that complete "the file does not hold ...".

use super::Format;
use crate::shape::document::{Document, Kept, Layer, MorphPart, On, Role};
use crate::shape::mesh::is_finite;

/// What `document` keeps for a format of its own that is not `format`.
pub(super) fn of_kept(document: &Document, format: Format) -> Vec<String> {
    match (&document.kept, format) {
        (Kept::Nothing, _) => Vec::new(),
        (Kept::Obj(_), Format::Obj) | (Kept::Ply(_), Format::Ply) => Vec::new(),
        (Kept::Stl(_), Format::Stl) => Vec::new(),
        (Kept::Stl(kept), _) => {
            let is_blank = |b: &u8| *b == 0 || b.is_ascii_whitespace();
            let says = !kept.header.iter().all(is_blank);
            says.then(|| "the header of the STL file".into())
                .into_iter()
                .collect()
        }
        (Kept::Obj(kept), _) => {
            let libraries = kept
                .libraries
                .iter()
                .map(|l| format!("the material library {l}"));
            let statements = counted(kept.statements.len(), "line, point or other statement");
            libraries.chain(statements).collect()
        }
        (Kept::Ply(kept), _) => super::ply::of_kept(kept),
        (Kept::Gltf(_), Format::Gltf | Format::Glb) => Vec::new(),
        (Kept::Gltf(kept), _) => super::gltf::lost_elsewhere(kept),
        (Kept::ThreeMf(_), Format::ThreeMf) => Vec::new(),
        (Kept::ThreeMf(kept), _) => kept.besides.clone(),
    }
}

/// The layers that a format does not hold.
pub(super) fn of_layers(document: &Document, holds: impl Fn(&Layer) -> bool) -> Vec<String> {
    let lost = document.layers.iter().filter(|l| !holds(l));
    lost.map(described).collect()
}

/// Polygons that a format for triangles cuts.
pub(super) fn of_polygons(document: &Document) -> Vec<String> {
    let polygons = document.mesh.polygons.iter();
    let cut = polygons.filter(|p| p.len() > 3).count();
    let phrase = numbered(
        cut,
        "face of more than three corners, cut into triangles",
        "faces of more than three corners, cut into triangles",
    );
    phrase.into_iter().collect()
}

/// Coordinates that change in single precision. Where the file has been in single precision before,
/// the rounding of what was moved is not worth a word, unless it is seen.
pub(super) fn of_precision(document: &Document) -> Vec<String> {
    let coordinates = document.mesh.positions.iter().flat_map(|p| p.iter());
    let change = coordinates.map(|&c| (f64::from(c as f32) - c).abs());
    let most = change.filter(|c| c.is_finite()).fold(0.0, f64::max);
    let allowed = match document.kept {
        Kept::Stl(_) | Kept::Gltf(_) => UNSEEN * document.mesh.diagonal(),
        _ => 0.0,
    };
    let phrase = |most: f64| format!("digits of the coordinates, which change by up to {most:.1e}");
    (most > allowed).then(|| phrase(most)).into_iter().collect()
}

/// A change of coordinates that nobody sees, fraction of D.
const UNSEEN: f64 = 1e-6;

/// How many vertices no face uses.
pub(super) fn loose_vertices(document: &Document) -> usize {
    let mut loose = vec![true; document.mesh.positions.len()];
    for &v in document.mesh.polygons.iter().flatten() {
        loose[v as usize] = false;
    }
    loose.into_iter().filter(|l| *l).count()
}

/// "3 cameras", "1 camera", or nothing.
pub(super) fn counted(count: usize, of: &str) -> Option<String> {
    numbered(count, of, &format!("{of}s"))
}

/// "3 vertices", "1 vertex", or nothing.
pub(super) fn numbered(count: usize, one: &str, more: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {more}")),
    }
}

/// Vertices without a finite position, which some formats forbid.
pub(super) fn of_unplaced(document: &Document) -> Option<String> {
    let positions = document.mesh.positions.iter();
    let unplaced = positions.filter(|p| !is_finite(p)).count();
    numbered(
        unplaced,
        "vertex without a finite position: other programs may refuse the file",
        "vertices without a finite position: other programs may refuse the file",
    )
}

/// What a layer is, such as "texture coordinates (per corner)".
fn described(layer: &Layer) -> String {
    let on = match layer.on {
        On::Vertex => "vertex",
        On::Corner => "corner",
        On::Face => "face",
    };
    let what = match layer.role {
        Role::Normal => "normals".into(),
        Role::Tangent => "tangents".into(),
        Role::TexCoord(0) => "texture coordinates".into(),
        Role::TexCoord(n) => format!("texture coordinates of set {n}"),
        Role::Color(0) => "colours".into(),
        Role::Color(n) => format!("colours of set {n}"),
        Role::Joints(_) => "skeleton joints".into(),
        Role::Weights(_) => "skeleton weights".into(),
        Role::Morph(k, MorphPart::Position) => format!("morph target {k}"),
        Role::Morph(k, MorphPart::Normal) => format!("normals of morph target {k}"),
        Role::Morph(k, MorphPart::Tangent) => format!("tangents of morph target {k}"),
        Role::Material => "material names".into(),
        Role::Group => "groups".into(),
        Role::Object => "object names".into(),
        Role::Smoothing => "smoothing groups".into(),
        Role::Other => format!("the property '{}'", layer.name),
    };
    format!("{what} (per {on})")
}
