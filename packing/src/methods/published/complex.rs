//! Complex relaxation of Zhao et al. (2025), §2.3: bodies as in separate relaxation, the fluid against their
//! particles.

use rayon::prelude::*;

use super::relaxation::{Interface, Relaxation, Relaxed};
use crate::estimate::Work;
use crate::forces::Forces;
use crate::lattice::Lattice;
use crate::methods::info::{CHOOSING, MethodInfo};
use crate::minimise::{Energy, GradientPenalty, Settling};
use crate::observer::Stage;
use crate::packed::{Packed, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{Body, PackingError, Problem};
use crate::run_log::RunLog;
use sphpack_kernels::KernelKind;
use sphpack_pairs::Repulsion;

/// The paper's complex relaxation (Zhao et al. 2025, §2.3), in the plane and in space, and a levelling after it.
///
/// In each step the bodies move first, each alone as in [`Relaxation`]; then the fluid, which sees the bodies' particles
/// where separate relaxation has confinement (eq. 12). The coupling is one-way: bodies do not see the fluid. Which h
/// holds between a fluid and a solid particle the paper does not say; here the fluid's.
///
/// The fluid is bounded "onto the non-contact surface" only (algorithm 1, line 14): a bound ∆s/2 outside of the bodies,
/// as separate relaxation has, would hold the first layer back with h |Σ V ∇W| up to 0.08. It is kept out of the
/// bodies, φ > 0 (eq. 11; φ > ∆s/2 where surface particles sit on the surface), which holds back no more than a
/// particle in a notch.
///
/// # Levelling
/// The paper's kernel and h leave Γ off by 1 to 2.5 % here and there, whether there is a body or not
/// (`docs/methods.md`), where the paper's figures span 0.4 %. So at the end all particles but those on surfaces go
/// down the energy
///
/// - E = ½ Σ V (Γᶠ + Γˢ) + ½ κ Σ_fluid V e(Γᶠ − Γ₀ᶠ)² + ½ κ Σ_solid V e(Γˢ − Γ₀ˢ)² + ½ μ h² Σ_first V |∇Γᶠ|²
///
/// with Γᶠ and Γˢ by the fluid's and the solid's h, summed over all particles, and e(x) by how much |x| is beyond
/// 0.25 %. Particles whose density is even enough feel the background pressure alone; the others trade Σ V ∇W = 0 for
/// it, but those of the first layer of fluid, which the last term keeps where their kernel gradient sum almost vanishes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Complex {
    /// How bodies and fluid relax.
    pub relaxation: Relaxation,
    /// κ; 0 leaves particles as the paper does.
    pub levelling: f64,
    /// μ, how much the first layer's kernel gradient sum counts while density is levelled.
    pub gradient_penalty: f64,
}

/// By how much Γ may be off without being levelled: κ is finite, so the last stay outside, by a half of this at most on
/// the scenes measured.
const LEEWAY: f64 = 0.0025;

/// Levelling ends where no force times h is larger, or after as many evaluations as relaxation may have.
const TOLERANCE: f64 = 0.02;

/// The first layer of fluid is what is within ∆s of a body at the end; some come nearer while density is levelled.
const FIRST_LAYER: f64 = 1.2;

/// C of the repulsion that keeps pairs from falling into one another.
const REPULSION: f64 = 0.001;

impl Default for Complex {
    fn default() -> Self {
        Self {
            relaxation: Relaxation::default(),
            levelling: 1000.0,
            gradient_penalty: 100.0,
        }
    }
}

impl Complex {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "complex",
        summary: "bodies relaxed alone, the fluid against their particles (Zhao et al. 2025)",
        kernel: KernelKind::WendlandC2,
        h_over_spacing: 1.3,
        // As many as relaxation, then as many that level, of two smoothing lengths with two sums each: three times as
        // long.
        work: Work {
            evaluations: 1500.0,
            times_plain: 4.0,
            confined_sides: 1.0,
            // Two sums, each with its lists: peaks of 164,000 particles in the plane and 65,000 in space.
            bytes: [450.0, 200.0],
            placing: CHOOSING,
            ..Work::PLAIN
        },
        ..MethodInfo::USUAL
    };

    /// Packs the problem.
    ///
    /// # Errors
    /// Those of packing bodies and fluid apart, as [`Relaxation`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        let (tolerance, most) = (
            self.relaxation.residual_tolerance,
            self.relaxation.max_iterations,
        );
        log.begin(&Self::INFO, tolerance, most);
        let mut relaxed = (self.relaxation).relax(problem, log, Interface::Particles)?;
        if self.levelling > 0.0 && most > 0 {
            relaxed = self.level(problem, relaxed, log)?;
        }
        Ok(relaxed.end(problem, log))
    }

    fn level<const D: usize>(
        &self,
        problem: &Problem<D>,
        mut relaxed: Relaxed<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Relaxed<D>, PackingError> {
        let settling = Settling {
            residual_tolerance: Some(TOLERANCE),
            max_evaluations: self.relaxation.max_iterations,
            repulsion: [REPULSION; 2],
            levelling: self.levelling,
            leeway: LEEWAY,
            ..Settling::default()
        };
        log.progress.tolerance = TOLERANCE;
        log.progress.max_evaluations = log.progress.evaluation + settling.max_evaluations;
        log.enter(Stage::Settling);
        let is_solid: Vec<bool> = relaxed.particles.body.iter().map(Option::is_some).collect();
        let first_layer = first_layer(problem, &relaxed.particles);
        let fluid_gamma = problem.perfect_gamma();
        let mut fluid = relaxed.whole;
        fluid.repulsion = settling.early_repulsion(problem.spacing());
        fluid.levelled = is_solid.iter().map(|is_solid| !is_solid).collect();
        let mut energy = Energy::new(
            &mut relaxed.particles,
            &relaxed.surfaces,
            fluid,
            problem.support(),
        );
        energy.add(self.solids(problem, is_solid, &settling));
        energy.penalise(GradientPenalty::of(first_layer, self.gradient_penalty));
        energy.keep_sides(&problem.bodies);
        let [_, last] = settling.schedule(problem.spacing(), fluid_gamma);
        let reason = settling.run(&mut energy, log, &[last])?;
        energy
            .added()
            .into_iter()
            .for_each(|solids| log.count(solids));
        log.seconds.forces += energy.penalty_seconds();
        relaxed.whole = energy.into_forces();
        if relaxed.stop_reason == StopReason::Converged {
            relaxed.stop_reason = reason;
        }
        Ok(relaxed)
    }

    /// The evaluator by the solids' h, which levels them.
    fn solids<const D: usize>(
        &self,
        problem: &Problem<D>,
        is_solid: Vec<bool>,
        settling: &Settling,
    ) -> Forces<D> {
        let (kernel, ratio) = (problem.kernel, self.relaxation.solid_h_over_spacing);
        let h = ratio * problem.spacing();
        let lattice = (problem.lattice).unwrap_or(Lattice::auto(D, kernel, ratio));
        let gamma = (lattice.fill(problem.domain.bounds, problem.spacing())).gamma(kernel, h);
        let none = Repulsion::none();
        let mut forces = Forces::new(&problem.domain, kernel, h, problem.skin(), none);
        forces.levelled = is_solid;
        forces.levelling = settling.last_levelling(gamma);
        forces
    }
}

/// The first layer of fluid around the bodies, by its particles' numbers.
fn first_layer<const D: usize>(problem: &Problem<D>, particles: &Particles<D>) -> Vec<u32> {
    let reach = FIRST_LAYER * problem.spacing();
    let is_near = |p: [f64; D]| {
        let p = problem.domain.wrap(p);
        let near = |body: &Body<D>| body.surface.closest_within(p, reach).is_some();
        problem.bodies.iter().any(near)
    };
    (0..particles.len() as u32)
        .into_par_iter()
        .filter(|&i| {
            let i = i as usize;
            let is_fluid = particles.kind[i] == Kind::Free && particles.body[i].is_none();
            is_fluid && is_near(particles.position[i])
        })
        .collect()
}
