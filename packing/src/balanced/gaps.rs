//! Gaps and crowds where surfaces face each other: a lattice that is cut between them leaves both.

use std::collections::HashMap;

use sphpack_geometry::Closest;
use sphpack_neighbors::point;

use super::pockets::Pockets;
use super::sites::Chosen;
use crate::depths::Depths;
use crate::problem::Problem;

/// A place with no particle nearer than this, in ∆s, is a gap. A lattice leaves 0.62 (hexagonal) to 0.71 (face-centred).
const GAP_OVER_SPACING: f64 = 0.85;

/// Where gaps are looked for: so far from surface particles, in ∆s, to both sides.
const LOOK_OVER_SPACING: [f64; 3] = [0.75, 1.0, 1.25];

/// A particle is only moved into a gap that gives it so much more room than it has, in ∆s.
const GAIN_OVER_SPACING: f64 = 0.15;

/// Moves the most crowded free particles of a region into its widest gaps beside surfaces, while that gives them more room.
pub(super) fn close<const D: usize>(
    problem: &Problem<D>,
    pockets: &Pockets<D>,
    sites: &[[f64; D]],
    on_surface: &[Closest<D>],
    chosen: &mut Chosen<D>,
) {
    let spacing = problem.spacing;
    let mut cells = Cells::new(spacing);
    for hit in on_surface {
        cells.add(hit.point, Who::Surface);
    }
    for (site, region) in chosen.region_of.iter().enumerate() {
        if let Some(region) = region {
            cells.add(sites[site], Who::Site(site as u32, *region));
        }
    }
    for (number, &(place, region)) in chosen.more.iter().enumerate() {
        cells.add(place, Who::More(number as u32, region));
    }
    let mut looked: Vec<[f64; D]> = Vec::new();
    for hit in on_surface {
        for far in LOOK_OVER_SPACING {
            for side in [-far, far] {
                let place = point::add_scaled(hit.point, side * spacing, hit.normal);
                if problem.domain.bounds.contains(place)
                    && cells
                        .room(place, GAP_OVER_SPACING * spacing, None)
                        .is_none()
                {
                    looked.push(place);
                }
            }
        }
    }
    if looked.is_empty() {
        return;
    }
    let bounds = problem.domain.bounds;
    let depths = Depths::of(&problem.bodies, bounds, spacing, spacing, &looked);
    let parts = problem.bodies.len();
    let mut gaps: Vec<(f64, [f64; D], u32)> = Vec::new();
    for (i, &place) in looked.iter().enumerate() {
        let part = (0..parts).find(|&part| depths.to_body(part, i) < 0.0);
        let region = part.or_else(|| Some(parts + pockets.at(problem, place)?));
        if let Some(region) = region {
            let room = cells.room(place, 2.0 * spacing, None);
            gaps.push((room.unwrap_or(2.0 * spacing), place, region as u32));
        }
    }
    // The widest first.
    gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut crowded = cells.crowded((GAP_OVER_SPACING - GAIN_OVER_SPACING) * spacing);
    for (_, gap, region) in gaps {
        let wide = match cells.room(gap, 2.0 * spacing, None) {
            Some(room) if room < GAP_OVER_SPACING * spacing => continue,
            room => room.unwrap_or(2.0 * spacing),
        };
        let Some(crowd) = crowded.get_mut(&region) else {
            continue;
        };
        // Who stood too near to one that has gone may have room by now.
        while let Some((place, who)) = crowd.pop() {
            let room = cells.room(place, spacing, Some(who)).unwrap_or(spacing);
            if room + GAIN_OVER_SPACING * spacing > GAP_OVER_SPACING * spacing {
                continue;
            }
            if room + GAIN_OVER_SPACING * spacing > wide {
                crowd.push((place, who));
                break;
            }
            cells.remove(place, who);
            let number = match who {
                Who::Site(site, _) => {
                    chosen.region_of[site as usize] = None;
                    chosen.more.push((gap, region));
                    chosen.more.len() - 1
                }
                Who::More(number, _) => {
                    chosen.more[number as usize].0 = gap;
                    number as usize
                }
                Who::Surface => break,
            };
            cells.add(gap, Who::More(number as u32, region));
            break;
        }
    }
}

/// Who sits in a place.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Who {
    Surface,
    /// A site, and its region.
    Site(u32, u32),
    /// A place that is no site.
    More(u32, u32),
}

/// What stands in a cell.
type Standing<const D: usize> = Vec<([f64; D], Who)>;

/// Places in cells of a grid, which come and go.
#[derive(Debug)]
struct Cells<const D: usize> {
    edge: f64,
    cells: HashMap<[i32; D], Standing<D>>,
}

impl<const D: usize> Cells<D> {
    fn new(edge: f64) -> Self {
        Self {
            edge,
            cells: HashMap::new(),
        }
    }

    fn cell(&self, place: [f64; D]) -> [i32; D] {
        place.map(|x| (x / self.edge).floor() as i32)
    }

    fn add(&mut self, place: [f64; D], who: Who) {
        self.cells
            .entry(self.cell(place))
            .or_default()
            .push((place, who));
    }

    fn remove(&mut self, place: [f64; D], who: Who) {
        if let Some(cell) = self.cells.get_mut(&self.cell(place)) {
            cell.retain(|&(_, other)| other != who || who == Who::Surface);
        }
    }

    /// The cells around one, so many to each side, in a fixed order.
    fn around(middle: [i32; D], way: i32) -> impl Iterator<Item = [i32; D]> {
        let width = (2 * way + 1) as usize;
        (0..width.pow(D as u32)).map(move |number| {
            let mut rest = number;
            std::array::from_fn(|k| {
                let i = (rest % width) as i32 - way;
                rest /= width;
                middle[k] + i
            })
        })
    }

    /// The distance of whoever is nearest to a place, but for `but`, within `most` (at most two cells).
    fn room(&self, place: [f64; D], most: f64, but: Option<Who>) -> Option<f64> {
        let way = (most / self.edge).ceil() as i32;
        Self::around(self.cell(place), way)
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .filter(|(_, who)| but.is_none_or(|but| but != *who))
            .map(|(other, _)| point::distance(place, *other))
            .filter(|distance| *distance < most)
            .reduce(f64::min)
    }

    /// The free particles with less room than `least`, by regions, those with the least last.
    fn crowded(&self, least: f64) -> HashMap<u32, Standing<D>> {
        let mut all: Vec<(f64, u64, [f64; D], Who)> = Vec::new();
        for &(place, who) in self.cells.values().flatten() {
            let number = match who {
                Who::Surface => continue,
                Who::Site(number, _) => u64::from(number),
                Who::More(number, _) => u64::from(number) + (1 << 32),
            };
            if let Some(room) = self.room(place, least, Some(who)) {
                all.push((room, number, place, who));
            }
        }
        // The order of the cells is nobody's; numbers decide between equals.
        all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut crowded: HashMap<u32, Standing<D>> = HashMap::new();
        for (_, _, place, who) in all {
            if let Who::Site(_, region) | Who::More(_, region) = who {
                crowded.entry(region).or_default().push((place, who));
            }
        }
        crowded
    }
}
