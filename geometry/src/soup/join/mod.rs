//! Shells that overlap or touch, made one.

mod cuts;
mod faces;
mod minus;
mod sheet;
mod tiles;

use std::collections::BTreeSet;

use sphpack_neighbors::{Bounds, point};

use super::check::Survey;
use super::crossings::{self, Meeting};
use super::shells::{Joined, Piece};
use super::{Soup, is_degenerate};
use crate::mesh::{topology, triangle, weld};
use crate::winding::FastWinding;
use cuts::Cuts;

/// Where surfaces only touch, every shell is grown by about this part of the size, so that they overlap.
const GROWTH: f64 = 1e-6;

/// How far behind a triangle, in parts of the size, it is asked what is there.
const BEHIND: f64 = 1e-8;

/// Points nearer than this, in parts of the size, become one after cutting.
const SAME: f64 = 1e-7;

/// Points at which the result is compared with what was asked for.
const PROBES: usize = 500;

/// The surface of what `soup` winds around at least once: its closed, agreeing shells cut along the lines where they
/// pass through each other, and what is inside others left out. `None` where that does not come out as a closed
/// mesh that agrees with the winding number everywhere.
///
/// Which triangles cross is decided exactly, and every point of a cut is known by what it is made of (an edge and a
/// triangle, or three triangles), so that both sides of a cut share their points. Surfaces that touch are grown by
/// 10⁻⁶ of the size first.
pub(super) fn join(soup: &Soup, survey: &Survey) -> Option<Soup> {
    let size = Bounds::of(&soup.vertices).diagonal();
    let mut shell = vec![0_u32; soup.triangles.len()];
    for (s, piece) in (0_u32..).zip(&survey.pieces) {
        for &t in &piece.triangles {
            shell[t as usize] = s;
        }
    }
    let mut grown = soup.clone();
    for attempt in 0..4 {
        let mut pairs = crossings::all(&grown);
        pairs.retain(|&(i, j, _)| shell[i as usize] != shell[j as usize]);
        if pairs.iter().all(|&(_, _, m)| m == Meeting::Crossing) {
            let pairs: Vec<(u32, u32)> = pairs.iter().map(|&(i, j, _)| (i, j)).collect();
            return cut(&grown, &pairs, size).filter(|joined| agrees(joined, &grown));
        }
        grown = grow(
            soup,
            &survey.pieces,
            GROWTH * f64::from(1 << attempt) * size,
        );
    }
    None
}

/// Every shell moved outward by one or two `step`s, no two shells by the same.
fn grow(soup: &Soup, pieces: &[Piece], step: f64) -> Soup {
    let mut normal = vec![[0.0; 3]; soup.vertices.len()];
    let mut factor = vec![0.0; soup.vertices.len()];
    for (s, piece) in pieces.iter().enumerate() {
        for &t in &piece.triangles {
            let corners = soup.corners(t as usize);
            let unit = point::unit(triangle::area_vector(&corners)).unwrap_or([0.0; 3]);
            for (k, v) in soup.triangles[t as usize].iter().enumerate() {
                let sum = &mut normal[*v as usize];
                *sum = point::add_scaled(*sum, triangle::angle(&corners, k), unit);
                // Faces of two shells that lay on each other stay parallel, one further out; and a trace of disorder
                // parts what would still meet in a point. Multiples of irrational numbers: even, without a pattern.
                let of_shell = (s as f64 * 0.414_213_562) % 1.0;
                factor[*v as usize] = 1.0 + of_shell;
            }
        }
    }
    let vertices = (0..soup.vertices.len())
        .map(|v| {
            let along = point::unit(normal[v]).unwrap_or([0.0; 3]);
            let disorder =
                [0.819_172_513, 0.671_043_607, 0.549_700_478].map(|a| (a * (v as f64 + 1.0)) % 1.0);
            let moved = point::add_scaled(soup.vertices[v], step * factor[v], along);
            point::add_scaled(moved, 1e-4 * step, disorder)
        })
        .collect();
    Soup {
        vertices,
        triangles: soup.triangles.clone(),
        welded: 0,
    }
}

/// Cuts the crossing `pairs` of triangles and keeps what bounds the whole.
fn cut(soup: &Soup, pairs: &[(u32, u32)], size: f64) -> Option<Soup> {
    let mut cuts = Cuts::find(soup, pairs)?;
    // All triangles after cutting, and the original each is a part of.
    let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(soup.triangles.len());
    for t in 0..soup.triangles.len() {
        if cuts.is_cut(t) {
            triangles.extend(faces::parts(soup, &mut cuts, t)?);
        } else {
            triangles.push(soup.triangles[t]);
        }
    }
    let mut vertices = soup.vertices.clone();
    vertices.extend(&cuts.points);
    let whole = Soup {
        vertices,
        triangles,
        welded: 0,
    };
    let kept = bounding(&whole, &cuts.lines(), soup, size);
    let (vertices, mut triangles) = weld::within(&whole.vertices, &kept, SAME * size);
    triangles.retain(|t| !is_degenerate(t));
    [(vertices, triangles), (whole.vertices, kept)]
        .into_iter()
        .find(|(_, triangles)| is_closed(triangles))
        .map(|(vertices, triangles)| {
            let mut joined = Soup {
                vertices,
                triangles,
                welded: 0,
            };
            joined.drop_unused();
            joined
        })
}

/// Whether any of two shells that touch reaches into the other: told at places just behind the triangles that touch.
pub(super) fn reach_into_each_other(soup: &Soup) -> bool {
    let size = Bounds::of(&soup.vertices).diagonal();
    let mut touching: BTreeSet<u32> = BTreeSet::new();
    for (i, j, _) in crossings::all(soup) {
        touching.extend([i, j]);
    }
    let probes: Vec<[f64; 3]> = touching
        .iter()
        .flat_map(|&t| {
            let corners = soup.corners(t as usize);
            let normal = point::unit(triangle::area_vector(&corners)).unwrap_or([0.0; 3]);
            let weights = [
                [0.34, 0.33, 0.33],
                [0.98, 0.01, 0.01],
                [0.01, 0.98, 0.01],
                [0.01, 0.01, 0.98],
                [0.49, 0.49, 0.02],
                [0.02, 0.49, 0.49],
                [0.49, 0.02, 0.49],
            ];
            weights.map(|w| point::add_scaled(triangle::place(&corners, w), -GROWTH * size, normal))
        })
        .collect();
    let winding = FastWinding::new(soup.loose());
    winding.batch(&probes).iter().any(|&w| w > 1.5)
}

fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let sides = topology::sorted_sides(triangles);
    topology::edges(&sides).all(|edge| matches!(edge, [a, b] if a.runs_up() != b.runs_up()))
}

/// The triangles of `whole` behind which `soup` winds around once and before which it does not; told patch by patch
/// between the `lines`.
fn bounding(whole: &Soup, lines: &BTreeSet<[u32; 2]>, soup: &Soup, size: f64) -> Vec<[u32; 3]> {
    let mut patches = Joined::new(whole.triangles.len());
    let sides = topology::sorted_sides(&whole.triangles);
    for edge in topology::edges(&sides) {
        if !lines.contains(&edge[0].ends().map(|v| v as u32)) {
            for other in &edge[1..] {
                patches.join(edge[0].triangle() as u32, other.triangle() as u32);
            }
        }
    }
    // Each patch is asked at its largest triangle.
    let mut largest: Vec<(f64, usize)> = vec![(-1.0, 0); whole.triangles.len()];
    for t in 0..whole.triangles.len() {
        let area = triangle::area(&whole.corners(t));
        let best = &mut largest[patches.find(t as u32) as usize];
        if area > best.0 {
            *best = (area, t);
        }
    }
    let roots: Vec<usize> = (0..largest.len())
        .filter(|&r| largest[r].0 >= 0.0)
        .collect();
    let winding = FastWinding::new(soup.loose());
    let probes: Vec<[f64; 3]> = roots
        .iter()
        .map(|&r| {
            let t = largest[r].1;
            let normal = point::unit(triangle::area_vector(&whole.corners(t)));
            point::add_scaled(whole.middle(t), -BEHIND * size, normal.unwrap_or([0.0; 3]))
        })
        .collect();
    let mut bounds = vec![false; whole.triangles.len()];
    for (&root, behind) in roots.iter().zip(winding.batch(&probes)) {
        bounds[root] = (0.5..1.5).contains(&behind);
    }
    (0..whole.triangles.len())
        .filter(|&t| bounds[patches.find(t as u32) as usize])
        .map(|t| whole.triangles[t])
        .collect()
}

/// Whether `joined` holds the points that `soup` winds around, and no others.
fn agrees(joined: &Soup, soup: &Soup) -> bool {
    let bounds = Bounds::of(&soup.vertices);
    let points: Vec<[f64; 3]> = (0..PROBES)
        .map(|i| {
            // A low-discrepancy sequence.
            let i = i as f64 + 0.5;
            let part = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9].map(|a| (a * i) % 1.0);
            std::array::from_fn(|k| bounds.min[k] + part[k] * (bounds.max[k] - bounds.min[k]))
        })
        .collect();
    let (wanted, found) = (
        FastWinding::new(soup.loose()),
        FastWinding::new(joined.loose()),
    );
    let (wanted, found) = (wanted.batch(&points), found.batch(&points));
    (0..PROBES).all(|i| (wanted[i] > 0.5) == (found[i] > 0.5))
}

impl Soup {
    /// Leaves out vertices that no triangle uses.
    fn drop_unused(&mut self) {
        let mut number = vec![u32::MAX; self.vertices.len()];
        let mut vertices = Vec::new();
        for t in &mut self.triangles {
            for v in t {
                let place = &mut number[*v as usize];
                if *place == u32::MAX {
                    *place = vertices.len() as u32;
                    vertices.push(self.vertices[*v as usize]);
                }
                *v = *place;
            }
        }
        self.vertices = vertices;
    }
}
