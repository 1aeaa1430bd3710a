//! The points and lines along which triangles pass through each other.

use std::collections::{BTreeMap, BTreeSet};

use robust::{Coord3D, orient3d};
use sphpack_neighbors::point;

use crate::soup::Soup;
use crate::soup::crossings::{Meeting, pierces};

/// A part of a line on a triangle: its ends, and the other triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub(super) ends: [u32; 2],
    pub(super) other: u32,
}

/// What a point of a cut is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// An edge, its lower vertex first, and the triangle that it pierces.
    Edge([u32; 2], u32),
    /// Three triangles, in order.
    Triple([u32; 3]),
}

/// All cuts through a soup.
#[derive(Debug, Default)]
pub(super) struct Cuts {
    /// New points; the first has the number of the soup's vertices.
    pub(super) points: Vec<[f64; 3]>,
    first: u32,
    known: BTreeMap<Key, u32>,
    /// Points on each edge, from its lower vertex, with the part of the way.
    on_edge: BTreeMap<[u32; 2], Vec<(f64, u32)>>,
    segments: BTreeMap<u32, Vec<Segment>>,
    /// Lines between numbers of points, the lower first, as they are after crossing each other.
    lines: BTreeSet<[u32; 2]>,
}

impl Cuts {
    /// The cuts of `pairs` of crossing triangles; `None` where two of them do not cross in one segment.
    pub(super) fn find(soup: &Soup, pairs: &[(u32, u32)]) -> Option<Self> {
        let mut cuts = Self {
            first: soup.vertices.len() as u32,
            ..Self::default()
        };
        for &(i, j) in pairs {
            let mut ends = Vec::new();
            for (from, into) in [(i, j), (j, i)] {
                let ids = soup.triangles[from as usize];
                let target = soup.corners(into as usize);
                for k in 0..3 {
                    let (a, b) = (ids[k], ids[(k + 1) % 3]);
                    let edge = [a.min(b), a.max(b)];
                    let [low, high] = edge.map(|v| soup.vertices[v as usize]);
                    match pierces(low, high, &target) {
                        Meeting::Apart => {}
                        Meeting::Touching => return None,
                        Meeting::Crossing => {
                            let end = cuts.on_edge(edge, [low, high], into, &target);
                            ends.push(end);
                        }
                    }
                }
            }
            let &[a, b] = ends.as_slice() else {
                return None;
            };
            if a == b {
                return None;
            }
            for (on, other) in [(i, j), (j, i)] {
                let segment = Segment {
                    ends: [a.min(b), a.max(b)],
                    other,
                };
                cuts.segments.entry(on).or_default().push(segment);
            }
        }
        for list in cuts.on_edge.values_mut() {
            list.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
        Some(cuts)
    }

    fn add(&mut self, key: Key, place: [f64; 3]) -> u32 {
        let number = self.first + self.points.len() as u32;
        self.points.push(place);
        self.known.insert(key, number);
        number
    }

    /// The point where an edge pierces a triangle.
    fn on_edge(
        &mut self,
        edge: [u32; 2],
        [low, high]: [[f64; 3]; 2],
        into: u32,
        target: &[[f64; 3]; 3],
    ) -> u32 {
        let key = Key::Edge(edge, into);
        if let Some(&number) = self.known.get(&key) {
            return number;
        }
        let height = |p: [f64; 3]| {
            let [a, b, c, p] =
                [target[0], target[1], target[2], p].map(|[x, y, z]| Coord3D { x, y, z });
            orient3d(a, b, c, p)
        };
        let (h, g) = (height(low), height(high));
        let part = (h / (h - g)).clamp(0.0, 1.0);
        let place = point::add_scaled(low, part, point::sub(high, low));
        let number = self.add(key, place);
        self.on_edge.entry(edge).or_default().push((part, number));
        number
    }

    /// The point of three triangles: `t`, and the two others of segments that cross on it.
    pub(super) fn triple(&mut self, mut triangles: [u32; 3], place: [f64; 3]) -> u32 {
        triangles.sort_unstable();
        let key = Key::Triple(triangles);
        match self.known.get(&key) {
            Some(&number) => number,
            None => self.add(key, place),
        }
    }

    /// Whether a line crosses triangle `t`.
    pub(super) fn is_cut(&self, t: usize) -> bool {
        self.segments.contains_key(&(t as u32))
    }

    /// The segments on triangle `t`.
    pub(super) fn segments(&self, t: usize) -> Vec<Segment> {
        self.segments.get(&(t as u32)).cloned().unwrap_or_default()
    }

    /// Points between two vertices, from the first to the second.
    pub(super) fn between(&self, a: u32, b: u32) -> Vec<u32> {
        let list = self.on_edge.get(&[a.min(b), a.max(b)]);
        let mut points: Vec<u32> = list.into_iter().flatten().map(|&(_, p)| p).collect();
        if a > b {
            points.reverse();
        }
        points
    }

    /// Where a vertex or a new point is.
    pub(super) fn place(&self, soup: &Soup, v: u32) -> [f64; 3] {
        match v.checked_sub(self.first) {
            None => soup.vertices[v as usize],
            Some(new) => self.points[new as usize],
        }
    }

    /// Notes a part of a line that no other line crosses any more.
    pub(super) fn note(&mut self, a: u32, b: u32) {
        self.lines.insert([a.min(b), a.max(b)]);
    }

    /// All parts of lines that were noted.
    pub(super) fn lines(&self) -> BTreeSet<[u32; 2]> {
        self.lines.clone()
    }
}
