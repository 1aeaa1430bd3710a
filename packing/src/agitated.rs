//! The agitated method of paper 000 §2: particles on circles keep the others moving until the surface has its share.

use std::time::Instant;

use rayon::prelude::*;
use sphpack_geometry::Closest;
use sphpack_neighbors::{KdTree, point};

use crate::course::Course;
use crate::forces::{Forces, largest};
use crate::motion::Motion;
use crate::observer::{Observer, Phase};
use crate::on_surface::OnSurface;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::repulsion::Repulsion;
use crate::seeding::{Seeds, particle_surfaces, seed};

/// The agitated method (000 §2).
///
/// Some free particles, on a coarse grid and at least 2 ∆s from every surface, run on circles (2-D, eq. 12) or closed
/// curves on spheres (3-D, eq. 13) of radius ∆s/2 and stir the rest. Slow free particles within ∆s/10 of a surface
/// become boundary particles, boundary particles farther than ∆s/4 become free again (§2.5); when their number has not
/// changed for a revolution, agitators become free particles, and the method ends when the largest error of the density
/// has changed by less than 10⁻³ within one more (eq. 17).
///
/// In the paper p_b = 2000 (d−1) k with k = 1 (eq. 18); here p_b = 1 and times are in units of ∆s/√p_b, which makes the
/// paper's revolution of 0.2 s at ∆s = 0.05 one of 179 units and its largest step, 10⁻⁴ s, one of 0.09: a revolution
/// is 2000 steps, also in 3-D, where the curve of eq. 13 takes two of them. Eq. 4 is cut at its zero, r = c, beyond
/// which it would attract; agitators start on their curve (eqs. 12 and 13 begin ∆s/2 off the site).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agitated {
    /// The end: how little the largest error of the density changes within a revolution (eq. 17).
    pub density_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// The damping ζ in √p_b/∆s (eq. 19).
    pub damping: f64,
    /// k in p_b ∆s^0: 1/(2000 (d−1)) of eq. 18, given here for d = 2.
    pub repulsion: f64,
    /// Steps of a revolution.
    pub revolution: usize,
    /// The side of the grid's cells, each of which gets an agitator, in ∆s.
    pub grid_over_spacing: f64,
    /// Distances in ∆s at which free particles become boundary particles, and these free ones.
    pub conversion_over_spacing: [f64; 2],
}

impl Default for Agitated {
    fn default() -> Self {
        Self {
            density_tolerance: 1e-3,
            max_iterations: 20_000,
            damping: 5e-3,
            repulsion: 1.0 / 2000.0,
            revolution: 2000,
            grid_over_spacing: 4.0,
            conversion_over_spacing: [0.1, 0.25],
        }
    }
}

/// The largest time step, in ∆s/√p_b.
const LARGEST_STEP: f64 = 0.09;

/// No particle moves farther than this in a step, in ∆s (eq. 20).
const FARTHEST: f64 = 0.01;

/// Agitators are at least this far from every surface, in ∆s.
const AWAY: f64 = 2.0;

/// c of eq. 4 in ∆s: 1.5 α with α = 1, and 1.2 between boundary particles.
const REACH: [f64; 2] = [1.5, 1.8];

/// Steps between two lines of the history.
const NOTE_EVERY: usize = 50;
