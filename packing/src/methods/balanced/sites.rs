//! Where the particles of every region start: lattice sites, and places between them where there are too few.

use std::cmp::Ordering;

use sphpack_geometry::Closest;
use sphpack_neighbors::Odometer;

use super::places::{self, Lack};
use super::pockets::Pockets;
use super::rim::{self, Candidate};
use super::shares::Share;
use crate::depths::Depths;
use crate::problem::{DEFAULT_INSET_OVER_SPACING, Problem};

/// Sites farther beyond a region's surface than this, in ∆s, are none of its.
const BEYOND_OVER_SPACING: f64 = 1.0;

/// A site nearer to the particle surface than this, in ∆s, is one too many: the settling would push it through.
const CLEAR_OVER_SPACING: f64 = 0.3;

/// Places per ∆s among which those are found that have the most room, in the plane and in space.
const PLACES: [i32; 2] = [4, 2];

/// Places are looked for within this of surface particles, in ∆s.
const BESIDE_OVER_SPACING: f64 = 1.5;

/// A place nearer than this to another particle, in ∆s, is none.
const ROOM_OVER_SPACING: f64 = 0.6;

/// What is chosen.
#[derive(Debug)]
pub(super) struct Chosen<const D: usize> {
    /// The region of every site that is kept.
    pub(super) region_of: Vec<Option<u32>>,
    /// More places, and their regions.
    pub(super) more: Vec<([f64; D], u32)>,
    /// How many every region has; fewer than its share where there is no room.
    pub(super) count: Vec<usize>,
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
    let beyond = BEYOND_OVER_SPACING * problem.spacing();
    let mut of_region: Vec<Vec<(u32, f64)>> = vec![Vec::new(); regions.len()];
    for i in 0..sites.len() {
        for (part, phi) in depths.around(i) {
            if phi < beyond && regions[part].sites > 0 {
                of_region[part].push((i as u32, depths.within(part, i)));
            }
        }
        let depth = depths.within(parts, i);
        if depth > -beyond
            && let Some(pocket) = (pockets.of_site(i))
                .or_else(|| pocket_in_front(problem, depths, pockets, (i, sites[i])))
        {
            of_region[parts + pocket].push((i as u32, depth));
        }
    }
    let mut region_of: Vec<Option<u32>> = vec![None; sites.len()];
    let mut lacking: Vec<Lack<D>> = Vec::new();
    for (region, (share, own)) in regions.iter().zip(&of_region).enumerate() {
        let free: Vec<Candidate<D>> = (own.iter())
            .filter(|(i, _)| region_of[*i as usize].is_none())
            .map(|&(i, depth)| Candidate {
                site: i as usize,
                place: sites[i as usize],
                depth,
            })
            .collect();
        let mut kept = rim::chosen(&free, share.sites, problem.spacing(), problem.seed);
        let mut beside = Vec::new();
        kept.retain(|&i| {
            let is_clear = is_clear(problem, depths, region, i);
            if !is_clear {
                beside.push(sites[i]);
            }
            is_clear
        });
        if kept.len() < share.sites {
            lacking.push(Lack {
                region: region as u32,
                count: share.sites - kept.len(),
                beside,
            });
        }
        for i in kept {
            region_of[i] = Some(region as u32);
        }
    }
    let mut count: Vec<usize> = regions.iter().map(|share| share.sites).collect();
    let mut more = Vec::new();
    if !lacking.is_empty() {
        let mut taken: Vec<[f64; D]> = on_surface.iter().map(|hit| hit.point).collect();
        let kept = (0..sites.len()).filter(|&i| region_of[i].is_some());
        taken.extend(kept.map(|i| sites[i]));
        for lack in lacking {
            let region = lack.region as usize;
            let places = between(problem, pockets, region, on_surface);
            let none = lack.count == regions[region].sites && places.len() == 1;
            let least = if none {
                0.0
            } else {
                ROOM_OVER_SPACING * problem.spacing()
            };
            let found = places::found(&places, &taken, &lack, least, problem.spacing());
            count[region] -= lack.count - found.len();
            for place in found {
                taken.push(place);
                more.push((place, lack.region));
            }
        }
    }
    Chosen {
        region_of,
        more,
        count,
    }
}

/// The pocket of fluid in front of the body that a site is in, just behind its surface.
fn pocket_in_front<const D: usize>(
    problem: &Problem<D>,
    depths: &Depths,
    pockets: &Pockets<D>,
    (site, place): (usize, [f64; D]),
) -> Option<usize> {
    let nearest = (depths.around(site)).min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (body, phi) = nearest?;
    (phi <= 0.0)
        .then(|| pockets.in_front(problem, body, place))
        .flatten()
}

/// Whether a site is clear of the particle surfaces around its region.
fn is_clear<const D: usize>(
    problem: &Problem<D>,
    depths: &Depths,
    region: usize,
    site: usize,
) -> bool {
    let least = CLEAR_OVER_SPACING * problem.spacing();
    let usual = DEFAULT_INSET_OVER_SPACING * problem.spacing();
    depths.around(site).all(|(part, phi)| {
        let inset = problem.bodies[part].inset_over_spacing * problem.spacing();
        match region.cmp(&part) {
            // Outside of every part that comes before, of all of them in the fluid.
            Ordering::Greater => phi + inset >= least,
            // A surface that is asked for deeper than usual has particles above it too.
            Ordering::Equal => inset > usual || -phi - inset >= least,
            // Parts around it are none of its affair.
            Ordering::Less => phi <= 0.0 || phi + inset >= least,
        }
    })
}

/// Places beside the surface particles of a region, and around its middle where it has none, all in it and clear of its
/// surface. A part that has no surface particle, and no place that is clear, has its deepest.
fn between<const D: usize>(
    problem: &Problem<D>,
    pockets: &Pockets<D>,
    region: usize,
    on_surface: &[Closest<D>],
) -> Vec<[f64; D]> {
    let parts = problem.bodies.len();
    let step = problem.spacing() / f64::from(PLACES[D.saturating_sub(2).min(1)]);
    let bounds = problem.domain.bounds;
    let reach = (BESIDE_OVER_SPACING * problem.spacing() / step).ceil() as i64;
    let around = match problem.bodies.get(region) {
        Some(part) => part.surface.bounds().grown(0.01 * problem.spacing()),
        None => bounds,
    };
    let beside = (on_surface.iter().map(|hit| hit.point)).filter(|&p| around.contains(p));
    let has_none = beside.clone().next().is_none();
    let mut cells: Vec<[i32; D]> = Vec::new();
    for p in beside.chain([around.center()]) {
        let middle: [i32; D] =
            std::array::from_fn(|k| ((p[k] - bounds.min[k]) / step).round() as i32);
        let around = Odometer::new([-reach; D], [reach + 1; D]);
        cells.extend(around.map(|step| std::array::from_fn(|k| middle[k] + step[k] as i32)));
    }
    cells.sort_unstable();
    cells.dedup();
    let places: Vec<[f64; D]> = (cells.into_iter())
        .map(|cell| std::array::from_fn(|k| bounds.min[k] + step * f64::from(cell[k])))
        .chain([around.center()])
        .filter(|&p| bounds.contains(p) && around.contains(p))
        .collect();
    let near = 2.0 * problem.spacing();
    let depths = Depths::of(&problem.bodies, bounds, problem.spacing(), near, &places);
    let of_bodies = region.min(parts);
    let clear: Vec<[f64; D]> = (0..places.len())
        .filter(|&i| depths.within(of_bodies, i) > 0.0 && is_clear(problem, &depths, of_bodies, i))
        .filter(|&i| region < parts || pockets.at(problem, places[i]) == Some(region - parts))
        .map(|i| places[i])
        .collect();
    if clear.is_empty() && region < parts && has_none {
        let deepest = (0..places.len()).max_by(|&i, &j| {
            depths
                .within(region, i)
                .total_cmp(&depths.within(region, j))
        });
        return deepest.map(|i| places[i]).into_iter().collect();
    }
    clear
}
