//! The property names that mean something, and the columns that belong together.

use crate::shape::document::{Kind, Layer, Numbers, On, Role, Values};

/// Names of properties that make one layer.
struct Family {
    /// The names, in the order of the layer's numbers.
    names: &'static [&'static str],
    /// How many of them there must be.
    least: usize,
    role: fn(u32) -> Role,
    /// Whether a number after the names counts sets.
    numbered: bool,
    /// The only type that counts, where there is one.
    kind: Option<Kind>,
    /// Whether faces have it too.
    faces: bool,
}

const fn family(names: &'static [&'static str], least: usize, role: fn(u32) -> Role) -> Family {
    Family {
        names,
        least,
        role,
        numbered: false,
        kind: None,
        faces: false,
    }
}

const NORMAL: Family = Family {
    faces: true,
    ..family(&["nx", "ny", "nz"], 3, |_| Role::Normal)
};
const COLOR: Family = Family {
    numbered: true,
    faces: true,
    ..family(&["red", "green", "blue", "alpha"], 3, Role::Color)
};
const TEXTURE: Family = Family {
    numbered: true,
    ..family(&["texture_u", "texture_v", "texture_w"], 1, Role::TexCoord)
};
const DIFFUSE: &[&str] = &[
    "diffuse_red",
    "diffuse_green",
    "diffuse_blue",
    "diffuse_alpha",
];
const FAMILIES: [Family; 8] = [
    NORMAL,
    COLOR,
    TEXTURE,
    Family {
        faces: true,
        ..family(DIFFUSE, 3, Role::Color)
    },
    Family {
        kind: Some(Kind::U8),
        ..family(&["r", "g", "b", "a"], 3, Role::Color)
    },
    family(&["s", "t"], 2, Role::TexCoord),
    family(&["u", "v"], 2, Role::TexCoord),
    family(&["texcoord_s", "texcoord_t"], 2, Role::TexCoord),
];

/// The names under which a layer of `width` numbers is written, where its role has some.
pub(super) fn default_names(role: Role, width: usize) -> Option<Vec<String>> {
    let (names, set): (&[&str], u32) = match role {
        Role::Normal => (NORMAL.names, 0),
        Role::Color(set) => (COLOR.names, set),
        Role::TexCoord(0) if width == 2 => (&["s", "t"], 0),
        Role::TexCoord(set) => (TEXTURE.names, set),
        _ => return None,
    };
    let suffix = if set == 0 {
        String::new()
    } else {
        set.to_string()
    };
    let names = names.get(..width)?.iter();
    Some(names.map(|n| format!("{n}{suffix}")).collect())
}

/// The name and the number of its set: `red2` is 2 of `red`.
fn split(name: &str) -> (&str, u32) {
    let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &name[base.len()..];
    match digits.parse() {
        Ok(set) if !digits.starts_with('0') => (base, set),
        _ => (name, 0),
    }
}

/// The layers in the named columns of vertices or faces, in the order of the columns.
pub(super) fn layers(mut columns: Vec<(String, Option<Values>)>, on: On) -> Vec<Layer> {
    let mut layers: Vec<Layer> = Vec::new();
    for i in 0..columns.len() {
        let group = group(&columns, i, on);
        let (role, members) = group.unwrap_or((Role::Other, vec![i]));
        let names: Vec<&str> = members.iter().map(|&m| columns[m].0.as_str()).collect();
        let name = names.join(" ");
        let parts: Vec<Values> = members
            .iter()
            .filter_map(|&m| columns[m].1.take())
            .collect();
        if let Some(values) = joined(parts) {
            let role = free(role, &layers);
            layers.push(Layer {
                name,
                on,
                role,
                values,
            });
        }
    }
    layers
}

/// The columns that belong together with column `i`, and what they are.
fn group(columns: &[(String, Option<Values>)], i: usize, on: On) -> Option<(Role, Vec<usize>)> {
    let kind = kind_of(columns[i].1.as_ref()?)?;
    let (base, number) = split(&columns[i].0);
    for family in &FAMILIES {
        let (base, set) = match family.numbered {
            true => (base, number),
            false => (columns[i].0.as_str(), 0),
        };
        let wrong_kind = family.kind.is_some_and(|k| k != kind);
        if !family.names.contains(&base) || wrong_kind || (on == On::Face && !family.faces) {
            continue;
        }
        let suffix = if set == 0 {
            String::new()
        } else {
            set.to_string()
        };
        let find = |name: &&str| {
            let name = format!("{name}{suffix}");
            let found = columns.iter().position(|c| c.0 == name)?;
            (kind_of(columns[found].1.as_ref()?)? == kind).then_some(found)
        };
        let members: Vec<usize> = family.names.iter().map_while(find).collect();
        if members.len() >= family.least && members.contains(&i) {
            return Some(((family.role)(set), members));
        }
    }
    None
}

fn kind_of(values: &Values) -> Option<Kind> {
    match values {
        Values::Rows { numbers, .. } => Some(numbers.kind()),
        _ => None,
    }
}

/// The role with the first number from its own that no layer has yet.
fn free(role: Role, layers: &[Layer]) -> Role {
    let taken = |role: Role| layers.iter().any(|l| l.role == role);
    let count = layers.len() as u32;
    match role {
        Role::Color(set) => (set..=set.saturating_add(count))
            .map(Role::Color)
            .find(|&r| !taken(r)),
        Role::TexCoord(set) => (set..=set.saturating_add(count))
            .map(Role::TexCoord)
            .find(|&r| !taken(r)),
        other => Some(other),
    }
    .unwrap_or(role)
}

/// Columns of one type side by side.
fn joined(mut parts: Vec<Values>) -> Option<Values> {
    if parts.len() < 2 {
        return parts.pop();
    }
    let columns: Vec<&Numbers> = parts.iter().filter_map(Values::numbers).collect();
    Some(Values::Rows {
        width: columns.len(),
        numbers: interleaved(&columns)?,
    })
}

macro_rules! interleaved {
    ($columns:expr, $($variant:ident),*) => {
        match $columns.first()? {
            $(Numbers::$variant(first) => {
                let columns = $columns.iter().map(|column| match column {
                    Numbers::$variant(v) => Some(v.as_slice()),
                    _ => None,
                });
                let columns: Vec<_> = columns.collect::<Option<_>>()?;
                let rows = (0..first.len()).flat_map(|i| columns.iter().map(move |c| c[i]));
                let mut all = Vec::with_capacity(first.len() * columns.len());
                all.extend(rows);
                Some(Numbers::$variant(all))
            }),*
        }
    };
}

fn interleaved(columns: &[&Numbers]) -> Option<Numbers> {
    interleaved!(columns, I8, U8, I16, U16, I32, U32, F32, F64)
}
