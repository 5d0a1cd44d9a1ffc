//! What the attributes of a mesh mean: names in the file, roles in a document.

use super::place::Direction;
use crate::shape::document::{MorphPart, Role};

/// One attribute of a mesh.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Attribute {
    /// Of the mesh itself.
    Base(String),
    /// Of a numbered morph target.
    Target(u32, String),
}

impl Attribute {
    /// Whether it is the positions.
    pub fn is_position(&self) -> bool {
        matches!(self, Self::Base(name) if name == "POSITION")
    }

    /// Its role and the name of its layer; `None` for positions and for the parts of a morph target
    /// that a document does not hold.
    pub fn role(&self) -> Option<(Role, String)> {
        let plain = |role| Some((role, String::new()));
        match self {
            Self::Target(k, name) => plain(Role::Morph(*k, morph_part(name)?)),
            Self::Base(name) => match name.as_str() {
                "POSITION" => None,
                "NORMAL" => plain(Role::Normal),
                "TANGENT" => plain(Role::Tangent),
                other => match numbered(other) {
                    Some(role) => plain(role),
                    None => Some((Role::Other, name.clone())),
                },
            },
        }
    }
}

fn morph_part(name: &str) -> Option<MorphPart> {
    match name {
        "POSITION" => Some(MorphPart::Position),
        "NORMAL" => Some(MorphPart::Normal),
        "TANGENT" => Some(MorphPart::Tangent),
        _ => None,
    }
}

fn numbered(name: &str) -> Option<Role> {
    let (set, number) = name.rsplit_once('_')?;
    let n: u32 = number
        .parse()
        .ok()
        .filter(|n: &u32| n.to_string() == number)?;
    match set {
        "TEXCOORD" => Some(Role::TexCoord(n)),
        "COLOR" => Some(Role::Color(n)),
        "JOINTS" => Some(Role::Joints(n)),
        "WEIGHTS" => Some(Role::Weights(n)),
        _ => None,
    }
}

/// The attribute of a layer that is called `name`; `None` where a mesh has none for its role.
pub(super) fn attribute_of(role: Role, name: &str) -> Option<Attribute> {
    let base = |name: String| Some(Attribute::Base(name));
    match role {
        Role::Normal => base("NORMAL".into()),
        Role::Tangent => base("TANGENT".into()),
        Role::TexCoord(n) => base(format!("TEXCOORD_{n}")),
        Role::Color(n) => base(format!("COLOR_{n}")),
        Role::Joints(n) => base(format!("JOINTS_{n}")),
        Role::Weights(n) => base(format!("WEIGHTS_{n}")),
        Role::Other => base(own_name(name)),
        Role::Morph(k, part) => {
            let part = match part {
                MorphPart::Position => "POSITION",
                MorphPart::Normal => "NORMAL",
                MorphPart::Tangent => "TANGENT",
            };
            Some(Attribute::Target(k, part.into()))
        }
        Role::Material | Role::Group | Role::Object | Role::Smoothing => None,
    }
}

/// A name that glTF allows: it starts with an underscore; letters, digits and underscores only.
fn own_name(name: &str) -> String {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if name.len() > 1 && name.starts_with('_') && name.chars().all(allowed) {
        return name.to_owned();
    }
    let letter = |c: char| {
        if allowed(c) {
            c.to_ascii_uppercase()
        } else {
            '_'
        }
    };
    format!("_{}", name.chars().map(letter).collect::<String>())
}

/// What the values of a role are where they are directions.
pub(super) fn direction(role: Role) -> Option<Direction> {
    match role {
        Role::Normal => Some(Direction::Normal),
        Role::Tangent => Some(Direction::Tangent),
        Role::Morph(_, MorphPart::Position) => Some(Direction::Move),
        Role::Morph(_, MorphPart::Normal) => Some(Direction::NormalChange),
        Role::Morph(_, MorphPart::Tangent) => Some(Direction::TangentChange),
        _ => None,
    }
}
