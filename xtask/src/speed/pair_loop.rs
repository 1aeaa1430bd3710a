//! The pair loop against the roofline.

use std::fmt::Write as _;

use sphpack_kernels::KernelKind;
use sphpack_neighbors::{Bounds, Domain};
use sphpack_packing::Lattice;
use sphpack_packing::forces::Forces;
use sphpack_pairs::Repulsion;

use super::machine::{bandwidth, peak, quickest};

/// Operations on doubles that a pair takes with the quintic, D of them dimensions, most pairs beyond 2h: difference D,
/// square 2D − 1, root and inverse 12, spline 8, scaling 2, sums 2 + 2D. The repulsion of the nearest is not counted.
const fn operations(dimension: usize) -> f64 {
    (5 * dimension + 23) as f64
}

/// Bytes per particle that an evaluation streams besides the list: slot, position, volume, sums.
const STREAMED: f64 = 180.0;

/// Dimension, edge of the box in ∆s.
const SETS: [(usize, f64); 4] = [(2, 100.0), (2, 1000.0), (3, 21.5), (3, 109.0)];

/// The table.
pub(super) fn table() -> Result<String, String> {
    let mut text = String::new();
    let (one, two) = (peak(1)?, peak(2)?);
    let (narrow, wide) = (bandwidth(1)?, bandwidth(2)?);
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "This machine: {:.1} and {:.1} G multiply-adds and sums of doubles per second on one and two threads,\n\
         {:.1} and {:.1} GB/s of memory. An evaluation is Γ, ∇Γ and repulsion, quintic, h/∆s = 1.2, list ready; a pair\n\
         takes {} operations in the plane, {} in space.\n\n\
         | set | particles | pairs/particle | M pairs/core-second | share of the peak | memory, GB/s | two threads |\n\
         |---|---|---|---|---|---|---|",
        one / 1e9,
        two / 1e9,
        narrow / 1e9,
        wide / 1e9,
        operations(2),
        operations(3),
    );
    for (dimension, edge) in SETS {
        let found = if dimension == 2 {
            evaluation::<2>(edge)?
        } else {
            evaluation::<3>(edge)?
        };
        let pairs = found.particles * found.neighbors;
        let _ = writeln!(
            text,
            "| {dimension}-D | {:.2e} | {:.0} | {:.0} | {:.0} % | {:.2} | {:.2} × |",
            found.particles,
            found.neighbors,
            pairs / found.seconds[0] / 1e6,
            100.0 * operations(dimension) * pairs / found.seconds[0] / one,
            found.particles * (STREAMED + 1.25 * found.neighbors) / found.seconds[0] / 1e9,
            found.seconds[0] / found.seconds[1],
        );
    }
    print!("{text}");
    Ok(text)
}

/// What an evaluation took on one and on two threads.
struct Evaluation {
    particles: f64,
    /// Directed pairs per particle.
    neighbors: f64,
    seconds: [f64; 2],
}

fn evaluation<const D: usize>(edge: f64) -> Result<Evaluation, String> {
    let (kernel, h) = (KernelKind::Quintic, 1.2);
    let bounds = Bounds::new([0.0; D], [edge; D]);
    let mut domain = Domain::new(bounds.min, bounds.max);
    domain.periodic = [true; D];
    let lattice = Lattice::auto(D, kernel, h);
    let mut positions = lattice.fill(bounds, 1.0).sites();
    let particles = positions.len();
    for (i, p) in positions.iter_mut().enumerate() {
        for (k, x) in p.iter_mut().enumerate() {
            *x += 0.1 * ((i * (2 * k + 3)) as f64).sin();
        }
    }
    let volumes = vec![1.0; particles];
    let mut seconds = [0.0; 2];
    for (threads, seconds) in (1..).zip(&mut seconds) {
        let repulsion = Repulsion::new(1.0, Repulsion::STRENGTH);
        let mut forces = Forces::new(&domain, kernel, h, 0.3, repulsion);
        forces.evaluate_plain(&positions, &volumes, |_| true);
        *seconds = quickest(threads, || {
            forces.evaluate_plain(&positions, &volumes, |_| true);
        })?;
    }
    let unit_ball = [std::f64::consts::PI, 4.0 / 3.0 * std::f64::consts::PI][D - 2];
    Ok(Evaluation {
        particles: particles as f64,
        neighbors: unit_ball * (kernel.support_over_h() * h).powi(D as i32) - 1.0,
        seconds,
    })
}
