//! Names of materials, groups and so on: a number per face, and comments that name the numbers.
//!
//! `comment material 0 Red wool` names material 0 of the face property `material`; -1 is none. In a
//! name, a line break is written as `\n` or `\r` and a backslash as two.

use crate::shape::document::{NO_ROW, Numbers, PlyRemark, Role, Values};

/// The properties that may be names.
const ROLES: [(&str, Role); 4] = [
    ("material", Role::Material),
    ("group", Role::Group),
    ("object", Role::Object),
    ("smoothing", Role::Smoothing),
];

/// The role of the names in a face property.
pub(super) fn role(property: &str) -> Option<Role> {
    ROLES.iter().find(|r| r.0 == property).map(|r| r.1)
}

/// The face property that holds names of a role.
pub(super) fn property(role: Role) -> Option<&'static str> {
    ROLES.iter().find(|r| r.1 == role).map(|r| r.0)
}

/// The names of a face property's numbers, taken out of the remarks; `None`, and nothing taken,
/// where the remarks do not name all of them in order.
pub(super) fn read(
    property: &str,
    values: &Values,
    remarks: &mut Vec<PlyRemark>,
) -> Option<Values> {
    let Values::Rows {
        numbers: Numbers::I32(numbers),
        ..
    } = values
    else {
        return None;
    };
    let named = |r: &PlyRemark| {
        let line = std::str::from_utf8(&r.line).ok()?;
        let rest = line.strip_prefix("comment ")?.strip_prefix(property)?;
        let (number, name) = rest.strip_prefix(' ')?.split_once(' ')?;
        Some((number.parse::<usize>().ok()?, unescaped(name)))
    };
    let found: Vec<(usize, String)> = remarks.iter().filter_map(named).collect();
    let in_order = found.iter().enumerate().all(|(i, f)| i == f.0);
    let known = |&n: &i32| n == -1 || usize::try_from(n).is_ok_and(|n| n < found.len());
    if found.is_empty() || !in_order || !numbers.iter().all(known) {
        return None;
    }
    remarks.retain(|r| named(r).is_none());
    let of = numbers.iter().map(|&n| u32::try_from(n).unwrap_or(NO_ROW));
    Some(Values::Names {
        names: found.into_iter().map(|f| f.1).collect(),
        of: of.collect(),
    })
}

/// The lines that name the numbers of a property.
pub(super) fn comments(property: &str, names: &[String]) -> String {
    let lines = names.iter().enumerate();
    lines
        .map(|(i, name)| format!("comment {property} {i} {}\n", escaped(name)))
        .collect()
}

fn escaped(name: &str) -> String {
    let name = name.replace('\\', "\\\\");
    name.replace('\n', "\\n").replace('\r', "\\r")
}

fn unescaped(name: &str) -> String {
    let mut plain = String::with_capacity(name.len());
    let mut characters = name.chars();
    while let Some(c) = characters.next() {
        match (c, characters.clone().next()) {
            ('\\', Some(next @ ('\\' | 'n' | 'r'))) => {
                characters.next();
                plain.push(match next {
                    'n' => '\n',
                    'r' => '\r',
                    other => other,
                });
            }
            _ => plain.push(c),
        }
    }
    plain
}
