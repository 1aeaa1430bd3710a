//! Where a surface bends, and how fine particles must be there.

use std::collections::HashSet;

use rayon::prelude::*;
use sphpack_geometry::{Closest, Feature, Surface};
use sphpack_neighbors::point;

/// Points of a surface that ask for the same spacing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spots<const D: usize> {
    /// Scene units.
    pub(crate) spacing: f64,
    pub(crate) points: Vec<[f64; D]>,
}

/// How fine a surface is to be where it bends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curved {
    /// Particles per radius of curvature.
    pub per_radius: f64,
    /// No finer than this, scene units.
    pub finest: f64,
    /// Where it does not bend, scene units.
    pub usual: f64,
}

/// A radius is measured between two points whose normals differ by no more than this, in radians: 17°. Where they differ by more
/// however near they are, there is a corner, which has no radius; so the corners of a polygon of 20 sides make a circle,
/// and those of one of 16 are corners.
const MOST_BEND: f64 = 0.3;

/// Two points this much nearer to each other than the finest spacing are at a corner.
const AT_CORNER: f64 = 1.0 / 16.0;

/// Points looked at first: so many per usual spacing, and no more than so many in all.
const PER_SPACING: f64 = 2.0;
const MOST_POINTS: f64 = 2e5;

/// Spacings are rounded down to powers of this times the finest.
const STEP: f64 = 1.1;

/// The points of a surface that ask for less than the usual spacing, by spacing, the finest first.
pub(crate) fn spots<const D: usize>(surface: &dyn Surface<D>, curved: Curved) -> Vec<Spots<D>> {
    let Curved {
        per_radius,
        finest,
        usual,
    } = curved;
    let cell = usual / PER_SPACING;
    let count = (surface.measure() / cell.powi(D as i32 - 1)).clamp(64.0, MOST_POINTS);
    let mut at = surface.scatter(count as usize);
    let mut apart = usual;
    let mut found: Vec<Spots<D>> = Vec::new();
    let levels = ((usual / finest).ln() / STEP.ln()).ceil().max(0.0) as usize;
    found.extend((0..levels).map(|level| Spots {
        spacing: finest * STEP.powi(level as i32),
        points: Vec::new(),
    }));
    // Halves the distance at which normals are compared, where they differ by too much.
    while !at.is_empty() && apart > AT_CORNER * finest && levels > 0 {
        let seen: Vec<Bend<D>> = at
            .par_iter()
            .map(|here| bend(surface, here, apart))
            .collect();
        let mut next = Vec::new();
        let mut taken = HashSet::new();
        for (here, bend) in at.iter().zip(seen) {
            match bend {
                Bend::Radius(radius) => {
                    let level = (radius / per_radius / finest).max(1.0).ln() / STEP.ln();
                    if let Some(spots) = found.get_mut(level as usize) {
                        spots.points.push(here.point);
                    }
                }
                Bend::TooMuch(others) => {
                    let nearer = std::iter::once(*here).chain(others);
                    next.extend(nearer.filter(|other| {
                        // One of those in a cell is enough.
                        let key = other.point.map(|x| (x / (0.25 * apart)).floor() as i64);
                        other.feature == Feature::Smooth && taken.insert(key)
                    }));
                }
            }
        }
        at = next;
        apart *= 0.5;
    }
    found.retain(|spots| !spots.points.is_empty());
    found
}

/// How a surface bends around a point.
enum Bend<const D: usize> {
    /// With this radius at least; infinite where it is flat.
    Radius(f64),
    /// By more than can be measured; with it points half as far away.
    TooMuch(Vec<Closest<D>>),
}

/// Compares the normal at a point with those of points around it, the curvature being that of both sides together.
fn bend<const D: usize>(surface: &dyn Surface<D>, here: &Closest<D>, apart: f64) -> Bend<D> {
    let mut radius = f64::INFINITY;
    let ways = tangents(here.normal);
    let beside = |way: [f64; D], far: f64| surface.closest(point::add_scaled(here.point, far, way));
    for &way in &ways {
        let sides = [apart, -apart].map(|far| beside(way, far));
        let is_too_much = |side: &Closest<D>| {
            side.feature != Feature::Smooth || angle(here.normal, side.normal) > MOST_BEND
        };
        if sides.iter().any(is_too_much) {
            let nearer = ways.iter().flat_map(|&way| {
                let half = 0.5 * apart;
                [beside(way, half), beside(way, -half)]
            });
            return Bend::TooMuch(nearer.collect());
        }
        let bend = angle(sides[0].normal, sides[1].normal);
        let along: f64 = (sides.iter())
            .map(|side| point::distance(here.point, side.point))
            .sum();
        if bend > 0.0 {
            radius = radius.min(along / bend);
        }
    }
    Bend::Radius(radius)
}

/// Between two unit vectors, in radians.
fn angle<const D: usize>(a: [f64; D], b: [f64; D]) -> f64 {
    // Of small angles the cosine knows little.
    2.0 * (0.5 * point::norm(point::sub(a, b))).min(1.0).asin()
}

/// Directions along a surface, without their opposites: one in the plane, four in space.
fn tangents<const D: usize>(normal: [f64; D]) -> Vec<[f64; D]> {
    if D == 2 {
        let mut along = [0.0; D];
        (along[0], along[1]) = (-normal[1], normal[0]);
        return vec![along];
    }
    // The axis that is most across.
    let across = (0..D).fold(0, |best, k| {
        if normal[k].abs() < normal[best].abs() {
            k
        } else {
            best
        }
    });
    let mut axis = [0.0; D];
    axis[across] = 1.0;
    let Some(first) = point::unit(point::reject(axis, normal)) else {
        return Vec::new();
    };
    let mut second = [0.0; D];
    for k in 0..D {
        let (a, b) = ((k + 1) % D, (k + 2) % D);
        second[k] = normal[a] * first[b] - normal[b] * first[a];
    }
    (0..4)
        .map(|k| {
            let (sine, cosine) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            point::add_scaled(point::scale(first, cosine), sine, second)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use sphpack_geometry::{Ball, Cuboid, Ellipsoid, Outline, Torus};

    use super::*;

    fn curved(per_radius: f64, finest: f64, usual: f64) -> Curved {
        Curved {
            per_radius,
            finest,
            usual,
        }
    }

    #[test]
    fn a_ball_has_one_radius() {
        for (radius, asked) in [(0.5, 12.0), (1.3, 20.0)] {
            let ball = Ball::new([0.1; 3], radius).expect("a ball");
            let found = spots(&ball, curved(asked, 0.01, 0.2));
            let spacing = radius / asked;
            for spots in &found {
                assert!(spots.spacing <= spacing * 1.0001, "{}", spots.spacing);
                assert!(spots.spacing * STEP * 1.01 > spacing, "{}", spots.spacing);
            }
            assert!(!found.is_empty());
        }
    }

    #[test]
    fn an_ellipse_is_finest_at_its_tips() {
        let (a, b) = (1.0, 0.25);
        let ellipse = Ellipsoid::new([0.0; 2], [a, b]).expect("an ellipse");
        let found = spots(&ellipse, curved(10.0, 0.003, 0.1));
        for spots in &found {
            for p in &spots.points {
                // The radius of curvature of an ellipse: (a²y²/b² + b²x²/a²)^1.5 / (ab).
                let square = (a * p[1] / b).powi(2) + (b * p[0] / a).powi(2);
                let asked = square.powf(1.5) / (a * b) / 10.0;
                assert!(
                    spots.spacing < 1.1 * asked,
                    "{p:?}: {} {asked}",
                    spots.spacing
                );
                assert!(
                    spots.spacing * STEP > 0.65 * asked,
                    "{p:?}: {} {asked}",
                    spots.spacing
                );
            }
        }
        let tip = b * b / a / 10.0;
        assert!(found[0].spacing < 1.05 * tip && found[0].spacing * STEP > 0.9 * tip);
    }

    #[test]
    fn the_leading_edge_of_an_airfoil_has_its_radius_and_the_trailing_edge_none() {
        let wing = Outline::naca("0012", 1.0).expect("a wing");
        // 1.1019 t² (Abbott and von Doenhoff 1959, eq. 6.3).
        let asked = 1.1019 * 0.12 * 0.12 / 12.0;
        let found = spots(&wing, curved(12.0, 2e-4, 0.02));
        assert!(
            (found[0].spacing / asked - 1.0).abs() < 0.15,
            "{}",
            found[0].spacing
        );
        let behind = |p: &&[f64; 2]| p[0] > 0.9;
        let fine = found.iter().filter(|spots| spots.spacing < 0.01);
        assert_eq!(
            fine.flat_map(|spots| &spots.points).filter(behind).count(),
            0
        );
    }

    #[test]
    fn flat_sides_and_corners_ask_for_nothing() {
        let cube = Cuboid::new([0.0; 3], [1.0, 0.7, 0.4]).expect("a box");
        assert!(spots(&cube, curved(12.0, 0.01, 0.1)).is_empty());
        let square = Cuboid::new([0.0; 2], [1.0, 0.3]).expect("a box");
        assert!(spots(&square, curved(12.0, 0.001, 0.1)).is_empty());
    }

    #[test]
    fn of_a_ring_the_lesser_radius_counts() {
        let ring = Torus::new([0.0; 3], [0.0, 0.0, 1.0], 1.0, 0.2).expect("a ring");
        let found = spots(&ring, curved(8.0, 0.005, 0.1));
        let all: usize = found.iter().map(|spots| spots.points.len()).sum();
        let asked = 0.2 / 8.0;
        let near = |spacing: f64| spacing < 1.02 * asked && spacing * STEP > 0.95 * asked;
        let right: usize = (found.iter().filter(|spots| near(spots.spacing)))
            .map(|spots| spots.points.len())
            .sum();
        assert!(all > 1000 && right == all, "{right} of {all}");
    }
}
