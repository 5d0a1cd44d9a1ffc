//! Pictures of drawings: outlines with their lines and their mirror images, transformation space as angle and
//! distance of the line (figure 2), the pairs and the spine, the mesh inside.

mod panel;
mod votes;

use crate::cluster::Projection;
use crate::context::Context;
use crate::deform::Igarashi;
use crate::error::Result;
use crate::job::pictures::plots::{self, plot_title};
use crate::job::{Detected, Measured, Symmetrized};
use crate::optimize::orbit::{Goal, Orbit};
use crate::optimize::outcome::mirrors;
use crate::optimize::schedule::Settings;
use crate::optimize::{OptimizeParams, optimize};
use crate::patch::Symmetry;
use crate::picture::Canvas;
use crate::picture::canvas::{GREY, INK, Text};
use crate::shape::wall::Wall;
use crate::shape::working::Working;
use crate::transform::Isometry;
use panel::{Frame, Panel};
use votes::density;

/// Side of a panel and the room for the page's title, pixels.
const SIDE: u32 = 460;
const HEAD: u32 = 64;

/// The run of a drawing: input above result, each with transformation space.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub(super) fn before_after(
    job: &Symmetrized,
    title: &str,
    figures: &str,
) -> Result<Option<Canvas>> {
    let Some(wall) = &job.before.wall else {
        return Ok(None);
    };
    if let Some(goal) = job.goals.iter().find(|g| !has_lines(g)) {
        return copies(job, wall, goal, [title, figures]).map(Some);
    }
    let contracted = contracted(job, wall)?;
    let rows = 1 + u32::from(contracted.is_some()) + u32::from(job.after.is_some());
    let mut page = titled(rows, [title, figures]);
    let bandwidth = job.report.head.params.cluster.bandwidth;
    let frame = Frame::around(wall);
    let place = |column: u32, row: u32| [column * SIDE, HEAD + row * SIDE];

    let mut panel = Panel::new(
        &mut page,
        place(0, 0),
        frame,
        "input, its lines and mirror image",
    );
    panel.state(&job.before, wall, Some(job.planes[0]));
    density(&job.before, bandwidth).draw(&mut page, place(1, 0), "before");
    let body = Igarashi::new(wall.clone())?;
    let mut panel = Panel::new(&mut page, place(2, 0), frame, "");
    match &job.bend {
        Some(bent) => panel.field(&job.before, wall, &bent.bend),
        None => panel.mesh(
            &body.sheet().surface.triangles,
            &body.sheet().surface.positions,
        ),
    }
    let after = job.after.as_ref().map(|after| (after, Some(job.planes[1])));
    let states = [
        (
            contracted.as_ref().map(|state| (state, None)),
            ["contracted: each line for its part", "contracted"],
        ),
        (after, ["result and its mirror image", "after"]),
    ];
    let states = states
        .into_iter()
        .filter_map(|(state, captions)| Some((state?, captions)));
    for (row, ((state, image), captions)) in (1..).zip(states) {
        let Some(moved) = &state.wall else { continue };
        let frame = Frame::around(moved).as_large_as(&frame);
        let mut panel = Panel::new(&mut page, place(0, row), frame, captions[0]);
        panel.state(state, moved, image);
        density(state, bandwidth).draw(&mut page, place(1, row), captions[1]);
        let inside = body.filled(&state.working.surface.positions)?;
        let mut panel = Panel::new(&mut page, place(2, row), frame, "");
        panel.mesh(&body.sheet().surface.triangles, &inside);
    }
    Ok(Some(page))
}

/// A page of three columns with a title and a line of figures.
fn titled(rows: u32, [title, figures]: [&str; 2]) -> Canvas {
    let mut page = Canvas::new(3 * SIDE, HEAD + rows * SIDE);
    let width = f64::from(page.width()) - 32.0;
    page.text(Text::new(title, 16.0, 28.0, 20.0).bold().within(width));
    let figures = Text::new(figures, 16.0, 52.0, 14.0).colored(GREY);
    page.text(figures.within(width));
    page
}

/// Whether there are reflections among what is made exact together, as there are in no row and in no copies.
fn has_lines(goal: &Goal) -> bool {
    matches!(&goal.orbit, Orbit::Group(elements) if elements.iter().any(Isometry::is_improper))
}

/// The run of a drawing whose copies were made alike: input above result, each with the first copy carried onto the others and
/// the votes for such motions.
fn copies(job: &Symmetrized, wall: &Wall, goal: &Goal, titles: [&str; 2]) -> Result<Canvas> {
    let states = std::iter::once((&job.before, ["input, one copy on the others", "before"]));
    let after = job.after.as_ref();
    let states = states.chain(after.map(|s| (s, ["result, one copy on the others", "after"])));
    let mut page = titled(1 + u32::from(after.is_some()), titles);
    let frame = Frame::around(wall);
    let mut members = job.before.symmetries().iter();
    let member = members.find(|s| goal.symmetries.contains(&s.id));
    let mut clouds = job.before.detection.clouds.iter();
    let cloud = clouds.position(|c| member.is_some_and(|s| s.class == c.class));
    let body = Igarashi::new(wall.clone())?;
    for (row, (state, captions)) in (0..).zip(states) {
        let Some(moved) = &state.wall else { continue };
        let place = |column: u32| [column * SIDE, HEAD + row * SIDE];
        let mut panel = Panel::new(&mut page, place(0), frame, captions[0]);
        panel.copies(&job.before, moved, goal);
        if let Some(cloud) = cloud {
            let points = job.before.detection.clouds[cloud].votes.points();
            let votes = plots::Votes::new(state, cloud, &job.before, &Projection::new(points));
            let bandwidth = job.report.head.params.cluster.bandwidth;
            let [x, y] = place(1);
            votes
                .plot(bandwidth, None, captions[1])
                .draw(&mut page, x, y, SIDE);
        }
        let inside = body.filled(&state.working.surface.positions)?;
        let mut panel = Panel::new(&mut page, place(2), frame, "");
        panel.mesh(&body.sheet().surface.triangles, &inside);
    }
    Ok(page)
}

/// The state of figure 2 between input and result, where the result went another way: a bent shape whose lines have
/// been contracted, each for the part that it holds for, and not been merged.
fn contracted(job: &Symmetrized, wall: &Wall) -> Result<Option<Detected>> {
    let undone = job.bend.as_ref().is_some_and(|b| b.straight.is_some());
    if !undone || mirrors(&job.before.detection).next().is_none() {
        return Ok(None);
    }
    let params = &job.report.head.params;
    let detect = params.detect().mirrors_only();
    let settings = Settings {
        wall: Some(wall),
        stiffness: None,
        region: None,
        part: false,
        detect: &detect,
        deform: &params.deform,
        optimize: &OptimizeParams {
            merge_angle: 0.0,
            final_steps: 0,
            finish_rounds: 0,
            ..params.optimize.clone()
        },
    };
    let mut ctx = Context::new(job.report.head.seed);
    let before = &job.before;
    let surface = &before.working.surface;
    let done = optimize(surface, &before.detection, settings, &mut ctx)?;
    let working = Working {
        surface: surface.with_positions(done.positions.clone()),
        ..before.working.clone()
    };
    let state = (working, Some(wall.moved(done.positions)));
    let diagonal = before.diagonal * before.working.normalization.scale;
    Detected::find(state, diagonal, &detect, &mut ctx).map(Some)
}

/// A drawing with the lines that were found.
pub(super) fn found(found: &Detected, title: &str) -> Option<Canvas> {
    let wall = found.wall.as_ref()?;
    let mut page = Canvas::new(2 * SIDE, HEAD + SIDE);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(2 * SIDE) - 32.0),
    );
    let first = mirrors(&found.detection).next().map(Symmetry::plane);
    let mut panel = Panel::new(&mut page, [0, HEAD], Frame::around(wall), "");
    panel.state(found, wall, first);
    density(found, crate::cluster::ClusterParams::default().bandwidth).draw(
        &mut page,
        [SIDE, HEAD],
        "",
    );
    Some(page)
}

/// A drawing with the line that was measured.
pub(super) fn measured(measured: &Measured, title: &str, line: bool) -> Option<Canvas> {
    let wall = measured.wall.as_ref()?;
    let mut page = Canvas::new(SIDE, HEAD + SIDE);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(SIDE) - 32.0),
    );
    let mut panel = Panel::new(&mut page, [0, HEAD], Frame::around(wall), "");
    panel.outline(wall);
    if line {
        panel.image(wall, &measured.asymmetry.plane);
        panel.line(&measured.asymmetry.plane, INK, 1.5);
    }
    Some(page)
}

/// The plot of transformation space alone.
pub(super) fn plotted(found: &Detected, bandwidth: f64, title: &str) -> Option<Canvas> {
    found.wall.as_ref()?;
    let side = 2 * SIDE;
    let mut page = Canvas::new(side, HEAD + side);
    page.text(
        Text::new(title, 16.0, 28.0, 20.0)
            .bold()
            .within(f64::from(side) - 32.0),
    );
    let votes = density(found, bandwidth);
    let title = plot_title(found, 0);
    votes.plot(&title).draw(&mut page, 0, HEAD, side);
    Some(page)
}
