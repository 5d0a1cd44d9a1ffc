//! All parameters of a job: a section for each stage, read from TOML, set one by one, checked.

use std::fmt::Write;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::cluster::ClusterParams;
use crate::deform::primo::DeformParams;
use crate::detect::DetectParams;
use crate::error::{Error, Result};
use crate::optimize::params::OptimizeParams;
use crate::pair::PairParams;
use crate::patch::PatchParams;
use crate::sample::SampleParams;

/// Parameters of [`crate::symmetrize`]. A parameter's dotted name is that of its section and its
/// field, `optimize.step`, in files, in `--set` and in errors.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Samples.
    pub sample: SampleParams,
    /// Pairs.
    pub pair: PairParams,
    /// Clusters.
    pub cluster: ClusterParams,
    /// Patches.
    pub patch: PatchParams,
    /// The deformation model.
    pub deform: DeformParams,
    /// The schedule.
    pub optimize: OptimizeParams,
}

/// What each parameter may be. The limits keep work and memory finite and formulas defined; within
/// them not every value is wise.
const RANGES: [(&str, f64, f64); 25] = [
    ("sample.count", 100.0, 20_000.0),
    ("pair.tolerance", 1e-6, 100.0),
    ("pair.partners", 1.0, 1000.0),
    ("pair.min_distance", 0.0, 1.0),
    ("pair.normal_tolerance", 1e-6, 2.0),
    ("cluster.bandwidth", 1e-4, 1.0),
    ("patch.tolerance", 1e-6, 0.5),
    ("patch.min_cos", -1.0, 1.0),
    ("patch.min_area", 0.0, 1.0),
    ("patch.max_confusion", 0.0, 1.0),
    ("patch.max_doubt", 0.0, 2.0),
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
    ("optimize.finish_length", 1e-4, 1.0),
    ("optimize.max_deformation", 0.0, f64::MAX),
];

impl Params {
    /// The parameters in a TOML document; those it does not name have their defaults.
    ///
    /// # Errors
    /// [`Error::Input`] for what is not TOML, [`Error::Params`] for an unknown name or a value out of
    /// its range.
    pub fn from_toml(text: &str) -> Result<Self> {
        let table: Table = text.parse().map_err(|e| damaged(text, &e))?;
        let params = Self::from_table(table, None)?;
        params.check()?;
        Ok(params)
    }

    /// The parameters as a TOML document that [`Params::from_toml`] reads, with their ranges as
    /// comments; one that is off is a comment too.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        let mut last = "";
        for (name, low, high) in RANGES {
            let (section, field) = name.split_once('.').expect("dotted");
            if section != last {
                let gap = if last.is_empty() { "" } else { "\n" };
                let _ = writeln!(text, "{gap}[{section}]");
                last = section;
            }
            let range = between(low, high);
            let _ = match self.value(name) {
                Some(value) => writeln!(text, "{:<28}# {range}", format!("{field} = {value}")),
                None => writeln!(text, "{:<28}# {range}; off", format!("# {field} =")),
            };
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
        let stage = table
            .get_mut(section)
            .and_then(Value::as_table_mut)
            .expect("every range names a section");
        if value == "none" {
            stage.remove(field);
        } else {
            stage.insert(field.to_owned(), parse(name, value)?);
        }
        let changed = Self::from_table(table, Some(name))?;
        if value == "none" && changed.number(name).is_some() {
            return Err(Error::params(name, "it cannot be turned off"));
        }
        changed.check()?;
        *self = changed;
        Ok(())
    }

    /// Checks every parameter's range.
    ///
    /// # Errors
    /// [`Error::Params`] with the first one out of it.
    pub fn check(&self) -> Result<()> {
        for (name, low, high) in RANGES {
            let Some(value) = self.number(name) else {
                continue;
            };
            if !(value >= low && value <= high) {
                return Err(Error::params(
                    name,
                    format!("{value} is out of range: {}", between(low, high)),
                ));
            }
        }
        Ok(())
    }

    /// The sections that detection takes.
    pub fn detect(&self) -> DetectParams {
        DetectParams {
            sample: self.sample.clone(),
            pair: self.pair.clone(),
            cluster: self.cluster.clone(),
            patch: self.patch.clone(),
        }
    }

    fn table(&self) -> Table {
        Table::try_from(self).expect("parameters are plain numbers")
    }

    /// The parameters in `table`; `changed` is the one to blame for what does not fit its type.
    fn from_table(table: Table, changed: Option<&str>) -> Result<Self> {
        for (section, fields) in &table {
            for (field, value) in fields.as_table().into_iter().flatten() {
                let name = format!("{section}.{field}");
                known(&name)?;
                if !matches!(value, Value::Integer(_) | Value::Float(_)) {
                    return Err(Error::params(name, format!("{value} is not a number")));
                }
            }
        }
        table.try_into().map_err(|e: toml::de::Error| {
            Error::params(changed.unwrap_or("file"), e.message().replace('\n', " "))
        })
    }

    fn value(&self, name: &str) -> Option<Value> {
        let (section, field) = name.split_once('.')?;
        self.table().get(section)?.get(field).cloned()
    }

    fn number(&self, name: &str) -> Option<f64> {
        match self.value(name)? {
            Value::Integer(i) => Some(i as f64),
            Value::Float(f) => Some(f),
            _ => None,
        }
    }
}

/// The section and field of a known dotted name.
fn known(name: &str) -> Result<(&str, &str)> {
    let listed = |section: Option<&str>| -> String {
        let of = |n: &&str| section.is_none_or(|s| n.split('.').next() == Some(s));
        let names: Vec<&str> = RANGES.iter().map(|r| r.0).filter(of).collect();
        names.join(", ")
    };
    if RANGES.iter().any(|(n, ..)| *n == name)
        && let Some(parts) = name.split_once('.')
    {
        return Ok(parts);
    }
    let near = listed(Some(name.split('.').next().unwrap_or(name)));
    let choice = if near.is_empty() { listed(None) } else { near };
    Err(Error::params(name, format!("unknown; there are {choice}")))
}

fn parse(name: &str, value: &str) -> Result<Value> {
    let number = value.parse::<i64>().map(Value::Integer);
    number
        .or_else(|_| value.parse::<f64>().map(Value::Float))
        .map_err(|_| Error::params(name, format!("{value:?} is not a number")))
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
                ..OptimizeParams::default()
            },
            ..Params::default()
        };
        for (section, fields) in params.table() {
            for (field, _) in fields.as_table().unwrap() {
                let name = format!("{section}.{field}");
                assert!(known(&name).is_ok(), "{name} has no entry in RANGES");
            }
        }
        for (name, low, high) in RANGES {
            let value = params.number(name).expect(name);
            assert!(low <= value && value <= high, "{name}: default {value}");
        }
    }

    #[test]
    fn toml_goes_round() {
        let mut params = Params::default();
        params.set("optimize.step", "0.1").unwrap();
        params.set("optimize.max_deformation", "0.02").unwrap();
        params.set("sample.count", "500").unwrap();
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
        fails("optimize", "1", "optimize.step");
        fails("optimize.step", "fast", "\"fast\" is not a number");
        fails("optimize.step", "NaN", "out of range: 0.001..=1");
        fails("optimize.step", "none", "cannot be turned off");
        fails("sample.count", "500.5", "parameter sample.count");
        fails("sample.count", "-1", "parameter sample.count");
        fails("cluster.bandwidth", "0", "0 is out of range");
        fails("optimize.max_deformation", "-0.1", "0 or more");
        assert_eq!(params, Params::default());
        let file = |text: &str| Params::from_toml(text).unwrap_err().to_string();
        assert!(file("[optimize]\nstep =").contains("line 2"));
        assert!(file("[optimise]\nstep = 1").contains("optimise.step"));
        assert!(file("[optimize]\nstep = \"a\"").contains("optimize.step"));
        assert!(file("optimize = 3").contains("expected"));
    }
}
