//! How deep many places are in every body, without asking for every distance.

use rayon::prelude::*;
use sphpack_geometry::Closest;
use sphpack_neighbors::{Bounds, place_of, point};

use crate::problem::Body;

/// Sites per edge of a cube of sites that is asked about as a whole.
const CUBE: f64 = 4.0;

/// Signed distances of sites to the bodies around them: exact near a surface, right to first order and of the right sign
/// elsewhere. A body that is so far from a site that two others are surely nearer is left out there, so that memory and time
/// follow the sites, not sites times bodies.
#[derive(Debug)]
pub struct Depths {
    bodies: usize,
    /// Between two surfaces nearer to each other than this there is no room, scene units.
    narrow: f64,
    /// The cube of every site.
    cube_of: Vec<u32>,
    /// The bodies that are seen from each cube, ascending.
    listed: Vec<Vec<u16>>,
    /// Site after site, `stride` entries each: one per listed body.
    phi: Vec<f64>,
    stride: usize,
}

/// Two surfaces nearer to each other than this, in ∆s, leave no room for a particle between them.
const NARROW_OVER_SPACING: f64 = 0.5;

/// What is seen of a body from a place: the signed distance, and the direction in which it grows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<const D: usize> {
    pub(crate) distance: f64,
    gradient: [f64; D],
}

impl<const D: usize> Seen<D> {
    /// The nearest place of the surface from where this was seen.
    pub(crate) fn nearest(&self, from: [f64; D]) -> [f64; D] {
        point::add_scaled(from, -self.distance, self.gradient)
    }

    fn from(place: [f64; D], hit: &Closest<D>) -> Self {
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
        let center = |cube: usize| -> [f64; D] {
            let place = place_of(cube, cubes);
            std::array::from_fn(|k| bounds.min[k] + edge[k] * (place[k] as f64 + 0.5))
        };
        let narrow = NARROW_OVER_SPACING * spacing;
        let all: Vec<u16> = (0..bodies.len() as u16).collect();
        let seen: Vec<Vec<(u16, Seen<D>)>> = (0..cubes.iter().product::<usize>())
            .into_par_iter()
            .with_min_len(64)
            .map(|cube| around(bodies, &all, center(cube), 2.0 * radius + narrow))
            .collect();
        let stride = seen.iter().map(Vec::len).max().unwrap_or(0);
        let cube_of: Vec<u32> = (sites.par_iter())
            .with_min_len(4096)
            .map(|p| {
                let mut cube = 0;
                for k in (0..D).rev() {
                    // The cast saturates at 0.
                    let i = ((p[k] - bounds.min[k]) / edge[k]) as usize;
                    cube = cube * cubes[k] + i.min(cubes[k] - 1);
                }
                cube as u32
            })
            .collect();
        let mut phi = vec![f64::INFINITY; sites.len() * stride];
        if stride > 0 {
            (phi.par_chunks_mut(stride).zip(sites).zip(&cube_of))
                .with_min_len(256)
                .for_each(|((phi, &site), &cube)| {
                    for (phi, (body, seen)) in phi.iter_mut().zip(&seen[cube as usize]) {
                        *phi = if seen.distance.abs() > radius + near {
                            let way = point::sub(site, center(cube as usize));
                            seen.distance + point::dot(seen.gradient, way)
                        } else {
                            bodies[usize::from(*body)].surface.closest(site).distance
                        };
                    }
                });
        }
        Self {
            bodies: bodies.len(),
            narrow,
            cube_of,
            listed: (seen.into_iter())
                .map(|seen| seen.into_iter().map(|(body, _)| body).collect())
                .collect(),
            phi,
            stride,
        }
    }

    /// The bodies around a site, ascending, with the signed distances from their surfaces, negative inside.
    pub fn around(&self, site: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let listed = &self.listed[self.cube_of[site] as usize];
        let phi = &self.phi[site * self.stride..(site + 1) * self.stride];
        listed
            .iter()
            .zip(phi)
            .map(|(&body, &phi)| (usize::from(body), phi))
    }

    /// The signed distance of a site from a body's surface, negative inside; infinite for a body that is not around.
    pub fn to_body(&self, body: usize, site: usize) -> f64 {
        self.around(site)
            .find(|&(number, _)| number == body)
            .map_or(f64::INFINITY, |(_, phi)| phi)
    }

    /// How far a site is from the nearest surface, infinite where there is none.
    pub(crate) fn to_surface(&self, site: usize) -> f64 {
        self.around(site)
            .fold(f64::INFINITY, |least, (_, phi)| least.min(phi.abs()))
    }

    /// How deep a site is in a region, negative outside: in body `region` and no earlier one, or, with `region` the
    /// number of bodies, in the fluid. Where two bodies touch, or nearly, there is no fluid: a site on their common side would
    /// be as deep in it as one beside a single body.
    pub(crate) fn within(&self, region: usize, site: usize) -> f64 {
        let (mut outside, mut second, mut own) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        for (body, phi) in self.around(site) {
            if body < region {
                (outside, second) = (outside.min(phi), second.min(phi.max(outside)));
            } else if body == region {
                own = phi;
            }
        }
        if region < self.bodies {
            outside.min(-own)
        } else {
            outside.min(outside + second - self.narrow)
        }
    }
}

/// What is seen from a place of some bodies: all that may be among the two nearest within half of `slack` (scene units).
pub(crate) fn around<const D: usize>(
    bodies: &[Body<D>],
    among: &[u16],
    place: [f64; D],
    slack: f64,
) -> Vec<(u16, Seen<D>)> {
    let (mut nearest, mut second) = (f64::INFINITY, f64::INFINITY);
    let mut seen: Vec<(u16, Seen<D>)> = Vec::new();
    for &number in among {
        let surface = &bodies[usize::from(number)].surface;
        let hit = surface
            .closest_within(place, second + slack)
            .or_else(|| surface.inside(place).then(|| surface.closest(place)));
        if let Some(hit) = hit {
            (nearest, second) = (
                nearest.min(hit.distance),
                second.min(hit.distance.max(nearest)),
            );
            seen.push((number, Seen::from(place, &hit)));
        }
    }
    seen.retain(|(_, seen)| seen.distance <= second + slack);
    seen
}
