//! What became of groups, rows, copies and slides, in words.

use std::fmt::Write;

use symmetrizer::optimize::Met;

/// A line for each goal.
pub fn done(goals: &[Met], steps: usize, rounds: usize) -> String {
    let contracted = match steps {
        0 => String::new(),
        _ => format!("contracted in {steps} steps, "),
    };
    let mut text = format!("{contracted}orbits drawn to their means in {rounds} rounds:");
    for goal in goals {
        let _ = write!(text, "\n    {}", line(goal));
    }
    text
}

fn line(goal: &Met) -> String {
    let copies = goal.order.map_or_else(
        || "any number of copies".to_owned(),
        |order| format!("{order} copies of each place"),
    );
    let [before, after] = goal.residual.map(|r| 100.0 * r);
    let end = if goal.kept {
        format!("{before:.3} -> {after:.4} % of L apart (rms)")
    } else {
        format!("left as it was, {before:.3} % of L apart (rms)")
    };
    format!(
        "{}: {copies} on {:.0} % of the surface, {end}",
        goal.name,
        100.0 * goal.area_fraction
    )
}
