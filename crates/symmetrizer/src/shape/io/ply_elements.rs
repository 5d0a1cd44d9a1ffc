//! Binary PLY elements as plain structs, so that no map is built per vertex or face.

use ply_rs_bw::ply::{BeginList, PropertyAccess, PropertyAccessResult};

use crate::error::{Error, Result};

/// Whether a face property of this name lists the corners; writers disagree on the name.
pub(super) fn is_corner_list(name: &str) -> bool {
    matches!(name, "vertex_indices" | "vertex_index")
}

/// A vertex: its `x`, `y`, `z` of any type.
#[derive(Default)]
pub(super) struct Vertex {
    pub position: [f64; 3],
}

impl Vertex {
    fn set(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Ignored,
        };
        self.position[axis] = value;
        PropertyAccessResult::Set
    }
}

macro_rules! coordinates {
    ($($setter:ident $type:ty),*) => {
        $(fn $setter(&mut self, name: &str, value: $type) -> PropertyAccessResult {
            self.set(name, f64::from(value))
        })*
    };
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self::default()
    }
    coordinates!(set_char i8, set_uchar u8, set_short i16, set_ushort u16);
    coordinates!(set_int i32, set_uint u32, set_float f32, set_double f64);
}

/// A face: its corners, in the list of the type that the file has.
#[derive(Default)]
pub(super) struct Face {
    signed: Vec<i32>,
    unsigned: Vec<u32>,
}

impl Face {
    /// The corners; `f` is the number of the face, for the message.
    pub fn corners(self, f: usize) -> Result<Vec<u32>> {
        if self.signed.is_empty() {
            return Ok(self.unsigned);
        }
        let corner = |v: i32| u32::try_from(v).map_err(|_| negative(f, v));
        self.signed.into_iter().map(corner).collect()
    }

    fn widen<T: Into<i32>>(&mut self, name: &str, corners: Vec<T>) -> PropertyAccessResult {
        if !is_corner_list(name) {
            return PropertyAccessResult::Ignored;
        }
        self.signed = corners.into_iter().map(Into::into).collect();
        PropertyAccessResult::Set
    }
}

fn negative(f: usize, v: i32) -> Error {
    Error::input(
        format!("face {f} (counted from 0) names vertex {v}"),
        "the file is damaged: indices count from 0",
    )
}

macro_rules! narrow_corners {
    ($($setter:ident $type:ty),*) => {
        $(fn $setter(&mut self, name: &str, corners: Vec<$type>) -> PropertyAccessResult {
            self.widen(name, corners)
        })*
    };
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Self::default()
    }
    fn begin_list_int(&mut self, name: &str, _: usize) -> BeginList<'_, i32> {
        match is_corner_list(name) {
            true => BeginList::Fill(&mut self.signed),
            false => BeginList::UseSetter,
        }
    }
    fn begin_list_uint(&mut self, name: &str, _: usize) -> BeginList<'_, u32> {
        match is_corner_list(name) {
            true => BeginList::Fill(&mut self.unsigned),
            false => BeginList::UseSetter,
        }
    }
    narrow_corners!(set_list_char i8, set_list_uchar u8, set_list_short i16, set_list_ushort u16);
}

/// An element that is passed over.
pub(super) struct Ignored;

impl PropertyAccess for Ignored {
    fn new() -> Self {
        Self
    }
}
