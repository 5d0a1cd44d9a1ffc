//! The table of symmetries.

use std::fmt::Write;

use symmetrizer::report::{InputReport, SymmetryReport};

use super::{direction, place, plane, refused, short, together};

/// Symmetries listed at the most; the report has them all.
const LISTED: usize = 20;

/// All that was found, and with `refusals` also what was not accepted.
pub fn symmetries(input: &InputReport, refusals: bool) -> String {
    let mut text = together::groups(&input.groups);
    text += &together::continuous(&input.continuous);
    if !text.is_empty() {
        text += "\n";
    }
    if !input.symmetries.is_empty() || text.is_empty() {
        text += &table(&input.symmetries);
    }
    if refusals {
        text += &refused::refused(&input.refused, &input.refused_counts);
    }
    text
}

fn table(symmetries: &[SymmetryReport]) -> String {
    if symmetries.is_empty() {
        return String::from("no symmetry found\n");
    }
    let listed = &symmetries[..symmetries.len().min(LISTED)];
    let places: Vec<String> = listed.iter().map(whereabouts).collect();
    let wide = places.iter().map(|p| p.chars().count()).max().unwrap_or(0);
    let wide = wide.max(5);
    let mut text = format!(
        " id  kind            {:<wide$}    angle  order  height  area %  rms % of L  group\n",
        "where"
    );
    for (s, place) in listed.iter().zip(&places) {
        let angle = s.angle_deg.map_or("-".into(), |a| format!("{a:.1}"));
        let order = s.order.map_or("-".into(), |n| n.to_string());
        let line = format!(
            "{:3}  {:<14}  {place:<wide$}  {angle:>7}  {order:>5}  {:6.2}  {:6.1}  {:10.3}  {}",
            s.id,
            s.kind,
            s.height,
            100.0 * s.area_fraction,
            100.0 * s.rms,
            s.group.as_deref().unwrap_or("")
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    if symmetries.len() > LISTED {
        let more = symmetries.len() - LISTED;
        let _ = writeln!(text, "     and {more} more: --report has them all");
    }
    text
}

/// The plane, the axis, the point or the shift.
fn whereabouts(s: &SymmetryReport) -> String {
    let mut parts = Vec::new();
    parts.extend(s.plane.as_ref().map(plane));
    parts.extend(s.axis.map(direction));
    parts.extend(s.point.map(|x| format!("through {}", place(x))));
    let along_axis = s.axis.and(s.shift).map(|v| {
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        format!("shift {}", short(length))
    });
    let free = s.shift.filter(|_| s.axis.is_none());
    parts.extend(along_axis.or(free.map(|v| format!("shift {}", place(v)))));
    parts.join("  ")
}
