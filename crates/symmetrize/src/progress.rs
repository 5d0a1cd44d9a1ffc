//! Time and progress of the stages, from the events of the library.

use std::cell::RefCell;
use std::io::IsTerminal;
use std::rc::Rc;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use symmetrizer::Event;
use symmetrizer::report::{RunReport, Timing};

use crate::terminal;

/// The clock and, on a terminal, a bar for each stage.
pub struct Progress(Rc<RefCell<Stages>>);

struct Stages {
    visible: bool,
    /// The stages that run now, the outermost first: index of the timing, beginning.
    running: Vec<(usize, Instant)>,
    timings: Vec<Timing>,
    bar: ProgressBar,
}

/// Steps of a bar.
const STEPS: u64 = 1000;

impl Progress {
    /// Bars are drawn on standard error if that is a terminal and nobody asked to be `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self(Rc::new(RefCell::new(Stages {
            visible: !quiet && std::io::stderr().is_terminal(),
            running: Vec::new(),
            timings: Vec::new(),
            bar: ProgressBar::hidden(),
        })))
    }

    /// A listener for a context.
    pub fn sink(&self) -> impl FnMut(Event<'_>) + 'static {
        let stages = Rc::clone(&self.0);
        move |event| match event {
            Event::Begin(name) => stages.borrow_mut().begin(name),
            Event::Progress(fraction) => stages.borrow_mut().advance(fraction),
            Event::End(_) => stages.borrow_mut().end(),
        }
    }

    /// What the run took so far.
    pub fn report(&self) -> RunReport {
        RunReport {
            timings: self.0.borrow().timings.clone(),
            threads: rayon::current_num_threads(),
            peak_memory: peak_memory(),
        }
    }
}

impl Stages {
    fn begin(&mut self, name: &str) {
        if self.running.is_empty() {
            self.bar = self.new_bar(name);
        } else {
            self.bar.set_message(name.to_owned());
        }
        let outer = self.running.last();
        let stage = outer.map_or(name.to_owned(), |(i, _)| {
            format!("{}/{name}", self.timings[*i].stage)
        });
        let known = self.timings.iter().position(|t| t.stage == stage);
        let index = known.unwrap_or(self.timings.len());
        if known.is_none() {
            self.timings.push(Timing {
                stage,
                runs: 0,
                seconds: 0.0,
            });
        }
        self.running.push((index, Instant::now()));
    }

    fn advance(&mut self, fraction: f64) {
        // An inner stage would set the outer one's bar back.
        let position = (fraction * STEPS as f64) as u64;
        if self.running.len() == 1 || position > self.bar.position() {
            self.bar.set_position(position);
        }
    }

    fn end(&mut self) {
        let Some((index, begun)) = self.running.pop() else {
            return;
        };
        let seconds = begun.elapsed().as_secs_f64();
        let timing = &mut self.timings[index];
        timing.runs += 1;
        timing.seconds += seconds;
        self.bar.set_message("");
        if self.running.is_empty() {
            self.bar.finish_and_clear();
            // What took no time is not worth a line.
            if self.visible && seconds >= 0.05 {
                terminal::note(&format!(
                    "{:>14}  {seconds:.1} s",
                    self.timings[index].stage
                ));
            }
        }
    }

    fn new_bar(&self, name: &str) -> ProgressBar {
        if !self.visible {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr());
        let style = ProgressStyle::with_template("{prefix:>14}  {bar:30} {msg}");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.set_prefix(name.to_owned());
        bar.enable_steady_tick(Duration::from_millis(200));
        bar
    }
}

/// The largest resident memory so far, bytes, where the system has a /proc that tells.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().trim_end_matches(" kB").trim().parse().ok()?;
    Some(kib * 1024)
}
