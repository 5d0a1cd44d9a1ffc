//! What was looked at and is no symmetry.

use std::fmt::Write;

use symmetrizer::report::{RefusalReport, RefusedCount};
use symmetrizer::transform::Class;

use super::{grouped, plane};

/// Refused mirrors listed at the most; the report has more.
const LISTED: usize = 8;

/// Mirrors one by one, the rest by reason.
pub fn refused(highest: &[RefusalReport], counts: &[RefusedCount]) -> String {
    let mut text = mirrors(highest);
    for class in [Class::Proper, Class::Improper] {
        text += &by_reason(class, counts);
    }
    match text.is_empty() {
        true => text,
        false => format!("\nrefused\n{text}"),
    }
}

fn mirrors(highest: &[RefusalReport]) -> String {
    let mirrors = || highest.iter().filter_map(|r| Some((r.plane.as_ref()?, r)));
    let mut text = String::new();
    for (p, r) in mirrors().take(LISTED) {
        let (plane, height, reason) = (plane(p), r.height, &r.reason);
        let _ = writeln!(text, "     mirror          {plane}  {height:6.2}  {reason}");
    }
    let more = mirrors().count().saturating_sub(LISTED);
    if more > 0 {
        let _ = writeln!(text, "     and {more} mirrors more");
    }
    text
}

fn by_reason(class: Class, counts: &[RefusedCount]) -> String {
    let of = || counts.iter().filter(|c| c.class == class);
    let all: usize = of().map(|c| c.count).sum();
    let mut text = String::new();
    if all > 0 {
        let _ = writeln!(text, "     {} {}", grouped(all), class.members());
    }
    for c in of() {
        let _ = writeln!(text, "     {:>9}  {}", grouped(c.count), c.reason);
    }
    text
}
