//! Mending what can safely be mended, and saying what was done.

use std::collections::BTreeSet;
use std::fmt;

use super::Sketch;
use super::report::OutlineReport;
use super::survey::{Relation, Survey};
use crate::outline::booleans::{Filled, resolved};
use crate::segment::signed_area;
use crate::soup::{Joined, four_digits, seven_digits};

/// Something that was done to loops.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum OutlineRepair {
    /// Points that repeated the one before were left out.
    DroppedRepeats(usize),
    /// Spikes were left out.
    DroppedSpikes(usize),
    /// Loops whose points lie on one line were left out.
    DroppedEmpty(usize),
    /// Loops that were there already were left out.
    DroppedDuplicates(usize),
    /// Loops that met themselves were taken for what they wind around the right way.
    Untangled {
        /// How many loops.
        loops: usize,
        /// The first place at which one met itself.
        place: [f64; 2],
        /// The area of what they wound around twice or the wrong way, which is there once or not at all.
        area: f64,
    },
    /// Loops that overlapped were joined: what of them was inside is gone.
    Joined {
        /// How many loops there were.
        loops: usize,
        /// How much area they had in common, that is, was there twice.
        shared_area: f64,
    },
    /// Loops that touched were put together: sides that two bodies shared are gone, holes at an edge are notches.
    Merged(usize),
    /// Places at which the outline touches itself in a point were left.
    LeftContacts(usize),
    /// Filled paths of a drawing that were open were closed by straight sides, as a viewer does.
    ClosedPaths {
        /// How many.
        paths: usize,
        /// The widest of their gaps.
        widest: f64,
    },
    /// Strokes of a drawing were taken for what they paint.
    Stroked {
        /// How many.
        strokes: usize,
        /// The width of the widest.
        widest: f64,
        /// Whether nothing in the drawing is filled.
        is_all: bool,
    },
    /// Texts of a drawing were left out.
    LeftOutTexts(usize),
    /// Images in a drawing were left out.
    LeftOutImages(usize),
    /// Masks and filters of a drawing were not applied.
    LeftOutEffects(usize),
}

impl fmt::Display for OutlineRepair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |n: usize, one: &'static str, several: &'static str| {
            if n == 1 { one } else { several }
        };
        match *self {
            Self::DroppedRepeats(n) => write!(
                f,
                "{n} {} left out",
                of(
                    n,
                    "point that repeats the one before was",
                    "points that repeat the ones before were"
                )
            ),
            Self::DroppedSpikes(n) => write!(
                f,
                "{n} {} left out",
                of(
                    n,
                    "spike, where the outline turned straight back, was",
                    "spikes, where the outline turned straight back, were"
                )
            ),
            Self::DroppedEmpty(n) => write!(
                f,
                "{n} {} left out",
                of(n, "loop without area was", "loops without area were")
            ),
            Self::DroppedDuplicates(n) => write!(
                f,
                "{n} {} left out",
                of(
                    n,
                    "loop that was there already was",
                    "loops that were there already were"
                )
            ),
            Self::Untangled { loops, place, area } => {
                let [x, y] = place.map(seven_digits);
                write!(
                    f,
                    "{loops} {}, first near ({x}, {y}), taken for what {} around the right way; an area of {} that was wound around twice or the wrong way counts once or not at all",
                    of(
                        loops,
                        "loop that met itself was",
                        "loops that met themselves were"
                    ),
                    of(loops, "it winds", "they wind"),
                    four_digits(area)
                )
            }
            Self::Joined { loops, shared_area } => write!(
                f,
                "{loops} loops that overlapped were joined; an area of {} that they shared counts once",
                four_digits(shared_area)
            ),
            Self::Merged(n) => {
                write!(f, "{n} loops that touched each other were put together")
            }
            Self::LeftContacts(n) => write!(
                f,
                "{n} {} left",
                of(
                    n,
                    "contact of the outline with itself, in a point, was",
                    "contacts of the outline with itself, in points, were"
                )
            ),
            Self::ClosedPaths { paths, widest } => write!(
                f,
                "{paths} filled {} closed by a straight side; the widest gap was {}",
                of(
                    paths,
                    "path of the drawing that was open was",
                    "paths of the drawing that were open were"
                ),
                four_digits(widest)
            ),
            Self::Stroked {
                strokes,
                widest,
                is_all,
            } => write!(
                f,
                "{strokes} {} to the body, up to {} wide{}",
                of(strokes, "stroke belongs", "strokes belong"),
                four_digits(widest),
                if is_all {
                    ", and nothing else, as nothing in the drawing is filled: fill the paths if what they go round is meant"
                } else {
                    ", as a viewer paints them"
                }
            ),
            Self::LeftOutTexts(n) => write!(
                f,
                "{n} {} left out; turn it into paths in the drawing program if it belongs to the body",
                of(n, "text of the drawing was", "texts of the drawing were")
            ),
            Self::LeftOutImages(n) => write!(
                f,
                "{n} {} left out; trace it in the drawing program if it belongs to the body",
                of(n, "image in the drawing was", "images in the drawing were")
            ),
            Self::LeftOutEffects(n) => write!(
                f,
                "{n} {} not applied: what they change is there as if without them",
                of(
                    n,
                    "mask or filter of the drawing was",
                    "masks and filters of the drawing were"
                )
            ),
        }
    }
}

/// Loops after mending.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct RepairedSketch {
    /// The loops that are left. Where loops were joined, outer ones run counter-clockwise, holes clockwise.
    pub sketch: Sketch,
    /// What was done, in this order.
    pub done: Vec<OutlineRepair>,
    /// What is still wrong.
    pub report: OutlineReport,
    /// Whether the directions of the loops tell what is solid: their nesting may not where they touch.
    pub(super) is_directed: bool,
}

impl Sketch {
    /// What is wrong with the loops, every defect with its count and a place, and what the loops are to the body.
    /// Crossings and contacts are looked for after repeated points, spikes and loops without area are left out.
    /// O(n log n) for n points that spread out, and as many meetings.
    #[must_use]
    pub fn check(&self) -> OutlineReport {
        Survey::new(self).report(self)
    }

    /// Mends what can be mended without a guess: repeated points, spikes, loops without area and doubled loops are left
    /// out. A loop that meets itself is taken for what it winds around the right way, where what it winds around the
    /// wrong way has less than 1 % of the area. Loops that overlap are joined where all that hang together run the same
    /// way round and none is within another of them; loops that touch are put together by their nesting. Where one of
    /// these cannot be done, none is. Loops of one or two points stay: they may be what is left of a loop that was cut
    /// apart.
    #[must_use]
    pub fn repaired(&self) -> RepairedSketch {
        let survey = Survey::new(self);
        let mut repaired = RepairedSketch {
            sketch: self.clone(),
            done: self.done.clone(),
            report: survey.report(self),
            is_directed: false,
        };
        if survey.rings.is_empty() {
            return repaired;
        }
        survey.tell_what_is_dropped(&mut repaired.done);
        // A loop of one or two points may be the rest of one that was cut apart.
        let cut_off: Vec<usize> = (0..self.loops.len())
            .filter(|&k| survey.trimmed[k].different < 3)
            .collect();
        let meets = !survey.pairs.is_empty() || survey.rings.iter().any(|r| r.own.is_some());
        if meets
            && cut_off.is_empty()
            && let Some(loops) = survey.joined(&mut repaired.done)
        {
            repaired.sketch.loops = loops;
            repaired.is_directed = true;
        } else {
            let kept = survey.kept.iter();
            let kept = kept.map(|&k| survey.trimmed[k].points.clone());
            let cut_off = cut_off.iter().map(|&k| self.loops[k].clone());
            repaired.sketch.loops = kept.chain(cut_off).collect();
        }
        repaired.report = repaired.sketch.check();
        repaired
    }
}

impl Survey {
    fn tell_what_is_dropped(&self, done: &mut Vec<OutlineRepair>) {
        let count = |of: &dyn Fn(usize) -> usize| (0..self.trimmed.len()).map(of).sum();
        let dropped = [
            OutlineRepair::DroppedRepeats(count(&|k| self.trimmed[k].repeats.0)),
            OutlineRepair::DroppedSpikes(count(&|k| self.trimmed[k].spikes.0)),
            OutlineRepair::DroppedEmpty(count(&|k| usize::from(self.trimmed[k].points.is_empty()))),
            OutlineRepair::DroppedDuplicates(count(&|k| usize::from(self.is_double[k]))),
        ];
        done.extend(dropped.into_iter().filter(|repair| {
            !matches!(
                repair,
                OutlineRepair::DroppedRepeats(0)
                    | OutlineRepair::DroppedSpikes(0)
                    | OutlineRepair::DroppedEmpty(0)
                    | OutlineRepair::DroppedDuplicates(0)
            )
        }));
    }

    /// One set of loops for all that meet and all that do not; `None` where it would be a guess.
    fn joined(&self, done: &mut Vec<OutlineRepair>) -> Option<Vec<Vec<[f64; 2]>>> {
        if self.rings.iter().any(|ring| ring.is_tangled) {
            return None;
        }
        let area = |loops: &[Vec<[f64; 2]>]| -> f64 {
            loops.iter().map(|points| signed_area(points)).sum()
        };
        let mut loops = Vec::new();
        let (mut joined, mut shared_area, mut merged) = (0, 0.0, 0);
        let (clusters, of) = self.clusters();
        let overlapping: BTreeSet<usize> = (self.pairs.iter())
            .filter(|(_, (_, relation))| *relation == Relation::Overlap)
            .map(|(pair, _)| of[pair.0])
            .collect();
        for cluster in clusters {
            let regions = cluster.iter().flat_map(|&k| self.rings[k].region.clone());
            let regions: Vec<Vec<[f64; 2]>> = regions.collect();
            let number = of[cluster[0]];
            if cluster.len() == 1 {
                loops.extend(regions);
            } else if overlapping.contains(&number) {
                let first = self.rings[cluster[0]].is_counter_clockwise;
                let is_guess = cluster.iter().any(|&k| {
                    let ring = &self.rings[k];
                    ring.is_counter_clockwise != first
                        || ring.around.iter().any(|&m| of[m] == number)
                });
                if is_guess {
                    return None;
                }
                let whole = resolved(&regions, Filled::Positive);
                joined += cluster.len();
                shared_area += (area(&regions) - area(&whole)).max(0.0);
                loops.extend(whole);
            } else {
                merged += cluster.len();
                loops.extend(resolved(&regions, Filled::Odd));
            }
        }
        self.tell_what_is_untangled(done);
        if joined > 0 {
            done.push(OutlineRepair::Joined {
                loops: joined,
                shared_area,
            });
        }
        if merged > 0 {
            done.push(OutlineRepair::Merged(merged));
        }
        let whole = resolved(&loops, Filled::Odd);
        (!whole.is_empty()).then_some(whole)
    }

    fn tell_what_is_untangled(&self, done: &mut Vec<OutlineRepair>) {
        let own = self
            .rings
            .iter()
            .filter_map(|ring| ring.own.map(|own| (ring, own)));
        let place = own.clone().next().map(|(_, own)| own.place);
        if let Some(place) = place {
            // The signed area counts what is there twice twice, and what is the wrong way round with a minus.
            let twice = own
                .clone()
                .map(|(ring, _)| signed_area(&ring.points) + 2.0 * ring.wrong - ring.area);
            done.push(OutlineRepair::Untangled {
                loops: own.count(),
                place,
                area: twice.sum::<f64>().max(0.0),
            });
        }
    }

    /// Rings that hang together by meeting, in the order of their first; and the first of every ring's.
    fn clusters(&self) -> (Vec<Vec<usize>>, Vec<usize>) {
        let mut together = Joined::new(self.rings.len());
        for &(a, b) in self.pairs.keys() {
            together.join(a as u32, b as u32);
        }
        let of: Vec<usize> = (0..self.rings.len())
            .map(|k| together.find(k as u32) as usize)
            .collect();
        let mut clusters: Vec<Vec<usize>> = vec![Vec::new(); of.len()];
        for (k, &first) in of.iter().enumerate() {
            clusters[first].push(k);
        }
        clusters.retain(|cluster| !cluster.is_empty());
        (clusters, of)
    }
}
