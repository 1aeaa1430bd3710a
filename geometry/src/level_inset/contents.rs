//! Whether a level set exists, and how long or large it is.

use sphpack_neighbors::{Bounds, place_of, point};

use super::gradient;
use crate::surface::Surface;

/// Points per axis at which a deep place is looked for.
const LOOK: usize = 12;

/// Steps of the climb to the deepest place.
const CLIMB: usize = 200;

/// Parts of the depth that do not count: a plate as thick as two depths has a level set, of two sheets in one place, whatever rounding
/// says. Without it its points would be found midway between its sides, which leaves them less even.
const EXACT: f64 = 1e-6;

/// Whether the body has a point as deep as `depth`.
///
/// Tries, from a coarse grid, the straight way down from the nearest surface point, which succeeds wherever the body
/// is locally thicker than twice the depth; and, should none succeed, climbs from the deepest grid points.
pub(super) fn reaches<const D: usize>(surface: &dyn Surface<D>, depth: f64) -> bool {
    let bounds = surface.bounds();
    let size = bounds.size();
    let shortest = size.iter().copied().fold(f64::INFINITY, f64::min);
    if 2.0 * depth >= shortest {
        return false;
    }
    let enough = -depth * (1.0 - EXACT);
    let mut deepest: Vec<(f64, [f64; D])> = Vec::new();
    for cell in 0..LOOK.pow(D as u32) {
        let place = place_of(cell, [LOOK; D]);
        let p: [f64; D] = std::array::from_fn(|k| {
            bounds.min[k] + size[k] * (place[k] as f64 + 0.5) / LOOK as f64
        });
        let hit = surface.closest(p);
        let below = point::add_scaled(hit.point, -depth * (1.0 + EXACT), gradient(p, &hit));
        if hit.distance < enough || surface.closest(below).distance < enough {
            return true;
        }
        deepest.push((hit.distance, p));
    }
    deepest.sort_by(|a, b| a.0.total_cmp(&b.0));
    deepest
        .iter()
        .take(8)
        .any(|&(distance, p)| climb(surface, p, distance, size) < enough)
}

/// The least signed distance found by walking from `p` along the axes.
fn climb<const D: usize>(
    surface: &dyn Surface<D>,
    mut p: [f64; D],
    mut distance: f64,
    size: [f64; D],
) -> f64 {
    let mut step = point::norm(size) / LOOK as f64;
    for _ in 0..CLIMB {
        let mut moved = false;
        for k in 0..D {
            for way in [step, -step] {
                let mut q = p;
                q[k] += way;
                let there = surface.closest(q).distance;
                if there < distance {
                    (p, distance, moved) = (q, there, true);
                }
            }
        }
        if !moved {
            step *= 0.5;
        }
    }
    distance
}

/// Measure and volume of {φ ≤ −depth}: boxes are halved where the level set may pass, down to 1/64 of the body's
/// size in 3-D (1/1024 in 2-D), and cut there by the tangent plane.
pub(super) fn integrate<const D: usize>(surface: &dyn Surface<D>, depth: f64) -> (f64, f64) {
    let bounds = surface.bounds().grown(-depth);
    let size = bounds.size();
    // A flat side between two cells would be half lost: the grid is a little larger and off the middle.
    let largest = size.iter().copied().fold(0.0, f64::max) * 1.02;
    let levels = if D == 2 { 10 } else { 6 };
    let center = bounds.center().map(|x| x + 0.003_7 * largest);
    let half = 0.5 * largest;
    let root = Bounds::new(center, center).grown(half);
    let leaf = |cell: &Bounds<D>, normal: [f64; D], f: f64| {
        let h = cell.size()[0];
        let (area, part) = cut(normal, f / h);
        (area * h.powi(D as i32 - 1), part * h.powi(D as i32))
    };
    let mut total = (0.0, 0.0);
    add_box(surface, depth, (root, levels), &leaf, &mut total);
    total
}

/// Measure and volume of the part of {φ ≤ −depth} within a `window`, which is cut into boxes of half the depth at most where the level set
/// may pass, but never more than 1/512 of its size.
pub(crate) fn integrate_within<const D: usize>(
    surface: &dyn Surface<D>,
    depth: f64,
    window: &Bounds<D>,
) -> (f64, f64) {
    let largest = window.size().iter().copied().fold(0.0, f64::max);
    let levels = (2.0 * largest / depth).log2().ceil().clamp(5.0, 9.0);
    let leaf = |cell: &Bounds<D>, normal: [f64; D], f: f64| {
        // As seen in the unit cube, which the box is stretched from.
        let size = cell.size();
        let stretched: [f64; D] = std::array::from_fn(|k| normal[k] * size[k]);
        let length = point::norm(stretched);
        let (area, part) = cut(point::scale(stretched, 1.0 / length), f / length);
        (area * cell.volume() / length, part * cell.volume())
    };
    let mut total = (0.0, 0.0);
    add_box(
        surface,
        depth,
        (*window, levels as usize),
        &leaf,
        &mut total,
    );
    total
}

/// Measure and volume of a plane through a box: the normal, and how far the middle of the box is from it.
type Leaf<'a, const D: usize> = &'a dyn Fn(&Bounds<D>, [f64; D], f64) -> (f64, f64);

fn add_box<const D: usize>(
    surface: &dyn Surface<D>,
    depth: f64,
    (cell, levels): (Bounds<D>, usize),
    leaf: Leaf<'_, D>,
    total: &mut (f64, f64),
) {
    let center = cell.center();
    let hit = surface.closest(center);
    let f = hit.distance + depth;
    if f.abs() > 0.5 * cell.diagonal() {
        if f < 0.0 {
            total.1 += cell.volume();
        }
        return;
    }
    if levels == 0 {
        let (area, volume) = leaf(&cell, gradient(center, &hit), f);
        total.0 += area;
        total.1 += volume;
        return;
    }
    for part in halves(&cell) {
        add_box(surface, depth, (part, levels - 1), leaf, total);
    }
}

/// The 2^D boxes that are left where a box is halved along every axis.
pub(crate) fn halves<const D: usize>(cell: &Bounds<D>) -> impl Iterator<Item = Bounds<D>> {
    let (cell, center) = (*cell, cell.center());
    (0..1_usize << D).map(move |bits| {
        let mut part = cell;
        for k in 0..D {
            if bits >> k & 1 == 1 {
                part.min[k] = center[k];
            } else {
                part.max[k] = center[k];
            }
        }
        part
    })
}

/// The plane n·x = −f through the unit cube around the origin: its area within, and the part of the cube behind.
///
/// With all n_k > 0 and c the plane's place from the cube's lowest corner, the part is
/// Σ ±max(c − n·v, 0)^D / (D! Π n_k) over the cube's corners v, and the area its derivative by c.
pub(crate) fn cut<const D: usize>(normal: [f64; D], f: f64) -> (f64, f64) {
    // Below this slope the sum cancels; tilting the plane by so little changes nothing that counts.
    let n = normal.map(|x| x.abs().max(1e-3));
    let n = point::unit(n).unwrap_or(n);
    let c = 0.5 * n.iter().sum::<f64>() - f;
    let (mut area, mut part) = (0.0, 0.0);
    for bits in 0..1_usize << D {
        let mut gap = c;
        for k in 0..D {
            if bits >> k & 1 == 1 {
                gap -= n[k];
            }
        }
        let gap = gap.max(0.0);
        let sign = if bits.count_ones() % 2 == 0 {
            1.0
        } else {
            -1.0
        };
        area += sign * gap.powi(D as i32 - 1);
        part += sign * gap.powi(D as i32);
    }
    let factorial: f64 = (1..D).map(|k| k as f64).product();
    let scale = 1.0 / (factorial * n.iter().product::<f64>());
    (
        (area * scale).max(0.0),
        (part * scale / D as f64).clamp(0.0, 1.0),
    )
}
