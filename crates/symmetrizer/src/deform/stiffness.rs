//! How stiff a shape is, place by place, as its user says it.

use crate::error::{Error, Result};
use crate::shape::document::{On, Role};
use crate::shape::working::Working;
use crate::shape::{Document, Mesh};

/// Multiples of the usual stiffness: 1 as is, 0.01 soft, 100 stiff. Soft regions take up the deformation,
/// stiff ones move as one piece.
#[derive(Debug, Clone, PartialEq)]
pub enum Stiffness {
    /// The same everywhere.
    Uniform(f64),
    /// One for each vertex of the document.
    Vertices(Vec<f64>),
    /// One for each polygon of the document.
    Polygons(Vec<f64>),
    /// One for each path of a drawing, counted in the order of painting.
    Paths(Vec<f64>),
    /// At places of a drawing, in the coordinates of its file: everywhere that of the nearest.
    Places(Vec<([f64; 2], f64)>),
}

impl Default for Stiffness {
    fn default() -> Self {
        Self::Uniform(1.0)
    }
}

/// The name of the property that a file gives it in.
pub const PROPERTY: &str = "stiffness";

impl Stiffness {
    /// What the property `stiffness` of a document's vertices or faces says; of both the faces'.
    pub fn of_document(document: &Document) -> Option<Self> {
        let named = |on: On| {
            let mut layers = document.layers.iter();
            layers.find(|l| l.on == on && l.role == Role::Other && l.name == PROPERTY)
        };
        let values = |on: On, count: usize| -> Option<Vec<f64>> {
            let layer = named(on)?;
            (0..count).map(|i| layer.values.get(i, 0)).collect()
        };
        let mesh = &document.mesh;
        values(On::Face, mesh.polygons.len())
            .map(Self::Polygons)
            .or_else(|| values(On::Vertex, mesh.positions.len()).map(Self::Vertices))
    }

    /// From `{"per": "vertex", "face" or "path", "values": [..]}`, or `{"per": "place", "places": [[x, y], ..],
    /// "values": [..]}`.
    ///
    /// # Errors
    /// [`Error::Params`] for anything else.
    pub fn from_json(text: &str) -> Result<Self> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Field {
            per: Per,
            places: Option<Vec<[f64; 2]>>,
            values: Vec<f64>,
        }
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "lowercase")]
        enum Per {
            Vertex,
            Face,
            Path,
            Place,
        }
        let form = r#"{"per": "vertex", "face" or "path", "values": [..]} or {"per": "place", "places": [[x, y], ..], "values": [..]}"#;
        let bad =
            |what: &str| Error::params(PROPERTY, format!("is not of the form {form}: {what}"));
        let field: Field = serde_json::from_str(text).map_err(|e| bad(&e.to_string()))?;
        let values = field.values;
        Ok(match (field.per, field.places) {
            (Per::Vertex, None) => Self::Vertices(values),
            (Per::Face, None) => Self::Polygons(values),
            (Per::Path, None) => Self::Paths(values),
            (Per::Place, Some(places)) if places.len() == values.len() && !places.is_empty() => {
                Self::Places(places.into_iter().zip(values).collect())
            }
            (Per::Place, _) => return Err(bad("each place has a value, and each value a place")),
            _ => return Err(bad("only values per place have places")),
        })
    }

    /// Whether it fits `mesh`.
    ///
    /// # Errors
    /// [`Error::Params`] for a wrong count, values that are not positive and finite, and what is for drawings.
    pub fn check(&self, mesh: &Mesh) -> Result<()> {
        let (values, wanted, what) = match self {
            Self::Uniform(_) => return self.check_values(),
            Self::Vertices(k) => (k, mesh.positions.len(), "vertices"),
            Self::Polygons(k) => (k, mesh.polygons.len(), "faces"),
            Self::Paths(_) | Self::Places(_) => {
                let what = "is per path or place, which is for drawings; a mesh takes it per vertex or face";
                return Err(Error::params(PROPERTY, what));
            }
        };
        counted(values.len(), wanted, what)?;
        self.check_values()
    }

    /// Whether all its values are positive and finite.
    ///
    /// # Errors
    /// [`Error::Params`].
    pub fn check_values(&self) -> Result<()> {
        let all: Vec<f64> = match self {
            Self::Uniform(k) => vec![*k],
            Self::Vertices(k) | Self::Polygons(k) | Self::Paths(k) => k.clone(),
            Self::Places(places) => places.iter().map(|p| p.1).collect(),
        };
        let bad = all.iter().position(|k| !(*k > 0.0 && k.is_finite()));
        bad.map_or(Ok(()), |i| {
            let what = format!("must be positive and finite; value {i} is {}", all[i]);
            Err(Error::params(PROPERTY, what))
        })
    }

    /// As values for the faces of the working surface, of a vertex field the mean over the corners;
    /// `None` where it is 1 everywhere.
    pub fn per_face(&self, working: &Working) -> Option<Vec<f64>> {
        let faces = &working.surface.triangles;
        match self {
            Self::Uniform(1.0) => None,
            Self::Uniform(k) => Some(vec![*k; faces.len()]),
            Self::Polygons(k) => {
                let polygons = working.polygon_of_face.iter();
                Some(polygons.map(|&p| k[p as usize]).collect())
            }
            Self::Vertices(k) => {
                let at = |v: u32| k[working.document_of_vertex[v as usize] as usize];
                let mean = |corners: &[u32; 3]| corners.iter().map(|&v| at(v)).sum::<f64>() / 3.0;
                Some(faces.iter().map(mean).collect())
            }
            // A surface of space has neither.
            Self::Paths(_) | Self::Places(_) => None,
        }
    }
}

/// Fails where there are `values` where as many as the shape's are `wanted`.
///
/// # Errors
/// [`Error::Params`].
pub fn counted(values: usize, wanted: usize, what: &str) -> Result<()> {
    if values == wanted {
        return Ok(());
    }
    let what = format!("has {values} values, the shape {wanted} {what}");
    Err(Error::params(PROPERTY, what))
}
