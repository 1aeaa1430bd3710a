//! Which triangles hang together, and which of these shells are around which.

use sphpack_neighbors::{Bounds, point};

use super::{Soup, is_degenerate};
use crate::mesh::topology::{self, Side};
use crate::mesh::triangle;
use crate::winding::FastWinding;

/// No shell, no other side.
pub(super) const NONE: u32 = u32::MAX;

/// One shell's triangles and what follows from them.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) triangles: Vec<u32>,
    pub(super) bounds: Bounds<3>,
    pub(super) area: f64,
    /// Positive where it faces outward; means little where it is open.
    pub(super) volume: f64,
    /// Whether every edge has two triangles that agree.
    pub(super) is_closed: bool,
}

/// Numbers sets that are joined one by one.
#[derive(Debug)]
pub(crate) struct Joined {
    parent: Vec<u32>,
}

impl Joined {
    pub(crate) fn new(count: usize) -> Self {
        Self {
            parent: (0..count as u32).collect(),
        }
    }

    pub(crate) fn find(&mut self, mut i: u32) -> u32 {
        while self.parent[i as usize] != i {
            let above = self.parent[self.parent[i as usize] as usize];
            self.parent[i as usize] = above;
            i = above;
        }
        i
    }

    /// The lower number stays.
    pub(crate) fn join(&mut self, i: u32, j: u32) {
        let (a, b) = (self.find(i), self.find(j));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

/// The shells of `soup`, in the order of their first triangles, and the shell of every triangle ([`NONE`] for
/// degenerate ones). `sides` must leave out degenerate triangles.
pub(super) fn find(soup: &Soup, sides: &[Side]) -> (Vec<Piece>, Vec<u32>) {
    let count = soup.triangles.len();
    let mut joined = Joined::new(count);
    for edge in topology::edges(sides) {
        for other in &edge[1..] {
            joined.join(edge[0].triangle() as u32, other.triangle() as u32);
        }
    }
    let mut of = vec![NONE; count];
    let mut pieces: Vec<Piece> = Vec::new();
    for t in 0..count {
        if is_degenerate(&soup.triangles[t]) {
            continue;
        }
        let root = joined.find(t as u32) as usize;
        if root == t {
            of[t] = pieces.len() as u32;
            pieces.push(Piece {
                triangles: Vec::new(),
                bounds: Bounds::EMPTY,
                area: 0.0,
                volume: 0.0,
                is_closed: true,
            });
        }
        of[t] = of[root];
        let piece = &mut pieces[of[t] as usize];
        piece.triangles.push(t as u32);
        let corners = soup.corners(t);
        for p in corners {
            piece.bounds.include(p);
        }
        piece.area += triangle::area(&corners);
    }
    for piece in &mut pieces {
        // About the middle, so that a far origin costs no digits.
        let middle = piece.bounds.center();
        let six: f64 = piece
            .triangles
            .iter()
            .map(|&t| {
                let [a, b, c] = soup.corners(t as usize).map(|p| point::sub(p, middle));
                point::dot(a, point::cross(b, c))
            })
            .sum();
        piece.volume = six / 6.0;
    }
    for edge in topology::edges(sides) {
        let good = matches!(edge, [a, b] if a.runs_up() != b.runs_up());
        if !good {
            pieces[of[edge[0].triangle()] as usize].is_closed = false;
        }
    }
    (pieces, of)
}

/// For every shell, the closed shells that are wholly around it, the smallest first. `meets(a, b)`: whether two
/// shells cross or touch, so that neither counts as around the other.
pub(super) fn around(
    soup: &Soup,
    pieces: &[Piece],
    meets: impl Fn(usize, usize) -> bool,
) -> Vec<Vec<usize>> {
    let mut windings: Vec<Option<FastWinding>> = vec![None; pieces.len()];
    let mut around = vec![Vec::new(); pieces.len()];
    // From left to right, so that only shells whose boxes may hold each other are compared.
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&a, &b| pieces[a].bounds.min[0].total_cmp(&pieces[b].bounds.min[0]));
    for (place, &inner) in order.iter().enumerate() {
        for &outer in &order[..place] {
            let (small, large) = (&pieces[inner], &pieces[outer]);
            if !large.is_closed || !large.bounds.contains_box(&small.bounds) || meets(inner, outer)
            {
                continue;
            }
            let winding = windings[outer].get_or_insert_with(|| {
                FastWinding::new(
                    large
                        .triangles
                        .iter()
                        .map(|&t| soup.corners(t as usize))
                        .collect(),
                )
            });
            let first = soup.triangles[small.triangles[0] as usize][0];
            if winding.at(soup.vertices[first as usize]).abs() > 0.5 {
                around[inner].push(outer);
            }
        }
        around[inner].sort_by(|&a, &b| {
            let size = |s: usize| pieces[s].volume.abs();
            size(a).total_cmp(&size(b)).then(a.cmp(&b))
        });
    }
    around
}
