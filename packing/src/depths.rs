//! How deep many places are in every body, without asking for every distance.

use rayon::prelude::*;
use sphpack_neighbors::{Bounds, point};

use crate::problem::Body;

/// Sites per edge of a cube of sites that is asked about as a whole.
const CUBE: f64 = 4.0;

/// Signed distances of sites to every body: exact near a surface, right to first order and of the right sign elsewhere.
#[derive(Debug)]
pub struct Depths {
    bodies: usize,
    /// Between two surfaces nearer to each other than this there is no room, scene units.
    narrow: f64,
    /// Site after site, one entry per body.
    phi: Vec<f64>,
}

/// Two surfaces nearer to each other than this, in ∆s, leave no room for a particle between them.
const NARROW_OVER_SPACING: f64 = 0.5;

/// What is seen of a body from a place: the signed distance, and the direction in which it grows.
#[derive(Debug, Clone, Copy)]
struct Seen<const D: usize> {
    distance: f64,
    gradient: [f64; D],
}

impl<const D: usize> Seen<D> {
    fn from(body: &Body<D>, place: [f64; D]) -> Self {
        let hit = body.surface.closest(place);
        let away = point::unit(point::sub(place, hit.point)).unwrap_or([0.0; D]);
        Self {
            distance: hit.distance,
            gradient: point::scale(away, hit.distance.signum()),
        }
    }
}

impl Depths {
    /// How far a distance may be off where it is not exact, scene units.
    pub(crate) fn error<const D: usize>(spacing: f64) -> f64 {
        CUBE * spacing * (D as f64).sqrt()
    }

    /// Exact within `near` (scene units) of a surface, and nowhere nearer than that by mistake. One query per cube of
    /// four sites a side, and one per site where that cube is near a surface; elsewhere the distance of the cube's
    /// middle is continued along its gradient, off by the cube's diagonal at most.
    pub fn of<const D: usize>(
        bodies: &[Body<D>],
        bounds: Bounds<D>,
        spacing: f64,
        near: f64,
        sites: &[[f64; D]],
    ) -> Self {
        let size = bounds.size();
        let cubes: [usize; D] =
            std::array::from_fn(|k| (size[k] / (CUBE * spacing)).ceil().max(1.0) as usize);
        let edge: [f64; D] = std::array::from_fn(|k| size[k] / cubes[k] as f64);
        let radius = 0.5 * point::norm(edge);
        let centers: Vec<[f64; D]> = (0..cubes.iter().product::<usize>())
            .map(|cube| {
                let mut rest = cube;
                std::array::from_fn(|k| {
                    let i = rest % cubes[k];
                    rest /= cubes[k];
                    bounds.min[k] + edge[k] * (i as f64 + 0.5)
                })
            })
            .collect();
        let far: Vec<Vec<Seen<D>>> = bodies
            .iter()
            .map(|body| {
                centers
                    .par_iter()
                    .with_min_len(64)
                    .map(|&c| Seen::from(body, c))
                    .collect()
            })
            .collect();
        let cube_of = |p: [f64; D]| {
            let mut cube = 0;
            for k in (0..D).rev() {
                // The cast saturates at 0.
                let i = ((p[k] - bounds.min[k]) / edge[k]) as usize;
                cube = cube * cubes[k] + i.min(cubes[k] - 1);
            }
            cube
        };
        let mut phi = vec![0.0; sites.len() * bodies.len()];
        if !bodies.is_empty() {
            phi.par_chunks_mut(bodies.len())
                .zip(sites)
                .with_min_len(256)
                .for_each(|(phi, &site)| {
                    let cube = cube_of(site);
                    for ((phi, body), far) in phi.iter_mut().zip(bodies).zip(&far) {
                        let seen = &far[cube];
                        *phi = if seen.distance.abs() > radius + near {
                            let way = point::sub(site, centers[cube]);
                            seen.distance + point::dot(seen.gradient, way)
                        } else {
                            body.surface.closest(site).distance
                        };
                    }
                });
        }
        Self {
            bodies: bodies.len(),
            narrow: NARROW_OVER_SPACING * spacing,
            phi,
        }
    }

    /// The signed distance of a site from a body's surface, negative inside.
    pub fn to_body(&self, body: usize, site: usize) -> f64 {
        self.phi[site * self.bodies + body]
    }

    /// How far a site is from the nearest surface, infinite where there is none.
    pub(crate) fn to_surface(&self, site: usize) -> f64 {
        self.phi[site * self.bodies..(site + 1) * self.bodies]
            .iter()
            .fold(f64::INFINITY, |least, phi| least.min(phi.abs()))
    }

    /// How deep a site is in a region, negative outside: in body `region` and no earlier one, or, with `region` the
    /// number of bodies, in the fluid. Where two bodies touch, or nearly, there is no fluid: a site on their common side would
    /// be as deep in it as one beside a single body.
    pub(crate) fn within(&self, region: usize, site: usize) -> f64 {
        let phi = &self.phi[site * self.bodies..(site + 1) * self.bodies];
        let (mut outside, mut second) = (f64::INFINITY, f64::INFINITY);
        for &phi in &phi[..region] {
            (outside, second) = (outside.min(phi), second.min(phi.max(outside)));
        }
        match phi.get(region) {
            Some(&own) => outside.min(-own),
            None => outside.min(outside + second - self.narrow),
        }
    }
}
