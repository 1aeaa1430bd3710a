//! Everything that checking and mending loops look at: how they meet, and which is in which.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use sphpack_neighbors::Bounds;

use super::Sketch;
use super::report::{
    LoopRole, OutlineDefect, OutlineDefectKind as Kind, OutlineReport, SketchLoop,
};
use super::trim::{Trimmed, trim};
use crate::Outline;
use crate::outline::booleans::{Filled, has_own_room, have_common_room, perimeter, resolved};
use crate::outline::{check, crosses};
use crate::segment::{side_of, signed_area};

/// A loop that crosses itself is taken for what it winds around the right way where what it winds around the wrong way
/// has at most this part of the area.
const FEW: f64 = 0.01;

/// More meetings than this are not counted, and nothing is joined.
const MOST_MEETINGS: usize = 1_000_000;

/// How two loops that meet lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    /// They have no room in common.
    Apart,
    /// The first is around the second.
    Around,
    /// The first is within the second.
    Within,
    /// They bound the same.
    Same,
    /// Each has room that the other has too, and room of its own.
    Overlap,
}

/// Pairs of sides that meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meetings {
    pub(super) count: usize,
    /// So many of them cross, the others touch.
    pub(super) crossings: usize,
    /// The first of them.
    pub(super) place: [f64; 2],
}

/// A loop that is left, its place in the sketch told by [`Survey::kept`].
#[derive(Debug)]
pub(super) struct Ring {
    /// Counter-clockwise.
    pub(super) points: Vec<[f64; 2]>,
    /// Whether it was given so.
    pub(super) is_counter_clockwise: bool,
    /// How it meets itself.
    pub(super) own: Option<Meetings>,
    /// What it bounds: itself, where it does not meet itself.
    pub(super) region: Vec<Vec<[f64; 2]>>,
    /// The area of that.
    pub(super) area: f64,
    /// The area of what it winds around the wrong way.
    pub(super) wrong: f64,
    /// Whether it crosses itself so that nobody knows what it bounds.
    pub(super) is_tangled: bool,
    /// The loops around it, by their place among those that are left; the smallest first.
    pub(super) around: Vec<usize>,
}

/// What is known of a sketch.
#[derive(Debug)]
pub(super) struct Survey {
    pub(super) trimmed: Vec<Trimmed>,
    /// Loops that are there already.
    pub(super) is_double: Vec<bool>,
    /// Of every ring, which loop of the sketch it is.
    pub(super) kept: Vec<usize>,
    pub(super) rings: Vec<Ring>,
    /// Pairs of rings that meet, the lower number first.
    pub(super) pairs: BTreeMap<(usize, usize), (Meetings, Relation)>,
}

impl Survey {
    pub(super) fn new(sketch: &Sketch) -> Self {
        let trimmed: Vec<Trimmed> = sketch.loops.iter().map(|points| trim(points)).collect();
        let mut is_double = doubles(&trimmed);
        loop {
            let survey = Self::of(&trimmed, &is_double);
            // Loops that run along each other with different points on them.
            let mut same = survey
                .pairs
                .iter()
                .filter(|(_, (_, relation))| *relation == Relation::Same)
                .map(|(&(_, later), _)| survey.kept[later])
                .peekable();
            if same.peek().is_none() {
                return Self {
                    trimmed,
                    is_double,
                    ..survey
                };
            }
            let same: Vec<usize> = same.collect();
            for index in same {
                is_double[index] = true;
            }
        }
    }

    fn of(trimmed: &[Trimmed], is_double: &[bool]) -> Self {
        let kept: Vec<usize> = (0..trimmed.len())
            .filter(|&k| !trimmed[k].points.is_empty() && !is_double[k])
            .collect();
        let mut survey = Self {
            trimmed: Vec::new(),
            is_double: Vec::new(),
            rings: Vec::with_capacity(kept.len()),
            kept,
            pairs: BTreeMap::new(),
        };
        if survey.kept.is_empty() {
            return survey;
        }
        let loops = survey.kept.iter().map(|&k| trimmed[k].points.clone());
        let outline = Outline::assemble(loops.collect());
        let (own, pairs, is_too_much) = meetings(&outline);
        for (&k, own) in survey.kept.iter().zip(own) {
            survey
                .rings
                .push(Ring::new(&trimmed[k].points, own, is_too_much));
        }
        for ((a, b), found) in pairs {
            let relation = if is_too_much {
                Relation::Overlap
            } else {
                relation(&survey.rings[a], &survey.rings[b])
            };
            survey.pairs.insert((a, b), (found, relation));
        }
        survey.nest(&outline);
        survey
    }

    /// Which rings are around each: of those it does not meet, those whose sides a ray crosses an odd number of times.
    fn nest(&mut self, outline: &Outline) {
        let mut around: Vec<Vec<usize>> = outline
            .rings_around()
            .into_iter()
            .enumerate()
            .map(|(k, mut around)| {
                around.retain(|&m| !self.pairs.contains_key(&(k.min(m), k.max(m))));
                around
            })
            .collect();
        for (&(a, b), &(_, relation)) in &self.pairs {
            match relation {
                Relation::Around => around[b].push(a),
                Relation::Within => around[a].push(b),
                Relation::Apart | Relation::Same | Relation::Overlap => {}
            }
        }
        for (k, mut around) in around.into_iter().enumerate() {
            around.sort_by(|&a, &b| {
                (self.rings[a].area.total_cmp(&self.rings[b].area)).then(a.cmp(&b))
            });
            self.rings[k].around = around;
        }
    }

    pub(super) fn report(&self, sketch: &Sketch) -> OutlineReport {
        let mut found: BTreeMap<Kind, OutlineDefect> = BTreeMap::new();
        let mut add = |kind, count: usize, place, loop_index| {
            if count > 0 {
                found
                    .entry(kind)
                    .or_insert(OutlineDefect {
                        kind,
                        count: 0,
                        place,
                        loop_index,
                    })
                    .count += count;
            }
        };
        for (k, one) in self.trimmed.iter().enumerate() {
            let first = sketch.loops[k].first().copied().unwrap_or_default();
            add(Kind::Repeated, one.repeats.0, one.repeats.1, k);
            add(Kind::Spike, one.spikes.0, one.spikes.1, k);
            if one.points.is_empty() {
                let kind = if one.is_flat() {
                    Kind::NoArea
                } else {
                    Kind::TooFewPoints
                };
                add(kind, 1, first, k);
            }
            add(Kind::Duplicate, usize::from(self.is_double[k]), first, k);
        }
        for (ring, &k) in self.rings.iter().zip(&self.kept) {
            if let Some(own) = ring.own {
                if own.crossings > 0 || ring.is_tangled {
                    let crossings = if own.crossings > 0 {
                        own.crossings
                    } else {
                        own.count
                    };
                    add(Kind::SelfIntersection, crossings, own.place, k);
                } else {
                    add(Kind::SelfContact, own.count, own.place, k);
                }
            }
        }
        for (&(a, _), (meetings, relation)) in &self.pairs {
            let kind = match relation {
                Relation::Overlap => Kind::Overlap,
                _ => Kind::Contact,
            };
            add(kind, 1, meetings.place, self.kept[a]);
        }
        OutlineReport {
            bounds: bounds(sketch),
            defects: found.into_values().collect(),
            loops: self.loops(sketch),
        }
    }

    fn loops(&self, sketch: &Sketch) -> Vec<SketchLoop> {
        let mut loops: Vec<SketchLoop> = sketch
            .loops
            .iter()
            .zip(&self.trimmed)
            .map(|(points, trimmed)| SketchLoop {
                points: trimmed.different,
                bounds: Bounds::of(points),
                length: perimeter(points),
                area: signed_area(points),
                role: LoopRole::Nothing,
                inside: None,
            })
            .collect();
        let overlapping: BTreeSet<usize> = (self.pairs.iter())
            .filter(|(_, (_, relation))| *relation == Relation::Overlap)
            .flat_map(|(&(a, b), _)| [a, b])
            .collect();
        for (number, (ring, &k)) in self.rings.iter().zip(&self.kept).enumerate() {
            loops[k].inside = ring.around.first().map(|&m| self.kept[m]);
            loops[k].role = if ring.is_tangled || overlapping.contains(&number) {
                LoopRole::Undecided
            } else if ring.around.len() % 2 == 1 {
                LoopRole::Hole
            } else {
                LoopRole::Body
            };
        }
        loops
    }
}

impl Ring {
    fn new(points: &[[f64; 2]], own: Option<Meetings>, is_too_much: bool) -> Self {
        let mut points = points.to_vec();
        let signed = signed_area(&points);
        let is_counter_clockwise = signed > 0.0;
        if !is_counter_clockwise {
            points[1..].reverse();
        }
        let mut ring = Self {
            region: vec![points.clone()],
            points,
            is_counter_clockwise,
            own,
            area: signed.abs(),
            wrong: 0.0,
            is_tangled: is_too_much,
            around: Vec::new(),
        };
        if ring.own.is_some() && !is_too_much {
            let area = |region: &[Vec<[f64; 2]>]| -> f64 {
                region.iter().map(|points| signed_area(points)).sum()
            };
            let negative = resolved(&ring.region, Filled::Negative);
            ring.region = resolved(&ring.region, Filled::Positive);
            ring.area = area(&ring.region);
            ring.wrong = area(&negative).abs();
            ring.is_tangled = ring.region.is_empty() || ring.wrong > FEW * ring.area;
        }
        ring
    }
}

/// Loops whose points are those of an earlier one, begun anywhere and run through either way.
fn doubles(loops: &[Trimmed]) -> Vec<bool> {
    let mut seen: HashSet<Vec<[u64; 2]>> = HashSet::new();
    loops
        .iter()
        .map(|one| {
            let points = &one.points;
            let n = points.len();
            let order = |&i: &usize, &j: &usize| {
                let ([a, b], [c, d]) = (points[i], points[j]);
                a.total_cmp(&c).then(b.total_cmp(&d))
            };
            let Some(first) = (0..n).min_by(order) else {
                return false;
            };
            let (before, after) = ((first + n - 1) % n, (first + 1) % n);
            let forward = order(&after, &before).is_le();
            let key: Vec<[u64; 2]> = (0..n)
                .map(|k| points[(if forward { first + k } else { first + n - k }) % n])
                // Zero has two signs.
                .map(|p| p.map(|x| (x + 0.0).to_bits()))
                .collect();
            !seen.insert(key)
        })
        .collect()
}

type Found = (
    Vec<Option<Meetings>>,
    BTreeMap<(usize, usize), Meetings>,
    bool,
);

/// How every loop meets itself, and every pair of loops; and whether there are more meetings than are counted.
fn meetings(outline: &Outline) -> Found {
    let mut own: Vec<Option<Meetings>> = vec![None; outline.loops().len()];
    let mut pairs: BTreeMap<(usize, usize), Meetings> = BTreeMap::new();
    let mut count = 0;
    for i in 0..outline.points().len() {
        let (a, _) = outline.address(i);
        check::meetings_of(outline, i, |j, place| {
            let (b, _) = outline.address(j);
            count += 1;
            let new = Meetings {
                count: 0,
                crossings: 0,
                place,
            };
            let entry = if a == b {
                own[a].get_or_insert(new)
            } else {
                pairs.entry((a.min(b), a.max(b))).or_insert(new)
            };
            entry.count += 1;
            entry.crossings += usize::from(cross_each_other(outline, i, j));
        });
        if count > MOST_MEETINGS {
            return (own, pairs, true);
        }
    }
    (own, pairs, false)
}

/// Whether two sides that meet do so within both.
fn cross_each_other(outline: &Outline, i: usize, j: usize) -> bool {
    let ([a, b], [c, d]) = (outline.side(i), outline.side(j));
    let apart = |p: f64, q: f64| (p > 0.0 && q < 0.0) || (p < 0.0 && q > 0.0);
    apart(side_of(a, b, c), side_of(a, b, d)) && apart(side_of(c, d, a), side_of(c, d, b))
}

/// How two rings that meet lie. Room counts that is thicker on average than the Booleans tell apart, 10⁻⁶ of the size of
/// both: what joins the loops later drops thinner pieces and holes by the same measure.
fn relation(a: &Ring, b: &Ring) -> Relation {
    let size = Bounds::of(&a.points)
        .union(Bounds::of(&b.points))
        .diagonal();
    if !have_common_room(&a.region, &b.region, size) {
        return Relation::Apart;
    }
    let own = |one: &Ring, other: &Ring| has_own_room(&one.region, &other.region, size);
    match (own(a, b), own(b, a)) {
        (true, true) => Relation::Overlap,
        (true, false) => Relation::Around,
        (false, true) => Relation::Within,
        (false, false) => Relation::Same,
    }
}

fn bounds(sketch: &Sketch) -> Bounds<2> {
    let boxes = sketch.loops.iter().filter(|points| !points.is_empty());
    boxes
        .map(|points| Bounds::of(points))
        .reduce(Bounds::union)
        .unwrap_or_else(|| Bounds::of(&[]))
}

impl Outline {
    /// For every loop, the others whose sides a ray from its first point crosses an odd number of times.
    fn rings_around(&self) -> Vec<Vec<usize>> {
        self.loops()
            .enumerate()
            .map(|(k, points)| {
                let mut odd: BTreeMap<usize, bool> = BTreeMap::new();
                self.beside(points[0], |i| {
                    let (m, _) = self.address(i);
                    let [a, b] = self.side(i);
                    if m != k && crosses(a, b, points[0]) {
                        *odd.entry(m).or_default() ^= true;
                    }
                });
                odd.into_iter().filter(|o| o.1).map(|o| o.0).collect()
            })
            .collect()
    }
}
