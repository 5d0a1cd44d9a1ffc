//! Optimizing sample positions (section 4.1): on a symmetric surface with an asymmetric
//! triangulation, gliding alone contracts the cluster, as in figure 5.
#![allow(clippy::print_stdout)]
mod common;

use common::{data, load};
use symmetrizer::Context;
use symmetrizer::cluster::{ClusterParams, Votes};
use symmetrizer::detect::{DetectParams, Detection, detect};
use symmetrizer::optimize::glide::{Glided, glide};
use symmetrizer::optimize::moving::Couple;
use symmetrizer::patch::Ground;
use symmetrizer::shape::working::Working;
use symmetrizer::shape::{ClosestPoint, Surface};

/// The pairs that voted for the highest mode, as sampled: nothing has matched them to the surface.
fn raw_couples(found: &Detection) -> Vec<Couple> {
    let votes = Votes::new(&found.clouds[0].pairs, &found.space, 3);
    let clusters = votes.clusters(&ClusterParams::default());
    let list = &found.samples.list;
    clusters[0]
        .votes
        .iter()
        .map(|&i| {
            let pair = &found.clouds[0].pairs[i as usize];
            Couple {
                sample: pair.p,
                p: list[pair.p as usize].at,
                q: list[pair.q as usize].at,
                weight: pair.weight,
            }
        })
        .collect()
}

struct Trial {
    surface: Surface,
    found: Detection,
    before: Vec<Couple>,
    after: Vec<Couple>,
    glided: Glided,
}

fn trial(model: &std::path::Path, seed: u64) -> Trial {
    let surface = Working::new(&load(model)).expect("a usable mesh").surface;
    let found = detect(&surface, &DetectParams::default(), &mut Context::new(seed)).unwrap();
    let before = raw_couples(&found);
    let mut after = before.clone();
    let ground = Ground {
        surface: &surface,
        closest: &ClosestPoint::new(&surface),
        samples: &found.samples,
    };
    let glided = glide(&ground, &mut after).expect("a determined mirror");
    Trial {
        surface,
        found,
        before,
        after,
        glided,
    }
}

#[test]
fn figure_5_gliding_contracts_the_cluster_of_a_symmetric_surface() {
    let Some(path) = data("truth/spot_retess.obj") else {
        return;
    };
    for seed in 1..=3 {
        let t = trial(&path, seed);
        let variance = &t.glided.variance;
        let (first, last) = (variance[0], variance[variance.len() - 1]);
        println!(
            "seed {seed}: {} pairs, variance {variance:.6?}",
            t.before.len()
        );
        assert!(t.before.len() > 100, "a cluster worth the name");
        assert!(
            first >= 5.0 * last,
            "seed {seed}: {first:.3e} -> {last:.3e}"
        );
        assert!(variance.windows(2).all(|w| w[1] < w[0]), "{variance:?}");
    }
}

#[test]
fn no_sample_glides_farther_than_the_spacing() {
    let Some(path) = data("truth/spot_retess.obj") else {
        return;
    };
    let t = trial(&path, 1);
    // The foot on the surface may lie a little farther than the point it is the foot of.
    let reach = 1.25 * t.found.samples.spacing;
    for (b, a) in t.before.iter().zip(&t.after) {
        for (from, to) in [(b.p, a.p), (b.q, a.q)] {
            let way = (t.surface.point(&to) - t.surface.point(&from)).norm();
            assert!(way <= reach, "{way} of {reach}");
            assert!((to.bary.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
}
