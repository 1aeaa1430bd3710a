//! Relaxation of Zhao et al. (2025), §2.1: every body alone, bounded by its surface and confined by what lies beyond.

use std::time::Instant;

use sphpack_geometry::{Closest, Surface};
use sphpack_kernels::KernelKind;
use sphpack_neighbors::point;

use super::confined::{Bound, Confined, update_ghosts};
use super::fluid_side::{around_body, tightest};
use crate::confinement::Confinement;
use crate::estimate::Work;
use crate::forces::Forces;
use crate::lattice::Filling;
use crate::methods::info::{CHOOSING, MethodInfo};
use crate::observer::Stage;
use crate::packed::{Packed, ParticleSurface, StopReason};
use crate::particles::{Kind, Particles};
use crate::problem::{PackingError, Problem};
use crate::run_log::RunLog;
use sphpack_pairs::Repulsion;

mod start;

use start::Start;

/// The paper's separate relaxation (Zhao et al. 2025, §2.1–2.2), in the plane and in space.
///
/// Every body, and the fluid, the box without the bodies (eq. 11), relaxes alone. None sees another: what lies beyond
/// its surface is completed as if it were full ([`Confinement`], eqs. 8 to 10), the fluid at the box's sides by the
/// frozen lattice. Solids are bounded by their particle surface (eq. 7), the fluid by the set as far outside the true
/// surface as keeps both ∆s apart. Kernel and h/∆s of the problem are the fluid's; the paper has Wendland's C2 at 1.3
/// there and at 1.05 in solids.
///
/// Where the paper leaves room, what was chosen, by what was measured (`docs/methods.md`):
///
/// - The lattices at the start, and who sits on the bounding set: `relaxation/start.rs`.
/// - Confinement has density 1 (eq. 8). The lattice's own Γ₀ in its place, 1.033 in solids, changes the means by 0.1 %
///   and the extremes not for the better.
/// - ∆t (eq. 5) is capped by the stiffest mode, or nothing would come to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    /// Stop where the largest h |Σ V ∇W|, completed, of particles that the surface does not hold back, is below this.
    /// The paper stops after a number of steps; its kinetic energy (eq. 14) falls with the step, this does not.
    pub residual_tolerance: f64,
    /// Give up after this many iterations.
    pub max_iterations: usize,
    /// h/∆s of solids.
    pub solid_h_over_spacing: f64,
}

impl Default for Relaxation {
    fn default() -> Self {
        Self {
            residual_tolerance: 1e-3,
            max_iterations: 20_000,
            solid_h_over_spacing: 1.05,
        }
    }
}

/// What the fluid sees of the solids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Interface {
    /// Confinement in their place.
    Confinement,
    /// Their particles.
    Particles,
}

/// Iterations between two looks at progress.
const LOOK_EVERY: usize = 50;

impl Relaxation {
    /// What it costs, moves and promises.
    pub const INFO: MethodInfo = MethodInfo {
        name: "relaxation",
        summary: "bodies and fluid relaxed apart, each within its surface (Zhao et al. 2025)",
        kernel: KernelKind::WendlandC2,
        h_over_spacing: 1.3,
        // 560 … 2,440 iterations. Both sides of every surface are confined.
        work: Work {
            evaluations: 1200.0,
            confined_sides: 2.0,
            placing: CHOOSING,
            ..Work::PLAIN
        },
        ..MethodInfo::USUAL
    };

    /// Packs the problem.
    ///
    /// # Errors
    /// Those of [`Problem::check`], and [`PackingError::Surface`].
    pub(crate) fn pack_in<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
    ) -> Result<Packed<D>, PackingError> {
        log.begin(&Self::INFO, self.residual_tolerance, self.max_iterations);
        let relaxed = self.relax(problem, log, Interface::Confinement)?;
        Ok(relaxed.end(problem, log))
    }

    pub(crate) fn relax<const D: usize>(
        &self,
        problem: &Problem<D>,
        log: &mut RunLog<'_>,
        interface: Interface,
    ) -> Result<Relaxed<D>, PackingError> {
        let surfaces = log.surfaces(problem)?;
        log.enter(Stage::Seeding);
        let seeding = Instant::now();
        let Start {
            solids,
            fluid,
            frozen_lattice,
        } = Start::of(problem, &surfaces, self.solid_h_over_spacing)?;
        let own = fluid.len();
        let mut solids = self.confined_solids(problem, &surfaces, solids);
        let mut fluid = confined_fluid(problem, fluid, &solids, interface);
        log.seconds.seeding = seeding.elapsed().as_secs_f64();

        log.enter(Stage::Settling);
        let mut whole = Forces::of(problem, Repulsion::none());
        let mut stop_reason = StopReason::IterationLimit;
        let (mut iteration, mut is_settled) = (1, false);
        log.go_on(&mut [
            &mut iteration,
            &mut is_settled,
            &mut solids,
            &mut fluid,
            &mut whole,
        ])?;
        while iteration <= self.max_iterations && !is_settled {
            if log.is_to_stop(&[&iteration, &is_settled, &solids, &fluid, &whole]) {
                break;
            }
            let mut residual: f64 = 0.0;
            for solid in &mut solids {
                residual = residual.max(solid.step());
            }
            if interface == Interface::Particles {
                update_ghosts(&mut fluid, &solids);
            }
            residual = residual.max(fluid.step());
            is_settled = residual < self.residual_tolerance;
            log.progress.evaluation = iteration;
            log.progress.criterion = residual;
            if iteration % LOOK_EVERY == 0 || is_settled {
                let (particles, on_surface) = together(&solids, &fluid, own);
                log.progress.on_surface = on_surface.len();
                whole.evaluate(&particles);
                log.tell();
                log.note(&whole, &particles);
            }
            iteration += 1;
        }
        if is_settled {
            stop_reason = StopReason::Converged;
        }
        if interface == Interface::Particles {
            log.set_aside(0, &[&iteration, &is_settled, &solids, &fluid, &whole]);
        }
        for one in solids.iter().chain([&fluid]) {
            log.count(&one.forces);
            log.seconds.forces += one.seconds[0];
            log.seconds.projection += one.seconds[1];
        }
        let (mut particles, on_surface) = together(&solids, &fluid, own);
        drop((solids, fluid));
        whole.evaluate(&particles);
        for i in on_surface {
            particles.kind[i] = Kind::Boundary;
        }
        Ok(Relaxed {
            particles,
            surfaces,
            frozen_lattice,
            whole,
            stop_reason,
        })
    }

    /// The solids, each bounded by its particle surface.
    fn confined_solids<'a, const D: usize>(
        &self,
        problem: &'a Problem<D>,
        surfaces: &'a [ParticleSurface<D>],
        solids: Vec<Particles<D>>,
    ) -> Vec<Confined<'a, D>> {
        let h = self.solid_h_over_spacing * problem.spacing();
        (problem.bodies.iter().zip(surfaces).zip(solids))
            .map(|((body, held), particles)| {
                let (kernel, domain) = (problem.kernel, &problem.domain);
                let forces = Forces::new(domain, kernel, h, problem.skin(), Repulsion::none());
                let (body, share) = (body.surface.as_ref(), body.inner_share());
                let confinement = Confinement::inside(body, domain, kernel, h, problem.spacing());
                let bound: Bound<'a, D> = Box::new(|p, _| held.surface.closest(p));
                Confined::new(particles, share, forces, Some(confinement), bound)
            })
            .collect()
    }
}

/// What relaxation comes to.
pub(crate) struct Relaxed<const D: usize> {
    /// Those that a body's surface holds are boundary particles.
    pub(crate) particles: Particles<D>,
    pub(crate) surfaces: Vec<ParticleSurface<D>>,
    frozen_lattice: Filling<D>,
    /// The evaluator of the problem, for particles that all see each other.
    pub(crate) whole: Forces<D>,
    pub(crate) stop_reason: StopReason,
}

impl<const D: usize> Relaxed<D> {
    pub(crate) fn end(self, problem: &Problem<D>, log: &mut RunLog<'_>) -> Packed<D> {
        let (forces, reason) = (&self.whole, self.stop_reason);
        log.end(
            problem,
            self.particles,
            self.frozen_lattice,
            self.surfaces,
            forces,
            reason,
        )
        .with_known_sides()
    }
}

/// The fluid, bounded by a set outside of the bodies.
fn confined_fluid<'a, const D: usize>(
    problem: &'a Problem<D>,
    mut fluid: Particles<D>,
    solids: &[Confined<'_, D>],
    interface: Interface,
) -> Confined<'a, D> {
    let confinement = match interface {
        Interface::Confinement => {
            let bodies: Vec<&dyn Surface<D>> = (problem.bodies.iter())
                .map(|body| body.surface.as_ref())
                .collect();
            let (domain, h) = (&problem.domain, problem.smoothing_length());
            let all = Confinement::outside(&bodies, domain, problem.kernel, h, problem.spacing());
            // What surface particles have on this side of a surface that they sit on.
            for solid in solids {
                let (particles, kind) = (&solid.particles, &solid.particles.kind);
                for i in (0..particles.len()).filter(|&i| kind[i] == Kind::Boundary) {
                    let beyond = solid.volume[i] - particles.volume[i];
                    if beyond > 0.0 {
                        fluid.push(particles.position[i], Kind::Frozen, beyond, None);
                    }
                }
            }
            Some(all)
        }
        Interface::Particles => {
            for solid in solids {
                for (&place, &volume) in solid.particles.position.iter().zip(&solid.volume) {
                    fluid.push(place, Kind::Frozen, volume, None);
                }
            }
            None
        }
    };
    let forces = Forces::of(problem, Repulsion::none());
    let bound: Bound<'a, D> = Box::new(move |p, _| fluid_bound(problem, interface, p));
    Confined::new(fluid, 1.0, forces, confinement, bound)
}

/// The nearest place of the set that bounds the fluid, its normal out of the fluid, its distance negative within.
fn fluid_bound<const D: usize>(
    problem: &Problem<D>,
    interface: Interface,
    p: [f64; D],
) -> Closest<D> {
    let wrapped = problem.domain.wrap(p);
    let back = point::sub(p, wrapped);
    let bounds = (problem.bodies.iter()).map(|body| {
        let floor = problem.spacing()
            * match interface {
                Interface::Confinement => (1.0 - body.inset_over_spacing).max(0.0),
                Interface::Particles => 1.0 - body.inner_share(),
            };
        let bound = around_body(wrapped, body.surface.closest(wrapped), floor);
        Closest {
            point: point::add(back, bound.point),
            ..bound
        }
    });
    tightest(p, bounds)
}

/// All particles, the bodies' first, and which of them their surface holds. `own` is how many of the fluid's
/// particles are not the solids' as it sees them.
fn together<const D: usize>(
    solids: &[Confined<'_, D>],
    fluid: &Confined<'_, D>,
    own: usize,
) -> (Particles<D>, Vec<usize>) {
    let mut all = Particles::new(fluid.particles.sizes.clone());
    let mut on_surface = Vec::new();
    for (one, count) in
        (solids.iter().map(|solid| (solid, solid.particles.len()))).chain([(fluid, own)])
    {
        for i in 0..count {
            let (p, kind) = (one.particles.position[i], one.particles.kind[i]);
            let body = one.particles.body[i];
            if one.is_bounded[i] && body.is_some() {
                on_surface.push(all.len());
            }
            all.push(p, kind, one.volume[i], body);
        }
    }
    (all, on_surface)
}
