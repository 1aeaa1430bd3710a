//! From a scene's method to the one that packs.

use sphpack_packing::{
    Agitated, Balanced, Band, Clipped, Complex, Coupled, Hybrid, Observer, Packed, Ppa, Problem,
    Relaxation, Standard, Triangulated, seeding::particle_surfaces,
};

use crate::Error;
use crate::scene::{BandWidth, Method, PackingSpec, Role, Scene};

/// Packs by the scene's method, with the scene's settings.
pub(crate) fn pack<const D: usize>(
    problem: &Problem<D>,
    scene: &Scene,
    observer: &mut dyn Observer,
) -> Result<Packed<D>, Error> {
    let packing = &scene.packing;
    let packed = match packing.method {
        Method::Balanced => Balanced {
            settling: packing.settling(),
            band: match packing.band {
                BandWidth::Auto => Band::Auto,
                BandWidth::Full => Band::Full,
            },
        }
        .pack(problem, observer),
        Method::Hybrid => (packing.hybrid)
            .apply(Hybrid {
                velocity_tolerance: packing.velocity_tolerance,
                max_iterations: packing.max_iterations,
                settling: packing.minimiser.map(|_| packing.settling()),
                ..Hybrid::default()
            })
            .pack(problem, observer),
        Method::Standard => Standard {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations: packing.max_iterations,
            ..Standard::default()
        }
        .pack(problem, observer),
        Method::Coupled => Coupled {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations: packing.max_iterations,
            ..Coupled::default()
        }
        .pack(problem, observer),
        Method::Agitated => (packing.agitated)
            .apply(Agitated {
                max_iterations: packing.max_iterations,
                ..Agitated::default()
            })
            .pack(problem, observer),
        Method::Ppa => Ppa {
            max_iterations: packing.max_iterations,
            containers: (scene.body.iter())
                .map(|body| body.role == Role::Container)
                .collect(),
            ..Ppa::default()
        }
        .pack(problem, observer),
        Method::Clipped => Clipped.pack(problem, observer),
        Method::Triangulated => Triangulated.pack(problem, observer),
        Method::Relaxation => relaxation(packing).pack(problem, observer),
        Method::Complex => Complex {
            relaxation: relaxation(packing),
            levelling: packing.settling().levelling,
            ..Complex::default()
        }
        .pack(problem, observer),
    };
    packed.map_err(|source| Error::Packing {
        path: scene.path.clone(),
        source,
    })
}

/// Whether the scene's method will take the problem, as far as that is known before the work.
pub(crate) fn check<const D: usize>(problem: &Problem<D>, scene: &Scene) -> Result<(), Error> {
    let checked = match scene.packing.method {
        Method::Balanced => Balanced::check(problem),
        // The fluid goes to the true surfaces.
        Method::Ppa => problem.check(),
        _ => particle_surfaces(problem).map(drop),
    };
    checked.map_err(|source| Error::Packing {
        path: scene.path.clone(),
        source,
    })
}

fn relaxation(packing: &PackingSpec) -> Relaxation {
    let defaults = Relaxation::default();
    Relaxation {
        residual_tolerance: packing
            .residual_tolerance
            .unwrap_or(defaults.residual_tolerance),
        max_iterations: packing.max_iterations,
        ..defaults
    }
}
