//! Cracks of no width: edges that meet corners of their neighbours in the middle.

use std::collections::BTreeMap;

use sphpack_neighbors::{Bounds, KdTree, point};

use super::{Soup, check, is_degenerate};
use crate::mesh::topology::{self, Side};

/// A corner nearer to an edge than this, in parts of the size, is on it.
pub(super) const WIDTH: f64 = 1e-6;

/// A triangle is cut at one of its edges in a round.
const MOST_ROUNDS: usize = 16;

impl Soup {
    /// Cuts triangles at open edges where corners of other open edges lie on them, so that both sides of a crack share their
    /// corners. Returns how many edges were cut. O(n log n) for n open edges that are short among the whole.
    pub(super) fn close_cracks(&mut self) -> usize {
        let width = WIDTH * Bounds::of(&self.vertices).diagonal();
        let mut count = 0;
        for _ in 0..MOST_ROUNDS {
            self.weld_rims(width);
            let cut = self.cut_open_edges(width);
            count += cut;
            if cut == 0 {
                break;
            }
        }
        count
    }

    /// Sides that no other meets, and their corners, ascending.
    fn open_sides(&self) -> (Vec<Side>, Vec<u32>) {
        let sides = check::sides(self);
        let open: Vec<Side> = topology::edges(&sides)
            .filter(|edge| edge.len() % 2 == 1)
            .map(|edge| edge[0])
            .collect();
        let mut rim: Vec<u32> = (open.iter())
            .flat_map(|side| side.ends().map(|v| v as u32))
            .collect();
        rim.sort_unstable();
        rim.dedup();
        (open, rim)
    }

    /// Makes corners of open edges one that are in one place.
    fn weld_rims(&mut self, width: f64) {
        let (_, rim) = self.open_sides();
        let places: Vec<[f64; 3]> = rim.iter().map(|&v| self.vertices[v as usize]).collect();
        let Ok(tree) = KdTree::new(&places) else {
            return;
        };
        let mut first: BTreeMap<u32, u32> = BTreeMap::new();
        for (number, &v) in rim.iter().enumerate() {
            let near = tree.within(places[number], width).into_iter();
            let earlier = near.map(|found| rim[found.index]).filter(|&w| w < v).min();
            if let Some(earlier) = earlier {
                first.insert(v, first.get(&earlier).copied().unwrap_or(earlier));
            }
        }
        if first.is_empty() {
            return;
        }
        for v in self.triangles.iter_mut().flatten() {
            *v = first.get(v).copied().unwrap_or(*v);
        }
        self.triangles.retain(|t| !is_degenerate(t));
    }

    fn cut_open_edges(&mut self, width: f64) -> usize {
        let (open, rim) = self.open_sides();
        let places: Vec<[f64; 3]> = rim.iter().map(|&v| self.vertices[v as usize]).collect();
        let Ok(tree) = KdTree::new(&places) else {
            return 0;
        };
        let mut is_cut = vec![false; self.triangles.len()];
        let mut count = 0;
        for side in open {
            let (t, k) = (side.triangle(), side.side());
            if is_cut[t] {
                continue;
            }
            let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.triangles[t][k]);
            let [from, to] = [a, b].map(|v| self.vertices[v as usize]);
            let way = point::sub(to, from);
            let length = point::norm(way);
            let middle = point::add_scaled(from, 0.5, way);
            let mut on: Vec<(f64, u32)> = (tree.within(middle, 0.5 * length + width).into_iter())
                .map(|found| rim[found.index])
                .filter(|&v| ![a, b, c].contains(&v))
                .filter_map(|v| {
                    let p = point::sub(self.vertices[v as usize], from);
                    let along = point::dot(p, way) / length;
                    let off = point::norm(point::add_scaled(p, -along / length, way));
                    (off <= width && along > width && along < length - width).then_some((along, v))
                })
                .collect();
            if on.is_empty() {
                continue;
            }
            on.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
            // Of corners in one place one will do: the others are welded to it, or another round's.
            on.dedup_by(|p, q| p.0 - q.0 <= width);
            is_cut[t] = true;
            count += 1;
            let mut before = a;
            for (number, (_, v)) in on.iter().copied().chain([(length, b)]).enumerate() {
                let part = [before, v, c];
                if number == 0 {
                    self.triangles[t] = part;
                } else {
                    self.triangles.push(part);
                }
                before = v;
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soup::tests::cuboid;
    use crate::soup::{HoleLimit, Repair};
    use crate::{Similarity, Surface};

    /// A cube of which one triangle has its longest side, or another, cut at some places, `off` beside it.
    fn cracked(cuts: &[f64], off: f64) -> Vec<[[f64; 3]; 3]> {
        let mut faces = cuboid([0.0; 3], [1.0; 3]);
        let [a, b, c] = faces.swap_remove(3);
        let place = |t: f64| -> [f64; 3] {
            std::array::from_fn(|k| a[k] + t * (b[k] - a[k]) + off * (c[k] - b[k]))
        };
        let mut from = a;
        for to in cuts.iter().map(|&t| place(t)).chain([b]) {
            faces.push([from, to, c]);
            from = to;
        }
        faces
    }

    #[test]
    fn edges_that_meet_corners_in_the_middle() {
        for (degrees, cuts, off) in [
            (0.0, &[0.5][..], 0.0),
            (33.0, &[0.2, 0.7, 0.9][..], 0.0),
            (33.0, &[0.5][..], 5e-7),
            (71.0, &[0.1, 0.10001, 0.6][..], -4e-7),
        ] {
            let turn =
                Similarity::<3>::new(3.0, [1.0, 0.2, 0.5], degrees, [1.0, 0.0, -2.0]).unwrap();
            let soup = Soup::from_loose(&cracked(cuts, off))
                .unwrap()
                .transformed(&turn)
                .unwrap();
            let repaired = soup.repaired(HoleLimit::Small);
            assert_eq!(repaired.done, [Repair::ClosedCracks(1)]);
            let mesh = repaired.body().unwrap().mesh;
            assert!((mesh.volume() - 27.0).abs() < 1e-4 && (mesh.measure() - 54.0).abs() < 1e-4);
        }
        // A crack of some width is a hole.
        let soup = Soup::from_loose(&cracked(&[0.5], 1e-4)).unwrap();
        assert!(
            !soup
                .repaired(HoleLimit::Small)
                .done
                .contains(&Repair::ClosedCracks(1))
        );
    }
}
