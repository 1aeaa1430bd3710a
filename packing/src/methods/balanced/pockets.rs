//! The connected pockets of fluid between the bodies.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, KdTree, place_of, point};

use crate::depths::{Depths, around};
use crate::problem::Problem;

/// Sites nearer to each other than this, in ∆s, are neighbours: beyond the nearest of every lattice, short of the next.
const LINK_OVER_SPACING: f64 = 1.3;

/// A passage narrower than this, in ∆s, does not connect: no particle's pressure passes it.
const PASSAGE_OVER_SPACING: f64 = 0.1;

/// Cells per ∆s by which volumes of pockets are measured, and the size of the cells that measuring begins with, in ∆s.
const FINEST: f64 = 4.0;
const COARSEST: f64 = 4.0;

/// In no pocket.
const NONE: u32 = u32::MAX;

/// The fluid's sites and volumes by pocket, that of most sites first.
#[derive(Debug)]
pub(super) struct Pockets<const D: usize> {
    /// Of every site; [`NONE`] in bodies.
    of_site: Vec<u32>,
    /// Scene units to the power D; all together what the bodies leave of the box.
    pub(super) volume: Vec<f64>,
    /// Where there is more than one.
    fluid: Option<Fluid<D>>,
}

/// The sites in the fluid.
#[derive(Debug)]
struct Fluid<const D: usize> {
    tree: KdTree<D>,
    place: Vec<[f64; D]>,
    /// How far each is from the nearest body.
    distance: Vec<f64>,
    pocket: Vec<u32>,
}

impl<const D: usize> Pockets<D> {
    /// The pockets of a problem whose bodies are parts. `whole` is the volume of all fluid, `least` that of half a particle:
    /// smaller pockets get none, and their volume is the first one's. A query per site, and a few more beside surfaces.
    pub(super) fn of(
        problem: &Problem<D>,
        sites: &[[f64; D]],
        depths: &Depths,
        whole: f64,
        least: f64,
    ) -> Self {
        let one = |of_site: Vec<u32>| Self {
            of_site,
            volume: vec![whole],
            fluid: None,
        };
        let outside: Vec<f64> = (0..sites.len())
            .map(|i| {
                let around = depths.around(i);
                around.fold(f64::INFINITY, |least, (_, phi)| least.min(phi))
            })
            .collect();
        let index: Vec<usize> = (0..sites.len()).filter(|&i| outside[i] > 0.0).collect();
        let mut of_site = vec![NONE; sites.len()];
        index.iter().for_each(|&i| of_site[i] = 0);
        let place: Vec<[f64; D]> = index.iter().map(|&i| sites[i]).collect();
        let Ok(tree) = KdTree::new(&place) else {
            return one(of_site);
        };
        let distance: Vec<f64> = index.iter().map(|&i| outside[i]).collect();
        let pocket = connected(problem, &tree, &place, &distance);
        let count = pocket.iter().max().map_or(0, |&most| most as usize + 1);
        if count < 2 {
            return one(of_site);
        }
        let fluid = Fluid {
            tree,
            place,
            distance,
            pocket,
        };
        let measured = fluid.measure(problem, count);
        let mut kept = vec![NONE; count];
        let mut volume = vec![0.0];
        kept[0] = 0;
        for k in (1..count).filter(|&k| measured[k] >= least) {
            kept[k] = volume.len() as u32;
            volume.push(measured[k]);
        }
        volume[0] = whole - volume[1..].iter().sum::<f64>();
        let fluid = Fluid {
            pocket: fluid.pocket.iter().map(|&k| kept[k as usize]).collect(),
            ..fluid
        };
        for (&i, &pocket) in index.iter().zip(&fluid.pocket) {
            of_site[i] = pocket;
        }
        Self {
            of_site,
            volume,
            fluid: Some(fluid),
        }
    }

    /// The pocket of a site; `None` where there is no room for a particle and, unless there is but one pocket, in bodies.
    pub(super) fn of_site(&self, site: usize) -> Option<usize> {
        if self.fluid.is_none() {
            return Some(0);
        }
        let pocket = self.of_site[site];
        (pocket != NONE).then_some(pocket as usize)
    }

    /// The pocket in front of a body's surface where that is nearest to a place; `None` where another body is there.
    pub(super) fn in_front(
        &self,
        problem: &Problem<D>,
        body: usize,
        place: [f64; D],
    ) -> Option<usize> {
        let hit = problem.bodies[body].surface.closest(place);
        let out = PASSAGE_OVER_SPACING * problem.spacing();
        let front = point::add_scaled(hit.point, out, hit.normal);
        (distance(problem, front) > 0.0)
            .then(|| self.at(problem, front))
            .flatten()
    }

    /// The pocket of a place in the fluid: that of the nearest site that can be seen from it.
    pub(super) fn at(&self, problem: &Problem<D>, place: [f64; D]) -> Option<usize> {
        let Some(fluid) = &self.fluid else {
            return Some(0);
        };
        let place = problem.domain.wrap(place);
        let pocket = fluid.seen_from(problem, place, distance(problem, place))?;
        (pocket != NONE).then_some(pocket as usize)
    }
}

impl<const D: usize> Fluid<D> {
    fn seen_from(&self, problem: &Problem<D>, place: [f64; D], here: f64) -> Option<u32> {
        let near = self.tree.nearest_n(place, 2 * D + 4);
        let seen = near.iter().find(|hit| {
            let ends = [here, self.distance[hit.index]];
            is_open(problem, place, self.place[hit.index], ends)
        });
        Some(self.pocket[seen.or(near.first())?.index])
    }

    /// The pockets' volumes, cell by cell: whole ones where no surface is near, else halved ones, down to [`FINEST`],
    /// where the distance from the surface says how much of a cell is fluid.
    fn measure(&self, problem: &Problem<D>, pockets: usize) -> Vec<f64> {
        let bounds = problem.domain.bounds;
        let size = bounds.size();
        let count: [usize; D] = std::array::from_fn(|k| {
            (size[k] / (COARSEST * problem.spacing())).ceil().max(1.0) as usize
        });
        let edge: [f64; D] = std::array::from_fn(|k| size[k] / count[k] as f64);
        let all: Vec<u16> = (0..problem.bodies.len() as u16).collect();
        let sums: Vec<Vec<(u32, f64)>> = (0..count.iter().product::<usize>())
            .into_par_iter()
            .map(|number| {
                let cell = place_of(number, count);
                let min: [f64; D] =
                    std::array::from_fn(|k| bounds.min[k] + edge[k] * cell[k] as f64);
                let mut sums = Vec::new();
                self.add_up(
                    problem,
                    Bounds::new(min, point::add(min, edge)),
                    &all,
                    &mut sums,
                );
                sums
            })
            .collect();
        let mut volume = vec![0.0; pockets];
        for (pocket, part) in sums.into_iter().flatten() {
            volume[pocket as usize] += part;
        }
        volume
    }

    /// What is fluid of a cell, by pockets. `bodies` are those that may be near.
    fn add_up(
        &self,
        problem: &Problem<D>,
        cell: Bounds<D>,
        bodies: &[u16],
        sums: &mut Vec<(u32, f64)>,
    ) {
        let center = cell.center();
        let radius = 0.5 * cell.diagonal();
        let seen = around(&problem.bodies, bodies, center, 2.0 * radius);
        let distance =
            (seen.iter()).fold(f64::INFINITY, |least, (_, seen)| least.min(seen.distance));
        let width = cell.size()[0];
        let part = if distance >= radius {
            1.0
        } else if distance <= -radius {
            0.0
        } else if width * FINEST <= 1.001 * problem.spacing() {
            (0.5 + distance / width).clamp(0.0, 1.0)
        } else {
            let listed: Vec<u16> = seen.into_iter().map(|(body, _)| body).collect();
            for bits in 0..1_usize << D {
                let is_upper = |k: usize| bits >> k & 1 == 1;
                let min =
                    std::array::from_fn(|k| if is_upper(k) { center[k] } else { cell.min[k] });
                let max =
                    std::array::from_fn(|k| if is_upper(k) { cell.max[k] } else { center[k] });
                self.add_up(problem, Bounds::new(min, max), &listed, sums);
            }
            return;
        };
        if part > 0.0
            && let Some(pocket) = self.seen_from(problem, center, distance)
        {
            sums.push((pocket, part * cell.volume()));
        }
    }
}

/// Places whose links are looked for at once: those of all places took 75 bytes a place, half of all that there was then.
const AT_ONCE: usize = 1 << 17;

/// The number of the pocket of every place, that of most places first.
fn connected<const D: usize>(
    problem: &Problem<D>,
    tree: &KdTree<D>,
    place: &[[f64; D]],
    distance: &[f64],
) -> Vec<u32> {
    let link = LINK_OVER_SPACING * problem.spacing();
    let linked_to = |i: usize| {
        let mut linked = Vec::new();
        for image in problem.domain.images(place[i], link) {
            for hit in tree.within(image, link) {
                let j = hit.index;
                if j > i && is_open(problem, image, place[j], [distance[i], distance[j]]) {
                    linked.push(j as u32);
                }
            }
        }
        linked
    };
    let mut first: Vec<u32> = (0..place.len() as u32).collect();
    for begin in (0..place.len()).step_by(AT_ONCE) {
        let some = begin..place.len().min(begin + AT_ONCE);
        let links: Vec<Vec<u32>> = (some.clone().into_par_iter())
            .with_min_len(256)
            .map(linked_to)
            .collect();
        for (i, linked) in some.zip(links) {
            for j in linked {
                let (a, b) = (root(&mut first, i as u32), root(&mut first, j));
                first[a.max(b) as usize] = a.min(b);
            }
        }
    }
    let mut size = vec![0_usize; place.len()];
    for i in 0..place.len() as u32 {
        size[root(&mut first, i) as usize] += 1;
    }
    let mut roots: Vec<u32> = (0..place.len() as u32)
        .filter(|&i| size[i as usize] > 0)
        .collect();
    roots.sort_by_key(|&i| (std::cmp::Reverse(size[i as usize]), i));
    let mut number = vec![0; place.len()];
    for (k, &i) in (0_u32..).zip(&roots) {
        number[i as usize] = k;
    }
    (0..place.len() as u32)
        .map(|i| number[root(&mut first, i) as usize])
        .collect()
}

/// The first member of a set of joined numbers; ways to it are halved.
pub(super) fn root(first: &mut [u32], mut i: u32) -> u32 {
    while first[i as usize] != i {
        first[i as usize] = first[first[i as usize] as usize];
        i = first[i as usize];
    }
    i
}

/// How far a place is from the nearest body, at most [`LINK_OVER_SPACING`]; negative inside.
fn distance<const D: usize>(problem: &Problem<D>, place: [f64; D]) -> f64 {
    let reach = LINK_OVER_SPACING * problem.spacing();
    problem.bodies.iter().fold(reach, |least, body| {
        let hit = body.surface.closest_within(place, least.abs());
        hit.map_or(least, |hit| least.min(hit.distance))
    })
}

/// Whether the straight way from one place in the fluid to another, so far from bodies each, is through fluid. Goes on by
/// as much as there is room.
pub(super) fn is_open<const D: usize>(
    problem: &Problem<D>,
    from: [f64; D],
    to: [f64; D],
    ends: [f64; 2],
) -> bool {
    let way = point::sub(to, from);
    let length = point::norm(way);
    let least = 0.5 * PASSAGE_OVER_SPACING * problem.spacing();
    // Out of a body, where the way begins in one.
    let first = if ends[0] > 0.0 { 1e-3 } else { 1.0 };
    let mut gone = ends[0].max(first * least);
    while gone < length - ends[1] {
        let room = distance(problem, point::add_scaled(from, gone / length, way));
        // Beside its ends, which may be as near to a surface as they like, a passage grows as it is left behind.
        let from_end = gone.min(length - gone);
        if room < least.min(0.5 * from_end) {
            return false;
        }
        gone += room;
    }
    true
}
