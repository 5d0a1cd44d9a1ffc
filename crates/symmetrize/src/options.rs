//! Flags that several verbs share, each with one meaning.

use std::path::PathBuf;

use clap::Args;
use symmetrizer::detect::Want;
use symmetrizer::straighten::When;
use symmetrizer::{CancelToken, Context, Error, Params, Result};

use crate::progress::Progress;

/// Flags of every verb.
#[derive(Args)]
pub struct Common {
    /// Seed of all randomness: the same input, parameters and seed give the same files
    #[arg(long, global = true, default_value_t = 0, value_name = "N")]
    pub seed: u64,
    /// Threads to work with [default: one per core]; the result does not depend on it
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// No progress and no summary, only errors
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// Flags that set parameters.
#[derive(Args)]
pub struct Tuning {
    /// Read parameters from a TOML file, as `symmetrize params` prints them
    #[arg(long, value_name = "FILE")]
    pub params: Option<PathBuf>,
    /// Set one parameter, say optimize.step=0.1; may be repeated, counts over --params
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
}

/// The flag that says what is looked for.
#[derive(Args)]
pub struct Sought {
    /// What to look for, with commas: mirror, rotation, translation, screw, glide, rotoreflection,
    /// inversion, continuous [default: all of them]
    #[arg(long, value_name = "KINDS", value_delimiter = ',')]
    classes: Vec<String>,
}

/// Flags that say what becomes of a bend.
#[derive(Args)]
pub struct Bends {
    /// Share of the bend to remove where the shape is symmetric about a bent axis: 0.5 leaves half of it,
    /// both sides alike [default: 1]
    #[arg(long, value_name = "SHARE", conflicts_with_all = ["keep_pose", "no_straighten"])]
    straighten: Option<f64>,
    /// Make the shape symmetric about its bent axis: both sides alike, the pose stays
    #[arg(long, conflicts_with = "no_straighten")]
    keep_pose: bool,
    /// Take no bend into account
    #[arg(long)]
    no_straighten: bool,
    /// Straighten where the symmetry under the bend is uncertain, too
    #[arg(long, conflicts_with = "no_straighten")]
    accept_uncertain: bool,
}

impl Bends {
    /// Sets in `params` what the flags say.
    pub fn set(&self, params: &mut Params) -> Result<()> {
        if let Some(share) = self.straighten {
            params.set("straighten.share", &share.to_string())?;
        }
        if self.keep_pose {
            params.straighten.share = 0.0;
        }
        if self.no_straighten {
            params.straighten.when = When::Never;
        }
        if self.accept_uncertain {
            params.straighten.when = When::Uncertain;
        }
        Ok(())
    }
}

impl Sought {
    /// Sets what is looked for in `params`, where the flag was given.
    pub fn narrow(&self, params: &mut Params) -> Result<()> {
        if !self.classes.is_empty() {
            let wants = self.classes.iter().map(|name| name.trim().parse::<Want>());
            params.detect.kinds = wants.collect::<Result<_>>()?;
        }
        Ok(())
    }
}

impl Tuning {
    /// The defaults, changed by the file, changed by the single settings.
    pub fn resolve(&self) -> Result<Params> {
        let mut params = match &self.params {
            None => Params::default(),
            Some(path) => {
                let text = std::fs::read_to_string(path).map_err(|e| Error::io(path, e))?;
                Params::from_toml(&text).map_err(|e| e.in_file(path))?
            }
        };
        for setting in &self.set {
            let (name, value) = setting.split_once('=').ok_or_else(|| {
                let what = "no value; write NAME=VALUE, say optimize.step=0.1";
                Error::params(setting, what)
            })?;
            params.set(name.trim(), value.trim())?;
        }
        Ok(params)
    }
}

/// What every verb works with.
pub struct Desk {
    seed: u64,
    quiet: bool,
    cancel: CancelToken,
    /// The clock and the bars.
    pub progress: Progress,
}

impl Desk {
    /// Takes over the common flags; from here on the threads are those asked for.
    pub fn new(common: &Common, cancel: CancelToken) -> Result<Self> {
        if let Some(threads) = common.threads {
            rayon::ThreadPoolBuilder::new()
                .num_threads(usize::from(threads))
                .build_global()
                .map_err(|e| Error::params("threads", e.to_string()))?;
        }
        Ok(Self {
            seed: common.seed,
            quiet: common.quiet,
            cancel,
            progress: Progress::new(common.quiet),
        })
    }

    /// A context that listens to Ctrl-C and reports its stages to the clock and the bars.
    pub fn context(&self) -> Context<'static> {
        Context::with_sink(self.seed, self.cancel.clone(), self.progress.sink())
    }

    /// Prints the answer, unless asked to be quiet.
    pub fn say(&self, text: &str) {
        if !self.quiet {
            crate::terminal::answer(text);
        }
    }
}
