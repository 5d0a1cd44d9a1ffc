//! Neighbouring elements gathered into pieces, which a coarse system moves as one.

use crate::deform::solver::system::Rows;

/// The piece of each element and how many pieces there are: grown in order from the first element that
/// is left, breadth first up to `size`; what is left over between them joins the smallest next to it.
pub fn aggregates(count: usize, rows: &Rows, size: usize) -> (Vec<u32>, usize) {
    let mut piece = vec![u32::MAX; count];
    let mut sizes: Vec<usize> = Vec::new();
    // Seeds are taken from the rim of what is gathered so far, so that pieces lie side by side.
    let mut rim = std::collections::VecDeque::new();
    let mut next = 0;
    loop {
        let seed = loop {
            match rim.pop_front() {
                Some(s) if piece[s as usize] == u32::MAX => break Some(s),
                Some(_) => {}
                None => {
                    while next < count && piece[next] != u32::MAX {
                        next += 1;
                    }
                    break (next < count).then_some(next as u32);
                }
            }
        };
        let Some(seed) = seed else {
            break;
        };
        let gathered = gather(seed, rows, &piece, size);
        let id = match smallest_beside(&gathered, rows, &piece, &sizes) {
            Some(beside) if 2 * gathered.len() < size => beside,
            _ => {
                sizes.push(0);
                sizes.len() as u32 - 1
            }
        };
        sizes[id as usize] += gathered.len();
        for &i in &gathered {
            piece[i as usize] = id;
        }
        for &i in &gathered {
            let free = rows.of(i as usize).iter().map(|&(_, j, _)| j);
            rim.extend(free.filter(|&j| piece[j as usize] == u32::MAX));
        }
    }
    (piece, sizes.len())
}

/// Up to `size` free elements around a seed, the nearest first.
fn gather(seed: u32, rows: &Rows, piece: &[u32], size: usize) -> Vec<u32> {
    let mut gathered = vec![seed];
    let mut at = 0;
    while at < gathered.len() && gathered.len() < size {
        for &(_, j, _) in rows.of(gathered[at] as usize) {
            if gathered.len() < size && piece[j as usize] == u32::MAX && !gathered.contains(&j) {
                gathered.push(j);
            }
        }
        at += 1;
    }
    gathered
}

fn smallest_beside(gathered: &[u32], rows: &Rows, piece: &[u32], sizes: &[usize]) -> Option<u32> {
    let beside = gathered
        .iter()
        .flat_map(|&i| rows.of(i as usize))
        .map(|&(_, j, _)| piece[j as usize])
        .filter(|&p| p != u32::MAX);
    beside.min_by_key(|&p| (sizes[p as usize], p))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_has_a_piece_of_its_neighbourhood() {
        // A strip of 1,000 elements and one that is joined to nothing.
        let pairs: Vec<[u32; 2]> = (0..999).map(|i| [i, i + 1]).collect();
        let rows = Rows::new(1001, &pairs);
        let (piece, count) = aggregates(1001, &rows, 20);
        assert!((40..=60).contains(&count), "{count}");
        for id in 0..count as u32 {
            let members: Vec<usize> = (0..1001).filter(|&i| piece[i] == id).collect();
            let span = members[members.len() - 1] - members[0] + 1;
            assert_eq!(span, members.len(), "a piece hangs together");
        }
        assert_eq!(piece[1000], count as u32 - 1);
    }
}
