//! Triangles that are there more than once.

use std::collections::BTreeMap;

use super::{Soup, is_degenerate};
use crate::mesh::topology;

/// Triangles of the same three vertices.
#[derive(Debug)]
struct Group {
    /// The lowest first.
    members: Vec<u32>,
    /// How many more run one way than the other.
    surplus: i32,
}

/// The groups of more than one triangle, by their sorted vertices.
fn groups(soup: &Soup) -> Vec<Group> {
    let mut keys: Vec<([u32; 3], u32)> = Vec::with_capacity(soup.triangles.len());
    for (t, corners) in soup.triangles.iter().enumerate() {
        if !is_degenerate(corners) {
            let mut key = *corners;
            key.sort_unstable();
            keys.push((key, t as u32));
        }
    }
    rayon::slice::ParallelSliceMut::par_sort_unstable(keys.as_mut_slice());
    keys.chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() > 1)
        .map(|group| Group {
            members: group.iter().map(|&(_, t)| t).collect(),
            surplus: group
                .iter()
                .map(|&(key, t)| {
                    let [a, b, c] = soup.triangles[t as usize];
                    let runs_so = [[a, b, c], [b, c, a], [c, a, b]].contains(&key);
                    if runs_so { 1 } else { -1 }
                })
                .sum(),
        })
        .collect()
}

/// Every triangle but the first of those with the same vertices.
pub(super) fn surplus(soup: &Soup) -> Vec<usize> {
    let mut all: Vec<usize> = groups(soup)
        .iter()
        .flat_map(|group| group.members[1..].iter().map(|&t| t as usize))
        .collect();
    all.sort_unstable();
    all
}

/// Which triangles to leave out so that none is there twice, and how many of these are whole walls.
///
/// Of triangles that run the same way one stays. Where as many run one way as the other, they are the wall between
/// two bodies that were put together, and none stays; unless nothing else is attached to that wall: then it is a
/// surface that was written with both sides, and one stays.
pub(super) fn to_leave_out(soup: &Soup) -> (Vec<bool>, usize) {
    let mut out = vec![false; soup.triangles.len()];
    let mut walls = 0;
    let groups = groups(soup);
    if groups.is_empty() {
        return (out, 0);
    }
    let mut wall_of: BTreeMap<u32, usize> = BTreeMap::new();
    for (g, group) in groups.iter().enumerate() {
        for &t in &group.members[1..] {
            out[t as usize] = true;
        }
        if group.surplus == 0 {
            wall_of.extend(group.members.iter().map(|&t| (t, g)));
        }
    }
    if wall_of.is_empty() {
        return (out, 0);
    }
    // Walls that hang together share one fate: with two others at an edge of the rim they part two bodies.
    let mut joined = super::shells::Joined::new(groups.len());
    let mut parts = vec![false; groups.len()];
    let sides = topology::sorted_sides(&soup.triangles);
    for edge in topology::edges(&sides) {
        let mut here: Vec<usize> = edge
            .iter()
            .filter_map(|side| wall_of.get(&(side.triangle() as u32)).copied())
            .collect();
        here.dedup();
        let Some(&first) = here.first() else { continue };
        for &other in &here[1..] {
            joined.join(first as u32, other as u32);
        }
        let others = edge
            .iter()
            .filter(|side| {
                let t = side.triangle();
                !out[t] && !wall_of.contains_key(&(t as u32))
            })
            .count();
        parts[first] |= others >= 2;
    }
    for g in 0..groups.len() {
        let root = joined.find(g as u32) as usize;
        parts[root] |= parts[g];
    }
    for (g, group) in groups.iter().enumerate() {
        if group.surplus == 0 && parts[joined.find(g as u32) as usize] {
            out[group.members[0] as usize] = true;
            walls += 1;
        }
    }
    (out, walls)
}
