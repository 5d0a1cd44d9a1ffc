//! Samples that slide alike, as a part: most of their neighbours do so too.

use crate::slip::ground::Ground;

/// Share of its neighbourhood that must slide where a sample belongs to the part; ours.
const MOST: f64 = 0.6;
/// Pieces of fewer samples are chance; ours.
const FEWEST: usize = 12;

/// Samples that make a part and those of them that slide, both increasing.
#[derive(Debug, Clone)]
pub struct Part {
    /// All, with the few that noise moves off.
    pub samples: Vec<u32>,
    /// Those within the gate.
    pub sliding: Vec<u32>,
}

impl Part {
    /// The samples `alive` in neighbourhoods most of which `conforms`.
    pub fn new(ground: &Ground, alive: &[bool], conforms: impl Fn(u32) -> bool) -> Self {
        let slides: Vec<bool> = (0..alive.len())
            .map(|i| alive[i] && conforms(i as u32))
            .collect();
        let belongs = |i: usize| {
            let near = ground.facing[i].iter().map(|&j| j as usize);
            let around: Vec<usize> = near.filter(|&j| alive[j]).chain([i]).collect();
            let sliding = around.iter().filter(|&&j| slides[j]).count();
            alive[i] && sliding as f64 >= MOST * around.len() as f64
        };
        let kept: Vec<u32> = (0..alive.len() as u32)
            .filter(|&i| belongs(i as usize))
            .collect();
        let pieces = pieces(&ground.around, &kept).into_iter();
        let mut samples: Vec<u32> = pieces.filter(|p| p.len() >= FEWEST).flatten().collect();
        samples.sort_unstable();
        let sliding = samples.iter().copied().filter(|&i| slides[i as usize]);
        Self {
            sliding: sliding.collect(),
            samples,
        }
    }

    /// The part without the samples that `keep` refuses.
    pub fn retained(&self, keep: impl Fn(u32) -> bool) -> Self {
        let of = |all: &[u32]| all.iter().copied().filter(|&i| keep(i)).collect();
        Self {
            samples: of(&self.samples),
            sliding: of(&self.sliding),
        }
    }

    /// The largest piece that hangs together in `graph`.
    pub fn largest_piece(&self, graph: &[Vec<u32>]) -> Self {
        let mut largest = Vec::new();
        for piece in pieces(graph, &self.samples) {
            if piece.len() > largest.len() {
                largest = piece;
            }
        }
        self.retained(|i| largest.binary_search(&i).is_ok())
    }
}

/// `samples` (increasing) cut into pieces that hang together in `graph`, each increasing.
fn pieces(graph: &[Vec<u32>], samples: &[u32]) -> Vec<Vec<u32>> {
    let mut open = vec![false; graph.len()];
    for &i in samples {
        open[i as usize] = true;
    }
    let mut found = Vec::new();
    for &seed in samples {
        if !std::mem::take(&mut open[seed as usize]) {
            continue;
        }
        let mut piece = vec![seed];
        let mut next = 0;
        while next < piece.len() {
            for &j in &graph[piece[next] as usize] {
                if std::mem::take(&mut open[j as usize]) {
                    piece.push(j);
                }
            }
            next += 1;
        }
        piece.sort_unstable();
        found.push(piece);
    }
    found
}
