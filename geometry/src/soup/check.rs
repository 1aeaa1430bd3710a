//! The check: every defect with its count and a place.

use std::collections::BTreeMap;

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

use super::crossings::{self, Meeting};
use super::report::{Defect, DefectKind, Hole, MeshReport, Shell, ShellRole};
use super::shells::{self, Joined, NONE, Piece};
use super::{Soup, doubles, is_degenerate};
use crate::mesh::topology::{self, Side};
use crate::mesh::triangle;

/// Counts, and the place of the first.
#[derive(Debug, Default)]
struct Tally {
    found: BTreeMap<DefectKind, (usize, [f64; 3])>,
}

impl Tally {
    fn add(&mut self, kind: DefectKind, place: impl FnOnce() -> [f64; 3]) {
        self.found.entry(kind).or_insert_with(|| (0, place())).0 += 1;
    }

    fn defects(self) -> Vec<Defect> {
        self.found
            .into_iter()
            .map(|(kind, (count, place))| Defect { kind, count, place })
            .collect()
    }
}

/// How shells meet each other, and triangles of one shell.
#[derive(Debug, Default)]
pub(super) struct Meetings {
    /// Pairs of shells, the lower number first, with a pair of their triangles; crossing, or only touching.
    pub(super) shells: BTreeMap<(u32, u32), (u32, Meeting)>,
    /// Crossing pairs of triangles of one shell.
    pub(super) within: Vec<(u32, u32)>,
}

impl Meetings {
    pub(super) fn find(soup: &Soup, shell: &[u32]) -> Self {
        let mut found = Self::default();
        for (i, j, meeting) in crossings::all(soup) {
            let (a, b) = (shell[i as usize], shell[j as usize]);
            if a == b {
                if meeting == Meeting::Crossing {
                    found.within.push((i, j));
                }
                continue;
            }
            let entry = found
                .shells
                .entry((a.min(b), a.max(b)))
                .or_insert((i, meeting));
            if meeting == Meeting::Crossing && entry.1 == Meeting::Touching {
                *entry = (i, meeting);
            }
        }
        found
    }

    fn meets(&self, a: usize, b: usize) -> bool {
        self.shells
            .contains_key(&(a.min(b) as u32, a.max(b) as u32))
    }
}

/// Everything that checking and mending look at.
#[derive(Debug)]
pub(super) struct Survey {
    pub(super) sides: Vec<Side>,
    pub(super) pieces: Vec<Piece>,
    pub(super) meetings: Meetings,
    pub(super) shells: Vec<Shell>,
}

impl Survey {
    pub(super) fn new(soup: &Soup) -> Self {
        let sides = sides(soup);
        let (pieces, of) = shells::find(soup, &sides);
        let meetings = Meetings::find(soup, &of);
        let around = shells::around(soup, &pieces, |a, b| meetings.meets(a, b));
        let shells = roles(&pieces, &around);
        debug_assert!(of.iter().all(|&s| s == NONE || (s as usize) < pieces.len()));
        Self {
            sides,
            pieces,
            meetings,
            shells,
        }
    }
}

/// Sides of all triangles but degenerate ones.
pub(super) fn sides(soup: &Soup) -> Vec<Side> {
    let mut sides = topology::sorted_sides(&soup.triangles);
    if soup.triangles.iter().any(is_degenerate) {
        sides.retain(|side| !is_degenerate(&soup.triangles[side.triangle()]));
    }
    sides
}

/// What every shell is to the body, and whether it faces the right way for that.
///
/// An outermost shell is a body; it faces outward or is inverted, and then what is in it is taken to be inverted
/// too. Inside a solid a shell that faces inward bounds a cavity, one that faces outward is redundant; inside a
/// cavity a shell is a body again.
fn roles(pieces: &[Piece], around: &[Vec<usize>]) -> Vec<Shell> {
    let mut shells: Vec<Shell> = pieces
        .iter()
        .zip(around)
        .map(|(piece, around)| Shell {
            triangles: piece.triangles.len(),
            bounds: piece.bounds,
            area: piece.area,
            volume: piece.volume,
            role: if piece.is_closed {
                ShellRole::Body
            } else {
                ShellRole::Undecided
            },
            is_inverted: false,
            inside: around.first().copied(),
        })
        .collect();
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by_key(|&s| (around[s].len(), s));
    // By how much the winding number is larger inside than outside, once all face the right way; and whether what
    // is inside is turned with the shell.
    let mut step = vec![0_i32; pieces.len()];
    let mut turns = vec![false; pieces.len()];
    for s in order {
        if shells[s].role == ShellRole::Undecided {
            continue;
        }
        let outside: i32 = around[s].iter().map(|&c| step[c]).sum();
        let inherited = shells[s].inside.is_some_and(|c| turns[c]);
        let faces_out = (pieces[s].volume > 0.0) != inherited;
        let (role, out) = match (outside > 0, faces_out) {
            (true, true) => (ShellRole::Redundant, true),
            (true, false) => (ShellRole::Cavity, false),
            (false, _) => (ShellRole::Body, true),
        };
        step[s] = if out { 1 } else { -1 };
        shells[s].role = role;
        shells[s].is_inverted = (pieces[s].volume > 0.0) != out;
        turns[s] = shells[s].is_inverted;
    }
    shells
}

/// Open edges that hang together, the largest group first.
fn holes(soup: &Soup, sides: &[Side]) -> Vec<Hole> {
    let open: Vec<[usize; 2]> = topology::edges(sides)
        .filter(|edge| edge.len() == 1)
        .map(|edge| edge[0].ends())
        .collect();
    let mut number: BTreeMap<usize, u32> = BTreeMap::new();
    for &v in open.as_flattened() {
        let next = number.len() as u32;
        number.entry(v).or_insert(next);
    }
    let mut joined = Joined::new(number.len());
    for [a, b] in &open {
        joined.join(number[a], number[b]);
    }
    let mut groups: BTreeMap<u32, Vec<[f64; 3]>> = BTreeMap::new();
    for [a, b] in open {
        let group = groups.entry(joined.find(number[&a])).or_default();
        group.extend([soup.vertices[a], soup.vertices[b]]);
    }
    let mut holes: Vec<Hole> = groups
        .into_values()
        .map(|points| {
            let (place, size) = across(&points);
            Hole {
                edges: points.len() / 2,
                size,
                place,
            }
        })
        .collect();
    holes.sort_by(|a, b| b.size.total_cmp(&a.size));
    holes
}

/// The middle of a hole with these points on its rim, and twice the distance of the furthest from there.
pub(super) fn across(points: &[[f64; 3]]) -> ([f64; 3], f64) {
    let middle = Bounds::of(points).center();
    let reach = points
        .iter()
        .map(|&p| point::distance(p, middle))
        .fold(0.0, f64::max);
    (middle, 2.0 * reach)
}

impl Soup {
    /// What is wrong with the triangles, every defect with its count and a place; and what shells they form.
    /// O(n log n) for triangles that spread out over a surface.
    #[must_use]
    pub fn check(&self) -> MeshReport {
        self.report(&Survey::new(self))
    }

    pub(super) fn report(&self, survey: &Survey) -> MeshReport {
        let mut tally = Tally::default();
        let flat: Vec<bool> = (0..self.triangles.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(|t| point::norm_squared(triangle::area_vector(&self.corners(t))) == 0.0)
            .collect();
        for (t, corners) in self.triangles.iter().enumerate() {
            if is_degenerate(corners) {
                tally.add(DefectKind::Degenerate, || self.middle(t));
            } else if flat[t] {
                tally.add(DefectKind::Sliver, || self.middle(t));
            }
        }
        for t in doubles::surplus(self) {
            tally.add(DefectKind::Duplicate, || self.middle(t));
        }
        for edge in topology::edges(&survey.sides) {
            let kind = match edge {
                [a, b] if a.runs_up() != b.runs_up() => continue,
                [_] => DefectKind::OpenEdge,
                [_, _] => DefectKind::Inconsistent,
                _ => DefectKind::NonManifold,
            };
            tally.add(kind, || edge[0].middle(&self.vertices));
        }
        for (shell, piece) in survey.shells.iter().zip(&survey.pieces) {
            let place = || self.middle(piece.triangles[0] as usize);
            if shell.is_inverted {
                tally.add(DefectKind::Inverted, place);
            }
            if shell.role == ShellRole::Redundant {
                tally.add(DefectKind::Redundant, place);
            }
        }
        for &(i, meeting) in survey.meetings.shells.values() {
            let kind = match meeting {
                Meeting::Crossing => DefectKind::Overlap,
                _ => DefectKind::Contact,
            };
            tally.add(kind, || self.middle(i as usize));
        }
        for &(i, _) in &survey.meetings.within {
            tally.add(DefectKind::SelfIntersection, || self.middle(i as usize));
        }
        MeshReport {
            triangles: self.triangles.len(),
            vertices: self.vertices.len(),
            welded: self.welded,
            bounds: Bounds::of(&self.vertices),
            area: survey.pieces.iter().map(|p| p.area).sum(),
            volume: survey.pieces.iter().map(|p| p.volume).sum(),
            defects: tally.defects(),
            holes: holes(self, &survey.sides),
            shells: survey.shells.clone(),
        }
    }
}
