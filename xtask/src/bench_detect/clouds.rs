//! Point clouds with known planes, scored as the SHREC'23 track does, beside trivial finders.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::json;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::{Context, Mesh, Result};

use super::found::{Found, Symmetry};
use super::place::diagonal;
use super::planes::{Guess, Limits, Scores, TruePlane};
use super::trial::{Trial, Trials};
use super::trivial;
use crate::data;
use crate::tables::{Section, Table, Verdict, number};

/// A point cloud and its planes.
pub struct Cloud {
    name: String,
    family: String,
    perturbation: String,
    mesh: Mesh,
    planes: Vec<TruePlane>,
}

#[derive(Deserialize)]
struct Entry {
    id: u32,
    family: String,
    perturbation: String,
}

/// The scores of a finder within the wide and the narrow limits.
type Pair = [Scores; 2];

/// One cloud and seed: the scores of detection, of the principal planes, of a random plane.
#[derive(Serialize)]
struct Outcome {
    cloud: String,
    family: String,
    perturbation: String,
    seed: u64,
    error: Option<String>,
    guesses: usize,
    scores: [Pair; 3],
}

/// The finders, in the order of [`Outcome::scores`].
const FINDERS: [&str; 3] = ["detection", "principal planes", "random plane"];

/// Wide and narrow limits: degrees, fraction of D.
const LIMITS: [(f64, f64); 2] = [(5.0, 0.02), (1.0, 0.01)];

/// The clouds of `folder` whose names contain `only`, in the order of its index.
///
/// # Errors
/// Files that are missing or damaged.
pub fn read_all(folder: &Path, only: &str) -> Result<Vec<Cloud>> {
    let index: Vec<Entry> = data::json(&folder.join("index.json"))?;
    let named = index.into_iter().map(|e| (format!("points{}", e.id), e));
    let wanted = named.filter(|(name, _)| name.contains(only));
    wanted.map(|(name, e)| read(folder, name, e)).collect()
}

fn read(folder: &Path, name: String, entry: Entry) -> Result<Cloud> {
    let points = rows::<3>(&folder.join(format!("{name}.txt")), 0)?;
    let planes = rows::<6>(&folder.join(format!("{name}_sym.txt")), 1)?;
    let plane = |[a, b, c, x, y, z]: [f64; 6]| TruePlane {
        normal: Vector::new(a, b, c),
        point: Point::new(x, y, z),
    };
    Ok(Cloud {
        name,
        family: entry.family,
        perturbation: entry.perturbation,
        mesh: Mesh {
            positions: points.into_iter().map(Point::from).collect(),
            ..Mesh::default()
        },
        planes: planes.into_iter().map(plane).collect(),
    })
}

/// The lines of a file after the first `skip`, `N` numbers each.
fn rows<const N: usize>(path: &Path, skip: usize) -> Result<Vec<[f64; N]>> {
    let text = data::text(path)?;
    let row = |line: &str| {
        let words = line.split_whitespace().map(|word| word.parse().ok());
        let numbers: Option<Vec<f64>> = words.collect();
        <[f64; N]>::try_from(numbers?).ok()
    };
    let rows = text.lines().skip(skip).map(row);
    let rows: Option<Vec<[f64; N]>> = rows.collect();
    rows.ok_or_else(|| data::damaged(path, &format!("a line has not {N} numbers")))
}

/// Detection on the clouds; none where there are none.
pub fn section(clouds: &[Cloud], trials: &Trials) -> Option<Section> {
    let mut outcomes: Vec<Outcome> = Vec::new();
    for cloud in clouds {
        let trials = trials.run(&cloud.name, &cloud.mesh, 0.0);
        outcomes.extend(trials.iter().map(|trial| outcome(cloud, trial)));
    }
    let overall = means(outcomes.iter())?;
    let errors: Vec<&String> = outcomes.iter().filter_map(|o| o.error.as_ref()).collect();
    let mut notes = vec![
        "5/2: within 5 degrees and 2 % of D; 1/1: within 1 degree and 1 %".to_owned(),
        format!("errors {} of {}", errors.len(), outcomes.len()),
    ];
    notes.extend(errors.first().map(|e| format!("the first: {e}")));
    Some(Section {
        title: "point clouds".into(),
        tables: vec![finders(&overall), parts(&outcomes)],
        notes,
        verdicts: verdicts(&overall),
        figures: json!({ "finders": FINDERS, "limits": LIMITS, "overall": overall, "outcomes": outcomes }),
    })
}

fn outcome(cloud: &Cloud, trial: &Trial) -> Outcome {
    let points = &cloud.mesh.positions;
    let d = diagonal(&cloud.mesh);
    let found = guesses(&trial.found, points);
    let mut rng = Context::new(trial.seed).rng(&format!("random plane {}", cloud.name));
    let lists = [
        &found,
        &trivial::principal(points),
        &trivial::random(points, &mut rng),
    ];
    let limits = LIMITS.map(|(degrees, distance)| Limits::new(degrees, distance));
    Outcome {
        cloud: cloud.name.clone(),
        family: cloud.family.clone(),
        perturbation: cloud.perturbation.clone(),
        seed: trial.seed,
        error: trial.error.clone(),
        guesses: found.len(),
        scores: lists.map(|list| limits.map(|l| Scores::of(list, &cloud.planes, d, l))),
    }
}

/// The planes found, each by its point next to the cloud's centroid.
fn guesses(found: &Found, points: &[Point]) -> Vec<Guess> {
    let centroid = trivial::centroid(points);
    let with_plane = found.symmetries.iter().filter_map(|s| Some((s, s.plane?)));
    with_plane
        .map(|(symmetry, plane)| {
            let height = plane.normal.dot(&centroid.coords) - plane.offset;
            Guess {
                normal: plane.normal,
                point: centroid - plane.normal * height,
                confidence: confidence(symmetry),
            }
        })
        .collect()
}

/// How sure a find is: how much of the shape it holds for, and how well.
fn confidence(symmetry: &Symmetry) -> f64 {
    symmetry.area_fraction * (1.0 - symmetry.rms / 0.02)
}

/// The mean scores of each finder; none of no outcomes.
fn means<'a>(outcomes: impl Iterator<Item = &'a Outcome> + Clone) -> Option<[Pair; 3]> {
    let mut all = [Pair::default(); 3];
    for (finder, pair) in all.iter_mut().enumerate() {
        for (limits, mean) in pair.iter_mut().enumerate() {
            let scores = outcomes.clone().map(|o| o.scores[finder][limits]);
            *mean = Scores::mean(&scores.collect::<Vec<Scores>>())?;
        }
    }
    Some(all)
}

fn finders(overall: &[Pair; 3]) -> Table {
    let mut table = Table::new([
        "all clouds",
        "MAP 5/2",
        "MAPr 5/2",
        "PHC 5/2",
        "MAP 1/1",
        "MAPr 1/1",
        "PHC 1/1",
    ]);
    for (name, pair) in FINDERS.iter().zip(overall) {
        let [a, b, c, d, e, f] = cells(pair);
        table.row([(*name).to_owned(), a, b, c, d, e, f]);
    }
    table
}

/// MAP, MAPr and PHC within the wide limits, then within the narrow ones.
fn cells(pair: &Pair) -> [String; 6] {
    let [wide, narrow] = pair.map(|s| [s.map, s.map_recall, s.phc]);
    let [a, b, c] = wide.map(|x| number(Some(x), 3));
    let [d, e, f] = narrow.map(|x| number(Some(x), 3));
    [a, b, c, d, e, f]
}

/// The scores of detection by perturbation and by family, with the trivial ones' MAPr.
fn parts(outcomes: &[Outcome]) -> Table {
    let mut table = Table::new([
        "detection on",
        "runs",
        "MAP 5/2",
        "MAPr 5/2",
        "PHC 5/2",
        "MAP 1/1",
        "MAPr 1/1",
        "PHC 1/1",
        "principal MAPr 5/2",
    ]);
    let keys: [fn(&Outcome) -> &String; 2] = [|o| &o.perturbation, |o| &o.family];
    for key in keys {
        let mut values: Vec<&String> = outcomes.iter().map(key).collect();
        values.sort();
        values.dedup();
        for value in values {
            let mine = outcomes.iter().filter(|o| key(o) == value);
            let runs = mine.clone().count().to_string();
            if let Some(all) = means(mine) {
                let [a, b, c, d, e, f] = cells(&all[0]);
                let principal = number(Some(all[1][0].map_recall), 3);
                table.row([value.clone(), runs, a, b, c, d, e, f, principal]);
            }
        }
    }
    table
}

fn verdicts(overall: &[Pair; 3]) -> Vec<Verdict> {
    let [found, principal, random] = overall.map(|pair| pair[0].map_recall);
    let better = principal.max(random);
    let ratio = (better > 0.0).then_some(found / better);
    vec![
        Verdict::at_least("MAPr at 5 degrees, 2 % of D", Some(found), 0.8, ""),
        Verdict::at_least("times that of the better trivial finder", ratio, 2.0, ""),
    ]
}
