//! How much of a body each place of its surface stands for, and how many particles that makes.

use rayon::prelude::*;
use sphpack_neighbors::{KdTree, point};

use super::Thin;
use crate::surface::{Closest, Surface};
use crate::thickness::{Touching, through};
use crate::{GeometryError, ParameterError};

/// Places per particle's area on the surface.
const PLACES: f64 = 8.0;

/// And on a watertight sheet in space: what points are moved to the middle of must be even itself where no hole may be left. With 8
/// some of the forty plates in `tests.rs` have holes, with 32 none.
const FINE: f64 = 32.0;

/// Places at least and at most.
const FEWEST: f64 = 1000.0;
const MOST: f64 = 4e6;

/// Medial places within this many spacings of each other are of one part.
const LINK: f64 = 0.75;

/// Where the ball beneath is larger than this many depths there surely is a particle surface.
pub(super) const HARDLY: f64 = 1.1;

/// Balls are looked for up to a spacing, and beyond this many depths.
const DEEP: f64 = 1.2;

/// A part whose places are all nearer to the particle surface than so many spacings has no points: they could not be
/// within a spacing of its tip and keep clear of the particle surface.
const REACH: f64 = 1.5;

/// Points per particle's volume of what is clear of the particle surface, at most.
const ROOM: f64 = 2.0;

/// How many spacings medial points keep clear of the particle surface, at least.
pub(super) const CLEAR: f64 = 0.65;

/// A place on the true surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<const D: usize> {
    pub(super) foot: Closest<D>,
    /// Radius of the ball that touches there, at most [`Shares::limit`].
    radius: f64,
    /// [`crate::thickness()`], as far as it matters.
    pub(super) thickness: f64,
}

/// A place midway between two sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Middle<const D: usize> {
    pub(super) point: [f64; D],
    /// Between the sides.
    pub(super) thickness: f64,
    /// Volume that the place stands for.
    pub(super) volume: f64,
    /// What of it is more than the body has there.
    excess: f64,
    /// Distance from the particle surface.
    pub(super) clear: f64,
}

/// Places midway between two sides that hang together.
#[derive(Debug, Clone)]
pub(super) struct Part<const D: usize> {
    pub(super) places: Vec<Middle<D>>,
    /// What lies beside them without being between two sides (the rim of a plate).
    pub(super) beside: Vec<Middle<D>>,
    /// Volume of the places and of what lies beside them.
    volume: f64,
    /// What of it is more than the body has there.
    excess: f64,
}

/// A body's surface layer, shared out.
#[derive(Debug, Clone)]
pub(super) struct Shares<const D: usize> {
    pub(super) spacing: f64,
    pub(super) depth: f64,
    /// Radius of the largest balls that are looked for.
    pub(super) limit: f64,
    /// Places over which the particle surface is.
    pub(super) over: Vec<Place<D>>,
    pub(super) parts: Vec<Part<D>>,
    /// Volume for which the points on the particle surface and on the medial parts stand.
    volume: f64,
}

/// How many points go where.
#[derive(Debug, Clone)]
pub(super) struct Counts {
    pub(super) on_surface: usize,
    /// On each part.
    pub(super) medial: Vec<usize>,
    /// Of the parts that get points.
    pub(super) medial_volume: f64,
    /// What of it is more than the body has.
    pub(super) excess: f64,
}

impl<const D: usize> Shares<D> {
    pub(super) fn new(
        body: &dyn Surface<D>,
        inset: Option<&dyn Surface<D>>,
        (spacing, depth): (f64, f64),
        thin: Thin,
    ) -> Result<Self, GeometryError> {
        let places = if D == 3 && thin == Thin::Watertight {
            FINE
        } else {
            PLACES
        };
        let count = places * body.measure() / spacing.powi(D as i32 - 1);
        let feet = body.scatter(count.clamp(FEWEST, MOST) as usize);
        if feet.is_empty() {
            return Err(ParameterError::OutOfRange {
                of: "sample",
                name: "area of the surface",
                value: body.measure(),
                needs: "large enough to be found, in 2 or 3 dimensions",
            }
            .into());
        }
        let limit = spacing.max(DEEP * depth);
        let area = body.measure() / feet.len() as f64;
        let places: Vec<(Place<D>, bool)> = feet
            .par_iter()
            .with_min_len(64)
            .map(|foot| look(body, foot, limit))
            .collect();
        let (over, below): (Vec<_>, Vec<_>) = places.into_iter().partition(|(place, _)| {
            inset.is_some_and(|surface| place.has(surface, spacing, depth))
        });
        // Half of what a sheet is taken to be thick at least.
        let least = match thin {
            Thin::Mass => 0.0,
            Thin::Watertight => 0.5 * spacing,
        };
        let below: Vec<(Middle<D>, bool)> = below
            .par_iter()
            .with_min_len(64)
            .map(|(place, between)| (place.middle(inset, area, (least, *between)), *between))
            .collect();
        let volume_below: f64 = (below.iter())
            .map(|(middle, _)| middle.volume - middle.excess)
            .sum();
        let (middle, beside): (Vec<_>, Vec<_>) =
            below.into_iter().partition(|(_, between)| *between);
        let mut parts = parts(middle.into_iter().map(|(m, _)| m).collect(), LINK * spacing)?;
        join(&mut parts, beside.into_iter().map(|(m, _)| m))?;
        let mut shares = Self {
            spacing,
            depth,
            limit,
            over: over.into_iter().map(|(place, _)| place).collect(),
            parts,
            volume: body.volume(),
        };
        if let Some(surface) = inset {
            let farthest = |part: &Part<D>| part.places.iter().fold(0.0, |far, m| m.clear.max(far));
            shares
                .parts
                .retain(|part| farthest(part) >= REACH * spacing);
            shares.volume = shares.layer(surface, area, volume_below, body.volume());
        } else {
            // What was found is the whole body.
            for part in &mut shares.parts {
                part.volume *= body.volume() / volume_below;
                part.excess *= body.volume() / volume_below;
            }
        }
        shares.volume += shares.parts.iter().map(|part| part.excess).sum::<f64>();
        Ok(shares)
    }

    /// The volume that all points stand for, where there is a particle surface: all that is at most a spacing deep.
    /// Every place has `area` of the true surface; `below` is the volume of what has no particle surface, the corners
    /// and edges of thick bodies too.
    fn layer(&self, surface: &dyn Surface<D>, area: f64, below: f64, whole: f64) -> f64 {
        if self.depth == 0.0 {
            return surface.measure() * self.mean_density() * self.spacing;
        }
        if self.over.iter().all(|place| place.radius < self.spacing) {
            return whole;
        }
        // The area shrinks from the true to the particle surface, and as much again beyond: exact for flat sides, and
        // where the body is thick the area of the particle surface times the spacing. Beside corners it is the ball
        // that counts, for the corners' own volume is in `below`.
        let shrinks = 1.0 - surface.measure() / (area * self.over.len() as f64);
        let columns = self.over.iter().map(|place| {
            let deep = place.radius.min(self.spacing);
            deep - 0.5 * shrinks / self.depth * deep * deep
        });
        (area * columns.sum::<f64>() + below).min(whole)
    }

    /// Points on the particle surface, in parts of their number were the body thick everywhere.
    pub(super) fn mean_density(&self) -> f64 {
        let all: f64 = self.over.iter().map(|p| self.density(p.thickness)).sum();
        all / self.over.len().max(1) as f64
    }

    /// Points per area, in parts of the full number, where the body is so thick.
    pub(super) fn density(&self, thickness: f64) -> f64 {
        let full = if self.depth > 0.0 {
            2.0 * self.spacing
        } else {
            self.spacing
        };
        (thickness / full).min(1.0)
    }

    /// Whole numbers of points: each part the nearest to its volume, the particle surface the rest.
    pub(super) fn counts(&self) -> Counts {
        let each = self.spacing.powi(D as i32);
        let medial: Vec<usize> = self
            .parts
            .iter()
            .map(|part| {
                let clear = |m: &&Middle<D>| m.clear >= CLEAR * self.spacing;
                let room: f64 = part.places.iter().filter(clear).map(|m| m.volume).sum();
                let due = (part.volume / each).round();
                due.min((ROOM * room / each).round()) as usize
            })
            .collect();
        let with_points = || self.parts.iter().zip(&medial).filter(|(_, n)| **n > 0);
        let all = (self.volume / each).round() as usize;
        Counts {
            on_surface: all.saturating_sub(medial.iter().sum()),
            medial_volume: with_points().fold(0.0, |sum, (part, _)| sum + part.volume),
            excess: with_points().fold(0.0, |sum, (part, _)| sum + part.excess),
            medial,
        }
    }
}

impl<const D: usize> Place<D> {
    /// Whether the particle surface is beneath. Where the body is hardly thick enough it is looked for.
    fn has(&self, inset: &dyn Surface<D>, spacing: f64, depth: f64) -> bool {
        let below = || point::add_scaled(self.foot.point, -depth, self.foot.normal);
        self.radius > HARDLY * depth
            || self.radius >= 0.999 * depth
                && inset.closest_within(below(), 0.05 * spacing).is_some()
    }

    /// The middle of the ball beneath, for a piece of the surface of this area.
    /// Between two sides it is taken to be twice `least` thick at least. Beside them, at a plate's rim, a strip of its sides and as much
    /// of the rim share a sheet's volume: else a plate a spacing thick would get a fifth more than its mass.
    fn middle(
        &self,
        inset: Option<&dyn Surface<D>>,
        area: f64,
        (least, is_between): (f64, bool),
    ) -> Middle<D> {
        let center = point::add_scaled(self.foot.point, -self.radius, self.foot.normal);
        let radius = self.radius.max(least);
        let deep = if is_between || least == 0.0 {
            radius
        } else {
            0.5 * least
        };
        Middle {
            point: center,
            thickness: 2.0 * radius,
            volume: area * deep,
            excess: area * (deep - self.radius),
            clear: inset.map_or(f64::INFINITY, |surface| surface.closest(center).distance),
        }
    }
}

/// The ball and the thickness at one place, and whether the ball is between two sides.
fn look<const D: usize>(body: &dyn Surface<D>, foot: &Closest<D>, limit: f64) -> (Place<D>, bool) {
    let inward = point::scale(foot.normal, -1.0);
    let ball = Touching::at(body, foot.point, inward, limit);
    let between = ball.is_between_sides(inward);
    let thickness = if between || ball.elsewhere.is_none() {
        2.0 * ball.radius
    } else {
        through(body, foot.point, inward, 2.0 * limit)
    };
    let place = Place {
        foot: *foot,
        radius: ball.radius,
        thickness,
    };
    (place, between)
}

/// A tree over points, which are finite.
pub(super) fn tree<const D: usize>(points: &[[f64; D]]) -> Result<KdTree<D>, GeometryError> {
    KdTree::new(points).map_err(|_| {
        ParameterError::OutOfRange {
            of: "sample",
            name: "coordinate of a point",
            value: (points.iter().flatten().copied().find(|x| !x.is_finite())).unwrap_or(f64::NAN),
            needs: "finite",
        }
        .into()
    })
}

/// The places that hang together.
fn parts<const D: usize>(places: Vec<Middle<D>>, link: f64) -> Result<Vec<Part<D>>, GeometryError> {
    let points: Vec<[f64; D]> = places.iter().map(|m| m.point).collect();
    let tree = tree(&points)?;
    let mut taken = vec![false; places.len()];
    let mut parts = Vec::new();
    for first in 0..places.len() {
        if taken[first] {
            continue;
        }
        taken[first] = true;
        let mut members = vec![first];
        let mut next = 0;
        while let Some(&i) = members.get(next) {
            next += 1;
            for found in tree.within(points[i], link) {
                if !std::mem::replace(&mut taken[found.index], true) {
                    members.push(found.index);
                }
            }
        }
        members.sort_unstable();
        let places: Vec<Middle<D>> = members.into_iter().map(|i| places[i]).collect();
        parts.push(Part {
            volume: places.iter().map(|m| m.volume).sum(),
            excess: places.iter().map(|m| m.excess).sum(),
            places,
            beside: Vec::new(),
        });
    }
    Ok(parts)
}

/// Adds what lies beside the parts to the nearest one, as if it were as thick as that is there, unless the particle
/// surface is nearer.
fn join<const D: usize>(
    parts: &mut [Part<D>],
    beside: impl Iterator<Item = Middle<D>>,
) -> Result<(), GeometryError> {
    let mut places = Vec::new();
    for (number, part) in parts.iter().enumerate() {
        places.extend(part.places.iter().map(|middle| (*middle, number)));
    }
    let points: Vec<[f64; D]> = places.iter().map(|(middle, _)| middle.point).collect();
    let tree = tree(&points)?;
    for middle in beside {
        if let Some(near) = tree.nearest(middle.point)
            && near.distance < middle.clear
        {
            let (there, number) = places[near.index];
            parts[number].volume += middle.volume;
            parts[number].excess += middle.excess;
            parts[number].beside.push(Middle {
                thickness: there.thickness,
                ..middle
            });
        }
    }
    Ok(())
}
