//! A tree of boxes around primitives: who is nearest, who is hit.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

/// Primitives per leaf, at most.
const LEAF: usize = 4;

/// Deepest stack a query can need: a median split of at most 2³² primitives is 32 levels deep.
const STACK: usize = 64;

/// One node. Nodes are stored depth first: the left child of inner node `i` is `i + 1`.
#[derive(Debug, Clone, Copy)]
struct Node<const D: usize> {
    bounds: Bounds<D>,
    /// Leaf: where its primitives start in `order`. Inner node: its right child.
    link: u32,
    /// Primitives of a leaf; 0 for an inner node.
    count: u32,
}

/// A bounding-volume hierarchy over the boxes of primitives (segments, triangles, …), which it knows by number only.
///
/// Built by median splits along the widest axis in O(n log n) with ties settled by number, so equal input gives an
/// equal tree; a query costs O(log n) for primitives spread over a curve or surface.
///
/// ```
/// use sphpack_geometry::Bvh;
/// use sphpack_neighbors::{Bounds, point};
///
/// let sites = [[0.0, 0.0], [3.0, 1.0], [5.0, 5.0]];
/// let bvh = Bvh::build(&sites.map(|s| Bounds::new(s, s)));
/// let near = bvh.nearest([2.5, 1.0], f64::INFINITY, |i| point::distance_squared(sites[i], [2.5, 1.0]));
/// assert_eq!(near.map(|near| (near.index, near.distance_squared)), Some((1, 0.25)));
/// ```
#[derive(Debug, Clone, Default)]
pub struct Bvh<const D: usize> {
    nodes: Vec<Node<D>>,
    order: Vec<u32>,
}

/// What a [`Bvh`] finds nearest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Which primitive.
    pub index: usize,
    /// Its squared distance, as the caller measures it.
    pub distance_squared: f64,
}

impl<const D: usize> Bvh<D> {
    /// The tree over `boxes`; primitive `i` is known by its place in the list (at most 2³² − 1 of them).
    #[must_use]
    pub fn build(boxes: &[Bounds<D>]) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let centers: Vec<[f64; D]> = boxes.iter().map(Bounds::center).collect();
        let mut nodes = Vec::with_capacity(boxes.len());
        if !order.is_empty() {
            split(boxes, &centers, &mut order, 0, &mut nodes);
        }
        Self { nodes, order }
    }

    /// Numbers the primitives in the order of the leaves from now on, and returns the old number of each new one, so
    /// that the caller can store its primitives in the order in which queries read them.
    pub fn renumber(&mut self) -> Vec<u32> {
        let count = self.order.len() as u32;
        std::mem::replace(&mut self.order, (0..count).collect())
    }

    /// How many primitives the tree holds.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether the tree holds nothing.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// The box around everything; [`Bounds::EMPTY`] for an empty tree.
    pub fn bounds(&self) -> Bounds<D> {
        self.nodes.first().map_or(Bounds::EMPTY, |n| n.bounds)
    }

    /// The primitive nearest to `p` among those within `√limit_squared` (included).
    /// `distance_squared(i)` must return the squared distance of primitive `i` from `p`, at least that of its box.
    #[inline]
    pub fn nearest(
        &self,
        p: [f64; D],
        limit_squared: f64,
        mut distance_squared: impl FnMut(usize) -> f64,
    ) -> Option<Nearest> {
        let root = self.nodes.first()?;
        let mut best = limit_squared;
        let mut found = None;
        let mut stack = [(0_u32, 0.0_f64); STACK];
        let mut depth = 0;
        let root_distance = root.bounds.distance_squared(p);
        if root_distance <= best {
            stack[0] = (0, root_distance);
            depth = 1;
        }
        while depth > 0 {
            depth -= 1;
            let (mut index, near) = stack[depth];
            if near > best {
                continue;
            }
            loop {
                let node = &self.nodes[index as usize];
                if node.count > 0 {
                    let first = node.link as usize;
                    for &i in &self.order[first..first + node.count as usize] {
                        let d = distance_squared(i as usize);
                        if d < best || (d <= best && found.is_none()) {
                            best = d;
                            found = Some(i as usize);
                        }
                    }
                    break;
                }
                let (left, right) = (index + 1, node.link);
                let to_left = self.nodes[left as usize].bounds.distance_squared(p);
                let to_right = self.nodes[right as usize].bounds.distance_squared(p);
                let ((near, d_near), (far, d_far)) = if to_left <= to_right {
                    ((left, to_left), (right, to_right))
                } else {
                    ((right, to_right), (left, to_left))
                };
                if d_far <= best {
                    stack[depth] = (far, d_far);
                    depth += 1;
                }
                if d_near > best {
                    break;
                }
                index = near;
            }
        }
        found.map(|index| Nearest {
            index,
            distance_squared: best,
        })
    }

    /// Calls `each` for every primitive in a leaf all of whose ancestors' boxes (and its own) `accept`.
    #[inline]
    pub fn visit(&self, accept: impl Fn(&Bounds<D>) -> bool, mut each: impl FnMut(usize)) {
        let mut index = 0;
        let mut stack = [0_u32; STACK];
        let mut depth = 0;
        if self.nodes.is_empty() {
            return;
        }
        loop {
            let node = &self.nodes[index];
            if accept(&node.bounds) {
                if node.count == 0 {
                    stack[depth] = node.link;
                    depth += 1;
                    index += 1;
                    continue;
                }
                let first = node.link as usize;
                for &i in &self.order[first..first + node.count as usize] {
                    each(i as usize);
                }
            }
            if depth == 0 {
                return;
            }
            depth -= 1;
            index = stack[depth] as usize;
        }
    }

    /// Calls `each` for every primitive whose leaf's box overlaps `range` (a superset of those that overlap it).
    pub fn overlapping(&self, range: &Bounds<D>, each: impl FnMut(usize)) {
        self.visit(|b| overlap(b, range), each);
    }

    /// The pairs i < j of primitives whose `boxes` overlap and that `keep(i, j)`; found in parallel, and sorted, so
    /// that they are the same for any number of threads.
    pub(crate) fn pairs(
        &self,
        boxes: &[Bounds<D>],
        keep: impl Fn(usize, usize) -> bool + Sync,
    ) -> Vec<(u32, u32)> {
        let mut pairs: Vec<(u32, u32)> = self
            .order
            .par_chunks(1024)
            .flat_map_iter(|chunk| {
                let mut found = Vec::new();
                for &i in chunk {
                    let range = &boxes[i as usize];
                    self.overlapping(range, |j| {
                        if j > i as usize && overlap(range, &boxes[j]) && keep(i as usize, j) {
                            found.push((i, j as u32));
                        }
                    });
                }
                found
            })
            .collect();
        pairs.par_sort_unstable();
        pairs
    }

    /// How many nodes the tree has; they are stored depth first, each before its children.
    pub(crate) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// What is below node `index`: its two children, or its primitives.
    #[inline]
    pub(crate) fn below(&self, index: usize) -> Below<'_> {
        let node = &self.nodes[index];
        if node.count == 0 {
            return Below::Nodes(index + 1, node.link as usize);
        }
        let first = node.link as usize;
        Below::Primitives(&self.order[first..first + node.count as usize])
    }

    /// The box of node `index`.
    pub(crate) fn node_bounds(&self, index: usize) -> &Bounds<D> {
        &self.nodes[index].bounds
    }

    /// Calls `each` for every primitive whose leaf's box the ray `origin + t direction`, t ≥ 0, meets (a superset of
    /// those it hits).
    pub fn along_ray(&self, origin: [f64; D], direction: [f64; D], each: impl FnMut(usize)) {
        self.visit(|b| ray_meets(b, origin, direction), each);
    }
}

/// What is below a node.
pub(crate) enum Below<'a> {
    /// Its children.
    Nodes(usize, usize),
    /// The numbers of a leaf's primitives.
    Primitives(&'a [u32]),
}

/// Whether two boxes have a point in common.
fn overlap<const D: usize>(a: &Bounds<D>, b: &Bounds<D>) -> bool {
    (0..D).all(|k| a.min[k] <= b.max[k] && b.min[k] <= a.max[k])
}

/// Whether the ray `origin + t direction`, t ≥ 0, meets the box, faces included, with a hair of tolerance.
fn ray_meets<const D: usize>(b: &Bounds<D>, origin: [f64; D], direction: [f64; D]) -> bool {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for k in 0..D {
        if direction[k] == 0.0 {
            if origin[k] < b.min[k] || origin[k] > b.max[k] {
                return false;
            }
            continue;
        }
        let s = (b.min[k] - origin[k]) / direction[k];
        let t = (b.max[k] - origin[k]) / direction[k];
        enter = enter.max(s.min(t));
        leave = leave.min(s.max(t));
    }
    enter <= leave + 1e-12 * (enter.abs() + leave.abs())
}

/// Builds the subtree over `order`, which starts at `first` of the whole order.
fn split<const D: usize>(
    boxes: &[Bounds<D>],
    centers: &[[f64; D]],
    order: &mut [u32],
    first: usize,
    nodes: &mut Vec<Node<D>>,
) {
    let mut bounds = Bounds::EMPTY;
    let mut spread = Bounds::EMPTY;
    for &i in order.iter() {
        bounds = bounds.union(boxes[i as usize]);
        spread.include(centers[i as usize]);
    }
    let here = nodes.len();
    let leaf = order.len() <= LEAF;
    nodes.push(Node {
        bounds,
        link: first as u32,
        count: if leaf { order.len() as u32 } else { 0 },
    });
    if leaf {
        return;
    }
    let size = point::sub(spread.max, spread.min);
    let axis = (1..D).fold(0, |a, k| if size[k] > size[a] { k } else { a });
    let middle = order.len() / 2;
    order.select_nth_unstable_by(middle, |&i, &j| {
        centers[i as usize][axis]
            .total_cmp(&centers[j as usize][axis])
            .then(i.cmp(&j))
    });
    let (left, right) = order.split_at_mut(middle);
    split(boxes, centers, left, first, nodes);
    nodes[here].link = nodes.len() as u32;
    split(boxes, centers, right, first + middle, nodes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn queries_match_brute_force(
            raw in prop::collection::vec(([-1.0..1.0, -1.0..1.0, -1.0..1.0], 0.0..0.2), 1..80),
            p in [-2.0..2.0, -2.0..2.0, -2.0..2.0],
            limit in 0.0..3.0,
        ) {
            let boxes: Vec<Bounds<3>> = raw.iter().map(|&(c, r): &([f64; 3], f64)| Bounds::new(c, c).grown(r)).collect();
            let mut bvh = Bvh::build(&boxes);
            let brute = boxes.iter().map(|b| b.distance_squared(p)).fold(f64::INFINITY, f64::min);
            let found = bvh.nearest(p, limit, |i| boxes[i].distance_squared(p));
            let distance = found.map(|found| found.distance_squared);
            prop_assert_eq!(distance, (brute <= limit).then_some(brute));
            let range = Bounds::new(p, p).grown(0.5);
            let hits = |b: &Bounds<3>| (0..3).all(|k| b.min[k] <= range.max[k] && range.min[k] <= b.max[k]);
            let mut seen = vec![false; boxes.len()];
            bvh.overlapping(&range, |i| seen[i] = true);
            prop_assert!((0..boxes.len()).all(|i| seen[i] || !hits(&boxes[i])));
            let mut hit = vec![false; boxes.len()];
            bvh.along_ray(p, [1.0, 0.0, -0.5], |i| hit[i] = true);
            prop_assert!((0..boxes.len()).all(|i| hit[i] || !ray_meets(&boxes[i], p, [1.0, 0.0, -0.5])));
            let order = bvh.renumber();
            let mut sorted = order.clone();
            sorted.sort_unstable();
            prop_assert!(sorted.iter().enumerate().all(|(k, &i)| k == i as usize));
            let again = bvh.nearest(p, limit, |i| boxes[order[i] as usize].distance_squared(p));
            prop_assert_eq!(again.map(|again| again.distance_squared), distance);
        }
    }

    #[test]
    fn nothing_and_not_a_number() {
        let none = Bvh::<2>::build(&[]);
        assert!(none.is_empty() && none.nearest([0.0; 2], 1.0, |_| 0.0).is_none());
        let one = Bvh::build(&[Bounds::new([0.0; 2], [1.0; 2])]);
        assert_eq!(one.len(), 1);
        assert!(
            one.nearest([f64::NAN; 2], f64::INFINITY, |_| f64::NAN)
                .is_none()
        );
    }
}
