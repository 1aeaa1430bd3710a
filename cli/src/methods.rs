//! From a scene's method to the one that packs.

use sphpack_packing::{
    Agitated, Balanced, Band, Clipped, Coupled, Hybrid, Observer, Packed, Ppa, Problem, Standard,
    Triangulated,
};

use crate::Error;
use crate::scene::{BandWidth, Method, Role, Scene};

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
        Method::Hybrid => Hybrid {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations: packing.max_iterations,
            settling: packing.minimiser.map(|_| packing.settling()),
            ..Hybrid::default()
        }
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
        Method::Agitated => Agitated {
            max_iterations: packing.max_iterations,
            ..Agitated::default()
        }
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
        other => {
            return Err(Error::System(format!(
                "this version has no method \"{}\"",
                other.name()
            )));
        }
    };
    packed.map_err(|source| Error::Packing {
        path: scene.path.clone(),
        source,
    })
}
