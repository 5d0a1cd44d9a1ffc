//! Connected pieces of the graph of samples.

/// The pieces of those for which `member` holds, along edges to neighbours that are `joined`; by their first
/// samples, each in the order in which it is reached.
pub fn pieces(
    neighbors: &[Vec<u32>],
    member: impl Fn(u32) -> bool,
    joined: impl Fn(u32, u32) -> bool,
) -> Vec<Vec<u32>> {
    let count = neighbors.len() as u32;
    let mut seen: Vec<bool> = (0..count).map(|s| !member(s)).collect();
    let mut pieces = Vec::new();
    for start in 0..count {
        if std::mem::replace(&mut seen[start as usize], true) {
            continue;
        }
        let mut piece = vec![start];
        let mut at = 0;
        while at < piece.len() {
            let a = piece[at];
            for &b in &neighbors[a as usize] {
                if !seen[b as usize] && joined(a, b) {
                    seen[b as usize] = true;
                    piece.push(b);
                }
            }
            at += 1;
        }
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_falls_apart_where_it_is_cut() {
        let chain: Vec<Vec<u32>> = vec![vec![1], vec![0, 2], vec![1, 3], vec![2, 4], vec![3]];
        let all = |_| true;
        let cut = |a: u32, b: u32| a + b != 3;
        assert_eq!(pieces(&chain, all, |_, _| true), [[0, 1, 2, 3, 4]]);
        assert_eq!(pieces(&chain, all, cut), [vec![0, 1], vec![2, 3, 4]]);
        assert_eq!(
            pieces(&chain, |s| s != 3, |_, _| true),
            [vec![0, 1, 2], vec![4]]
        );
    }
}
