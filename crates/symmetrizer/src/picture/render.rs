//! Draws a triangle mesh as matte clay, with colours and mirror planes.

use image::{Rgba, RgbaImage};
use rayon::prelude::*;

use crate::geom::{Point, Vector};
use crate::picture::camera::{Camera, unit};
use crate::picture::checks::Checks;
use crate::picture::light::{Surroundings, shade, to_linear, to_srgb};
use crate::picture::normals::corner_normals;
use crate::picture::planes::{Layer, Sheet, Tile};
use crate::picture::visible::{Sights, barycentric};
use crate::transform::isometry::Plane;

/// Samples per pixel, each way.
const SAMPLES: u32 = 2;
/// The colour of plain clay, sRGB.
pub const CLAY: [f32; 3] = [0.86, 0.82, 0.775];
/// How far occluders darken the clay, as a share of the picture's shorter side.
const REACH: f64 = 0.055;

/// Half the width of the outlines of planes and of tiles, pixels.
const PLANE_LINE: f64 = 0.85;
const TILE_LINE: f64 = 1.3;

/// What is behind the shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Background {
    /// Opaque white.
    #[default]
    White,
    /// Nothing: the picture has an alpha channel.
    Transparent,
}

/// What to draw. Triangles that name missing vertices or have coordinates that are not finite are
/// left out.
#[derive(Debug, Clone, Copy, Default)]
pub struct Scene<'a> {
    /// Vertex positions, model units.
    pub positions: &'a [Point],
    /// Vertex indices of each triangle.
    pub triangles: &'a [[u32; 3]],
    /// sRGB colour of each vertex in 0..=1, or plain clay; a missing entry is clay too.
    pub colors: Option<&'a [[f32; 3]]>,
    /// A pattern that takes the place of the colours.
    pub checks: Option<Checks<'a>>,
    /// Mirror planes with their sRGB colours.
    pub planes: &'a [(Plane, [u8; 3])],
    /// Pieces of planes.
    pub tiles: &'a [Tile],
}

/// The picture of `scene` that `camera` sees, 2 x 2 samples to a pixel.
pub fn render(scene: &Scene<'_>, camera: &Camera, background: Background) -> RgbaImage {
    let painter = Painter::new(scene, camera);
    let (width, height) = (camera.width(), camera.height());
    let rows: Vec<Vec<Rgba<u8>>> = (0..height)
        .into_par_iter()
        .map(|y| {
            (0..width)
                .map(|x| painter.pixel(x, y, background))
                .collect()
        })
        .collect();
    RgbaImage::from_fn(width, height, |x, y| rows[y as usize][x as usize])
}

/// Linear premultiplied colour to a pixel.
fn encode(color: [f64; 4], background: Background) -> Rgba<u8> {
    let alpha = color[3].clamp(0.0, 1.0);
    let byte = |v: f64| (v * 255.0).round() as u8;
    let [r, g, b, _] = match background {
        Background::White => color.map(|c| byte(to_srgb(c + 1.0 - alpha))),
        Background::Transparent => color.map(|c| byte(to_srgb(c / alpha.max(1e-9)))),
    };
    let a = match background {
        Background::White => 255,
        Background::Transparent => byte(alpha),
    };
    Rgba([r, g, b, a])
}

struct Painter<'a> {
    scene: &'a Scene<'a>,
    triangles: Vec<[u32; 3]>,
    projected: Vec<Vector>,
    normals: Vec<[Vector; 3]>,
    sights: Sights,
    sheets: Vec<Sheet>,
    surroundings: Surroundings,
}

impl<'a> Painter<'a> {
    fn new(scene: &'a Scene<'a>, camera: &Camera) -> Self {
        let camera = camera.finer(SAMPLES);
        let projected: Vec<Vector> = scene.positions.iter().map(|p| camera.project(p)).collect();
        let drawable = |v: &u32| {
            let p = projected.get(*v as usize);
            // Beyond 1e9 samples the arithmetic of the fill would lose whole samples.
            p.is_some_and(|p| p.iter().all(|c| c.abs() < 1e9))
        };
        let triangles: Vec<[u32; 3]> = scene
            .triangles
            .iter()
            .filter(|t| t.iter().all(drawable))
            .copied()
            .collect();
        let shorter = f64::from(camera.width().min(camera.height()));
        let samples = Sights::new(
            camera.width() as usize,
            camera.height() as usize,
            &projected,
            &triangles,
        );
        Self {
            normals: picture_normals(&projected, &triangles),
            sheets: sheets(scene, &camera, &triangles),
            scene,
            triangles,
            projected,
            sights: samples,
            surroundings: Surroundings::new(REACH * shorter),
        }
    }

    fn pixel(&self, x: u32, y: u32, background: Background) -> Rgba<u8> {
        let mut sum = [0.0; 4];
        for sy in 0..SAMPLES {
            for sx in 0..SAMPLES {
                let sample = self.sample((x * SAMPLES + sx) as usize, (y * SAMPLES + sy) as usize);
                sum = std::array::from_fn(|i| sum[i] + sample[i]);
            }
        }
        encode(sum.map(|c| c / f64::from(SAMPLES * SAMPLES)), background)
    }

    /// The linear premultiplied colour of a sample.
    fn sample(&self, x: usize, y: usize) -> [f64; 4] {
        let sight = self.sights.at(x, y);
        let at = Vector::new(x as f64 + 0.5, y as f64 + 0.5, sight.depth());
        if !sight.hits() {
            return self.behind_sheets(&at, [0.0; 4]);
        }
        let [r, g, b] = self.clay(x, y, sight.face as usize);
        let cuts = self.sheets.iter().filter_map(|s| s.cut(&at));
        let surface = cuts.fold([r, g, b, 1.0], |below, cut| over(&cut, below));
        self.behind_sheets(&at, surface)
    }

    /// The colour of what is seen at `at` through the sheets in front of it.
    fn behind_sheets(&self, at: &Vector, color: [f64; 4]) -> [f64; 4] {
        let mut layers: Vec<Layer> = self
            .sheets
            .iter()
            .filter_map(|s| s.layer(at.x, at.y))
            .filter(|l| l.depth < at.z)
            .collect();
        layers.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        layers.iter().fold(color, |below, layer| over(layer, below))
    }

    /// The shaded surface at a sample that sees `face`.
    fn clay(&self, x: usize, y: usize, face: usize) -> [f64; 3] {
        let t = self.triangles[face];
        let corners = t.map(|v| self.projected[v as usize]);
        let b = barycentric(&corners, x as f64 + 0.5, y as f64 + 0.5);
        let normal = self.normal(face, &corners, &b);
        let albedo = match &self.scene.checks {
            Some(checks) => checks.color(&mix(t, &b, |v| checks.place(v))),
            None => mix(t, &b, |v| self.color(v).map(f64::from)),
        };
        let open = self.surroundings.openness(&self.sights, x, y, &normal);
        shade(&normal, albedo.map(|a| to_linear(a.clamp(0.0, 1.0))), open)
    }

    fn color(&self, vertex: usize) -> [f32; 3] {
        let color = self.scene.colors.and_then(|c| c.get(vertex));
        color
            .copied()
            .unwrap_or(CLAY)
            .map(|c| if c.is_finite() { c } else { 0.5 })
    }

    /// The interpolated normal in camera axes, on the side of the face that the eye sees.
    fn normal(&self, face: usize, corners: &[Vector; 3], b: &[f64; 3]) -> Vector {
        let [m0, m1, m2] = self.normals[face];
        let mut n = m0 * b[0] + m1 * b[1] + m2 * b[2];
        let [p, q, r] = corners;
        // Sample rows count downwards, so a face towards the eye runs clockwise there.
        if (q - p).cross(&(r - p)).z > 0.0 {
            n = -n;
        }
        // At a silhouette the smooth normal may point just beyond it.
        n.z = n.z.max(0.0);
        unit(n).unwrap_or_else(Vector::z)
    }
}

/// Barycentric mean of what the corners have.
fn mix(t: [u32; 3], b: &[f64; 3], of: impl Fn(usize) -> [f64; 3]) -> [f64; 3] {
    let [p, q, r] = t.map(|v| of(v as usize));
    std::array::from_fn(|i| b[0] * p[i] + b[1] * q[i] + b[2] * r[i])
}

/// Corner normals in camera axes, from vertices in sample coordinates.
fn picture_normals(projected: &[Vector], triangles: &[[u32; 3]]) -> Vec<[Vector; 3]> {
    let points: Vec<Point> = projected
        .iter()
        .map(|p| Point::new(p.x, -p.y, -p.z))
        .collect();
    corner_normals(&points, triangles)
}

fn sheets(scene: &Scene<'_>, camera: &Camera, triangles: &[[u32; 3]]) -> Vec<Sheet> {
    let used: Vec<Point> = triangles
        .iter()
        .flatten()
        .map(|&v| scene.positions[v as usize])
        .collect();
    let half = |line: f64| line * f64::from(SAMPLES);
    let planes = scene
        .planes
        .iter()
        .filter_map(|(plane, color)| Sheet::new(plane, *color, &used, camera, half(PLANE_LINE)));
    let tiles = scene.tiles.iter();
    let tiles = tiles.filter_map(|tile| Sheet::over(tile, camera, half(TILE_LINE)));
    planes.chain(tiles).collect()
}

fn over(layer: &Layer, below: [f64; 4]) -> [f64; 4] {
    let [r, g, b] = layer.color.map(|c| c * layer.opacity);
    let top = [r, g, b, layer.opacity];
    std::array::from_fn(|i| top[i] + below[i] * (1.0 - layer.opacity))
}
