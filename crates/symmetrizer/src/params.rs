//! All parameters of a job: a section for each stage, read from TOML, set one by one, checked.

use std::fmt::Write;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::cluster::ClusterParams;
use crate::deform::DeformParams;
use crate::detect::{DetectParams, Want, Wanted};
use crate::error::{Error, Result};
use crate::optimize::params::OptimizeParams;
use crate::pair::PairParams;
use crate::patch::PatchParams;
use crate::sample::SampleParams;
use crate::slip::SlipParams;
use crate::straighten::StraightenParams;

/// Parameters of [`crate::symmetrize`]. A parameter's dotted name is that of its section and its
/// field, `optimize.step`, in files, in `--set` and in errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// What is looked for.
    pub detect: Wanted,
    /// Samples.
    pub sample: SampleParams,
    /// Pairs.
    pub pair: PairParams,
    /// Clusters.
    pub cluster: ClusterParams,
    /// Patches.
    pub patch: PatchParams,
    /// Continuous symmetries.
    pub slip: SlipParams,
    /// Bends.
    pub straighten: StraightenParams,
    /// The deformation model.
    pub deform: DeformParams,
    /// The schedule.
    pub optimize: OptimizeParams,
}

/// What each parameter may be. The limits keep work and memory finite and formulas defined; within
/// them not every value is wise.
const RANGES: [(&str, f64, f64); 50] = [
    ("sample.count", 100.0, 20_000.0),
    ("sample.outline", 100.0, 2_000.0),
    ("pair.tolerance", 1e-6, 100.0),
    ("pair.partners", 1.0, 1000.0),
    ("pair.min_distance", 0.0, 1.0),
    ("pair.normal_tolerance", 1e-6, 2.0),
    ("cluster.bandwidth", 1e-4, 1.0),
    ("patch.tolerance", 1e-6, 0.5),
    ("patch.min_cos", -1.0, 1.0),
    ("patch.end", 1.0, 1e6),
    ("patch.copy_end", 1.0, 1e6),
    ("patch.min_area", 0.0, 1.0),
    ("patch.max_confusion", 0.0, 1.0),
    ("pair.min_strength", 0.0, 10.0),
    ("pair.max_gap", 1e-6, 10.0),
    ("patch.copy_tolerance", 1e-6, 0.5),
    ("patch.max_filled", 0.0, 2.0),
    ("patch.max_rim", 0.0, 2.0),
    ("patch.max_chance", 0.0, 1.0),
    ("patch.max_unlikeness", 0.0, 2.0),
    ("patch.min_copy", 0.0, 1.0),
    ("patch.min_firmness", 0.0, 1.0),
    ("patch.outline_copy", 0.0, 1.0),
    ("patch.outline_filled", 0.0, 2.0),
    ("patch.outline_unlikeness", 0.0, 2.0),
    ("patch.outline_chance", 0.0, 1.0),
    ("patch.max_doubt", 0.0, 2.0),
    ("patch.min_height", 0.0, 1.0),
    ("slip.tolerance", 1e-4, 0.5),
    ("slip.min_area", 0.0, 1.0),
    ("straighten.share", 0.0, 1.0),
    ("straighten.min_bend", 0.0, 180.0),
    ("deform.length", 1e-4, 10.0),
    ("deform.half_height", 1e-5, 1.0),
    ("deform.control_faces", 100.0, 1e6),
    ("optimize.step", 1e-3, 1.0),
    ("optimize.redetect_every", 1.0, 1000.0),
    ("optimize.contract_steps", 0.0, 1000.0),
    ("optimize.merge_steps", 0.0, 1000.0),
    ("optimize.merged_distance", 1e-5, 1.0),
    ("optimize.merge_angle", 0.0, 90.0),
    ("optimize.min_height", 0.0, 1.0),
    ("optimize.final_steps", 0.0, 1000.0),
    ("optimize.finish_rounds", 0.0, 1000.0),
    ("optimize.finish_lengths", 1e-4, 1.0),
    ("optimize.finish_asymmetry", 0.0, 1.0),
    ("optimize.orbit_rounds", 0.0, 1000.0),
    ("optimize.only", 0.0, 1e9),
    ("optimize.max_symmetries", 1.0, 1e6),
    ("optimize.max_deformation", 0.0, f64::MAX),
];

/// The one parameter that is a list of names; its type knows them.
const KINDS: &str = "detect.kinds";
/// The deformer's.
const MODEL: &str = "deform.model";
/// When bends are undone.
const WHEN: &str = "straighten.when";

impl Params {
    /// The parameters in a TOML document; those it does not name have their defaults.
    ///
    /// # Errors
    /// [`Error::Input`] for what is not TOML, [`Error::Params`] for an unknown name or a value out of
    /// its range.
    pub fn from_toml(text: &str) -> Result<Self> {
        let table: Table = text.parse().map_err(|e| damaged(text, &e))?;
        let params = Self::from_table(&table)?;
        params.check()?;
        Ok(params)
    }

    /// The parameters as a TOML document that [`Params::from_toml`] reads, with their ranges as
    /// comments; one that is off is a comment too.
    pub fn to_toml(&self) -> String {
        let plain = toml::to_string(self).expect("parameters are plain values");
        let mut text = String::new();
        for section in plain.split_inclusive("\n\n") {
            let end = section.trim_end();
            let name = end.split(['[', ']']).nth(1).unwrap_or_default();
            for line in end.lines() {
                let _ = match range_of(&format!("{name}.{}", field_in(line))) {
                    Some(range) => writeln!(text, "{line:<31} # {range}"),
                    None => writeln!(text, "{line}"),
                };
            }
            for (field, range) in self.switched_off(name) {
                let _ = writeln!(text, "{:<32}# {range}; off", format!("# {field} ="));
            }
            text += &section[end.len()..].replacen('\n', "", 1);
        }
        text
    }

    /// Sets the parameter with the dotted name `name` to `value`, as it would be written in TOML;
    /// `none` turns an optional one off.
    ///
    /// # Errors
    /// [`Error::Params`] for an unknown name, with the known ones, and for a value of the wrong
    /// kind or out of its range.
    pub fn set(&mut self, name: &str, value: &str) -> Result<()> {
        let mut table = self.table();
        let (section, field) = known(name)?;
        let stage = table.entry(section).or_insert_with(|| Table::new().into());
        let stage = stage.as_table_mut().expect("a section is a table");
        if value == "none" {
            stage.remove(field);
        } else {
            stage.insert(field.to_owned(), parse(value));
        }
        let changed = Self::from_table(&table)?;
        if value == "none" && changed.value(name).is_some() {
            return Err(Error::params(name, "it cannot be turned off"));
        }
        changed.check()?;
        *self = changed;
        Ok(())
    }

    /// Checks every parameter's range, and that there is something to look for.
    ///
    /// # Errors
    /// [`Error::Params`] with the first one out of it.
    pub fn check(&self) -> Result<()> {
        if self.detect.kinds.is_empty() {
            let what = format!("nothing to look for; there are {}", Want::names());
            return Err(Error::params(KINDS, what));
        }
        for (name, low, high) in RANGES {
            let inside = |x: &f64| (low..=high).contains(x);
            if let Some(x) = self.numbers(name).into_iter().find(|x| !inside(x)) {
                let range = between(low, high);
                return Err(Error::params(name, format!("{x} is out of range: {range}")));
            }
        }
        Ok(())
    }

    /// The sections that detection takes.
    pub fn detect(&self) -> DetectParams {
        DetectParams {
            wanted: self.detect.clone(),
            sample: self.sample.clone(),
            pair: self.pair.clone(),
            cluster: self.cluster.clone(),
            patch: self.patch.clone(),
            slip: Some(self.slip.clone()),
        }
    }

    fn from_table(table: &Table) -> Result<Self> {
        for (section, fields) in table {
            for (field, value) in fields.as_table().into_iter().flatten() {
                let name = format!("{section}.{field}");
                known(&name)?;
                // Alone, so that what does not fit its type has a name.
                let alone = Table::from_iter([(field.clone(), value.clone())]);
                let alone = Table::from_iter([(section.clone(), Value::Table(alone))]);
                alone.try_into::<Self>().map_err(|e| misfit(&name, &e))?;
            }
        }
        let whole = table.clone().try_into();
        whole.map_err(|e| misfit("sections", &e))
    }

    fn table(&self) -> Table {
        Table::try_from(self).expect("parameters are plain values")
    }

    /// The parameters of a section that are off, with their ranges.
    fn switched_off(&self, section: &str) -> Vec<(&'static str, String)> {
        let off = |name: &str| self.value(name).is_none();
        RANGES
            .iter()
            .filter(|(name, ..)| off(name))
            .filter_map(|&(name, low, high)| Some((name.split_once('.')?, between(low, high))))
            .filter(|((of, _), _)| *of == section)
            .map(|((_, field), range)| (field, range))
            .collect()
    }

    fn value(&self, name: &str) -> Option<Value> {
        let (section, field) = name.split_once('.')?;
        self.table().get(section)?.get(field).cloned()
    }

    /// The numbers of a parameter: one, those of a list, none where it is off.
    fn numbers(&self, name: &str) -> Vec<f64> {
        let number = |value: &Value| match value {
            Value::Integer(i) => Some(*i as f64),
            Value::Float(x) => Some(*x),
            _ => None,
        };
        match self.value(name) {
            Some(Value::Array(list)) => list.iter().filter_map(number).collect(),
            value => value.iter().filter_map(number).collect(),
        }
    }
}

/// All dotted names: those of the defaults, and those that are off by default.
fn names() -> Vec<String> {
    let defaults = Params::default().table();
    let mut names: Vec<String> = defaults
        .iter()
        .flat_map(|(section, fields)| {
            let fields = fields.as_table().into_iter().flatten();
            fields.map(move |(field, _)| format!("{section}.{field}"))
        })
        .chain(RANGES.iter().map(|r| r.0.to_owned()))
        .collect();
    names.sort();
    names.dedup();
    names
}

/// The section and field of a known dotted name.
fn known(name: &str) -> Result<(&str, &str)> {
    let all = names();
    if let Some(parts) = name.split_once('.')
        && all.iter().any(|n| n == name)
    {
        return Ok(parts);
    }
    let section = name.split('.').next();
    let near = all.iter().filter(|n| n.split('.').next() == section);
    let near: Vec<&str> = near.map(String::as_str).collect();
    let choice = if near.is_empty() {
        all.join(", ")
    } else {
        near.join(", ")
    };
    Err(Error::params(name, format!("unknown; there are {choice}")))
}

/// A value as TOML has it; what is none is text.
fn parse(value: &str) -> Value {
    let table = format!("value = {value}").parse::<Table>();
    let parsed = table.ok().and_then(|mut t| t.remove("value"));
    parsed.unwrap_or_else(|| Value::String(value.to_owned()))
}

fn misfit(name: &str, error: &toml::de::Error) -> Error {
    Error::params(name, error.message().replace('\n', " "))
}

fn range_of(name: &str) -> Option<String> {
    if name == KINDS {
        return Some(format!("any of {}", Want::names()));
    }
    if name == MODEL {
        return Some("primo or arap".into());
    }
    if name == WHEN {
        return Some("never, accepted or uncertain".into());
    }
    let (_, low, high) = RANGES.iter().find(|r| r.0 == name)?;
    Some(between(*low, *high))
}

/// The field that a line of TOML sets.
fn field_in(line: &str) -> &str {
    line.split('=').next().unwrap_or_default().trim()
}

fn between(low: f64, high: f64) -> String {
    if high < f64::MAX {
        format!("{low}..={high}")
    } else {
        format!("{low} or more")
    }
}

/// What is wrong with a document, with the line.
fn damaged(text: &str, error: &toml::de::Error) -> Error {
    let before = error.span().and_then(|s| text.get(..s.start));
    let line = before.map_or(1, |b| b.matches('\n').count() + 1);
    Error::input(
        format!("line {line}: {}", error.message().replace('\n', " ")),
        "parameter files are TOML, as `symmetrize params` prints them",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_has_a_range() {
        let params = Params {
            optimize: OptimizeParams {
                max_deformation: Some(0.1),
                only: Some(vec![0, 3]),
                max_symmetries: Some(2),
                ..OptimizeParams::default()
            },
            ..Params::default()
        };
        for name in names() {
            assert!(range_of(&name).is_some(), "{name} has no entry in RANGES");
        }
        for (name, low, high) in RANGES {
            let values = params.numbers(name);
            assert!(!values.is_empty(), "{name} is in RANGES, but there is none");
            let inside = values.iter().all(|x| (low..=high).contains(x));
            assert!(inside, "{name}: default {values:?}");
        }
    }

    #[test]
    fn toml_goes_round() {
        let mut params = Params::default();
        params.set("optimize.step", "0.1").unwrap();
        params.set("optimize.max_deformation", "0.02").unwrap();
        params.set("sample.count", "500").unwrap();
        let kinds = "[\"glide\", \"continuous\"]";
        params.set("detect.kinds", kinds).unwrap();
        assert_eq!(params.detect.kinds, [Want::Glide, Want::Continuous]);
        assert_eq!(Params::from_toml(&params.to_toml()).unwrap(), params);
        params.set("optimize.max_deformation", "none").unwrap();
        assert_eq!(params.optimize.max_deformation, None);
    }

    #[test]
    fn part_of_a_document_leaves_the_rest_alone() {
        let params = Params::from_toml("[optimize]\nstep = 1\n").unwrap();
        assert_eq!(params.optimize.step, 1.0);
        assert_eq!(params.sample, SampleParams::default());
    }

    #[test]
    fn mistakes_are_named() {
        let mut params = Params::default();
        let mut fails = |name: &str, value: &str, part: &str| {
            let message = params.set(name, value).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        };
        fails("optimize.stepp", "1", "optimize.redetect_every");
        fails("nothing", "1", "sample.count");
        fails(
            "detect.kinds",
            "[\"mirror\", \"spiral\"]",
            "unknown variant `spiral`",
        );
        fails("detect.kinds", "[\"identity\"]", "`rotation`");
        fails("detect.kinds", "mirror", "expected a sequence");
        fails("detect.kinds", "[]", "nothing to look for");
        fails("optimize", "1", "optimize.step");
        fails("optimize.step", "fast", "string \"fast\", expected f64");
        fails("optimize.step", "nan", "out of range: 0.001..=1");
        fails("optimize.step", "none", "cannot be turned off");
        fails("sample.count", "500.5", "parameter sample.count");
        fails("sample.count", "-1", "parameter sample.count");
        fails("cluster.bandwidth", "0", "0 is out of range");
        fails("optimize.max_deformation", "-0.1", "0 or more");
        fails("optimize.finish_lengths", "[0.1, 5]", "5 is out of range");
        fails("optimize.finish_lengths", "0.1", "expected an array");
        assert_eq!(params, Params::default());
        let file = |text: &str| Params::from_toml(text).unwrap_err().to_string();
        assert!(file("[optimize]\nstep =").contains("line 2"));
        assert!(file("[optimise]\nstep = 1").contains("optimise.step"));
        assert!(file("[optimize]\nstep = \"a\"").contains("optimize.step"));
        assert!(file("optimize = 3").contains("expected"));
    }
}
