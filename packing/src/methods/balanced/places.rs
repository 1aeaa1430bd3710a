//! Places for particles that no site is there for.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};

use sphpack_neighbors::{KdTree, Odometer, point};

/// What a region lacks.
#[derive(Debug)]
pub(super) struct Lack<const D: usize> {
    pub(super) region: u32,
    /// Particles.
    pub(super) count: usize,
    /// Where some of them were to be, had there been room: no more than `count`.
    pub(super) beside: Vec<[f64; D]>,
}

/// A particle that cannot be where it was to be is put no farther from there than this, in ∆s.
const ASIDE_OVER_SPACING: f64 = 2.0;

/// At most as many of `places` as are lacking, none nearer than `least` to what is `taken` or to each other: first those that
/// have the most room around where particles were to be, so that what a place lacks is not put elsewhere, then those that have the
/// most of all.
pub(super) fn found<const D: usize>(
    places: &[[f64; D]],
    taken: &[[f64; D]],
    lack: &Lack<D>,
    least: f64,
    spacing: f64,
) -> Vec<[f64; D]> {
    let taken = KdTree::new(taken).ok();
    let mut found = aside(places, taken.as_ref(), &lack.beside, least, spacing);
    add_roomiest(places, taken.as_ref(), &mut found, lack.count, least);
    found
}

/// For each of `wanted` the place near it that has the most room, if any has.
fn aside<const D: usize>(
    places: &[[f64; D]],
    taken: Option<&KdTree<D>>,
    wanted: &[[f64; D]],
    least: f64,
    spacing: f64,
) -> Vec<[f64; D]> {
    let Ok(near) = KdTree::new(places) else {
        return Vec::new();
    };
    let reach = ASIDE_OVER_SPACING * spacing;
    let cell = |p: [f64; D]| -> [i64; D] { p.map(|x| (x / reach).floor() as i64) };
    let mut chosen: HashMap<[i64; D], Vec<[f64; D]>> = HashMap::new();
    let mut found = Vec::new();
    for &wanted in wanted {
        let room = |place: [f64; D]| {
            let taken = taken
                .and_then(|tree| tree.nearest(place))
                .map_or(reach, |hit| hit.distance.min(reach));
            let middle = cell(place);
            (Odometer::new([-1; D], [2; D]))
                .filter_map(|step| chosen.get(&std::array::from_fn(|k| middle[k] + step[k])))
                .flatten()
                .fold(taken, |least, &other| {
                    least.min(point::distance(place, other))
                })
        };
        let mut around: Vec<usize> = near
            .within(wanted, reach)
            .iter()
            .map(|hit| hit.index)
            .collect();
        around.sort_unstable();
        let best = (around.into_iter().map(|i| (places[i], room(places[i]))))
            .filter(|&(_, room)| room >= least)
            // The first of equals, whatever rounding says.
            .reduce(|best, next| {
                if next.1 > best.1 + 1e-9 * spacing {
                    next
                } else {
                    best
                }
            });
        if let Some((place, _)) = best {
            chosen.entry(cell(place)).or_default().push(place);
            found.push(place);
        }
    }
    found
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

/// Adds to what is `chosen`, one after another until there are `count`, the places that are farthest from it and from all that are
/// taken, none nearer than `least`.
fn add_roomiest<const D: usize>(
    places: &[[f64; D]],
    taken: Option<&KdTree<D>>,
    chosen: &mut Vec<[f64; D]>,
    count: usize,
    least: f64,
) {
    if chosen.len() >= count {
        return;
    }
    let mut heap: BinaryHeap<Room> = (places.iter().enumerate())
        .map(|(place, &p)| Room {
            distance: taken
                .and_then(|tree| tree.nearest(p))
                .map_or(f64::INFINITY, |hit| hit.distance),
            place,
            known: 0,
        })
        .collect();
    while chosen.len() < count
        && let Some(room) = heap.pop()
        && room.distance >= least
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
}
