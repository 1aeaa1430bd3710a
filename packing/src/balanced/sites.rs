//! Where the particles of every region start: lattice sites, and places between them where there are too few.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use sphpack_geometry::Closest;
use sphpack_neighbors::{Bounds, KdTree, point};

use super::gaps;
use super::pockets::Pockets;
use super::shares::Share;
use crate::depths::Depths;
use crate::problem::Problem;

/// Sites farther beyond a region's surface than this, in ∆s, are none of its.
const BEYOND_OVER_SPACING: f64 = 1.0;

/// A site nearer to the particle surface than this, in ∆s, is one too many: the settling would push it through.
const CLEAR_OVER_SPACING: f64 = 0.3;

/// Places per ∆s among which those are found that have the most room.
const PLACES: i32 = 4;

/// What is chosen.
#[derive(Debug)]
pub(super) struct Chosen<const D: usize> {
    /// The region of every site that is kept.
    pub(super) region_of: Vec<Option<u32>>,
    /// More places, and their regions.
    pub(super) more: Vec<([f64; D], u32)>,
}

/// For every region (the parts, then the pockets) as many places as its share says: its deepest sites, and in place of those
/// that lie in or beside the layer of surface particles, `on_surface`, the places with the most room.
pub(super) fn choose<const D: usize>(
    problem: &Problem<D>,
    depths: &Depths,
    pockets: &Pockets<D>,
    sites: &[[f64; D]],
    on_surface: &[Closest<D>],
    regions: &[Share],
) -> Chosen<D> {
    let parts = problem.bodies.len();
    let beyond = BEYOND_OVER_SPACING * problem.spacing;
    let mut of_region: Vec<Vec<(u32, f64)>> = vec![Vec::new(); regions.len()];
    for i in 0..sites.len() {
        for (part, phi) in depths.around(i) {
            if phi < beyond && regions[part].sites > 0 {
                of_region[part].push((i as u32, depths.within(part, i)));
            }
        }
        let depth = depths.within(parts, i);
        if depth > -beyond
            && let Some(pocket) = pockets.of_site(i)
        {
            of_region[parts + pocket].push((i as u32, depth));
        }
    }
    let mut region_of: Vec<Option<u32>> = vec![None; sites.len()];
    let mut lacking: Vec<(u32, usize)> = Vec::new();
    for (region, (share, own)) in regions.iter().zip(&of_region).enumerate() {
        let free = (own.iter())
            .filter(|(i, _)| region_of[*i as usize].is_none())
            .map(|&(i, depth)| (i as usize, depth));
        let mut kept = deepest(free, share.sites, problem.spacing, problem.seed);
        kept.retain(|&i| is_clear(problem, depths, region, i));
        if kept.len() < share.sites {
            lacking.push((region as u32, share.sites - kept.len()));
        }
        for i in kept {
            region_of[i] = Some(region as u32);
        }
    }
    let mut more = Vec::new();
    if !lacking.is_empty() {
        let mut taken: Vec<[f64; D]> = on_surface.iter().map(|hit| hit.point).collect();
        taken.extend(
            (0..sites.len())
                .filter(|&i| region_of[i].is_some())
                .map(|i| sites[i]),
        );
        for (region, count) in lacking {
            let own: Vec<[f64; D]> = (of_region[region as usize].iter())
                .map(|&(i, _)| sites[i as usize])
                .collect();
            let places = between(problem, pockets, region as usize, &own);
            for place in roomiest(&places, &taken, count) {
                taken.push(place);
                more.push((place, region));
            }
        }
    }
    let mut chosen = Chosen { region_of, more };
    gaps::close(problem, pockets, sites, on_surface, &mut chosen);
    chosen
}

/// Whether a site is clear of the particle surfaces around its region.
fn is_clear<const D: usize>(
    problem: &Problem<D>,
    depths: &Depths,
    region: usize,
    site: usize,
) -> bool {
    let least = CLEAR_OVER_SPACING * problem.spacing;
    depths.around(site).all(|(part, phi)| {
        let inset = problem.bodies[part].inset_over_spacing * problem.spacing;
        match region.cmp(&part) {
            // Outside of every part that comes before, of all of them in the fluid.
            Ordering::Greater => phi + inset >= least,
            Ordering::Equal => -phi - inset >= least,
            // Parts around it are none of its affair.
            Ordering::Less => phi <= 0.0 || phi + inset >= least,
        }
    })
}

/// Places between and beside the sites of a region, all in it and as clear of its surface as any are.
fn between<const D: usize>(
    problem: &Problem<D>,
    pockets: &Pockets<D>,
    region: usize,
    sites: &[[f64; D]],
) -> Vec<[f64; D]> {
    let parts = problem.bodies.len();
    let step = problem.spacing / f64::from(PLACES);
    let bounds = problem.domain.bounds;
    // Cells of a grid that a site, or the middle of a part without one, is within ∆s of.
    let reach = PLACES + 1;
    let mut cells: Vec<[i32; D]> = Vec::new();
    let from: Vec<[f64; D]> = match problem.bodies.get(region) {
        Some(part) if sites.is_empty() => vec![part.surface.bounds().center()],
        _ => sites.to_vec(),
    };
    for p in from {
        let middle: [i32; D] =
            std::array::from_fn(|k| ((p[k] - bounds.min[k]) / step).round() as i32);
        let around = (2 * reach + 1) as usize;
        for number in 0..around.pow(D as u32) {
            let mut rest = number;
            cells.push(std::array::from_fn(|k| {
                let i = (rest % around) as i32 - reach;
                rest /= around;
                middle[k] + i
            }));
        }
    }
    cells.sort_unstable();
    cells.dedup();
    let places: Vec<[f64; D]> = (cells.into_iter())
        .map(|cell| std::array::from_fn(|k| bounds.min[k] + step * f64::from(cell[k])))
        .filter(|&p| bounds.contains(p))
        .collect();
    let around = Bounds::of(&places);
    let near = 2.0 * problem.spacing;
    let depths = Depths::of(&problem.bodies, around, problem.spacing, near, &places);
    let is_own = |i: usize| {
        let depth = depths.within(region.min(parts), i);
        depth > 0.0 && (region < parts || pockets.at(problem, places[i]) == Some(region - parts))
    };
    let own: Vec<usize> = (0..places.len()).filter(|&i| is_own(i)).collect();
    let clear: Vec<usize> = (own.iter().copied())
        .filter(|&i| is_clear(problem, &depths, region.min(parts), i))
        .collect();
    let best = if clear.is_empty() { own } else { clear };
    best.into_iter().map(|i| places[i]).collect()
}

/// A place, and how far it is from what was taken when that was last looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Room {
    distance: f64,
    place: usize,
    /// Of the places that were taken since, those that `distance` knows.
    known: usize,
}

impl Eq for Room {}

impl Ord for Room {
    fn cmp(&self, other: &Self) -> Ordering {
        (self.distance.total_cmp(&other.distance)).then(other.place.cmp(&self.place))
    }
}

impl PartialOrd for Room {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// One after another the `count` places that are farthest from all that are taken.
fn roomiest<const D: usize>(
    places: &[[f64; D]],
    taken: &[[f64; D]],
    count: usize,
) -> Vec<[f64; D]> {
    let tree = KdTree::new(taken).ok();
    let mut heap: BinaryHeap<Room> = (places.iter().enumerate())
        .map(|(place, &p)| Room {
            distance: (tree.as_ref())
                .and_then(|tree| tree.nearest(p))
                .map_or(f64::INFINITY, |hit| hit.distance),
            place,
            known: 0,
        })
        .collect();
    let mut chosen: Vec<[f64; D]> = Vec::new();
    while chosen.len() < count
        && let Some(room) = heap.pop()
    {
        if room.known == chosen.len() {
            chosen.push(places[room.place]);
            continue;
        }
        let distance = (chosen[room.known..].iter()).fold(room.distance, |least, &other| {
            least.min(point::distance(places[room.place], other))
        });
        heap.push(Room {
            distance,
            known: chosen.len(),
            ..room
        });
    }
    chosen
}

/// The deepest of a region's sites, `count` of them, of `sites` with their depths. Depths are compared to within 10⁻⁹ ∆s, so
/// that neither the unit of length nor the place of the origin decides between equals.
pub(crate) fn deepest(
    sites: impl Iterator<Item = (usize, f64)>,
    count: usize,
    spacing: f64,
    seed: u64,
) -> Vec<usize> {
    let mut candidates: Vec<(f64, u64, usize)> = sites
        .map(|(i, depth)| {
            let depth = (depth / spacing * 1e9).round();
            (depth, scrambled(i as u64 ^ seed), i)
        })
        .collect();
    // Deepest first; equals in no order that favours a side.
    let order =
        |a: &(f64, u64, usize), b: &(f64, u64, usize)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
    if count < candidates.len() {
        candidates.select_nth_unstable_by(count, order);
        candidates.truncate(count);
    }
    candidates.into_iter().map(|(_, _, i)| i).collect()
}

/// A one-to-one scramble of 64 bits (the finaliser of SplitMix64).
fn scrambled(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
