//! The names of the finite groups of isometries that fix a point, after Schoenflies.
//!
//! A group is told by how many rotations it has, their highest order, and its mirrors and
//! inversion; the table gives the orders, so that no angle is measured.

use serde::{Serialize, Serializer};

use crate::geom::{Matrix3, Vector};
use crate::group::exact::Table;
use crate::transform::Isometry;
use crate::transform::kind::turn_of;

/// A finite group of isometries in Schoenflies notation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Name {
    /// Rotations about one axis, n of them; C1 is no symmetry.
    C(u32),
    /// One mirror.
    Cs,
    /// The inversion.
    Ci,
    /// n rotations and n mirrors through their axis.
    Cv(u32),
    /// n rotations and the mirror across their axis.
    Ch(u32),
    /// Powers of a rotoreflection of even order, which is the number.
    S(u32),
    /// n rotations and n half-turns across their axis.
    D(u32),
    /// Those and the mirror across the axis.
    Dh(u32),
    /// Those and mirrors halfway between the half-turns.
    Dd(u32),
    /// Rotations of the tetrahedron.
    T,
    /// The tetrahedron.
    Td,
    /// Its rotations and the inversion.
    Th,
    /// Rotations of the octahedron and cube.
    O,
    /// Octahedron and cube.
    Oh,
    /// Rotations of the icosahedron and dodecahedron.
    I,
    /// Icosahedron and dodecahedron.
    Ih,
}

impl Name {
    /// The name of an exact group; `None` where the numbers of its elements are no group's.
    pub fn of(elements: &[Isometry], table: &Table) -> Option<Self> {
        let proper: Vec<usize> = (0..elements.len())
            .filter(|&g| !elements[g].is_improper())
            .collect();
        let rotations = proper.len();
        let highest = proper.iter().map(|&g| table.order_of(g)).max()?;
        let improper = elements.iter().filter(|t| t.is_improper());
        let mirrors = improper.clone().filter(|t| is_mirror(t)).count();
        let inversion = improper.clone().any(is_inversion);
        let chiral = improper.count() == 0;
        let n = highest as u32;
        let name = match (rotations, highest) {
            (12, 3) => match (chiral, inversion) {
                (true, _) => Self::T,
                (_, true) => Self::Th,
                _ => Self::Td,
            },
            (24, 4) if chiral => Self::O,
            (24, 4) => Self::Oh,
            (60, 5) if chiral => Self::I,
            (60, 5) => Self::Ih,
            _ if rotations == highest => match mirrors {
                _ if chiral => Self::C(n),
                1 if n == 1 => Self::Cs,
                0 if n == 1 => Self::Ci,
                0 => Self::S(2 * n),
                1 => Self::Ch(n),
                _ => Self::Cv(n),
            },
            _ if rotations == 2 * highest => match mirrors {
                _ if chiral => Self::D(n),
                m if m == highest => Self::Dd(n),
                _ => Self::Dh(n),
            },
            _ => return None,
        };
        (name.order() == elements.len()).then_some(name)
    }

    /// How many elements the group has.
    pub fn order(self) -> usize {
        let n = match self {
            Self::C(n) | Self::S(n) => n,
            Self::Cs | Self::Ci => 2,
            Self::Cv(n) | Self::Ch(n) | Self::D(n) => 2 * n,
            Self::Dh(n) | Self::Dd(n) => 4 * n,
            Self::T => 12,
            Self::Td | Self::Th | Self::O => 24,
            Self::Oh => 48,
            Self::I => 60,
            Self::Ih => 120,
        };
        n as usize
    }

    /// Whether several axes are of order 3 or higher: tetrahedron, octahedron, icosahedron.
    pub fn is_polyhedral(self) -> bool {
        use Name::{I, Ih, O, Oh, T, Td, Th};
        matches!(self, T | Td | Th | O | Oh | I | Ih)
    }
}

impl std::fmt::Display for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = match self {
            Self::C(n) => format!("C{n}"),
            Self::Cv(n) => format!("C{n}v"),
            Self::Ch(n) => format!("C{n}h"),
            Self::S(n) => format!("S{n}"),
            Self::D(n) => format!("D{n}"),
            Self::Dh(n) => format!("D{n}h"),
            Self::Dd(n) => format!("D{n}d"),
            other => format!("{other:?}"),
        };
        f.pad(&text)
    }
}

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// An improper element that is its own inverse without being the inversion.
fn is_mirror(t: &Isometry) -> bool {
    let order_two = (t.linear - t.linear.transpose()).amax() < 1e-6;
    t.is_improper() && order_two && t.linear.trace() > 0.0
}

fn is_inversion(t: &Isometry) -> bool {
    (t.linear + Matrix3::identity()).amax() < 1e-6
}

/// The axis of the rotation or rotoreflection of highest order, rotations and earlier elements
/// first, or else the normal of the mirror.
pub(super) fn principal_axis(elements: &[Isometry], table: &Table) -> Option<Vector> {
    if Name::of(elements, table)?.is_polyhedral() {
        return None;
    }
    let turned = |t: &Isometry| turn_of(&(t.linear * t.linear.determinant().signum())).0;
    let turning = (1..elements.len())
        .filter(|&g| !is_mirror(&elements[g]) && !is_inversion(&elements[g]))
        .max_by_key(|&g| {
            let proper = !elements[g].is_improper();
            (table.order_of(g), proper, std::cmp::Reverse(g))
        });
    let chosen = turning.or_else(|| (1..elements.len()).find(|&g| is_mirror(&elements[g])))?;
    Some(turned(&elements[chosen]))
}
