//! Tables, verdicts and the sections they make up, as text.

use std::fmt;

use serde::Serialize;
use serde_json::Value;

/// A part of the answer.
pub struct Section {
    /// What it is about.
    pub title: String,
    /// Its tables.
    pub tables: Vec<Table>,
    /// What else is to be said.
    pub notes: Vec<String>,
    /// The goals.
    pub verdicts: Vec<Verdict>,
    /// Everything, for programs.
    pub figures: Value,
}

/// A goal and what was reached.
#[derive(Debug, Clone, Serialize)]
pub struct Verdict {
    /// What is wanted.
    pub goal: String,
    /// What is.
    pub reached: String,
    /// Whether that is enough.
    pub met: bool,
}

/// Cells in columns.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Verdict {
    /// A verdict.
    pub fn new(goal: impl Into<String>, reached: impl Into<String>, met: bool) -> Self {
        Self {
            goal: goal.into(),
            reached: reached.into(),
            met,
        }
    }

    /// Met where there is a value and it is at most `most`.
    pub fn at_most(what: &str, value: Option<f64>, most: f64, unit: &str) -> Self {
        let met = value.is_some_and(|v| v <= most);
        Self::new(format!("{what} <= {most}{unit}"), number(value, 3), met)
    }

    /// Met where there is a value and it is at least `least`.
    pub fn at_least(what: &str, value: Option<f64>, least: f64, unit: &str) -> Self {
        let met = value.is_some_and(|v| v >= least);
        Self::new(format!("{what} >= {least}{unit}"), number(value, 3), met)
    }
}

impl Table {
    /// A table with the heads of its columns.
    pub fn new<const N: usize>(heads: [&str; N]) -> Self {
        Self {
            rows: vec![heads.map(str::to_owned).into()],
        }
    }

    /// Adds a row.
    pub fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.into());
    }

    /// Whether it has heads only.
    pub fn is_empty(&self) -> bool {
        self.rows.len() < 2
    }
}

impl fmt::Display for Table {
    /// The first column to the left, the others to the right.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let wide = |c: usize| self.rows.iter().filter_map(move |r| r.get(c));
        let width = |c: usize| wide(c).map(|cell| cell.chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in &self.rows {
            let mut line = String::new();
            for (c, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                line += &match c {
                    0 => format!("{cell:<width$}"),
                    _ => format!("  {cell:>width$}"),
                };
            }
            writeln!(f, "  {}", line.trim_end())?;
        }
        Ok(())
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = if self.met { "met   " } else { "MISSED" };
        write!(f, "{word}  {}: {}", self.goal, self.reached)
    }
}

impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "== {}", self.title)?;
        for table in self.tables.iter().filter(|t| !t.is_empty()) {
            writeln!(f, "{table}")?;
        }
        for note in &self.notes {
            writeln!(f, "  {note}")?;
        }
        for v in &self.verdicts {
            writeln!(f, "  {v}")?;
        }
        Ok(())
    }
}

/// A number with `digits` decimals; `-` for none.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "-".into(), |v| format!("{v:.digits$}"))
}

/// `part` of `whole`.
pub fn of(part: usize, whole: usize) -> String {
    format!("{part}/{whole}")
}

/// The share in percent; none of nothing.
pub fn percent(part: usize, whole: usize) -> Option<f64> {
    (whole > 0).then(|| 100.0 * part as f64 / whole as f64)
}

/// The median, where what is missing counts as larger than anything; none where the middle is missing.
pub fn median(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.map(|v| v.unwrap_or(f64::INFINITY)).collect();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    let middle = if n == 0 {
        return None;
    } else {
        0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
    };
    middle.is_finite().then_some(middle)
}

/// The largest; none where one is missing or there are none.
pub fn worst(values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let all: Option<Vec<f64>> = values.collect();
    all?.into_iter().max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_counts_as_large() {
        assert_eq!(median([Some(3.0), None, Some(1.0)].into_iter()), Some(3.0));
        assert_eq!(median([Some(3.0), Some(1.0)].into_iter()), Some(2.0));
        assert_eq!(median([Some(1.0), None].into_iter()), None);
        assert_eq!(median(std::iter::empty()), None);
        assert_eq!(worst([Some(1.0), Some(2.0)].into_iter()), Some(2.0));
        assert_eq!(worst([Some(1.0), None].into_iter()), None);
    }

    #[test]
    fn columns_line_up() {
        let mut table = Table::new(["shape", "n"]);
        table.row(["a".into(), "10".into()]);
        assert_eq!(table.to_string(), "  shape   n\n  a      10\n");
    }
}
