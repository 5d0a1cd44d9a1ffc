//! The bend of a job: partners in the same colours, the local mirrors along the spine, how far they are
//! trusted, and the shape before, straight, and as it came out.

mod chart;
mod slices;
mod views;

use std::borrow::Cow;

use crate::error::Result;
use crate::field::Reach;
use crate::field::grow::Land;
use crate::field::trust::Verdict;
use crate::geom::{Point, Vector};
use crate::job::Symmetrized;
use crate::job::bent::REACH;
use crate::picture::{Canvas, Cell, Checks, Row, Rows, Scene, Tile, View};
use crate::report::BendReport;
use crate::shape::{ClosestPoint, Surface};
use crate::straighten::blend::Blend;
use crate::straighten::{Straightened, straighten};

pub use chart::Chart;
use slices::{Mirrors, Slices};

/// The colours of trusted samples, of those that are not, and of those without a partner; sRGB, told apart
/// by the colour-blind too.
const TRUSTED: [u8; 3] = [66, 133, 190];
const DOUBTED: [u8; 3] = [230, 140, 30];
const ALONE: [u8; 3] = [150, 150, 152];
/// The colour below mirrors.
const PALE: [u8; 3] = [222, 219, 214];
/// Squares along the shape.
const SQUARES: f64 = 18.0;

/// The rows about the bend of `job`; none where it has none.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn rows(job: &Symmetrized) -> Result<Option<Canvas>> {
    let Some(shown) = Shown::new(job)? else {
        return Ok(None);
    };
    let pairs = Checks {
        places: &shown.chart.places,
        side: 1.0 / SQUARES,
    };
    let trust = shown.trust_colors();
    let pale = vec![unit(PALE); shown.input().positions.len()];
    let states = shown.states();
    let mut rows = vec![
        shown.pairs(pairs),
        shown.planes(&pale, &states[0]),
        shown.confidence(&trust),
    ];
    if shown.report.verdict != Verdict::Refuse {
        rows.extend(shown.poses(&pale, &states));
    }
    let page = Rows {
        title: format!("Bend: {}", verdict(shown.report.verdict)),
        lines: vec![figures(shown.report), shown.made()],
        rows,
    };
    Ok(Some(page.canvas()))
}

/// The places by which the pairs of the bend of `job` are coloured; none where it has none.
///
/// # Errors
/// [`crate::Error::Numerical`].
pub fn chart(job: &Symmetrized) -> Result<Option<Chart>> {
    Ok(Shown::new(job)?.map(|shown| shown.chart))
}

/// A bend and what is drawn of it.
struct Shown<'a> {
    job: &'a Symmetrized,
    bent: &'a crate::job::Bent,
    report: &'a BendReport,
    blend: Blend,
    /// The input without the bend, whether or not the job has undone it.
    straight: Cow<'a, Straightened>,
    chart: Chart,
    slices: Slices,
    views: [(&'static str, View); 3],
}

/// A state of the shape with the mirrors along its spine.
struct State {
    name: String,
    surface: Surface,
    tiles: Vec<Tile>,
    spine: Vec<Point>,
}

impl<'a> Shown<'a> {
    fn new(job: &'a Symmetrized) -> Result<Option<Self>> {
        let (Some(bent), Some(report)) = (&job.bend, &job.report.bend) else {
            return Ok(None);
        };
        let input = &job.before.working.surface;
        let samples = &bent.samples;
        let straight = match &bent.straight {
            Some(straight) => Cow::Borrowed(straight),
            None => {
                let reach = Reach::new(samples, REACH);
                let closest = ClosestPoint::new(input);
                let land = Land::new(input, &closest, samples, &reach);
                Cow::Owned(straighten(&land, &bent.bend)?)
            }
        };
        let surface = input.with_positions(straight.positions.clone());
        let blend = Blend::new(input, samples);
        let chart = Chart::new(&bent.bend, samples, &surface, &straight.plane, &blend);
        let slices = Slices::new(&bent.bend, samples, &surface, &chart);
        let normals = bent.bend.turns.iter().map(|t| t.transpose() * Vector::x());
        let normals: Vec<Vector> = normals.collect();
        let views = views::views(&straight, &normals);
        Ok(Some(Self {
            job,
            bent,
            report,
            blend,
            straight,
            chart,
            slices,
            views,
        }))
    }

    fn input(&self) -> &Surface {
        &self.job.before.working.surface
    }

    fn pairs<'b>(&'b self, checks: Checks<'b>) -> Row<'b> {
        let scene = Scene {
            checks: Some(checks),
            ..self.scene(self.input())
        };
        let note = "partners have the same colour and lie in the same square, so the squares of both sides \
                    meet at the middle; grey: no partner";
        Row {
            name: "pairs".into(),
            note: vec![(note.into(), None)],
            cells: self.cells(scene, &[]),
        }
    }

    fn planes<'b>(&'b self, pale: &'b [[f32; 3]], input: &'b State) -> Row<'b> {
        let scene = Scene {
            colors: Some(pale),
            tiles: &input.tiles,
            ..self.scene(self.input())
        };
        let note = "the local mirrors along the spine, coloured as the pairs they are for; dark: the middles \
                    of these pairs";
        Row {
            name: "mirrors".into(),
            note: vec![(note.into(), None)],
            cells: self.cells(scene, &input.spine),
        }
    }

    fn confidence<'b>(&'b self, colors: &'b [[f32; 3]]) -> Row<'b> {
        let scene = Scene {
            colors: Some(colors),
            ..self.scene(self.input())
        };
        let trust = &self.bent.bend.trust;
        let partners = self.bent.bend.settled.partners.iter();
        let alone = partners.filter(|q| q.is_none()).count() as f64;
        let alone = alone / trust.trusted.len().max(1) as f64;
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        let doubted = (1.0 - trust.share - alone).max(0.0);
        let words = [
            (format!("trusted {}", percent(trust.share)), TRUSTED),
            (format!("not trusted {}", percent(doubted)), DOUBTED),
            (format!("no partner {}", percent(alone)), ALONE),
        ];
        Row {
            name: "confidence".into(),
            note: words.map(|(words, color)| (words, Some(color))).into(),
            cells: self.cells(scene, &[]),
        }
    }

    /// The states side by side, a row for each of two views.
    fn poses<'b>(&'b self, pale: &'b [[f32; 3]], states: &'b [State]) -> Vec<Row<'b>> {
        let row = |(name, view): &(&str, View)| Row {
            name: format!("poses, {name}"),
            note: Vec::new(),
            cells: states
                .iter()
                .map(|state| Cell {
                    caption: state.name.clone(),
                    scene: Scene {
                        colors: Some(pale),
                        tiles: &state.tiles,
                        ..self.scene(&state.surface)
                    },
                    view: *view,
                    line: &state.spine,
                })
                .collect(),
        };
        self.views[..2].iter().map(row).collect()
    }

    fn scene<'b>(&self, surface: &'b Surface) -> Scene<'b> {
        Scene {
            positions: &surface.positions,
            triangles: &surface.triangles,
            ..Scene::default()
        }
    }

    /// The same in all views.
    fn cells<'b>(&self, scene: Scene<'b>, line: &'b [Point]) -> Vec<Cell<'b>> {
        let cell = |(name, view): &(&str, View)| Cell {
            caption: (*name).into(),
            scene,
            view: *view,
            line,
        };
        self.views.iter().map(cell).collect()
    }

    fn trust_colors(&self) -> Vec<[f32; 3]> {
        let bend = &self.bent.bend;
        let states = bend.settled.partners.iter().zip(&bend.trust.trusted);
        let colors = states.map(|(partner, trusted)| match (partner, trusted) {
            (None, _) => ALONE,
            (_, true) => TRUSTED,
            (_, false) => DOUBTED,
        });
        let colors: Vec<Vector> = colors.map(|c| Vector::from(c.map(f64::from))).collect();
        let means = self.blend.means(&colors);
        means
            .iter()
            .map(|c| [c.x, c.y, c.z].map(|c| c as f32 / 255.0))
            .collect()
    }

    /// Input, straight, and result where it was straightened.
    fn states(&self) -> Vec<State> {
        let input = self.input();
        let undone = self.bent.straight.is_some();
        let straight = if undone {
            "straightened"
        } else {
            "straightened, if accepted"
        };
        let positions = |x: &[Point]| input.with_positions(x.to_vec());
        let mut surfaces = vec![
            ("input".to_owned(), positions(&input.positions)),
            (straight.to_owned(), positions(&self.straight.positions)),
        ];
        if let Some(after) = self.job.after.as_ref().filter(|_| undone) {
            let surface = &after.working.surface;
            surfaces.push((self.result_name(), positions(&surface.positions)));
        }
        let states = surfaces.into_iter().enumerate();
        states
            .map(|(k, (name, surface))| {
                let mirrors = match (k, &self.report.kept) {
                    (0, _) => Mirrors::OfField,
                    (2, None) => Mirrors::In(self.job.planes[1]),
                    _ => Mirrors::WithPairs,
                };
                let (tiles, spine) = self.slices.tiles(&surface, mirrors);
                State {
                    name,
                    surface,
                    tiles,
                    spine,
                }
            })
            .collect()
    }

    fn result_name(&self) -> String {
        match &self.report.kept {
            Some(kept) => format!("result: symmetric, {:.0} degrees kept", kept.degrees),
            None => "result: symmetric".into(),
        }
    }

    /// What was made of the bend, or can be.
    fn made(&self) -> String {
        let report = self.report;
        let least = self.job.report.head.params.straighten.min_bend;
        match report.verdict {
            _ if self.bent.straight.is_some() => match &report.kept {
                Some(kept) => format!(
                    "{:.0} degrees removed, {:.0} kept: both sides are alike about the mirrors as they are \
                     bent then",
                    report.removed, kept.degrees
                ),
                None => format!("{:.0} degrees removed", report.removed),
            },
            Verdict::Refuse => "the bend was left alone".into(),
            _ if report.degrees < least => {
                format!("left alone: less than {least} degrees (straighten.min_bend)")
            }
            Verdict::Uncertain => {
                "the bend was left alone: where both sides of the pairs belong together, \
                 --accept-uncertain undoes it"
                    .into()
            }
            Verdict::Accept => "the bend was left alone".into(),
        }
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Accept => "symmetric about its bent axis",
        Verdict::Uncertain => "uncertain, perhaps symmetric about a bent axis",
        Verdict::Refuse => "refused, no symmetry about a bent axis that could be trusted",
    }
}

fn figures(report: &BendReport) -> String {
    format!(
        "score {:.2}   ·   {:.0} % of the surface trusted   ·   likeness of partners {:.2}   ·   local \
         mirrors turn by {:.0} degrees",
        report.score,
        100.0 * report.trusted,
        report.likeness,
        report.degrees
    )
}

fn unit(color: [u8; 3]) -> [f32; 3] {
    color.map(|c| f32::from(c) / 255.0)
}
