//! What every long call carries: the seed, a sink for progress, a cancel token, the warnings.
//!
//! The library has no clock, no terminal and no environment; whoever calls it hears of stages
//! through [`Event`]s and may time or draw them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use crate::error::{Error, Result, Warning};

/// A sticky request to stop; clones share it, any thread may set it.
#[derive(Debug, Clone, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// Asks every call that carries this token to return [`Error::Cancelled`] soon.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether [`CancelToken::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Fails with [`Error::Cancelled`] when asked to stop.
    ///
    /// # Errors
    /// That one.
    pub fn check(&self) -> Result<()> {
        match self.is_cancelled() {
            true => Err(Error::Cancelled),
            false => Ok(()),
        }
    }
}

/// What a stage tells the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Event<'a> {
    /// A stage begins.
    Begin(&'a str),
    /// The running stage is this far, in 0..=1, never decreasing.
    Progress(f64),
    /// The running stage ends.
    End(&'a str),
}

/// Seed, progress sink, cancel token and warnings of one job.
pub struct Context<'a> {
    seed: u64,
    cancel: CancelToken,
    sink: Box<dyn FnMut(Event<'_>) + 'a>,
    warnings: Vec<Warning>,
    /// How far the running stage is; stages may nest.
    reached: f64,
}

impl Default for Context<'_> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<'a> Context<'a> {
    /// A context without a listener.
    pub fn new(seed: u64) -> Self {
        Self::with_sink(seed, CancelToken::default(), |_| {})
    }

    /// A context whose stages report to `sink` and stop when `cancel` is set.
    pub fn with_sink(seed: u64, cancel: CancelToken, sink: impl FnMut(Event<'_>) + 'a) -> Self {
        Self {
            seed,
            cancel,
            sink: Box::new(sink),
            warnings: Vec::new(),
            reached: 0.0,
        }
    }

    /// The job's seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// A generator of its own for the stage `name`: the same seed and name give the same stream on
    /// every machine, whatever other stages draw.
    pub fn rng(&self, name: &str) -> Pcg64 {
        // FNV-1a of the name, so that streams differ between stages.
        let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, b| {
            (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
        });
        Pcg64::seed_from_u64(self.seed ^ hash)
    }

    /// Runs `work` with other streams of random numbers, the same for the same `turn`; turn 0 has those of the job.
    pub fn drawn_anew<T>(&mut self, turn: u64, work: impl FnOnce(&mut Self) -> T) -> T {
        let other = self.seed ^ turn.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let seed = std::mem::replace(&mut self.seed, other);
        let result = work(self);
        self.seed = seed;
        result
    }

    /// Runs `work` as the stage `name`, with its begin and end events.
    pub fn stage<T>(&mut self, name: &str, work: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        self.check()?;
        (self.sink)(Event::Begin(name));
        let outer = std::mem::replace(&mut self.reached, 0.0);
        let result = work(self);
        self.reached = outer;
        (self.sink)(Event::End(name));
        result
    }

    /// Reports how far the running stage is, and fails with [`Error::Cancelled`] when asked to stop.
    pub fn progress(&mut self, fraction: f64) -> Result<()> {
        self.check()?;
        self.reached = self.reached.max(fraction.clamp(0.0, 1.0));
        (self.sink)(Event::Progress(self.reached));
        Ok(())
    }

    /// Fails with [`Error::Cancelled`] when asked to stop.
    pub fn check(&self) -> Result<()> {
        self.cancel.check()
    }

    /// The token, for work that goes on in several threads.
    pub fn token(&self) -> &CancelToken {
        &self.cancel
    }

    /// Keeps a warning for the report.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.warnings.push(Warning(text.into()));
    }

    /// The warnings so far, oldest first.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    /// Each turn has streams of its own, turn 0 those of the job, and afterwards all is as before.
    #[test]
    fn numbers_are_drawn_anew_for_a_while() {
        let mut ctx = Context::new(7);
        let mut draw = |turn| ctx.drawn_anew(turn, |ctx| ctx.rng("sample").random::<u64>());
        let drawn = [draw(0), draw(1), draw(2), draw(1)];
        assert_eq!(drawn[1], drawn[3]);
        assert!(drawn[0] != drawn[1] && drawn[1] != drawn[2]);
        assert_eq!(drawn[0], ctx.rng("sample").random::<u64>());
        assert_eq!(ctx.seed(), 7);
    }
}
