//! How long a whole run on a bent shape takes, stage by stage.

use std::time::Instant;

use symmetrizer::context::{CancelToken, Event};
use symmetrizer::shape::io;
use symmetrizer::{Context, Mesh, Params, Result, symmetrize};

use crate::data;
use crate::tables::{Table, median, number};

/// Runs of which the median counts.
const RUNS: usize = 3;

/// Seconds of the stages of a run on the bunny, file reading and writing not included.
///
/// # Errors
/// Test data that is missing or damaged; those of a run.
pub fn table() -> Result<Table> {
    let mesh = io::read(&data::root()?.join("3d/bunny.obj"))?.mesh;
    let runs = (0..RUNS).map(|_| stages(&mesh));
    let runs: Vec<Vec<(String, f64)>> = runs.collect::<Result<_>>()?;
    let mut table = Table::new(["bunny", "seconds"]);
    for (k, (stage, _)) in runs[0].iter().enumerate() {
        let seconds = median(runs.iter().map(|run| Some(run[k].1)));
        table.row([stage.clone(), number(seconds, 2)]);
    }
    Ok(table)
}

/// The outermost stages of one run in order, and the whole.
fn stages(mesh: &Mesh) -> Result<Vec<(String, f64)>> {
    let start = Instant::now();
    let mut open: Vec<Instant> = Vec::new();
    let mut stages = Vec::new();
    let sink = |event: Event<'_>| match event {
        Event::Begin(_) => open.push(Instant::now()),
        Event::End(name) => {
            let begun = open.pop();
            if let (Some(begun), true) = (begun, open.is_empty()) {
                stages.push((name.to_string(), begun.elapsed().as_secs_f64()));
            }
        }
        Event::Progress(_) => {}
    };
    let mut ctx = Context::with_sink(0, CancelToken::default(), sink);
    symmetrize(mesh, &Params::default(), &mut ctx)?;
    drop(ctx);
    stages.push(("all".to_string(), start.elapsed().as_secs_f64()));
    Ok(stages)
}
