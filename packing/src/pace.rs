//! How fast this machine computes, now.

use std::time::Instant;

use sphpack_geometry::Ball;
use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Domain, point};

use crate::confinement::Confinement;
use crate::estimate::Estimate;
use crate::forces::Forces;
use crate::problem::Problem;
use crate::seeding::seed;
use sphpack_pairs::Repulsion;

/// Core-seconds of a pair where the constants of [estimates](crate::estimate) were measured. Between that machine,
/// which others share, and another at rest lies a factor of 2.5: nothing but a measurement tells.
pub const REFERENCE: f64 = 8e-9;

/// Core-seconds of a patch of a ball's surface that confines, for each ∆s^D of a cube as wide as the support, where the
/// constant for [confinement](crate::estimate) was measured. Its loop has no vectors, so that it is slower than that over the
/// pairs by another factor on every machine.
const PATCH_REFERENCE: f64 = 5.2e-8;

/// Spacings along an edge of the box that is measured; it takes some milliseconds.
const EDGE: f64 = 12.0;

/// The radius of the ball that confines, in ∆s: as small as one can be that is not cut finer.
const RADIUS: f64 = 2.0;

/// Evaluations; the quickest counts, others may have been held up.
const REPEATS: usize = 5;

/// How slow this machine is, over where estimates were measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// In sums over pairs.
    pub pairs: f64,
    /// In sums over what confines.
    pub confining: f64,
}

impl Pace {
    /// That of now, on one thread; 1 where it cannot be measured. What is not needed for an estimate is not measured.
    pub fn measured(of: &Estimate) -> Self {
        let confines = of.confining_seconds > 0.0;
        let measure = || Self {
            pairs: seconds_per_pair().map_or(1.0, |pair| pair / REFERENCE),
            confining: if confines {
                seconds_per_patch().map_or(1.0, |patch| patch / PATCH_REFERENCE)
            } else {
                1.0
            },
        };
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        one.map_or(
            Self {
                pairs: 1.0,
                confining: 1.0,
            },
            |one| one.install(measure),
        )
    }

    /// The mean of two.
    #[must_use]
    pub fn mean(self, other: Self) -> Self {
        Self {
            pairs: 0.5 * (self.pairs + other.pairs),
            confining: 0.5 * (self.confining + other.confining),
        }
    }
}

impl Estimate {
    /// Core-seconds of one evaluation at a pace.
    pub fn seconds_of_one(&self, pace: Pace) -> f64 {
        pace.pairs * self.seconds_per_evaluation + pace.confining * self.confining_seconds
    }

    /// Core-seconds of so many evaluations and all the rest.
    pub fn seconds(&self, pace: Pace, evaluations: f64) -> f64 {
        pace.pairs * self.seconds_beside + evaluations * self.seconds_of_one(pace)
    }
}

/// What takes the least time of some times.
fn quickest(mut work: impl FnMut()) -> f64 {
    (0..REPEATS)
        .map(|_| {
            let begin = Instant::now();
            work();
            begin.elapsed().as_secs_f64()
        })
        .fold(f64::INFINITY, f64::min)
}

fn seconds_per_pair() -> Option<f64> {
    let problem = Problem::new(Domain::new([0.0; 3], [EDGE; 3]), 1.0);
    let particles = seed(&problem).ok()?.particles;
    let mut forces = Forces::of(&problem, Repulsion::none());
    forces.evaluate(&particles);
    let quickest = quickest(|| forces.evaluate(&particles));
    let pairs = forces.list().targets() as f64 * 4.0 / 3.0
        * std::f64::consts::PI
        * problem.support().powi(3);
    Some(quickest / pairs)
}

fn seconds_per_patch() -> Option<f64> {
    let middle = [0.5 * EDGE; 3];
    let ball = Ball::new(middle, RADIUS).ok()?;
    let mut problem = Problem::new(Domain::new([0.0; 3], [EDGE; 3]), 1.0);
    // The kernel of the methods that confine.
    (problem.kernel, problem.h_over_spacing) = (KernelKind::WendlandC2, 1.3);
    let (kernel, h) = (problem.kernel, problem.smoothing_length());
    let confinement = Confinement::outside(&[&ball], &problem.domain, kernel, h, 1.0);
    let mut places = seed(&problem).ok()?.particles.position;
    places.retain(|&p| point::distance(p, middle) > RADIUS);
    let mut sums = vec![[0.0; 3]; places.len()];
    let quickest = quickest(|| confinement.add_gradients(&places, |_| true, &mut sums));
    Some(quickest / confinement.patches() as f64 / problem.support().powi(3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_machine_has_a_pace() {
        let estimate = Estimate {
            particles: 1.0,
            frozen: 0.0,
            neighbors: 1.0,
            memory_bytes: 1.0,
            kept_bytes: 1.0,
            seconds_per_evaluation: 2.0,
            confining_seconds: 3.0,
            seconds_beside: 5.0,
        };
        let pace = Pace::measured(&estimate);
        // From a hundred times as fast to a build without optimisation.
        for slowness in [pace.pairs, pace.confining] {
            assert!(slowness > 0.01 && slowness < 1000.0, "{pace:?}");
        }
        let seconds = estimate.seconds(pace, 7.0);
        let expected = (5.0 + 14.0) * pace.pairs + 21.0 * pace.confining;
        assert!((seconds / expected - 1.0).abs() < 1e-12, "{seconds}");
        let plain = Estimate {
            confining_seconds: 0.0,
            ..estimate
        };
        assert_eq!(Pace::measured(&plain).confining, 1.0);
    }
}
