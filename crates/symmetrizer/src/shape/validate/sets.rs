//! Sets of numbers that are joined two by two.

/// The numbers from 0 in disjoint sets; a set is named by its smallest number.
pub(super) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    /// `count` sets of one number each.
    pub fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    /// The name of the set of `v`; paths are halved on the way.
    pub fn root(&mut self, mut v: u32) -> u32 {
        while self.parent[v as usize] != v {
            let next = self.parent[self.parent[v as usize] as usize];
            self.parent[v as usize] = next;
            v = next;
        }
        v
    }

    /// Makes the sets of `a` and `b` one.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
