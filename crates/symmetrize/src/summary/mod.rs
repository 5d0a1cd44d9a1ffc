//! Results in words and tables for people.

mod found;
mod orbits;
mod refused;
mod together;

use std::fmt::Write;
use std::path::Path;

use symmetrizer::apply::measure::{AsymmetryReport, Distortion, PlaneReport};
use symmetrizer::field::trust::Verdict;
use symmetrizer::optimize::Step;
use symmetrizer::report::{BendReport, Report, ShapeReport};
use symmetrizer::{Outcome, Warning};

pub use found::symmetries;
pub use symmetrizer::shape::validate::grouped;

/// A line about a shape.
pub fn shape(shape: &ShapeReport) -> String {
    let name = shape.file.as_deref().unwrap_or("the shape");
    let parts = match shape.faces {
        0 => format!("{} points", grouped(shape.vertices)),
        faces => format!(
            "{} vertices, {} triangles",
            grouped(shape.vertices),
            grouped(faces)
        ),
    };
    format!(
        "{name}: {parts}, bounding-box diagonal D = {}, scale L = {}\n",
        short(shape.diagonal),
        short(shape.scale)
    )
}

/// Everything about a run but its files; a `picture` that was asked for shows what a person should look at.
pub fn run(report: &Report, picture: Option<&Path>) -> String {
    let mut text = shape(&report.input.shape);
    text += "\n";
    let bend = report.bend.as_ref();
    let bend = bend.map_or_else(String::new, |b| self::bend(b, picture));
    let Some(result) = &report.result else {
        return text + &symmetries(&report.input, true) + &bend + &warnings(&report.warnings);
    };
    text += &symmetries(&report.input, false);
    text += "\n";
    for step in &report.steps {
        let _ = writeln!(text, "  {}", done(step));
    }
    text += "\n";
    let states = [
        ("before", report.input.shape.asymmetry.as_ref()),
        ("after", Some(&result.asymmetry)),
    ];
    // About one mirror; what was made exact otherwise has its figures above.
    if result.exact.is_empty() {
        text += &asymmetry(&states);
    }
    text += &distortion(&result.distortion);
    text += &bend;
    let _ = writeln!(text, "energy       {:.2e}", result.energy);
    let _ = writeln!(text, "outcome      {}", outcome(report.outcome));
    text + &warnings(&report.warnings)
}

/// A line for each warning.
pub fn warnings(warnings: &[Warning]) -> String {
    let lines = warnings.iter().map(|w| format!("warning      {}\n", w.0));
    lines.collect()
}

/// Asymmetry of one or more states, a row for each.
pub fn asymmetry(states: &[(&str, Option<&AsymmetryReport>)]) -> String {
    let mut text = String::from("asymmetry, % of D    mean     rms     p95     p99     max\n");
    for (name, state) in states {
        if let Some(a) = state {
            let _ = writeln!(
                text,
                "  {name:<14} {:8.3}{:8.3}{:8.2}{:8.2}{:8.2}",
                a.mean, a.rms, a.p95, a.p99, a.max
            );
        }
    }
    text
}

/// What became of a shape.
pub fn distortion(d: &Distortion) -> String {
    let correlation = d
        .curvature_correlation
        .map_or("undefined".into(), |c| format!("{c:.3}"));
    format!(
        "distortion   vertices moved {:.2} % of D (rms; at most {:.1}), edges stretched {:.1} % (p99)\n\
         \x20            curvature correlation {correlation}, {} new crossings, {} inverted faces\n",
        d.rms,
        d.max,
        100.0 * d.edge_stretch_p99.exp_m1(),
        d.new_crossings,
        d.inverted_faces
    )
}

/// A plane n.x = offset.
pub fn plane(plane: &PlaneReport) -> String {
    format!(
        "{} . x = {:>9}",
        direction(plane.normal),
        short(plane.offset)
    )
}

/// What was made of a bend.
fn bend(bend: &BendReport, picture: Option<&Path>) -> String {
    let verdict = match bend.verdict {
        Verdict::Accept => "symmetric about its bent axis",
        Verdict::Uncertain => "uncertain, perhaps symmetric about a bent axis",
        Verdict::Refuse => "no symmetry about a bent axis that could be trusted",
    };
    let kept = bend.kept.as_ref().map_or_else(String::new, |kept| {
        format!(
            "             {:.0} degrees kept: partners {:.3} % of D from opposite each other across the \
             bent mirror, the centre line moved {:.2} %\n",
            kept.degrees, kept.across, kept.line
        )
    });
    let further: Vec<String> = bend.further.iter().map(|b| format!("{b:.0}")).collect();
    let further = match further.is_empty() {
        true => String::new(),
        false => format!("; once they were, bends of {} more", further.join(", ")),
    };
    let ask = match bend.verdict {
        Verdict::Uncertain if bend.removed == 0.0 && bend.kept.is_none() => look(picture),
        _ => String::new(),
    };
    format!(
        "bend         {verdict} (score {:.2}: {:.0} % trusted, likeness {:.2}; {:.1} % without a partner that \
         fits); local mirrors turn by {:.0} degrees, {:.0} removed{further}\n{kept}{ask}",
        bend.score,
        100.0 * bend.trusted,
        bend.likeness,
        100.0 * bend.unfit,
        bend.degrees,
        bend.removed
    )
}

/// Asks whether an uncertain bend is to be undone.
fn look(picture: Option<&Path>) -> String {
    let see = match picture {
        Some(path) => format!("{} shows its pairs", path.display()),
        None => "--picture FILE shows its pairs".into(),
    };
    format!("             {see}; where they belong together, --accept-uncertain undoes it\n")
}

fn done(step: &Step) -> String {
    match step {
        Step::Straighten { bend, .. } => format!("straightened: a bend of {bend:.0} degrees"),
        Step::Bend { bend } => format!("bent again by {bend:.0} degrees"),
        Step::Contract {
            symmetry, steps, ..
        } => format!("contracted {symmetry} in {steps} steps"),
        Step::Merge {
            symmetries: [a, b],
            steps,
            distance,
            coverage,
            kept,
            ..
        } => format!(
            "merged {a} and {b} in {steps} steps: {:.2} -> {:.2} % of L apart, \
             the best holds for {:.0} -> {:.0} % of the surface{}",
            100.0 * distance[0],
            100.0 * distance[1],
            100.0 * coverage[0],
            100.0 * coverage[1],
            if *kept { "" } else { "; undone" }
        ),
        Step::ContractWhole { steps, .. } => format!("contracted the whole in {steps} steps"),
        Step::Orbits {
            goals,
            steps,
            rounds,
            ..
        } => orbits::done(goals, *steps, *rounds),
        Step::Mend { share, left } => format!(
            "mended {:.1} % of the area, which has its own form again; {left} faces stay tangled",
            100.0 * share
        ),
        Step::Finish {
            rounds,
            asymmetry,
            undone,
        } => format!(
            "finished at full resolution in {rounds} rounds: mirrored vertices {:.3} -> {:.3} % of L \
             from the surface{}",
            100.0 * asymmetry[0],
            100.0 * asymmetry[1],
            if *undone > 0.0 {
                format!(
                    "; undone on {:.1} % of the area, where the surface would have crossed itself",
                    100.0 * undone
                )
            } else {
                String::new()
            }
        ),
    }
}

fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Converged => "converged",
        Outcome::EnergyLimit => "energy limit reached: stopped there, as --max-deformation asks",
        Outcome::StepLimit => "step limit reached: a merge did not close (optimize.merge_steps)",
        Outcome::NoSymmetry => "no symmetry found",
    }
}

/// A vector or point with four significant digits; what is nothing beside the rest is 0.
fn place(x: [f64; 3]) -> String {
    let size = x.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    let [x, y, z] = x.map(|c| short(if c.abs() < 1e-12 * size { 0.0 } else { c }));
    format!("({x}, {y}, {z})")
}

/// A direction.
fn direction(d: [f64; 3]) -> String {
    // No -0.000.
    let [x, y, z] = d.map(|c| if c.abs() < 5e-4 { 0.0 } else { c });
    format!("({x:6.3}, {y:6.3}, {z:6.3})")
}

/// Four significant digits, plain where that is short.
pub fn short(x: f64) -> String {
    let size = x.abs();
    if size == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&size) {
        let decimals = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_uncertain_bend_asks_for_a_look() {
        let mut report = BendReport {
            verdict: Verdict::Uncertain,
            score: 0.3,
            trusted: 0.6,
            likeness: 0.5,
            relief: 0.4,
            unfit: 0.1,
            rival: None,
            degrees: 34.0,
            removed: 0.0,
            further: Vec::new(),
            kept: None,
        };
        let text = bend(&report, Some(Path::new("p.png")));
        assert!(text.contains("p.png shows its pairs"), "{text}");
        assert!(text.contains("--accept-uncertain"), "{text}");
        assert!(bend(&report, None).contains("--picture FILE"));
        report.removed = 34.0;
        assert!(!bend(&report, None).contains("--accept-uncertain"));
        report.further = vec![9.4, 28.7];
        let text = bend(&report, None);
        assert!(
            text.contains("34 removed; once they were, bends of 9, 29 more"),
            "{text}"
        );
    }

    #[test]
    fn numbers_are_readable() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(123), "123");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(short(0.25), "0.2500");
        assert_eq!(short(-1234.5), "-1234");
        assert_eq!(short(1e-9), "1.000e-9");
        assert_eq!(short(0.0), "0");
    }
}
