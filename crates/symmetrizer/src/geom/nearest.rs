//! Range and neighbour queries among fixed points: kiddo's k-d tree with answers in one order.

use std::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};

/// An index over points of K coordinates.
pub struct PointIndex<const K: usize> {
    /// `None` for an empty set, which kiddo refuses.
    tree: Option<ImmutableKdTree<f64, K>>,
}

impl<const K: usize> PointIndex<K> {
    /// Indexes `points`; all coordinates must be finite.
    pub fn new(points: &[[f64; K]]) -> Self {
        Self {
            tree: ImmutableKdTree::new_from_slice(points).ok(),
        }
    }

    /// Indices of the points closer than `radius` to `x`, increasing.
    pub fn within(&self, x: &[f64; K], radius: f64) -> Vec<u32> {
        let mut found: Vec<u32> = self.around(x, radius).collect();
        found.sort_unstable();
        found
    }

    /// The same in the order in which the tree has them, which is the same for the same points.
    pub fn around(&self, x: &[f64; K], radius: f64) -> impl Iterator<Item = u32> + use<K> {
        let square = radius * radius;
        let hits = self.tree.as_ref().map(|tree| {
            let query = tree.query(x).within::<SquaredEuclidean<f64>>(square);
            query.unsorted().execute()
        });
        hits.into_iter().flatten().map(|hit| hit.item)
    }

    /// Index and squared distance of the point nearest to `x`.
    pub fn nearest(&self, x: &[f64; K]) -> Option<(u32, f64)> {
        let hit = self
            .tree
            .as_ref()?
            .query(x)
            .nearest_one::<SquaredEuclidean<f64>>()
            .execute();
        Some((hit.item, hit.distance))
    }

    /// Indices and squared distances of the `count` points nearest to `x`, nearest first, those at
    /// one distance by index; fewer where there are fewer.
    pub fn nearest_n(&self, x: &[f64; K], count: usize) -> Vec<(u32, f64)> {
        let (Some(tree), Some(count)) = (&self.tree, NonZero::new(count)) else {
            return Vec::new();
        };
        let mut found: Vec<(u32, f64)> = tree
            .query(x)
            .nearest_n::<SquaredEuclidean<f64>>(count)
            .execute()
            .iter()
            .map(|hit| (hit.item, hit.distance))
            .collect();
        found.sort_unstable_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        found
    }
}
