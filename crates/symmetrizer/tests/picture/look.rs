//! Pictures of real models for the eye: written where `SYMMETRIZER_PICTURES` names a folder.

use std::path::PathBuf;

use rand::Rng;
use symmetrizer::Context;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::{
    Angle, Background, Camera, ColorMap, ColorScale, DensityPlot, Extent, Panel, PlotMode,
    ReportPicture, ScalarField, Scene, Sheet, Stance, categorical, render, render_sheet,
};
use symmetrizer::transform::isometry::Plane;

use crate::models::{Model, load};

pub fn keep(name: &str, png: &[u8]) {
    if let Some(folder) = std::env::var_os("SYMMETRIZER_PICTURES") {
        std::fs::write(PathBuf::from(folder).join(name), png).unwrap();
    }
}

/// A model with a rough mirror plane through its centroid and a made-up asymmetry.
pub fn example(name: &str, normal: Vector) -> Option<(Model, Plane, Vec<f64>)> {
    let model = load(name)?;
    let plane = Plane::through(&model.centroid(), normal.normalize());
    let scalar = asymmetry(&model, &plane);
    Some((model, plane, scalar))
}

/// Something like an asymmetry: large on one side's far end.
fn asymmetry(model: &Model, plane: &Plane) -> Vec<f64> {
    let radius = model.radius_about(&model.centroid());
    let value = |p: &Point| {
        let d = plane.signed_distance(p) / radius;
        8.0 * d.max(0.0).powi(2) + 4.0 * (p.y / radius).max(0.0).powi(2)
    };
    model.positions.iter().map(value).collect()
}

#[test]
fn real_models_fill_their_pictures() {
    for (name, normal) in [
        ("bunny.obj", Vector::new(0.04, 0.01, 1.0)),
        ("cheburashka.obj", Vector::x()),
        ("spot_seams.obj", Vector::x()),
        ("homer.obj", Vector::x()),
    ] {
        let Some((model, plane, scalar)) = example(name, normal) else {
            return;
        };
        let stance = Stance::about(Some(&plane), &model.positions);
        let center = model.centroid();
        let radius = model.radius_about(&center);
        let scale = ColorScale {
            map: ColorMap::Heat,
            low: 0.0,
            high: 4.0,
        };
        let colors = scale.colors(&scalar);
        for angle in Angle::ALL {
            let camera = Camera::fit(stance.view(angle), center, radius, 500, 500);
            let scene = Scene {
                positions: &model.positions,
                triangles: &model.triangles,
                colors: (angle == Angle::Side).then_some(&colors),
                planes: &[(plane, categorical(0))],
                ..Scene::default()
            };
            let image = render(&scene, &camera, Background::White);
            let drawn = image.pixels().filter(|p| p.0 != [255; 4]).count();
            assert!(drawn > 500 * 500 / 20, "{name} {}: {drawn}", angle.name());
            let mut png = std::io::Cursor::new(Vec::new());
            image.write_to(&mut png, image::ImageFormat::Png).unwrap();
            keep(&format!("{name}-{}.png", angle.name()), png.get_ref());
        }
    }
}

/// Votes around two clusters, and scattered ones.
fn votes(spread: f64) -> (Vec<[f64; 2]>, Vec<f64>) {
    let mut rng = Context::new(5).rng("votes");
    let mut uniform = move || f64::from(rng.next_u32()) / f64::from(u32::MAX) - 0.5;
    let mut points = Vec::new();
    for i in 0..7000 {
        let (x, y, s) = match i % 10 {
            0..4 => (0.0, 0.0, spread),
            4..6 => (0.35, 0.2, spread),
            _ => (0.1, 0.0, 1.2),
        };
        let mut round = || s * (uniform() + uniform() + uniform());
        points.push([x + round(), y + round()]);
    }
    let weights = (0..7000).map(|i| 1.0 + f64::from(i % 3)).collect();
    (points, weights)
}

fn modes() -> Vec<PlotMode> {
    let mode = |position, label: &str, height, color| PlotMode {
        position,
        label: label.into(),
        height,
        color,
    };
    vec![
        mode([0.0, 0.0], "body", 10.8, 0),
        mode([0.35, 0.2], "head", 3.2, 1),
        mode([0.3, 0.24], "ear", 0.8, 2),
        mode([-0.6, -0.5], "3", 0.3, 3),
    ]
}

#[test]
fn a_density_plot_to_look_at() {
    let (points, weights) = votes(0.1);
    let modes = modes();
    let plot = DensityPlot {
        shown: Default::default(),
        points: &points,
        weights: &weights,
        modes: &modes,
        bandwidth: 0.05,
        axes: None,
        title: "bunny.obj: 7,000 votes",
    };
    let png = plot.to_png(600).unwrap();
    assert!(png.len() > 10_000);
    keep("density.png", &png);
    keep("density.svg", plot.to_svg(600).unwrap().as_bytes());
}

#[test]
fn a_report_and_a_sheet_to_look_at() {
    for (name, normal) in [
        ("bunny.obj", Vector::new(0.04, 0.01, 1.0)),
        ("homer.obj", Vector::x()),
        ("spot_seams.obj", Vector::x()),
    ] {
        let Some((model, plane, scalar)) = example(name, normal) else {
            return;
        };
        report_picture(name, &model, plane, &scalar);
        sheet_picture(name, &model, plane, &scalar);
    }
}

fn report_picture(name: &str, model: &Model, plane: Plane, scalar: &[f64]) {
    let head = Plane::through(&model.centroid(), Vector::new(0.83, 0.15, 0.54).normalize());
    let (before, after) = (votes(0.1), votes(0.02));
    let modes = modes();
    let axes = Some(Extent::around(&before.0, 0.03));
    let plot = |points, weights, modes| DensityPlot {
        shown: Default::default(),
        points,
        weights,
        modes,
        bandwidth: 0.05,
        axes,
        title: "",
    };
    let calm: Vec<f64> = scalar.iter().map(|s| 0.05 * s).collect();
    let squeezed = model.map(|p| p - plane.normal * (0.1 * plane.signed_distance(p)));
    let planes = [(plane, categorical(0)), (head, categorical(1))];
    let has_plot = name == "bunny.obj";
    let picture = ReportPicture {
        title: name,
        subtitle: "mean asymmetry 2.03 % → 0.08 % of D   ·   99th percentile 16.0 % → 0.6 %   ·   2 symmetries",
        before: Panel {
            positions: &model.positions,
            scalar,
            planes: &planes,
            density: has_plot.then(|| plot(&before.0, &before.1, &modes)),
        },
        after: Panel {
            positions: &squeezed.positions,
            scalar: &calm,
            planes: &planes[..1],
            density: has_plot.then(|| plot(&after.0, &after.1, &modes[..1])),
        },
        triangles: &model.triangles,
        scale_max: Some(6.0),
        scale_label: "asymmetry, % of D",
    };
    let png = picture.to_png().unwrap();
    keep(&format!("{name}-report.png"), &png);
}

fn sheet_picture(name: &str, model: &Model, plane: Plane, scalar: &[f64]) {
    let sheet = Sheet {
        title: name,
        positions: &model.positions,
        triangles: &model.triangles,
        scalar: (name == "homer.obj").then_some(ScalarField {
            values: scalar,
            max: None,
            label: "asymmetry, % of D",
        }),
        planes: &[(plane, categorical(0))],
        upright: None,
        angles: &Angle::ALL,
        size: [340, 360],
    };
    keep(
        &format!("{name}-sheet.png"),
        &render_sheet(&sheet).to_png().unwrap(),
    );
}
