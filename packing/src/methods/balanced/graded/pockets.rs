//! The connected pockets of fluid, by cells.

use sphpack_neighbors::point;

use super::cells::{Cells, Leaf};
use crate::methods::balanced::pockets::{is_open, root};
use crate::problem::Problem;

/// The pocket of every leaf, that of most leaves first, and how many there are. Leaves whose middle is in no fluid have that of
/// a neighbour, or the first.
pub(super) fn of<const D: usize>(cells: &Cells<D>, problem: &Problem<D>) -> (Vec<u32>, usize) {
    let leaves = &cells.leaves;
    let is_fluid = |leaf: &Leaf<D>| leaf.distance > 0.0;
    let mut first: Vec<u32> = (0..leaves.len() as u32).collect();
    for (own, leaf) in leaves.iter().enumerate() {
        if !is_fluid(leaf) {
            continue;
        }
        for other in beside(cells, problem, leaf) {
            let there = &leaves[other];
            // Across a periodic side the way is not looked at: bodies there were cut to match.
            let near = there.bounds.center();
            let way = problem.domain.difference(near, leaf.bounds.center());
            let to = point::add(leaf.bounds.center(), way);
            let ends = [leaf.distance, there.distance];
            if is_fluid(there) && is_open(problem, leaf.bounds.center(), to, ends) {
                let (a, b) = (root(&mut first, own as u32), root(&mut first, other as u32));
                first[a.max(b) as usize] = a.min(b);
            }
        }
    }
    let mut size = vec![0.0; leaves.len()];
    for (own, leaf) in leaves.iter().enumerate().filter(|(_, leaf)| is_fluid(leaf)) {
        size[root(&mut first, own as u32) as usize] += leaf.bounds.volume();
    }
    let mut roots: Vec<u32> = (0..leaves.len() as u32)
        .filter(|&i| size[i as usize] > 0.0)
        .collect();
    roots.sort_by(|a, b| {
        let by_size = size[*b as usize].total_cmp(&size[*a as usize]);
        by_size.then(a.cmp(b))
    });
    let mut number = vec![0; leaves.len()];
    for (k, &i) in (0_u32..).zip(&roots) {
        number[i as usize] = k;
    }
    let mut pocket: Vec<u32> = (0..leaves.len() as u32)
        .map(|i| number[root(&mut first, i) as usize])
        .collect();
    for own in (0..leaves.len()).filter(|&own| !is_fluid(&leaves[own])) {
        let neighbor =
            (beside(cells, problem, &leaves[own])).find(|&other| is_fluid(&leaves[other]));
        pocket[own] = neighbor.map_or(0, |other| pocket[other]);
    }
    (pocket, roots.len().max(1))
}

/// The leaves behind the middles of a leaf's sides.
fn beside<const D: usize>(
    cells: &Cells<D>,
    problem: &Problem<D>,
    leaf: &Leaf<D>,
) -> impl Iterator<Item = usize> {
    let (center, size) = (leaf.bounds.center(), leaf.bounds.size());
    (0..2 * D).filter_map(move |side| {
        let axis = side / 2;
        let sign = if side % 2 == 0 { -1.0 } else { 1.0 };
        let mut place = center;
        place[axis] += sign * 0.51 * size[axis];
        let place = problem.domain.wrap(place);
        (problem.domain.bounds.contains(place)).then(|| cells.at(place))
    })
}
