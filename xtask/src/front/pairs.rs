//! What a packing takes on any machine: the pairs that its sums go over.

use sphpack::scene::{Finish, Method};
use sphpack::{Report, Solution};
use sphpack_packing::Moves;

/// A band that would hold more than this part of the particles holds all of them.
const WORTHWHILE: f64 = 0.7;

/// Pairs, about: evaluations of density and force, and those that corrected masses take, times the particles that move at
/// first, times the neighbours of one, times the passes of an evaluation. Machines and their load make no difference.
pub(super) fn pairs<const D: usize>(solution: &Solution<D>, report: &Report) -> f64 {
    let (problem, packing) = (&solution.problem, &report.scene.packing);
    let particles = &solution.packed.particles;
    let width = match packing.method.info().moves {
        Moves::Nothing => 0.0,
        Moves::Band => packing
            .band()
            .first_width(problem, packing.settling_in(D).finish),
        Moves::All => f64::INFINITY,
    };
    let mobile: Vec<[f64; D]> = (0..particles.len())
        .filter(|&i| particles.kind[i].is_mobile())
        .map(|i| particles.position[i])
        .collect();
    let is_near = |p: &&[f64; D]| {
        (problem.bodies.iter()).any(|body| body.surface.closest(**p).distance.abs() <= width)
    };
    let near = if width.is_finite() {
        mobile.iter().filter(is_near).count() as f64
    } else {
        mobile.len() as f64
    };
    let moving = if near > WORTHWHILE * mobile.len() as f64 {
        mobile.len() as f64
    } else {
        near
    };
    let unit_ball = [std::f64::consts::PI, 4.0 / 3.0 * std::f64::consts::PI][D - 2];
    let neighbors =
        unit_ball * problem.support().powi(D as i32) / problem.filling().volume_per_site();
    // Levelling needs the density before it can push.
    let levels = packing.method == Method::Balanced
        && packing.finish == Finish::Even
        && packing.settling_in(D).levelling > 0.0;
    let passes = if levels { 2.0 } else { 1.0 };
    let of_masses = report
        .mass_correction
        .map_or(0.0, |masses| masses.evaluations as f64);
    let all = mobile.len() as f64;
    neighbors * (passes * moving * report.force_evaluations as f64 + all * of_masses)
}
