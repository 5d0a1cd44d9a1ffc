//! The columns of a PLY file as a document.

use super::header::{Declared, Header};
use super::{axis, faces, families, index_list, names};
use crate::error::Result;
use crate::geom::Point;
use crate::shape::document::{
    Document, Kept, Layer, Numbers, On, PlyElement, PlyKept, PlyProperty, Role, Values,
};
use crate::shape::mesh::Polygons;

/// The document of `columns`, one per property of each element.
///
/// # Errors
/// [`crate::Error::Input`] where a face has a negative corner or strips are too long.
pub(super) fn document(header: Header<'_>, columns: Vec<Vec<Values>>) -> Result<Document> {
    let mut document = Document::default();
    let mut kept = PlyKept {
        form: header.form,
        elements: Vec::new(),
        remarks: header.remarks,
    };
    let has_faces = header.elements.iter().any(|e| e.name == "face");
    let mut strips = None;
    for (declared, columns) in header.elements.into_iter().zip(columns) {
        if declared.name == "tristrips" {
            strips = strip_column(&declared, columns);
            if !has_faces {
                kept.elements.push(faces_of_strips(declared));
            }
            continue;
        }
        let element = match declared.name.as_str() {
            "vertex" => vertices(declared, columns, &mut document),
            "face" => face_element(declared, columns, &mut document, &mut kept)?,
            _ => other(declared, columns),
        };
        kept.elements.push(element);
    }
    if let Some(strips) = strips {
        append_strips(&strips, &mut document)?;
    }
    document.kept = Kept::Ply(kept);
    Ok(document)
}

/// The element with the types that its columns have.
fn typed(declared: Declared, columns: &[Values]) -> PlyElement {
    let mut properties = declared.properties;
    let own = |p: &PlyProperty| match declared.name.as_str() {
        "vertex" => axis(&p.name).is_some(),
        "face" => matches!(p.name.as_str(), "vertex_indices" | "vertex_index"),
        _ => false,
    };
    for (property, values) in properties.iter_mut().zip(columns) {
        // Positions and corners have the mesh's types by now.
        if let (false, Some(numbers)) = (own(property), values.numbers()) {
            property.kind = numbers.kind();
        }
    }
    PlyElement {
        name: declared.name,
        properties,
    }
}

fn other(declared: Declared, columns: Vec<Values>) -> PlyElement {
    let mut element = typed(declared, &columns);
    for (property, values) in element.properties.iter_mut().zip(columns) {
        property.values = Some(values);
    }
    element
}

fn vertices(declared: Declared, columns: Vec<Values>, document: &mut Document) -> PlyElement {
    let element = typed(declared, &columns);
    let mut position: [Option<Values>; 3] = [None, None, None];
    let mut others = Vec::new();
    for (property, values) in element.properties.iter().zip(columns) {
        match axis(&property.name) {
            Some(axis) => position[axis] = Some(values),
            None => others.push((property.name.clone(), Some(values))),
        }
    }
    if let [Some(x), Some(y), Some(z)] = position.each_ref().map(|v| Some(doubles(v.as_ref()?))) {
        let points = x.iter().zip(&y).zip(&z);
        document.mesh.positions = points.map(|((x, y), z)| Point::new(*x, *y, *z)).collect();
    }
    document.layers.extend(families::layers(others, On::Vertex));
    element
}

/// The numbers of a column; the types that coordinates have in one go.
fn doubles(values: &Values) -> Vec<f64> {
    match values.numbers() {
        Some(Numbers::F32(v)) => v.iter().copied().map(f64::from).collect(),
        Some(Numbers::F64(v)) => v.clone(),
        Some(other) => other.iter().collect(),
        None => Vec::new(),
    }
}

fn face_element(
    declared: Declared,
    columns: Vec<Values>,
    document: &mut Document,
    kept: &mut PlyKept,
) -> Result<PlyElement> {
    let corners = index_list(&declared).map(|p| p.name.clone());
    let element = typed(declared, &columns);
    let mut others = Vec::new();
    for (property, values) in element.properties.iter().zip(columns) {
        if Some(&property.name) == corners.as_ref() {
            document.mesh.polygons = faces::polygons(values)?;
        } else {
            others.push((property.name.clone(), Some(values)));
        }
    }
    let polygons = &document.mesh.polygons;
    let layers = families::layers(others, On::Face).into_iter();
    let layers = layers.map(|l| meant(l, polygons, kept));
    document.layers.extend(layers);
    Ok(element)
}

/// Texture coordinates and names are known by more than the name of the property.
fn meant(layer: Layer, polygons: &Polygons, kept: &mut PlyKept) -> Layer {
    if let Some(set) = texture_set(&layer.name)
        && let Some(values) = faces::two_per_corner(&layer.values, polygons)
    {
        return Layer {
            on: On::Corner,
            role: Role::TexCoord(set),
            values,
            ..layer
        };
    }
    if let Some(role) = names::role(&layer.name)
        && let Some(values) = names::read(&layer.name, &layer.values, &mut kept.remarks)
    {
        return Layer {
            role,
            values,
            ..layer
        };
    }
    layer
}

/// The set of the texture coordinates in a face property: `texcoord` is 0, `texcoord1` is 1.
fn texture_set(name: &str) -> Option<u32> {
    match name.strip_prefix("texcoord")? {
        "" => Some(0),
        set if set.starts_with('0') => None,
        set => set.parse().ok(),
    }
}

fn strip_column(declared: &Declared, columns: Vec<Values>) -> Option<Values> {
    let name = index_list(declared)?.name.as_str();
    let mut named = declared.properties.iter().zip(columns);
    named
        .find(|(p, _)| p.name == name)
        .map(|(_, values)| values)
}

/// The element that strips are written as.
fn faces_of_strips(mut declared: Declared) -> PlyElement {
    let list = index_list(&declared).map(|p| p.name.clone());
    declared
        .properties
        .retain(|p| Some(&p.name) == list.as_ref());
    PlyElement {
        name: "face".into(),
        properties: declared.properties,
    }
}

/// The triangles of strips are the last faces; they have no values in the layers of faces.
fn append_strips(strips: &Values, document: &mut Document) -> Result<()> {
    let count = faces::strips(strips, &mut document.mesh.polygons)?;
    for layer in &mut document.layers {
        let extra = match layer.on {
            On::Vertex => continue,
            On::Face => count,
            On::Corner => 3 * count,
        };
        let empty = Values::Names {
            names: Vec::new(),
            of: Vec::new(),
        };
        let values = std::mem::replace(&mut layer.values, empty);
        layer.values = faces::lengthened(values, extra);
    }
    Ok(())
}
