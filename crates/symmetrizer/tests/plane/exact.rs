//! Outlines to the last digit.

use crate::shared::{drawing, symmetrized};

#[test]
fn exact_outlines_are_their_own_mirror_images() {
    let Some(drawing) = drawing("truth/gecko_bent.svg") else {
        return;
    };
    let exact = symmetrized(&drawing).exact().expect("a line");
    assert_eq!(exact.outline().rings.len(), 1);
    let mut places: Vec<[f64; 2]> = exact.outline().points().map(|p| [p.x, p.y]).collect();
    places.sort_by(|a, b| {
        a[0].abs()
            .total_cmp(&b[0].abs())
            .then(a[1].total_cmp(&b[1]))
    });
    // Flattened curves: the same points on both sides but for the last bits.
    let mut alone = 0;
    for p in &places {
        let near = |q: &&[f64; 2]| (q[0] + p[0]).abs() < 1e-9 && (q[1] - p[1]).abs() < 1e-9;
        alone += usize::from(!places.iter().any(|q| near(&q)));
    }
    assert_eq!(alone, 0, "of {}", places.len());
    let lost = (exact.outline().area() / drawing.outline().area() - 1.0).abs();
    assert!(lost < 0.03, "{lost}");
}

#[test]
fn the_same_bytes_come_with_any_number_of_threads() {
    let Some(drawing) = drawing("truth/beetle11_sym_bent.svg") else {
        return;
    };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| symmetrized(&drawing).drawing.svg())
    };
    assert_eq!(with(1), with(3));
}
