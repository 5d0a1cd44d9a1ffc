//! Groups and continuous symmetries in words.

use std::fmt::Write;

use symmetrizer::geom::{Matrix3, Vector};
use symmetrizer::report::{ContinuousReport, GroupReport};
use symmetrizer::slip::Slip;

use super::{direction, place, short};

/// A line for each group.
pub fn groups(groups: &[GroupReport]) -> String {
    let mut text = String::new();
    for group in groups {
        let _ = writeln!(text, "{}", line(group));
    }
    text
}

/// A line for each part that slides along itself.
pub fn continuous(parts: &[ContinuousReport]) -> String {
    let mut text = String::new();
    for part in parts {
        let share = 100.0 * part.area_fraction;
        let _ = writeln!(text, "{}: {share:.0} % of the surface", slide(part));
    }
    text
}

fn line(group: &GroupReport) -> String {
    let name = &group.name;
    if let (Some(step), Some(vector)) = (&group.step, group.step_vector) {
        return format!("{name}: {}", stepped(step, vector.into()));
    }
    let mut text = name.clone();
    // Schoenflies symbols begin with a capital; other groups are copies, whose number is in the name.
    if name.starts_with(|c: char| c.is_ascii_uppercase()) {
        let _ = write!(text, ", order {}: {}", group.order, content(group));
    }
    if let Some(axis) = group.axis {
        let _ = write!(text, "; axis {}", direction(axis));
    }
    text
}

/// The step of a row.
fn stepped(step: &[[f64; 4]; 4], vector: Vector) -> String {
    let linear = Matrix3::from_fn(|r, c| step[r][c]);
    let cosine = (linear.trace() - linear.determinant().signum()) / 2.0;
    let angle = cosine.clamp(-1.0, 1.0).acos().to_degrees();
    let length = vector.norm();
    let along = direction((vector / length.max(f64::MIN_POSITIVE)).into());
    let mut text = format!("step {} along {along}", short(length));
    if angle > 0.05 {
        let _ = write!(text, ", turned by {angle:.1} degrees");
    }
    text
}

/// The elements of a point group by kind, without the identity.
fn content(group: &GroupReport) -> String {
    let kinds = [
        ("mirror", "mirrors"),
        ("half-turn", "half-turns"),
        ("other rotation", "other rotations"),
        ("inversion", "inversions"),
        ("rotoreflection", "rotoreflections"),
    ];
    let mut counts = [0_usize; 5];
    for element in &group.elements {
        let linear = Matrix3::from_fn(|r, c| element[r][c]);
        let (trace, proper) = (linear.trace(), linear.determinant() > 0.0);
        let is = |value: f64| (trace - value).abs() < 1e-3;
        match proper {
            true if is(3.0) => {}
            true if is(-1.0) => counts[1] += 1,
            true => counts[2] += 1,
            false if is(1.0) => counts[0] += 1,
            false if is(-3.0) => counts[3] += 1,
            false => counts[4] += 1,
        }
    }
    let some = counts.iter().zip(kinds).filter(|(n, _)| **n > 0);
    let words: Vec<String> = some
        .map(|(n, (one, many))| match n {
            1 if one == "inversion" => one.to_owned(),
            1 => format!("1 {one}"),
            n => format!("{n} {many}"),
        })
        .collect();
    match counts[1] {
        0 => words.join(", ").replace("other rotation", "rotation"),
        _ => words.join(", "),
    }
}

fn slide(part: &ContinuousReport) -> String {
    let axis = direction(part.axis.unwrap_or_default());
    let point = place(part.point);
    match part.kind {
        Slip::Revolution => format!("any angle about {axis} through {point}"),
        Slip::Extrusion => format!("any shift along {axis}"),
        Slip::Helix => {
            let pitch = std::f64::consts::TAU * part.pitch.unwrap_or(0.0);
            let turn = short(pitch);
            format!("any angle about {axis} through {point} with a shift of {turn} per turn")
        }
        Slip::Cylinder => format!("any angle about and any shift along {axis} through {point}"),
        Slip::Sphere => format!("any turn about {point}"),
        Slip::Plane => format!("any shift and turn in the plane across {axis} through {point}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn group(name: &str, diagonals: &[[f64; 3]]) -> GroupReport {
        let matrix = |d: &[f64; 3]| {
            std::array::from_fn(|r| {
                std::array::from_fn(|c| match (r, c) {
                    (3, 3) => 1.0,
                    _ if r == c => d[r],
                    _ => 0.0,
                })
            })
        };
        GroupReport {
            name: name.into(),
            order: diagonals.len(),
            axis: None,
            point: [0.0; 3],
            step: None,
            step_vector: None,
            elements: diagonals.iter().map(matrix).collect(),
            symmetries: Vec::new(),
            orbit: Vec::new(),
        }
    }

    #[test]
    fn groups_are_told_by_what_they_have() {
        let signs = [1.0, -1.0];
        let all: Vec<[f64; 3]> = (0..8)
            .map(|i| [signs[i & 1], signs[i >> 1 & 1], signs[i >> 2]])
            .collect();
        let boxed = group("D2h", &all);
        let told = "D2h, order 8: 3 mirrors, 3 half-turns, inversion\n";
        assert_eq!(groups(&[boxed]), told);
        assert_eq!(groups(&[group("6 copies", &all[..6])]), "6 copies\n");
        let mut row = group("row 5", &all[..1]);
        let mut step = row.elements[0];
        (step[0][3], step[1][3]) = (3.0, 4.0);
        (row.step, row.step_vector) = (Some(step), Some([3.0, 4.0, 0.0]));
        let told = "row 5: step 5.000 along ( 0.600,  0.800,  0.000)\n";
        assert_eq!(groups(&[row]), told);
    }

    #[test]
    fn slides_are_told_by_what_moves() {
        let part = |kind, axis: Option<[f64; 3]>| ContinuousReport {
            kind,
            axis,
            point: [0.0, 2.0, 0.0],
            pitch: (kind == Slip::Helix).then_some(0.5),
            area_fraction: 0.5,
            rms_deg: 1.0,
            faces: Vec::new(),
        };
        let up = Some([0.0, 0.0, 1.0]);
        let text = continuous(&[part(Slip::Revolution, up), part(Slip::Sphere, None)]);
        let lines: Vec<&str> = text.lines().collect();
        let first =
            "any angle about ( 0.000,  0.000,  1.000) through (0, 2.000, 0): 50 % of the surface";
        assert_eq!(lines[0], first);
        assert_eq!(
            lines[1],
            "any turn about (0, 2.000, 0): 50 % of the surface"
        );
        assert!(continuous(&[part(Slip::Helix, up)]).contains("shift of 3.142 per turn"));
    }
}
