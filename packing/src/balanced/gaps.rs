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

/// Moves at most, per surface particle.
const MOST_MOVES: usize = 4;

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
    let most = MOST_MOVES * on_surface.len();
    for (_, gap, region) in gaps.into_iter().take(most) {
        let wide = match cells.room(gap, 2.0 * spacing, None) {
            Some(room) if room < GAP_OVER_SPACING * spacing => continue,
            room => room.unwrap_or(2.0 * spacing),
        };
        let Some((room, place, who)) = cells.most_crowded(gap, region) else {
            continue;
        };
        if wide < room + GAIN_OVER_SPACING * spacing {
            continue;
        }
        cells.remove(place, who);
        match who {
            Who::Site(site, region) => {
                chosen.region_of[site as usize] = None;
                let number = chosen.more.len() as u32;
                chosen.more.push((gap, region));
                cells.add(gap, Who::More(number, region));
            }
            Who::More(number, region) => {
                chosen.more[number as usize].0 = gap;
                cells.add(gap, Who::More(number, region));
            }
            Who::Surface => {}
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

impl Who {
    fn is_of(self, region: u32) -> bool {
        matches!(self, Self::Site(_, own) | Self::More(_, own) if own == region)
    }
}

/// What stands in a cell.
type Standing<const D: usize> = Vec<([f64; D], Who)>;

/// Places in cells of a grid, which come and go.
#[derive(Debug)]
struct Cells<const D: usize> {
    edge: f64,
    cells: HashMap<[i32; D], Standing<D>>,
}

/// Cells to each side in which a crowded particle is looked for.
const WAY: i32 = 12;

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

    /// The free particle of a region, not too far from a place, that has the least room.
    fn most_crowded(&self, place: [f64; D], region: u32) -> Option<(f64, [f64; D], Who)> {
        let mut worst: Option<(f64, [f64; D], Who)> = None;
        for cell in Self::around(self.cell(place), WAY) {
            for &(other, who) in self.cells.get(&cell).into_iter().flatten() {
                if who.is_of(region) {
                    let room = self.room(other, self.edge, Some(who)).unwrap_or(self.edge);
                    if worst.is_none_or(|(least, _, _)| room < least) {
                        worst = Some((room, other, who));
                    }
                }
            }
        }
        worst
    }
}
