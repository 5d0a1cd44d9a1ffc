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

    /// From `{"per": "vertex" or "face", "values": [..]}`.
    ///
    /// # Errors
    /// [`Error::Params`] for anything else.
    pub fn from_json(text: &str) -> Result<Self> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Field {
            per: Per,
            values: Vec<f64>,
        }
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "lowercase")]
        enum Per {
            Vertex,
            Face,
        }
        let field: Field = serde_json::from_str(text).map_err(|e| {
            let form = r#"{"per": "vertex" or "face", "values": [..]}"#;
            Error::params(PROPERTY, format!("is not of the form {form}: {e}"))
        })?;
        Ok(match field.per {
            Per::Vertex => Self::Vertices(field.values),
            Per::Face => Self::Polygons(field.values),
        })
    }

    /// Whether it fits `mesh`.
    ///
    /// # Errors
    /// [`Error::Params`] for a wrong count or values that are not positive and finite.
    pub fn check(&self, mesh: &Mesh) -> Result<()> {
        let (values, wanted, what) = match self {
            Self::Uniform(k) => (std::slice::from_ref(k), 1, "value"),
            Self::Vertices(k) => (k.as_slice(), mesh.positions.len(), "vertices"),
            Self::Polygons(k) => (k.as_slice(), mesh.polygons.len(), "faces"),
        };
        if values.len() != wanted {
            let count = values.len();
            let what = format!("has {count} values, the shape {wanted} {what}");
            return Err(Error::params(PROPERTY, what));
        }
        let bad = values.iter().position(|k| !(*k > 0.0 && k.is_finite()));
        bad.map_or(Ok(()), |i| {
            let what = format!("must be positive and finite; value {i} is {}", values[i]);
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
        }
    }
}
