//! Ties between the components of a shape, so that loose parts (eyes, buttons, shells) ride along.

use crate::geom::{Point, PointIndex};

/// Ties per component.
const PER_PART: usize = 6;

/// Pairs that tie each further component, the largest first, to what is nearest among those before it.
/// Components are those of `links` between elements at `centers`.
pub fn bridges(centers: &[Point], links: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let component = components(centers.len(), links);
    let parts = component.iter().max().map_or(0, |&c| c + 1);
    if parts < 2 {
        return Vec::new();
    }
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); parts];
    for (i, &c) in (0..).zip(&component) {
        members[c].push(i);
    }
    members.sort_by_key(|m| std::cmp::Reverse(m.len()));
    let place = |i: &u32| -> [f64; 3] { centers[*i as usize].coords.into() };
    let mut anchored: Vec<u32> = members[0].clone();
    let mut found = Vec::new();
    for part in &members[1..] {
        let index = PointIndex::new(&anchored.iter().map(place).collect::<Vec<_>>());
        let mut near: Vec<(f64, u32, u32)> = part
            .iter()
            .filter_map(|i| {
                let (k, d2) = index.nearest(&place(i))?;
                Some((d2, *i, anchored[k as usize]))
            })
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.extend(near.iter().take(PER_PART).map(|&(_, i, j)| [i, j]));
        anchored.extend_from_slice(part);
    }
    found
}

/// The component of each element, numbered by first member.
fn components(count: usize, links: impl Iterator<Item = [u32; 2]>) -> Vec<usize> {
    let mut near: Vec<Vec<u32>> = vec![Vec::new(); count];
    for [i, j] in links {
        near[i as usize].push(j);
        near[j as usize].push(i);
    }
    let mut component = vec![usize::MAX; count];
    let mut parts = 0;
    for start in 0..count {
        if component[start] != usize::MAX {
            continue;
        }
        let mut stack = vec![start];
        component[start] = parts;
        while let Some(f) = stack.pop() {
            for &g in &near[f] {
                if component[g as usize] == usize::MAX {
                    component[g as usize] = parts;
                    stack.push(g as usize);
                }
            }
        }
        parts += 1;
    }
    component
}
