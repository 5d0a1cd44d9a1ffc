//! Layers: values per vertex, corner or face.

use super::numbers::Numbers;

/// A row index that names no row: an element without a value.
pub const NO_ROW: u32 = u32::MAX;

/// What a layer has a value for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// Each vertex.
    Vertex,
    /// Each corner of each polygon, in the polygons' order.
    Corner,
    /// Each polygon.
    Face,
}

/// Which part of a vertex a morph target moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MorphPart {
    /// Its position, in model units.
    Position,
    /// Its normal.
    Normal,
    /// Its tangent.
    Tangent,
}

/// What the values of a layer mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Normals, 3 numbers; they turn with the surface.
    Normal,
    /// Tangents, 3 numbers and perhaps a sign; they turn with the surface.
    Tangent,
    /// Texture coordinates of a numbered set, 1 to 3 numbers.
    TexCoord(u32),
    /// Colours of a numbered set, 3 or 4 numbers: whole ones from 0 to the type's maximum, others
    /// from 0 to 1.
    Color(u32),
    /// The joints of a skeleton that move a vertex, 4 numbers, in a numbered set.
    Joints(u32),
    /// How much each of the joints moves it.
    Weights(u32),
    /// Displacements of a numbered morph target, 3 numbers; they turn with the surface.
    Morph(u32, MorphPart),
    /// Material names.
    Material,
    /// Group names; several groups are separated by a space.
    Group,
    /// Object names.
    Object,
    /// Smoothing groups, by name.
    Smoothing,
    /// Anything else, known by its name only.
    Other,
}

/// The values of a layer; "element" is a vertex, corner or face.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// The same count of numbers for each element, one element after the other.
    Rows {
        /// Numbers per element.
        width: usize,
        /// All numbers.
        numbers: Numbers,
    },
    /// Rows that elements share, and perhaps some that none uses.
    Pool {
        /// Numbers per row.
        width: usize,
        /// The rows, one after the other.
        numbers: Numbers,
        /// The row of each element, or [`NO_ROW`].
        rows: Vec<u32>,
    },
    /// A list of numbers for each element: `starts[i]..starts[i + 1]`.
    Lists {
        /// Where each list starts, and the end of the last.
        starts: Vec<u32>,
        /// All numbers.
        numbers: Numbers,
    },
    /// One of a few names for each element.
    Names {
        /// The names.
        names: Vec<String>,
        /// The name of each element, or [`NO_ROW`].
        of: Vec<u32>,
    },
}

/// Values for every vertex, corner or face.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// The names that the file gives the values, separated by spaces; may be empty where the role
    /// says enough.
    pub name: String,
    /// What there is a value for.
    pub on: On,
    /// What the values mean.
    pub role: Role,
    /// The values.
    pub values: Values,
}

impl Values {
    /// Numbers per element, where that is fixed.
    pub fn width(&self) -> Option<usize> {
        match self {
            Self::Rows { width, .. } | Self::Pool { width, .. } => Some(*width),
            Self::Lists { .. } | Self::Names { .. } => None,
        }
    }

    /// The row of `numbers` that holds the values of element `i`, where it has one.
    pub fn row(&self, i: usize) -> Option<usize> {
        match self {
            Self::Rows { .. } => Some(i),
            Self::Pool { rows, .. } => (rows[i] != NO_ROW).then_some(rows[i] as usize),
            Self::Lists { .. } | Self::Names { .. } => None,
        }
    }

    /// Whether every element has a value.
    pub fn is_complete(&self) -> bool {
        match self {
            Self::Pool { rows, .. } | Self::Names { of: rows, .. } => !rows.contains(&NO_ROW),
            Self::Rows { .. } | Self::Lists { .. } => true,
        }
    }

    /// The numbers, except of names.
    pub fn numbers(&self) -> Option<&Numbers> {
        match self {
            Self::Rows { numbers, .. }
            | Self::Pool { numbers, .. }
            | Self::Lists { numbers, .. } => Some(numbers),
            Self::Names { .. } => None,
        }
    }

    /// Number `k` of element `i`, where it has one.
    pub fn get(&self, i: usize, k: usize) -> Option<f64> {
        let (width, numbers) = (self.width()?, self.numbers()?);
        Some(numbers.get(self.row(i)? * width + k))
    }

    /// The name of element `i`, where it has one.
    pub fn name(&self, i: usize) -> Option<&str> {
        match self {
            Self::Names { names, of } => names.get(of[i] as usize).map(String::as_str),
            _ => None,
        }
    }
}

impl Role {
    /// Whether the values are directions or displacements, which turn with the surface.
    pub fn turns(self) -> bool {
        matches!(self, Self::Normal | Self::Tangent | Self::Morph(..))
    }
}
