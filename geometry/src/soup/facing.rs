//! Triangles that all face one way.

use super::Soup;
use super::shells::NONE;
use crate::mesh::topology::{self, Side};

/// Which triangles must be turned so that neighbours agree: across edges with two triangles, the fewer of each group
/// that hangs together. Where no choice is free of contradictions (a Möbius strip), some edge stays wrong.
pub(super) fn to_turn(soup: &Soup, sides: &[Side]) -> Vec<bool> {
    let count = soup.triangles.len();
    // Per side the triangle across, and whether it runs along the edge the same way.
    let mut across = vec![[(NONE, false); 3]; count];
    for edge in topology::edges(sides) {
        if let [a, b] = edge {
            let same = a.runs_up() == b.runs_up();
            across[a.triangle()][a.side()] = (b.triangle() as u32, same);
            across[b.triangle()][b.side()] = (a.triangle() as u32, same);
        }
    }
    let mut turn = vec![false; count];
    let mut seen = vec![false; count];
    let mut group: Vec<u32> = Vec::new();
    for start in 0..count {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        group.clear();
        group.push(start as u32);
        let (mut next, mut turned) = (0, 0);
        while let Some(&t) = group.get(next) {
            next += 1;
            for &(other, same) in &across[t as usize] {
                if other == NONE || seen[other as usize] {
                    continue;
                }
                seen[other as usize] = true;
                turn[other as usize] = turn[t as usize] != same;
                turned += usize::from(turn[other as usize]);
                group.push(other);
            }
        }
        if 2 * turned > group.len() {
            for &t in &group {
                turn[t as usize] = !turn[t as usize];
            }
        }
    }
    turn
}
