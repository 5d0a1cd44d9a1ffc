//! The renderer: areas, symmetry, planes, odd input, determinism.

use image::RgbaImage;
use symmetrizer::geom::{Point, Vector};
use symmetrizer::picture::{Background, Camera, Scene, View, categorical, render};
use symmetrizer::transform::isometry::Plane;

use crate::models::{Model, sphere};

fn scene(model: &Model) -> Scene<'_> {
    Scene {
        positions: &model.positions,
        triangles: &model.triangles,
        ..Scene::default()
    }
}

fn front(width: u32, height: u32, radius: f64) -> Camera {
    let view = View::new(-Vector::z(), Vector::y());
    Camera::fit(view, Point::origin(), radius, width, height)
}

/// The area that the shape covers, pixels.
fn covered(image: &RgbaImage) -> f64 {
    image.pixels().map(|p| f64::from(p.0[3]) / 255.0).sum()
}

/// A round body with one ear on each side, mirror-symmetric in x, different front and back.
fn eared() -> Model {
    let ball = sphere(24);
    let ear = |side: f64| {
        ball.map(move |p| Point::new(side * (0.7 + 0.4 * p.x), 0.9 + 0.6 * p.y, 0.3 + 0.2 * p.z))
    };
    ball.clone().and(&ear(1.0)).and(&ear(-1.0))
}

#[test]
fn a_sphere_covers_the_area_of_its_disc() {
    let model = sphere(90);
    let camera = front(200, 160, 1.0);
    let image = render(&scene(&model), &camera, Background::Transparent);
    let radius = camera.pixels_per_unit();
    let expected = std::f64::consts::PI * radius * radius;
    assert!((covered(&image) / expected - 1.0).abs() < 0.005);
    assert!(
        radius < 80.0 && radius > 70.0,
        "the sphere fits with a small margin"
    );
}

#[test]
fn a_symmetric_shape_seen_edge_on_is_a_symmetric_picture() {
    let model = eared();
    let image = render(&scene(&model), &front(160, 120, 2.0), Background::White);
    let mirrored = image::imageops::flip_horizontal(&image);
    let different = image
        .pixels()
        .zip(mirrored.pixels())
        .filter(|(a, b)| (0..3).any(|i| a.0[i].abs_diff(b.0[i]) > 3))
        .count();
    // Vertices mirrored with a rounding error may flip a sample on a silhouette.
    assert!(different < 30, "{different} pixels differ");
    let tipped = model.map(|p| Point::new(p.x + 0.1 * p.y, p.y, p.z));
    let image = render(&scene(&tipped), &front(160, 120, 2.0), Background::White);
    let mirrored = image::imageops::flip_horizontal(&image);
    assert_ne!(image, mirrored);
}

#[test]
fn a_smooth_sphere_has_no_facets() {
    let image = render(
        &scene(&sphere(40)),
        &front(200, 200, 1.0),
        Background::White,
    );
    let jump = |a: u32, b: u32| {
        let (p, q) = (image.get_pixel(a, 100).0, image.get_pixel(b, 100).0);
        p[0].abs_diff(q[0])
    };
    assert!((30..170).all(|x| jump(x, x + 1) <= 4));
}

#[test]
fn a_plane_in_front_tints_and_a_plane_behind_does_not() {
    let model = sphere(24);
    let camera = front(100, 100, 1.5);
    let pixel = |offset: f64, x: u32| {
        let planes = [(
            Plane {
                normal: Vector::z(),
                offset,
            },
            categorical(0),
        )];
        let scene = Scene {
            planes: &planes,
            ..scene(&model)
        };
        let image = render(&scene, &camera, Background::White);
        image.get_pixel(x, 50).0
    };
    let bare = render(&scene(&model), &camera, Background::White);
    assert_eq!(pixel(-1.2, 50), bare.get_pixel(50, 50).0);
    let tinted = pixel(1.2, 50);
    let blueness = |p: [u8; 4]| i32::from(p[2]) - i32::from(p[0]);
    assert!(blueness(tinted) > blueness(bare.get_pixel(50, 50).0) + 10);
    // Beside the shape the sheet shows on the background wherever it lies.
    assert_ne!(pixel(-1.2, 17), [255; 4]);
}

#[test]
fn a_plane_seen_edge_on_is_a_line_in_the_middle() {
    let model = sphere(24);
    let planes = [(
        Plane {
            normal: Vector::x(),
            offset: 0.0,
        },
        [0, 0, 255],
    )];
    let scene = Scene {
        planes: &planes,
        ..scene(&model)
    };
    let image = render(&scene, &front(101, 101, 1.4), Background::White);
    let blue = |x: u32| {
        let p = image.get_pixel(x, 30).0;
        i32::from(p[2]) - i32::from(p[0]) > 100
    };
    let columns: Vec<u32> = (0..101).filter(|&x| blue(x)).collect();
    assert_eq!(columns, [50], "one line through the middle");
}

#[test]
fn odd_input_is_drawn_without_panic() {
    let nan = Point::new(f64::NAN, 0.0, 0.0);
    let far = Point::new(1e308, -1e308, 1e308);
    let model = Model {
        positions: vec![Point::origin(), nan, far, Point::new(1.0, 0.0, 0.0)],
        triangles: vec![[0, 1, 2], [0, 3, 2], [0, 0, 0], [0, 3, 99], [3, 3, 0]],
    };
    let planes = [
        (
            Plane {
                normal: Vector::zeros(),
                offset: 1.0,
            },
            [1, 2, 3],
        ),
        (
            Plane {
                normal: Vector::x(),
                offset: f64::NAN,
            },
            [1, 2, 3],
        ),
        (
            Plane {
                normal: Vector::y() * 1e-200,
                offset: 1e300,
            },
            [1, 2, 3],
        ),
    ];
    let scene = Scene {
        planes: &planes,
        colors: Some(&[[f32::NAN; 3]]),
        ..scene(&model)
    };
    for radius in [1.0, 0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320, 1e308] {
        let image = render(&scene, &front(9, 0, radius), Background::Transparent);
        assert_eq!(image.dimensions(), (9, 1));
    }
    let image = render(
        &Scene::default(),
        &front(8, 8, 1.0),
        Background::Transparent,
    );
    assert_eq!(covered(&image), 0.0);
}

#[test]
fn one_thread_and_two_draw_the_same_bytes() {
    let model = eared();
    let planes = [(
        Plane {
            normal: Vector::new(0.6, 0.0, 0.8),
            offset: 0.1,
        },
        categorical(1),
    )];
    let scene = Scene {
        planes: &planes,
        ..scene(&model)
    };
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| render(&scene, &front(120, 90, 2.0), Background::White))
    };
    assert_eq!(draw(1), draw(2));
}
