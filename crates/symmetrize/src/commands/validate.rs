//! `symmetrize validate`: what is wrong with a mesh.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use symmetrizer::report::ValidateReport;
use symmetrizer::shape::Findings;
use symmetrizer::shape::validate::{FIRST, Finding, Place, Severity, Size};
use symmetrizer::{Error, Result};

use crate::Answer;
use crate::files::{ReportFile, check_distinct, commit};
use crate::input::{self, Input, is_drawing};
use crate::options::Desk;
use crate::summary::{grouped, short};

/// Columns of a line of text.
const WIDTH: usize = 100;
/// Columns before the sentences below a finding.
const INDENT: usize = 10;

/// Say what is wrong with a shape and what a run does about it
///
/// Counts and locates holes, duplicate faces, vertices in one place and the like. Numbers of
/// vertices and faces are the file's own, counted from 0. The exit code is 0 where a run works on
/// the file, 1 where it refuses it, 2 where the file cannot be read at all.
#[derive(Args)]
pub struct ValidateArgs {
    #[arg(help = input::HELP)]
    input: Input,
    /// Write everything in figures here, as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
}

/// The verb.
pub fn validate(args: &ValidateArgs, desk: &Desk) -> Result<Answer> {
    if let Some(path) = args.input.path().filter(|path| is_drawing(path)) {
        return Err(Error::input(
            format!(
                "{} is a drawing, and validate looks at meshes",
                path.display()
            ),
            "detect and run say what they leave out as they read it",
        ));
    }
    let path = args.report.as_deref();
    check_distinct(args.input.path(), &[], path.as_slice())?;
    let file = path.map(ReportFile::reserve).transpose()?;
    let mut ctx = desk.context();
    let mesh = args.input.examine(&mut ctx)?.mesh;
    let findings = ctx.stage("validate", |_| Ok(Findings::of(&mesh)))?;
    let mut report = ValidateReport::new(findings, &ctx);
    report.file = Some(args.input.name());
    if let Some(file) = file {
        report.run = Some(desk.progress.report());
        commit([file.write(&report)?])?;
    }
    desk.say(&text(&report.findings, &args.input.name()));
    Ok(if report.works {
        Answer::Yes
    } else {
        Answer::No
    })
}

/// Everything in words.
fn text(found: &Findings, name: &str) -> String {
    let mut text = format!(
        "{name}: {}, {}, which make {} to work with\n",
        counted(found.vertices, "vertex", "vertices"),
        counted(found.faces, "face", "faces"),
        counted(found.triangles, "triangle", "triangles"),
    );
    if let Some(size) = &found.size {
        text += &extent(size);
    }
    text += "\n";
    let (fine, told): (Vec<&Finding>, Vec<&Finding>) = found
        .findings
        .iter()
        .partition(|f| f.severity == Severity::Fine);
    for finding in told {
        text += &entry(finding);
    }
    let fine: Vec<String> = fine.into_iter().map(Finding::title).collect();
    if !fine.is_empty() {
        text += &wrapped("fine", &fine.join(", "));
    }
    text + "\n" + &verdict(found)
}

fn extent(size: &Size) -> String {
    let [x, y, z] = std::array::from_fn(|k| short(size.high[k] - size.low[k]));
    format!(
        "box {x} x {y} x {z}, diagonal D = {}, centre {} from the origin\n",
        short(size.diagonal),
        short(size.offset)
    )
}

/// A line with count and places, then sentences.
fn entry(finding: &Finding) -> String {
    let line = format!(
        "{:<INDENT$}{:<36}  {}",
        severity(finding.severity),
        finding.title(),
        places(finding)
    );
    let mut text = format!("{}\n", line.trim_end());
    let run = format!("A run {}.", finding.action);
    for sentence in [&finding.what, &run] {
        text += &wrapped("", sentence);
    }
    text
}

fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Refused => "REFUSED",
        Severity::Mended => "mended",
        Severity::Note => "note",
        Severity::Fine => "fine",
    }
}

/// "faces 3, 8, 9 ...", or nothing.
fn places(finding: &Finding) -> String {
    if finding.first.is_empty() {
        return String::new();
    }
    let shown = if finding.at == "edges" { 3 } else { FIRST };
    let numbers: Vec<String> = finding
        .first
        .iter()
        .take(shown)
        .map(|place| match place {
            Place::One(v) => v.to_string(),
            Place::Edge([u, v]) => format!("{u}-{v}"),
        })
        .collect();
    let what = match (finding.count, finding.at) {
        (1, "vertices") => "vertex",
        (1, "faces") => "face",
        (1, "edges") => "edge",
        (_, many) => many,
    };
    let more = if finding.count > numbers.len() {
        ", ..."
    } else {
        ""
    };
    format!("{what} {}{more}", numbers.join(", "))
}

fn verdict(found: &Findings) -> String {
    let refusals: Vec<String> = found.refusals().map(Finding::title).collect();
    if refusals.is_empty() {
        "a run works on this file\n".to_owned()
    } else {
        format!("a run refuses this file: {}\n", refusals.join("; "))
    }
}

fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{} {}", grouped(n), if n == 1 { one } else { many })
}

/// A sentence in lines of [`WIDTH`] columns, indented; `first` stands before the first line.
fn wrapped(first: &str, sentence: &str) -> String {
    let mut text = String::new();
    let mut line = format!("{first:<INDENT$}");
    for word in sentence.split_whitespace() {
        if line.len() > INDENT && line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(text, "{line}");
            line = " ".repeat(INDENT);
        }
        if line.len() > INDENT {
            line.push(' ');
        }
        line += word;
    }
    if line.len() > INDENT {
        let _ = writeln!(text, "{line}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_broken_into_lines() {
        assert_eq!(wrapped("", ""), "");
        assert_eq!(wrapped("fine", "One two."), "fine      One two.\n");
        let long = wrapped("", &"word ".repeat(40));
        assert_eq!(long.lines().count(), 3);
        assert!(
            long.lines()
                .all(|l| l.len() <= WIDTH && l.starts_with("          word"))
        );
    }
}
