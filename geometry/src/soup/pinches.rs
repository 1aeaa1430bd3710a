//! Edges where a body touches itself or another: four triangles or more, and how they part into edges of two.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use sphpack_neighbors::point;

use super::shells::Joined;
use super::{Soup, check};
use crate::mesh::topology::{self, Side};

/// Wedges thinner than this, or with less than this to a half turn, radians, are not safe to tell.
const CLEAR: f64 = 1e-6;

impl Soup {
    /// Parts edges at which wedges of the body meet: every wedge gets an edge of its own. Only where the triangles around
    /// the edge agree on what is inside and every wedge is less than a half turn: then each place is nearest to a face
    /// of its own wedge before it is nearest to the edge, and which triangles belong together is no guess. Returns how
    /// many edges were parted.
    pub(super) fn part_pinches(&mut self) -> usize {
        let count = self.part_vertices();
        if count > 0 {
            while self.part_middles() {}
        }
        count
    }

    /// The edges of more than two triangles that can be parted, each as its wedges; those at the rim of a hole cannot.
    fn pinches(&self, sides: &[Side]) -> BTreeMap<[usize; 2], Vec<[Side; 2]>> {
        let mut rims: BTreeSet<usize> = BTreeSet::new();
        for edge in topology::edges(sides) {
            if edge.len() == 1 {
                rims.extend(edge[0].ends());
            }
        }
        topology::edges(sides)
            .filter(|edge| edge.len() > 2 && edge[0].ends().iter().all(|v| !rims.contains(v)))
            .filter_map(|edge| Some((edge[0].ends(), self.wedges(edge)?)))
            .collect()
    }

    /// Every fan of triangles around a vertex at which edges part gets a vertex of its own. Returns how many edges are
    /// parted.
    fn part_vertices(&mut self) -> usize {
        let sides = check::sides(self);
        let pinches = self.pinches(&sides);
        if pinches.is_empty() {
            return 0;
        }
        // Corner k of triangle t is number 3 t + k; those of one fan are joined.
        let mut fans = Joined::new(3 * self.triangles.len());
        let mut join = |a: &Side, b: &Side| {
            for v in a.ends() {
                let corner = |s: &Side| {
                    let own = &self.triangles[s.triangle()];
                    let k = (0..3).find(|&k| own[k] as usize == v).unwrap_or(0);
                    (3 * s.triangle() + k) as u32
                };
                fans.join(corner(a), corner(b));
            }
        };
        for edge in topology::edges(&sides) {
            if let Some(wedges) = pinches.get(&edge[0].ends()) {
                for [a, b] in wedges {
                    join(a, b);
                }
            } else {
                for other in &edge[1..] {
                    join(&edge[0], other);
                }
            }
        }
        let ends = pinches.keys().flatten();
        let pinched: BTreeSet<u32> = ends.map(|&v| v as u32).collect();
        // The first fan keeps the vertex.
        let mut copies: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut kept: BTreeSet<u32> = BTreeSet::new();
        for t in 0..self.triangles.len() {
            for k in 0..3 {
                let v = self.triangles[t][k];
                if !pinched.contains(&v) {
                    continue;
                }
                let fan = fans.find((3 * t + k) as u32);
                let own = *copies.entry((v, fan)).or_insert_with(|| {
                    if kept.insert(v) {
                        return v;
                    }
                    self.vertices.push(self.vertices[v as usize]);
                    self.vertices.len() as u32 - 1
                });
                self.triangles[t][k] = own;
            }
        }
        pinches.len()
    }

    /// Where wedges hang together at both ends of their edge, all but the first get a vertex in its middle. Whether
    /// there was any; of a triangle with several such edges one at a time.
    fn part_middles(&mut self) -> bool {
        let pinches = self.pinches(&check::sides(self));
        let mut split: BTreeSet<usize> = BTreeSet::new();
        for (ends, wedges) in &pinches {
            for wedge in &wedges[1..] {
                if wedge.iter().any(|side| split.contains(&side.triangle())) {
                    continue;
                }
                let [a, b] = ends.map(|v| self.vertices[v]);
                let middle = self.vertices.len() as u32;
                self.vertices.push(point::scale(point::add(a, b), 0.5));
                for side in wedge {
                    let (t, k) = (side.triangle(), side.side());
                    split.insert(t);
                    let mut other = self.triangles[t];
                    other[k] = middle;
                    self.triangles[t][(k + 1) % 3] = middle;
                    self.triangles.push(other);
                }
            }
        }
        !split.is_empty()
    }

    /// The pairs of triangles that bound a wedge of the body, around an edge of several; `None` where that is not
    /// plain.
    fn wedges(&self, edge: &[Side]) -> Option<Vec<[Side; 2]>> {
        let [a, b] = edge[0].ends().map(|v| self.vertices[v]);
        let axis = point::unit(point::sub(b, a))?;
        let mut frame: Option<[[f64; 3]; 2]> = None;
        let mut turned: Vec<(f64, Side)> = Vec::with_capacity(edge.len());
        for &side in edge {
            let third = self.triangles[side.triangle()][(side.side() + 2) % 3];
            let away = point::sub(self.vertices[third as usize], a);
            let out = point::unit(point::reject(away, axis))?;
            let [x, y] = *frame.get_or_insert_with(|| [out, point::cross(axis, out)]);
            let angle = point::dot(out, y).atan2(point::dot(out, x));
            turned.push((angle.rem_euclid(TAU), side));
        }
        turned.sort_by(|p, q| p.0.total_cmp(&q.0));
        // A triangle that runs along the edge has the body before it, the others behind them.
        let start = turned.iter().position(|(_, side)| !side.runs_up())?;
        turned.rotate_left(start);
        let count = turned.len();
        let mut wedges = Vec::with_capacity(count / 2);
        for k in 0..count {
            let ((from, side), (to, next)) = (turned[k], turned[(k + 1) % count]);
            let turn = (to - from).rem_euclid(TAU);
            if side.runs_up() == next.runs_up() || !(CLEAR..=TAU - CLEAR).contains(&turn) {
                return None;
            }
            if !side.runs_up() {
                if turn > PI - CLEAR {
                    return None;
                }
                wedges.push([side, next]);
            }
        }
        Some(wedges)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Surface;
    use crate::soup::tests::cuboid;
    use crate::soup::{DefectKind, HoleLimit, Repair};

    /// The boundary of unit cubes at these places.
    fn cubes(places: &[[i32; 3]]) -> Soup {
        let mut faces = Vec::new();
        for &place in places {
            let low = place.map(f64::from);
            let all = cuboid(low, low.map(|x| x + 1.0));
            // Two triangles per side: below and above along z, y, x.
            for (n, t) in all.into_iter().enumerate() {
                let (axis, up) = (2 - n / 4, n / 2 % 2);
                let mut beyond = place;
                beyond[axis] += if up == 1 { 1 } else { -1 };
                if !places.contains(&beyond) {
                    faces.push(t);
                }
            }
        }
        Soup::from_loose(&faces).unwrap()
    }

    #[test]
    fn two_cubes_at_an_edge() {
        let soup = cubes(&[[0, 0, 0], [1, 1, 0]]);
        assert_eq!(
            soup.check()
                .defect(DefectKind::NonManifold)
                .map(|d| d.count),
            Some(1)
        );
        let body = soup.body().unwrap();
        assert_eq!(body.done[0], Repair::Parted(1));
        assert!(
            (body.mesh.volume() - 2.0).abs() < 1e-4,
            "{}",
            body.mesh.volume()
        );
        for (p, inside) in [
            ([0.9, 0.9, 0.5], true),
            ([1.1, 1.1, 0.5], true),
            ([0.9, 1.1, 0.5], false),
            ([1.1, 0.9, 0.5], false),
        ] {
            assert_eq!(body.mesh.inside(p), inside, "{p:?}");
            assert_eq!(body.mesh.closest(p).distance < 0.0, inside, "{p:?}");
        }
    }

    #[test]
    fn a_ring_that_touches_itself() {
        let ring = [
            [0, 0, 0],
            [1, 1, 0],
            [2, 1, 0],
            [2, 0, 0],
            [2, -1, 0],
            [1, -1, 0],
            [0, -1, 0],
        ];
        let repaired = cubes(&ring).repaired(HoleLimit::Small);
        assert_eq!(repaired.done, [Repair::Parted(1)]);
        assert!(repaired.report.is_clean(), "{:?}", repaired.report.defects);
        let mesh = repaired.body().unwrap().mesh;
        assert!((mesh.volume() - 7.0).abs() < 1e-12);
        assert!(!mesh.inside([1.5, 0.5, 0.5]) && mesh.inside([0.9, 0.9, 0.5]));
    }

    #[test]
    fn a_wedge_in_a_notch_is_refused() {
        // Three quarters of a block, and in the notch a wedge that touches its edge only.
        let block = cubes(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]]);
        let at = |x: f64, y: f64, z: f64| [1.0 + x, 1.0 + y, z];
        let low = [at(0.0, 0.0, 0.0), at(0.9, 0.3, 0.0), at(0.3, 0.9, 0.0)];
        let high = low.map(|[x, y, _]| [x, y, 1.0]);
        let mut wedge = vec![[low[0], low[2], low[1]], high];
        for k in 0..3 {
            let n = (k + 1) % 3;
            wedge.push([low[k], low[n], high[n]]);
            wedge.push([low[k], high[n], high[k]]);
        }
        let soup = Soup::from_loose(&[block.loose(), wedge].concat()).unwrap();
        assert_eq!(
            soup.check()
                .defect(DefectKind::NonManifold)
                .map(|d| d.count),
            Some(1)
        );
        let repaired = soup.repaired(HoleLimit::Small);
        assert!(repaired.done.is_empty() && repaired.soup == soup);
        assert!(
            soup.body()
                .unwrap_err()
                .to_string()
                .contains("more than two triangles")
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn any_cubes_part(bits in 1..1_u32 << 27) {
            let at = |n: i32| [n % 3, n / 3 % 3, n / 9];
            let places: Vec<[i32; 3]> = (0..27).filter(|n| bits >> n & 1 == 1).map(at).collect();
            let soup = cubes(&places);
            let before = soup.check();
            let pinches = before.defect(DefectKind::NonManifold).map_or(0, |d| d.count);
            let repaired = soup.repaired(HoleLimit::Small);
            let expected: Vec<Repair> = (pinches > 0).then_some(Repair::Parted(pinches)).into_iter().collect();
            prop_assert_eq!(&repaired.done, &expected);
            prop_assert!(repaired.report.defect(DefectKind::NonManifold).is_none());
            prop_assert!(repaired.report.defect(DefectKind::OpenEdge).is_none());
            prop_assert!((repaired.report.volume - places.len() as f64).abs() < 1e-9);
        }
    }
}
