//! Only what is near a surface moves.

use crate::depths::Depths;
use crate::forces::{Forces, largest};
use crate::minimise::Finish;
use crate::particles::{Kind, Particles};
use crate::problem::Problem;
use rayon::prelude::*;
use sphpack_neighbors::{KdTree, point};

/// Which particles settle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Band {
    /// Those within two and a half support radii of a surface; half as many again while the residual beyond asks for it. The others stay
    /// on their lattice, and are neither integrated nor listed. For a calm finish all, in the end: what a body does to its
    /// surroundings falls off so slowly (10⁻³ two support radii away, 10⁻⁴ eight of them, around the cylinder at
    /// ∆s = 0.025) that nothing stays where it is to within 10⁻⁵.
    #[default]
    Auto,
    /// All.
    Full,
}

/// Support radii that the band is wide at first.
const FIRST_WIDTH: f64 = 2.5;

/// A band that would hold more than this part of the particles that can move saves nothing: all move.
const WORTHWHILE: f64 = 0.7;

/// The particles of a band, those that they see, and those that look at them.
pub(super) struct Part<const D: usize> {
    /// The particles; what does not move is frozen.
    pub(super) particles: Particles<D>,
    /// Their places among all.
    order: Vec<usize>,
    /// Places here of particles just beyond the band that could move.
    pub(super) rim: Vec<usize>,
    /// Whether it is everything.
    pub(super) is_all: bool,
}

impl Band {
    /// The width to begin with, scene units; infinite for everything.
    pub fn first_width<const D: usize>(self, problem: &Problem<D>, finish: Finish) -> f64 {
        match (self, finish) {
            (Self::Auto, Finish::Even | Finish::Both | Finish::Calm) => {
                FIRST_WIDTH * problem.support()
            }
            _ => f64::INFINITY,
        }
    }
}

impl<const D: usize> Part<D> {
    /// The part within `width` (scene units) of a surface.
    pub(super) fn of(problem: &Problem<D>, particles: &Particles<D>, width: f64) -> Self {
        let sight = problem.reach();
        let distance = if width.is_finite() {
            distances(problem, particles)
        } else {
            vec![0.0; particles.len()]
        };
        let count = |is_in: &dyn Fn(usize) -> bool| {
            (0..particles.len())
                .filter(|&i| particles.kind[i].is_mobile() && is_in(i))
                .count() as f64
        };
        let is_all = count(&|i| distance[i] <= width) >= WORTHWHILE * count(&|_| true);
        if is_all {
            return Self::all(particles);
        }
        // Whoever is seen by what moves or is on the rim must be there, however far off its distance is: it may be too
        // great by the whole error where another part of the surface is nearer than that of the cube's middle, too
        // small only by what the way across the gradient adds.
        let error = Depths::error::<D>(problem.spacing());
        let seen = width + 2.0 * sight + error + (0.5 * error).powi(2) / (2.0 * width);
        Self::cut(particles, &distance, (width, sight, seen))
    }

    /// The part within `width` (scene units) of any of some places.
    pub(super) fn around(
        problem: &Problem<D>,
        particles: &Particles<D>,
        places: &[[f64; D]],
        width: f64,
    ) -> Self {
        let domain = &problem.domain;
        let wrapped: Vec<[f64; D]> = places.iter().map(|&place| domain.wrap(place)).collect();
        let Ok(tree) = KdTree::new(&wrapped) else {
            return Self::all(particles);
        };
        let sight = problem.reach();
        let seen = width + 2.0 * sight;
        let of_one = |&place: &[f64; D]| {
            (domain.images(domain.wrap(place), seen))
                .filter_map(|image| tree.nearest(image))
                .map(|found| found.distance)
                .fold(f64::INFINITY, f64::min)
        };
        let distance: Vec<f64> = particles
            .position
            .par_iter()
            .with_min_len(1024)
            .map(of_one)
            .collect();
        Self::cut(particles, &distance, (width, sight, seen))
    }

    /// What is nearer than `width` moves, what is within `sight` of that is its rim, what is not farther than `seen` is there.
    fn cut(
        particles: &Particles<D>,
        distance: &[f64],
        (width, sight, seen): (f64, f64, f64),
    ) -> Self {
        let order: Vec<usize> = (0..particles.len())
            .filter(|&i| distance[i] <= seen)
            .collect();
        let mut part = particles.selected(&order);
        let mut rim = Vec::new();
        for (place, &i) in order.iter().enumerate() {
            let kind = &mut part.kind[place];
            if distance[i] <= width || *kind == Kind::Frozen {
                continue;
            }
            if distance[i] <= width + sight {
                rim.push(place);
            }
            // Who is near a surface is told by the particles on it.
            let stays_on_surface = kind.is_on_surface() && distance[i] <= width + sight;
            *kind = if stays_on_surface {
                Kind::Fixed
            } else {
                Kind::Frozen
            };
        }
        Self {
            particles: part,
            order,
            rim,
            is_all: false,
        }
    }

    fn all(particles: &Particles<D>) -> Self {
        Self {
            particles: particles.clone(),
            order: (0..particles.len()).collect(),
            rim: Vec::new(),
            is_all: true,
        }
    }

    /// Brings the places that were settled back.
    pub(super) fn write_back(&self, particles: &mut Particles<D>) {
        for (&i, &p) in self.order.iter().zip(&self.particles.position) {
            particles.position[i] = p;
        }
    }

    /// The largest force times h on the particles just beyond the band. One evaluation, of these alone.
    pub(super) fn rim_residual(&self, problem: &Problem<D>, forces: &mut Forces<D>) -> f64 {
        if self.rim.is_empty() {
            return 0.0;
        }
        let mut is_rim = vec![false; self.particles.len()];
        for &place in &self.rim {
            is_rim[place] = true;
        }
        forces.targets_changed();
        forces.evaluate_plain(&self.particles.position, &self.particles.volume, |i| {
            is_rim[i]
        });
        problem.smoothing_length()
            * largest(self.rim.len(), |k| {
                point::norm(forces.acceleration(self.rim[k]))
            })
    }
}

/// Every particle's distance from the nearest surface, right to first order.
fn distances<const D: usize>(problem: &Problem<D>, particles: &Particles<D>) -> Vec<f64> {
    let around = problem.domain.bounds.grown(problem.frozen_depth());
    let places = &particles.position;
    let depths = Depths::of(&problem.bodies, around, problem.spacing(), 0.0, places);
    (0..particles.len())
        .map(|i| {
            if particles.kind[i].is_on_surface() {
                0.0
            } else {
                depths.to_surface(i)
            }
        })
        .collect()
}
