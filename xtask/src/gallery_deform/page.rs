//! The page, as Markdown.

use super::exhibit::{Exhibit, PARTS, Role};
use super::goals::{Best, Comparison, Entry};
use crate::tables::number;

/// What stands above the exhibits.
const HEAD: &str = include_str!("head.md");

/// Heads of the tables' columns.
const FIGURES: &str = "| method | inverted | newly crossing | stretch p99 | correlation | handles missed by, % of D | \
                       centre line off, % | steps | s |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
const GOALS: &str = "| ours | intact | beside the truest: stretch | correlation | goal | beside the tightest: stretch \
                     | correlation | goal |\n|---|---|--:|--:|---|--:|--:|---|\n";

/// The page with the sections of all exhibits.
pub fn page(sections: &[String]) -> String {
    let head = HEAD.replace("PARTS", &PARTS.to_string());
    format!("{head}\n{}", sections.join("\n"))
}

/// An exhibit's section: picture, figures, goals.
pub fn section(exhibit: &Exhibit, entries: &[Entry]) -> String {
    let mut text = format!(
        "## {}\n\n{} triangles; {} vertices held, {} moved, {} free. {} Look at: {}\n\n![{}]({}.png)\n\n{FIGURES}",
        exhibit.title,
        exhibit.surface.triangles.len(),
        exhibit.count(Role::Held),
        exhibit.count(Role::Moved),
        exhibit.count(Role::Free),
        exhibit.handles,
        exhibit.look,
        exhibit.title,
        exhibit.name,
    );
    text.extend(rest(exhibit));
    text.extend(entries.iter().map(row));
    if let Some(best) = Best::of(entries) {
        text += &goals(entries, &best);
    }
    text
}

/// How crooked the centre line is at rest.
fn rest(exhibit: &Exhibit) -> Option<String> {
    let sag = exhibit.line.as_ref()?;
    let off = 100.0 * sag.sag(&exhibit.surface, &exhibit.surface.positions);
    Some(format!(
        "| at rest | | | | | | {} | | |\n",
        number(Some(off), 1)
    ))
}

fn row(entry: &Entry) -> String {
    let (d, f) = (&entry.deformed, &entry.figures);
    let cells = [
        d.method.clone(),
        f.inverted.to_string(),
        f.crossing.to_string(),
        number(Some(f.stretch), 4),
        number(f.correlation, 4),
        number(Some(f.residual), 3),
        number(f.sag, 1),
        d.steps.to_string(),
        number(Some(d.seconds), 1),
    ];
    format!("| {} |\n", cells.join(" | "))
}

fn goals(entries: &[Entry], best: &Best<'_>) -> String {
    let names = format!(
        "\nThe peer's truest is {}, its tightest {}.\n\n{GOALS}",
        best.truest.deformed.method, best.tightest.deformed.method
    );
    let ours = entries.iter().filter(|e| !e.deformed.peer);
    names + &ours.map(|e| goal(e, best)).collect::<String>()
}

fn goal(entry: &Entry, best: &Best<'_>) -> String {
    let intact = if entry.figures.intact() { "yes" } else { "NO" };
    let mut cells = vec![entry.deformed.method.clone(), intact.into()];
    for peer in [best.truest, best.tightest] {
        let c = Comparison::new(&entry.figures, &peer.figures);
        let met = if c.met { "met" } else { "MISSED" };
        cells.extend([
            format!("x {:.3}", c.stretch),
            format!("{:+.4}", c.correlation),
            met.into(),
        ]);
    }
    format!("| {} |\n", cells.join(" | "))
}
