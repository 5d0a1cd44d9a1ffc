//! Products of verified isometries until nothing new comes up, each new one verified in its turn.

use std::collections::BTreeSet;

use crate::geom::Matrix3;
use crate::group::exact::{Table, exact_turns};
use crate::group::{Verify, Within};
use crate::transform::{Isometry, Kind};

/// The greatest order a group may have: that of the icosahedron with its mirrors.
const GREATEST_ORDER: usize = 120;

/// A group that closes: indices into the pool, the identity first, and their products.
pub(super) struct Closed {
    pub members: Vec<usize>,
    pub table: Table,
    /// The linear parts of the exact group.
    pub turns: Vec<Matrix3>,
}

/// All isometries that the shape was asked for, so that none is asked for twice.
pub(super) struct Pool<'a, 'v> {
    within: Within<'a>,
    verify: &'a mut Verify<'v>,
    /// Those that hold, as they were verified; the identity is the first.
    measured: Vec<Isometry>,
    /// The same, each the nearest mirror, inversion, rotation or rotoreflection. They are not made
    /// to fix one point: small angles do not say well where it is.
    held: Vec<Isometry>,
    refused: Vec<Isometry>,
}

impl<'a, 'v> Pool<'a, 'v> {
    pub fn new(within: Within<'a>, verify: &'a mut Verify<'v>) -> Self {
        Self {
            within,
            verify,
            measured: vec![Isometry::identity()],
            held: vec![Isometry::identity()],
            refused: Vec::new(),
        }
    }

    /// The isometries of `members` as they were verified.
    pub fn measured(&self, members: &[usize]) -> Vec<Isometry> {
        members.iter().map(|&i| self.measured[i]).collect()
    }

    /// The index of `t`, which is offered to the shape if it is new; `None` where it is refused.
    pub fn ask(&mut self, t: &Isometry) -> Option<usize> {
        if let Some(known) = self.within.find(t, &self.held) {
            return Some(known);
        }
        if self.within.find(t, &self.refused).is_some() {
            return None;
        }
        let answer = self.within.ask(t, self.verify);
        let settled = answer.and_then(|r| Some((r, self.settled(&r)?)));
        match settled {
            None => {
                self.refused.push(*t);
                None
            }
            Some((measured, held)) => Some(self.admit(measured, held)),
        }
    }

    fn admit(&mut self, measured: Isometry, held: Isometry) -> usize {
        self.within.find(&held, &self.held).unwrap_or_else(|| {
            self.measured.push(measured);
            self.held.push(held);
            self.held.len() - 1
        })
    }

    /// The inverse of a member, which needs no asking.
    fn inverse(&mut self, member: usize) -> usize {
        let (measured, held) = (&self.measured[member], &self.held[member]);
        let inverses = (measured.inverse(), held.inverse());
        self.admit(inverses.0, inverses.1)
    }

    /// `t` as the nearest isometry of a kind that fixes a point; `None` where that is too far.
    fn settled(&self, t: &Isometry) -> Option<Isometry> {
        let (kind, near) = t.snapped(self.within.space, self.within.tolerance);
        let moves = matches!(kind, Kind::Translation | Kind::Screw | Kind::Glide);
        (!moves).then_some(near)
    }

    /// The group that `generators` generate; `None` where a product is refused, where it is too
    /// large, or where its products do not make a group.
    pub fn close(&mut self, generators: &[usize]) -> Option<Closed> {
        let mut steps: Vec<usize> = Vec::new();
        for &g in generators {
            steps.push(g);
            steps.push(self.inverse(g));
        }
        let mut members = vec![0];
        let mut seen = BTreeSet::from([0]);
        let mut next = 0;
        while let Some(&member) = members.get(next) {
            for &step in &steps {
                let product = self.held[member].after(&self.held[step]);
                let i = self.ask(&product)?;
                if seen.insert(i) {
                    members.push(i);
                }
                if members.len() > GREATEST_ORDER {
                    return None;
                }
            }
            next += 1;
        }
        let held: Vec<Isometry> = members.iter().map(|&i| self.held[i]).collect();
        let table = Table::of(&held, self.within.space)?;
        let turns: Vec<Matrix3> = held.iter().map(|t| t.linear).collect();
        let turns = exact_turns(&turns, &table)?;
        Some(Closed {
            members,
            table,
            turns,
        })
    }
}
