//! Points midway between the sides of what is too thin for a particle surface.

use sphpack_neighbors::{Domain, Found, KdTree, point};

use super::shares::{CLEAR, Counts, Middle, Part, Shares, tree};
use crate::GeometryError;
use crate::sample::{Candidates, Local, keep_evenest};
use crate::surface::{Closest, Feature, Surface};
use crate::thickness::Touching;

/// Times that points move to the middle of what they stand for, where they are few: what is uneven over a few points is soon even.
const ROUNDS: usize = 40;
const FEW: usize = 8;

/// A part thicker than so many spacings has more points than one row holds, which part into two the sooner the more they are moved.
const ROW: f64 = 1.1;

/// Times more that many do, and besides so many for every point across. What is uneven over many points evens out slowly, the
/// slower where no tips hold it: a point goes on by a part of its last move, this one or what the longest wave asks for.
const SLOW_ROUNDS: usize = 120;
const ROUNDS_EACH: f64 = 2.0;
const MOMENTUM: f64 = 0.9;

/// A point ends a part where the next other one is this much farther from the part's end.
const END: f64 = 1.25;

/// How many spacings points moved to tips are from each other, at least.
const ROOM_AT_TIPS: f64 = 0.9;

/// Times as far apart points start as they would be on a sheet: far enough for a rod.
const WIDE: f64 = 1.5;

/// Where no point of the inset is within so many times the distance that others keep from it, the inset itself is clear.
const SURELY_CLEAR: f64 = 3.0;

/// Strides by which the tip of a part is approached; each leaves five sixths of the way in a wedge of 20°.
const STRIDES: usize = 20;

/// Points on the medial parts of the body, as many on each as `counts` says. Those on the particle surface,
/// `on_surface`, take their share of what is next to them.
///
/// The evenest of many places are moved to the middle of the places nearest to them (Lloyd's method) until they are as
/// dense as the body is thick: with weights ρ^(1 + 2/d) in d dimensions that gives the density ρ. Points that end a part
/// farther than a spacing from its tip are then moved on to that, and the others once more.
pub(super) fn along<const D: usize>(
    (body, inset): (&dyn Surface<D>, Option<&dyn Surface<D>>),
    shares: &Shares<D>,
    counts: &Counts,
    on_surface: &[Closest<D>],
) -> Result<Vec<[f64; D]>, GeometryError> {
    let fixed: Vec<[f64; D]> = on_surface.iter().map(|site| site.point).collect();
    let around = tree(&fixed)?;
    let mut all = Vec::new();
    for (part, &count) in shares.parts.iter().zip(&counts.medial) {
        if count == 0 {
            continue;
        }
        let places = &part.places;
        let neighbors = near_part(places, &around, 2.0 * shares.spacing);
        let fixed: Vec<[f64; D]> = neighbors.into_iter().map(|i| fixed[i]).collect();
        let window = body.window();
        let mut sites = start(places, &fixed, (count, shares.spacing), window.as_ref());
        let free = vec![true; sites.len()];
        sites.extend(&fixed);
        let mut set = Set {
            part,
            body,
            inset,
            around: &around,
            clear: CLEAR * shares.spacing,
            sites,
            free,
        };
        set.settle(shares.spacing)?;
        set.reach_tips(shares.spacing)?;
        set.settle(shares.spacing)?;
        set.sites.truncate(set.free.len());
        let nearest = tree(&places.iter().map(|place| place.point).collect::<Vec<_>>())?;
        for p in set.sites {
            let place = || nearest.nearest(p).map(|found| places[found.index].point);
            let inside = || body.inside(p).then_some(p);
            let found = midway(body, p, shares).or_else(inside).or_else(place);
            all.push(found.unwrap_or(p));
        }
    }
    Ok(all)
}

/// Which of the points in `tree` are within `reach` of the places, in order.
fn near_part<const D: usize>(places: &[Middle<D>], tree: &KdTree<D>, reach: f64) -> Vec<usize> {
    let mut near: Vec<usize> = places
        .iter()
        .flat_map(|place| tree.within(place.point, reach))
        .map(|found| found.index)
        .collect();
    near.sort_unstable();
    near.dedup();
    near
}

/// `count` of the places, evenly spread between each other and the fixed points.
fn start<const D: usize>(
    places: &[Middle<D>],
    fixed: &[[f64; D]],
    (count, spacing): (usize, f64),
    window: Option<&Domain<D>>,
) -> Vec<[f64; D]> {
    // All on one side.
    let hit = |point: [f64; D]| Closest {
        point,
        normal: std::array::from_fn(|k| if k == 0 { 1.0 } else { 0.0 }),
        distance: 0.0,
        feature: Feature::Smooth,
    };
    let held: Vec<Closest<D>> = fixed.iter().map(|&p| hit(p)).collect();
    let places: Vec<&Middle<D>> = places
        .iter()
        .filter(|place| place.clear >= CLEAR * spacing)
        .collect();
    let hits: Vec<Closest<D>> = places.iter().map(|place| hit(place.point)).collect();
    let root = 1.0 / (D as f64 - 1.0);
    let mut locals = vec![Local::even(spacing); held.len()];
    locals.extend(places.iter().map(|place| {
        let density = (place.thickness / spacing).max(0.05);
        Local {
            unit: spacing,
            ..Local::even(WIDE * spacing * density.powf(-root))
        }
    }));
    let kept = keep_evenest(&Candidates::of(&hits), &held, count, &locals, window);
    kept.into_iter().map(|i| places[i].point).collect()
}

/// The point midway between two sides at `p`, which is near the middle.
fn midway<const D: usize>(
    body: &dyn Surface<D>,
    p: [f64; D],
    shares: &Shares<D>,
) -> Option<[f64; D]> {
    let hit = body.closest(p);
    let inward = point::unit(point::sub(p, hit.point)).filter(|_| hit.distance < 0.0)?;
    let ball = Touching::at(body, hit.point, inward, shares.limit);
    let found = point::add_scaled(hit.point, ball.radius, inward);
    let near = point::distance(found, p) < 0.25 * shares.spacing;
    (near && ball.is_between_sides(inward)).then_some(found)
}

/// A part and the points on it.
struct Set<'a, const D: usize> {
    part: &'a Part<D>,
    body: &'a dyn Surface<D>,
    inset: Option<&'a dyn Surface<D>>,
    /// The points on the inset.
    around: &'a KdTree<D>,
    /// How far from the inset its points keep.
    clear: f64,
    /// Its points, then the fixed ones around.
    sites: Vec<[f64; D]>,
    /// Which of its points still move.
    free: Vec<bool>,
}

impl<const D: usize> Set<'_, D> {
    /// Moves free points to the weighted middle of the places nearest to them.
    fn settle(&mut self, spacing: f64) -> Result<(), GeometryError> {
        let power = 2.0 / (D as f64 - 1.0);
        let thickest = self.part.places.iter().map(|place| place.thickness);
        let is_row = thickest.fold(0.0, f64::max) <= ROW * spacing;
        // Beside an inset, which pushes points away, a sheet's points could be thrown onto each other.
        let is_alone = D == 2 || self.inset.is_none();
        let is_slow = is_row && is_alone && self.free.len() > FEW || self.body.window().is_some();
        let across = (self.free.len() as f64).powf(1.0 / (D as f64 - 1.0));
        let (rounds, momentum) = if is_slow {
            let longest = 1.0 - std::f64::consts::TAU / across;
            (
                SLOW_ROUNDS + (ROUNDS_EACH * across) as usize,
                longest.max(MOMENTUM),
            )
        } else {
            (ROUNDS, 0.0)
        };
        let mut moves = vec![[0.0; D]; self.free.len()];
        for round in 0..rounds {
            // The last ones come to rest.
            let part = if round + ROUNDS / 2 < rounds {
                momentum
            } else {
                0.0
            };
            let tree = tree(&self.sites)?;
            let mut sums = vec![([0.0; D], 0.0); self.sites.len()];
            for place in self.part.places.iter().chain(&self.part.beside) {
                let Some(found) = tree.nearest(place.point) else {
                    continue;
                };
                let weight = place.volume * place.thickness.powf(power);
                let sum = &mut sums[found.index];
                let way = point::sub(place.point, self.sites[found.index]);
                *sum = (point::add_scaled(sum.0, weight, way), sum.1 + weight);
            }
            for (i, (sum, weight)) in sums.into_iter().enumerate().take(self.free.len()) {
                if self.free[i] && weight > 0.0 {
                    let again = point::scale(moves[i], part);
                    moves[i] = point::add_scaled(again, 1.0 / weight, sum);
                    let middle = point::add(self.sites[i], moves[i]);
                    self.sites[i] = self.kept_clear(middle);
                }
            }
        }
        Ok(())
    }

    /// `p`, or the nearest point as far from the inset as points keep.
    fn kept_clear(&self, p: [f64; D]) -> [f64; D] {
        let is_beside = |near: Found| near.distance <= SURELY_CLEAR * self.clear;
        if !self.around.nearest(p).is_some_and(is_beside) {
            return p;
        }
        let Some(hit) = self.inset.map(|surface| surface.closest(p)) else {
            return p;
        };
        match point::unit(point::sub(p, hit.point)) {
            Some(away) if hit.distance < self.clear => {
                let away = point::scale(away, hit.distance.signum());
                point::add_scaled(hit.point, self.clear, away)
            }
            _ => p,
        }
    }

    /// Where the body ends on the way `on` from `p`, which is near its end.
    fn end_of(&self, mut p: [f64; D], on: [f64; D]) -> [f64; D] {
        for _ in 0..STRIDES {
            let depth = -self.body.closest(p).distance;
            p = point::add_scaled(p, depth.max(0.0), on);
        }
        p
    }

    /// Moves points that end the part to within `spacing` of its tip, and holds them there, unless others are too near.
    fn reach_tips(&mut self, spacing: f64) -> Result<(), GeometryError> {
        let tree = tree(&self.sites)?;
        let mut tips: Vec<Option<(f64, [f64; D])>> = vec![None; self.free.len()];
        for place in &self.part.places {
            let near = tree.nearest_n(place.point, 2);
            let Some(&first) = near.first() else {
                continue;
            };
            let second = near.get(1).map_or(f64::INFINITY, |found| found.distance);
            let alone = second > END * first.distance;
            if let Some(tip) = tips.get_mut(first.index)
                && first.distance > spacing
                && alone
                && tip.is_none_or(|(far, _)| first.distance > far)
            {
                *tip = Some((first.distance, place.point));
            }
        }
        for (i, tip) in tips.into_iter().enumerate() {
            let Some((far, place)) = tip else {
                continue;
            };
            let on = point::scale(point::sub(place, self.sites[i]), 1.0 / far);
            let tip = self.end_of(place, on);
            // No end where the body goes on beyond the box.
            if (self.body.window()).is_some_and(|window| !window.bounds.contains(tip)) {
                continue;
            }
            let moved = self.kept_clear(point::add_scaled(tip, -spacing, on));
            let near = |(j, other): (usize, &[f64; D])| {
                j != i && point::distance(*other, moved) < ROOM_AT_TIPS * spacing
            };
            if !self.sites[..self.free.len()].iter().enumerate().any(near) {
                self.sites[i] = moved;
                self.free[i] = false;
            }
        }
        Ok(())
    }
}
