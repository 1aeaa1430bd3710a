//! How fast this machine sums over pairs, now.

use std::time::Instant;

use sphpack_neighbors::Domain;

use crate::forces::Forces;
use crate::problem::Problem;
use crate::seeding::seed;
use sphpack_pairs::Repulsion;

/// Core-seconds of a pair where the constants of [estimates](crate::estimate) were measured. Between that machine,
/// which others share, and another at rest lies a factor of 2.5: nothing but a measurement tells.
pub const REFERENCE: f64 = 8e-9;

/// Spacings along an edge of the box that is measured; it takes some milliseconds.
const EDGE: f64 = 12.0;

/// Evaluations; the quickest counts, others may have been held up.
const REPEATS: usize = 5;

/// Core-seconds that a pair takes on this machine, over [`REFERENCE`]; 1 where that cannot be measured.
pub fn slowness() -> f64 {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    (one.ok().and_then(|one| one.install(seconds_per_pair))).map_or(1.0, |pair| pair / REFERENCE)
}

fn seconds_per_pair() -> Option<f64> {
    let problem = Problem::new(Domain::new([0.0; 3], [EDGE; 3]), 1.0);
    let particles = seed(&problem).ok()?.particles;
    let mut forces = Forces::of(&problem, Repulsion::none());
    forces.evaluate(&particles);
    let quickest = (0..REPEATS)
        .map(|_| {
            let begin = Instant::now();
            forces.evaluate(&particles);
            begin.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min);
    let pairs = forces.list().targets() as f64 * 4.0 / 3.0
        * std::f64::consts::PI
        * problem.support().powi(3);
    Some(quickest / pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_machine_has_a_pace() {
        let slowness = slowness();
        // From a hundred times as fast to a build without optimisation.
        assert!(slowness > 0.01 && slowness < 1000.0, "{slowness}");
    }
}
