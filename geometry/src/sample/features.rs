//! Corners and sharp edges of a surface in space, occupied first.

use std::collections::HashMap;

use sphpack_neighbors::{Domain, Odometer, point};

use super::polyline::Polyline;
use crate::surface::{Closest, Feature, Surface};

/// Features nearer than this many spacings share one point. Points along a chain never are: rounding its length to
/// whole intervals makes them three quarters of a spacing at least.
const CROWDED: f64 = 0.7;

/// Sharp edges that hang together and are shorter in all than this many spacings are no features.
const SHORT: f64 = 2.0;

/// Cosine of an angle by which normals differ only where the surface turns.
const TURNED: f64 = 0.99;

/// How far beyond an edge, in spacings, it is looked at.
const LOOK: f64 = 0.02;

/// Points on the corners, then evenly along the sharp edges, at most `count`, whichever come first (evenly taken in
/// the order of the features where there are more).
///
/// Chains that hang together and are shorter than two spacings in all are no features at this resolution, nor are
/// corners where only such chains end: a scanned or coarse mesh has many, and where they are held the rest cannot be
/// even.
pub(crate) fn occupied<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    spacing: f64,
    count: usize,
) -> Vec<Closest<D>> {
    let features = surface.features();
    let chains: Vec<Polyline<D>> = features
        .edges
        .into_iter()
        .filter(|chain| chain.len() > 1)
        .map(Polyline::new)
        .collect();
    let sizes = sizes_of_parts(&chains);
    let ends_at = |c: [f64; D]| sizes.get(&key(c));
    let mut crowd = Crowd::new(CROWDED * spacing);
    let mut corners = Vec::new();
    for c in features.corners {
        if ends_at(c).is_none_or(|&size| size >= SHORT * spacing) && crowd.admits(c) {
            corners.push(c);
        }
    }
    let mut sites: Vec<Closest<D>> = thinned(corners, count)
        .into_iter()
        .map(|c| Closest {
            distance: 0.0,
            feature: Feature::Corner,
            ..surface.closest(c)
        })
        .collect();
    let mut along = Vec::new();
    let window = surface.window();
    for chain in &chains {
        let part = ends_at(chain.points()[0]);
        let passes = chain_passes(chain, window.as_ref());
        if passes == [false; 2] && part.is_none_or(|&size| size < SHORT * spacing) {
            continue;
        }
        // Half an interval is left where the edge passes a side of the box, so that what goes on beyond is as even.
        let [lead, trail] = passes.map(|passes| if passes { 0.5 } else { 0.0 });
        let intervals = (chain.length() / spacing + lead - trail).round().max(1.0);
        let first = usize::from(!chain.is_closed() && !passes[0]);
        for i in first..intervals as usize {
            let way = (i as f64 + lead) / (intervals + lead - trail);
            let (p, tangent) = chain.at(chain.length() * way);
            let site = on_edge(surface, p, tangent, LOOK * spacing);
            if crowd.admits(site.point) {
                along.push(site);
            }
        }
    }
    sites.extend(thinned(along, count - sites.len()));
    sites
}

/// How near to a side of the box, in parts of its size, an edge ends that passes it.
const AT_SIDE: f64 = 1e-6;

/// Whether an edge begins, and ends, where it passes a side of a box.
fn chain_passes<const D: usize>(chain: &Polyline<D>, window: Option<&Domain<D>>) -> [bool; 2] {
    let Some(bounds) = window
        .map(|window| window.bounds)
        .filter(|_| !chain.is_closed())
    else {
        return [false; 2];
    };
    let slack = AT_SIDE * bounds.diagonal();
    let points = chain.points();
    [points[0], points[points.len() - 1]]
        .map(|p| (0..D).any(|k| p[k] - bounds.min[k] <= slack || bounds.max[k] - p[k] <= slack))
}

/// `p`, which is on or near a sharp edge that runs along `tangent`, put onto it: from within the wedge between the
/// normals of its two sides, outside where it is convex and inside where it is reflex, the edge is the closest place.
fn on_edge<const D: usize, S: Surface<D> + ?Sized>(
    surface: &S,
    p: [f64; D],
    tangent: [f64; D],
    look: f64,
) -> Closest<D> {
    let one = surface.closest(p);
    let seen = |direction: [f64; D]| surface.closest(point::add_scaled(p, look, direction));
    // Across the edge, on the one side where that still is the same face and on the other where it is not.
    let across = third(tangent, one.normal);
    let other = [1.0, -1.0]
        .map(|way| seen(point::add_scaled(one.normal, way, across)))
        .into_iter()
        .find(|hit| hit.feature != Feature::Smooth || point::dot(hit.normal, one.normal) < TURNED)
        .unwrap_or(one);
    let mean = point::unit(point::add(one.normal, other.normal)).unwrap_or(one.normal);
    let found = [mean, point::scale(mean, -1.0)]
        .into_iter()
        .map(seen)
        .find(|hit| hit.feature != Feature::Smooth)
        .unwrap_or(one);
    Closest {
        distance: 0.0,
        feature: Feature::Edge,
        ..found
    }
}

/// The direction perpendicular to both of two vectors in space.
fn third<const D: usize>(a: [f64; D], b: [f64; D]) -> [f64; D] {
    let turned = |k: usize| a[(k + 1) % D] * b[(k + 2) % D] - a[(k + 2) % D] * b[(k + 1) % D];
    point::unit(std::array::from_fn(turned)).unwrap_or([0.0; D])
}

/// At most `count` of the items, evenly taken.
pub(super) fn thinned<T>(items: Vec<T>, count: usize) -> Vec<T> {
    let have = items.len();
    if have <= count {
        return items;
    }
    // Item i is the next one where i count / have steps to a new whole number.
    items
        .into_iter()
        .enumerate()
        .filter(|(i, _)| (i * count) / have != ((i + 1) * count) / have)
        .map(|(_, item)| item)
        .collect()
}

/// A point as a key: equal points have equal keys.
fn key<const D: usize>(p: [f64; D]) -> [u64; D] {
    p.map(|x| (x + 0.0).to_bits())
}

/// For every end of a chain, the total length of the chains that hang together with it.
fn sizes_of_parts<const D: usize>(chains: &[Polyline<D>]) -> HashMap<[u64; D], f64> {
    let mut number: HashMap<[u64; D], usize> = HashMap::new();
    let mut parent: Vec<usize> = Vec::new();
    let mut ends = Vec::with_capacity(chains.len());
    for chain in chains {
        let points = chain.points();
        let mut id = |p: [f64; D]| {
            *number.entry(key(p)).or_insert_with(|| {
                parent.push(parent.len());
                parent.len() - 1
            })
        };
        let (a, b) = (id(points[0]), id(points[points.len() - 1]));
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b)] = a.min(b);
        ends.push(a);
    }
    let mut total = vec![0.0; parent.len()];
    for (chain, &end) in chains.iter().zip(&ends) {
        total[root(&mut parent, end)] += chain.length();
    }
    number
        .into_iter()
        .map(|(k, id)| (k, total[root(&mut parent, id)]))
        .collect()
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

/// Points no two of which are nearer than a distance, found by a grid of cells of that size.
#[derive(Debug, Clone)]
struct Crowd<const D: usize> {
    least: f64,
    cells: HashMap<[i64; D], Vec<[f64; D]>>,
}

impl<const D: usize> Crowd<D> {
    fn new(least: f64) -> Self {
        Self {
            least,
            cells: HashMap::new(),
        }
    }

    /// Takes `p` in where nobody is too near.
    fn admits(&mut self, p: [f64; D]) -> bool {
        let cell = p.map(|x| (x / self.least).floor() as i64);
        for step in Odometer::new([-1; D], [2; D]) {
            let other: [i64; D] = std::array::from_fn(|k| cell[k].saturating_add(step[k]));
            let crowded = self
                .cells
                .get(&other)
                .is_some_and(|there| there.iter().any(|&q| point::distance(p, q) < self.least));
            if crowded {
                return false;
            }
        }
        self.cells.entry(cell).or_default().push(p);
        true
    }
}
