//! What a packing will take, told before it.

use crate::confinement::{PATCHES_ALONG_EDGE, expected_patches};
use crate::problem::{PackingError, Problem};
use crate::slabs;
use sphpack_neighbors::point;

#[cfg(test)]
mod tests;

/// What a method does, as far as it decides how much time and memory a packing takes. Pairs of numbers are for the
/// plane and for space. How the numbers are checked: `cargo xtask estimates`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Work {
    /// Evaluations of density and force until particles are at rest, in the middle of what scenes take.
    pub evaluations: f64,
    /// The time of one over that of a plain sum over the pairs.
    pub times_plain: f64,
    /// Neighbour lists that are there at a time.
    pub lists: f64,
    /// Sides of every surface that have a [`Confinement`](crate::Confinement).
    pub confined_sides: f64,
    /// Bytes of a particle that moves, beside those of a list.
    pub bytes: [f64; 2],
    /// Core-seconds of a particle until it is at its place at the start.
    pub placing: f64,
    /// Core-seconds of a particle on a surface until that is sampled evenly.
    pub sampling: [f64; 2],
}

impl Work {
    /// Of a method that evaluates once, and does nothing but sum over the pairs of one list.
    pub const PLAIN: Self = Self {
        evaluations: 1.0,
        times_plain: 1.0,
        lists: 1.0,
        confined_sides: 0.0,
        bytes: [0.0; 2],
        placing: 0.0,
        sampling: [0.0; 2],
    };

    /// Evaluations until the end, where so many iterations are allowed.
    pub fn evaluations_within(&self, max_iterations: usize) -> f64 {
        self.evaluations.min(max_iterations as f64)
    }
}

/// What a packing will need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Particles in the box.
    pub particles: f64,
    /// Frozen particles around it.
    pub frozen: f64,
    /// Neighbours within the support of one particle.
    pub neighbors: f64,
    /// Peak memory of the packing, bytes, to about a third.
    pub memory_bytes: f64,
    /// Bytes of these that are not free again when particles are written.
    pub kept_bytes: f64,
    /// Core-seconds of one evaluation of density and force of what moves, where a pair takes
    /// [`pace::REFERENCE`](crate::pace::REFERENCE), to a factor of about two; without what confines.
    pub seconds_per_evaluation: f64,
    /// Core-seconds of one evaluation for the surfaces that confine, likewise.
    pub confining_seconds: f64,
    /// Core-seconds of all the rest, likewise: placing particles, measuring and writing them.
    pub seconds_beside: f64,
}

/// Bytes of a process that packs next to nothing: 17 MiB.
const LEAST_BYTES: f64 = 1.75e7;

/// Bytes of a particle as it is kept; of one that is seen, in list and slots. By the peaks of settling 350,000
/// particles in space: 460 a particle with the method hybrid, where all are seen, of which the candidates are 190.
const PARTICLE_BYTES: f64 = 60.0;
const SEEN_BYTES: f64 = 200.0;

/// Bytes of a particle at the end, when all are measured and brought into columns: what these hold, and what the
/// allocator keeps of earlier arrays below 32 MiB, which as many particles as in the last line fill. Peaks of 100,000
/// to 2,000,000 particles that never moved took, beside writing, 286 … 215 a particle in the plane, 270 … 450 in
/// space; 45,000,000 took 180.
const COLUMN_BYTES: [f64; 2] = [150.0, 210.0];
const HELD_BYTES: [f64; 2] = [120.0, 190.0];
const MOST_HELD: f64 = 1.4e6;

/// Core-seconds of a plain sum over the pairs of one particle: for each pair, and beside them, the list's upkeep and
/// the motion among it. By 40 … 4,500 evaluations of the method hybrid with 13 … 113 neighbours in the plane (0.19 …
/// 0.72 µs) and 33 … 905 in space (0.47 … 5.7 µs).
const PAIR_SECONDS: [f64; 2] = [5e-9, 7e-9];
const BESIDE_SECONDS: [f64; 2] = [2e-7, 4e-7];

/// Core-seconds of a particle that is seen, at rest too, until it is in its slot: where a ball moves 9,000 of 300,000, most
/// of an evaluation is for the others.
const SEEN_SECONDS: f64 = 6e-8;

/// Core-seconds of a particle at the end, frozen ones included: 8 … 13 µs, measuring, sorting by bodies, writing and
/// reading again.
const END_SECONDS: f64 = 1.2e-5;

/// Bytes of a patch of a surface that confines while patches are put in order, and later; core-seconds until it is
/// cut. In space by balls of 1,700 … 2,200 ∆s² and boxes of 350 and 400: 1.5 kB with one confined side, 2.1 kB with two. In the
/// plane a patch is one piece of a curve, by its fields 130 bytes: of 100 discs.
const PATCH_BYTES: [f64; 2] = [430.0, 1300.0];
const KEPT_PATCH_BYTES: [f64; 2] = [130.0, 500.0];
const CUTTING_SECONDS: f64 = 1.8e-5;

/// Core-seconds of a patch that confines all particles within its reach on one side, for each ∆s^D of a cube as wide as the
/// support, where [`pace`](crate::pace) is 1: 36 … 58 ns for both sides of balls, tori, ellipsoids, boxes and cylinders of 1 … 5 ∆s in
/// space, 28 … 75 ns for discs and squares.
const CONFINING_SECONDS: f64 = 2.3e-8;

/// Where spacings differ: bytes of a particle beside those of others, of a neighbour in its list; the time of an evaluation over
/// that of a uniform one, and core-seconds until a particle is at its place.
const GRADED_BYTES: f64 = 400.0;
const GRADED_LISTED: [f64; 2] = [2.0, 2.0];
const GRADED_SUMS: f64 = 1.5;
const GRADED_PLACING: f64 = 3e-5;

impl<const D: usize> Problem<D> {
    /// What the packing by a method of such work will need, from volumes and areas, where particles within `moves` (scene
    /// units) of a surface settle and the others stay where they are. Where surfaces confine, some places on them tell how finely
    /// they will be cut.
    ///
    /// # Errors
    /// Those of [`Problem::check`].
    pub fn estimate(&self, moves: f64, work: &Work) -> Result<Estimate, PackingError> {
        self.check()?;
        if self.resolution.uniform().is_none() {
            return Ok(self.estimate_graded(work));
        }
        let filling = self.filling();
        let particles = filling.count() as f64;
        let frozen = filling.continued_count(&self.domain, self.frozen_depth());
        let unit_ball = [std::f64::consts::PI, 4.0 / 3.0 * std::f64::consts::PI][D - 2];
        let per_site = filling.volume_per_site();
        let neighbors = unit_ball * self.support().powi(D as i32) / per_site;
        let area: f64 = self.bodies.iter().map(|body| body.surface.measure()).sum();
        let moving = if self.bodies.is_empty() {
            0.0
        } else {
            (area * 2.0 * moves / per_site).min(particles)
        };
        let around = area * 4.0 * self.reach() / per_site;
        // Across periodic sides there are images in place of frozen particles.
        let size = self.domain.bounds.size();
        let larger: f64 = (0..D)
            .filter(|&k| self.domain.periodic[k])
            .map(|k| 1.0 + 2.0 * self.reach() / size[k])
            .product();
        let images = particles * (larger - 1.0);
        let seen = (moving + around).min(particles) + frozen + images;
        let all = particles + frozen;
        // Blocks of eight list every candidate within the reach of any of the eight: about twice the neighbours.
        let listed = |reach: f64| 4.0 * 2.2 / 8.0 * unit_ball * reach.powi(D as i32) / per_site;
        let on_surface = area / self.spacing().powi(D as i32 - 1);
        let sides = work.confined_sides;
        let (mut patches, mut confining) = (0.0, 0.0);
        if sides > 0.0 {
            let smooth = (self.bodies.iter())
                .map(|body| expected_patches(body.surface.as_ref(), self.spacing()));
            patches = smooth.sum::<f64>() + self.sharp() * PATCHES_ALONG_EDGE;
            let kept = (sides - 1.0) * KEPT_PATCH_BYTES[D - 2];
            confining = patches * (PATCH_BYTES[D - 2] + kept);
        }
        let settling = moving * (work.bytes[D - 2] + work.lists * listed(self.reach()))
            + work.lists * seen * SEEN_BYTES
            + confining;
        let judged = listed(self.support().max(self.judging_reach));
        let measuring =
            all * (SEEN_BYTES - PARTICLE_BYTES) + judged * particles.min(slabs::MOST as f64);
        let kept = all * COLUMN_BYTES[D - 2] + all.min(MOST_HELD) * HELD_BYTES[D - 2];
        let peak = (settling.max(measuring) + all * PARTICLE_BYTES).max(kept);
        let sum = moving * (BESIDE_SECONDS[D - 2] + neighbors * PAIR_SECONDS[D - 2])
            + if moving > 0.0 {
                seen * SEEN_SECONDS
            } else {
                0.0
            };
        let in_support = (self.support() / self.spacing()).powi(D as i32);
        Ok(Estimate {
            particles,
            frozen,
            neighbors,
            memory_bytes: LEAST_BYTES + peak,
            kept_bytes: LEAST_BYTES + kept,
            seconds_per_evaluation: work.times_plain * sum,
            confining_seconds: sides * patches * in_support * CONFINING_SECONDS,
            seconds_beside: all * END_SECONDS
                + particles * work.placing
                + on_surface * work.sampling[D - 2]
                + sides * patches * CUTTING_SECONDS,
        })
    }

    /// [`Problem::estimate`] where spacings differ: all particles move, are placed and summed by their own sizes.
    fn estimate_graded(&self, work: &Work) -> Estimate {
        let sight = self.frozen_depth() / self.spacing();
        let [particles, frozen] = self.resolution.count_in_box(&self.domain, sight);
        let unit_ball = [std::f64::consts::PI, 4.0 / 3.0 * std::f64::consts::PI][D - 2];
        let in_spacings = self.support() / self.spacing();
        let neighbors = unit_ball * in_spacings.powi(D as i32);
        let all = particles + frozen;
        let bytes = work.bytes[D - 2] + GRADED_BYTES + GRADED_LISTED[D - 2] * neighbors;
        let peak = all * (bytes + SEEN_BYTES + PARTICLE_BYTES);
        let kept = all * COLUMN_BYTES[D - 2] + all.min(MOST_HELD) * HELD_BYTES[D - 2];
        let sum = BESIDE_SECONDS[D - 2] + neighbors * PAIR_SECONDS[D - 2];
        Estimate {
            particles,
            frozen,
            neighbors,
            memory_bytes: LEAST_BYTES + peak.max(kept),
            kept_bytes: LEAST_BYTES + kept,
            seconds_per_evaluation: GRADED_SUMS * work.times_plain * particles * sum,
            confining_seconds: 0.0,
            seconds_beside: all * END_SECONDS + particles * GRADED_PLACING,
        }
    }

    /// How long the bodies' sharp edges are, in ∆s; 0 in the plane.
    fn sharp(&self) -> f64 {
        let edges = (self.bodies.iter()).flat_map(|body| body.surface.features().edges);
        let length: f64 = edges
            .map(|edge| {
                let sides = edge.windows(2);
                sides
                    .map(|ends| point::distance(ends[0], ends[1]))
                    .sum::<f64>()
            })
            .sum();
        length / self.spacing()
    }
}
