//! From a scene's method to the one that packs.

use sphpack_packing::{
    Agitated, Balanced, Clipped, Complex, Coupled, Hybrid, Method as Packs, Observer, Packed,
    PackingError, Ppa, Problem, Relaxation, RunLog, Standard, Triangulated,
};

use crate::Error;
use crate::dimension::{Dimension, Space};
use crate::scene::{Method, PackingSpec, Role, Scene};

/// The scene's method, with the scene's settings.
pub(crate) fn method<const D: usize>(scene: &Scene) -> Box<dyn Packs<D>>
where
    Agitated: Packs<D>,
    Balanced: Packs<D>,
    Clipped: Packs<D>,
    Complex: Packs<D>,
    Coupled: Packs<D>,
    Hybrid: Packs<D>,
    Ppa: Packs<D>,
    Relaxation: Packs<D>,
    Standard: Packs<D>,
    Triangulated: Packs<D>,
{
    let packing = &scene.packing;
    let max_iterations = packing.max_iterations;
    match packing.method {
        // Settings of "auto" are picked when the scene is opened.
        Method::Balanced | Method::Auto => Box::new(Balanced {
            settling: packing.settling_in(D),
            band: packing.band(),
        }),
        Method::Hybrid => Box::new(packing.hybrid.apply(Hybrid {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations,
            settling: packing.minimiser.map(|_| packing.settling_in(D)),
            ..Hybrid::default()
        })),
        Method::Standard => Box::new(Standard {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations,
            ..Standard::default()
        }),
        Method::Coupled => Box::new(Coupled {
            velocity_tolerance: packing.velocity_tolerance,
            max_iterations,
            ..Coupled::default()
        }),
        Method::Agitated => Box::new(packing.agitated.apply(Agitated {
            max_iterations,
            ..Agitated::default()
        })),
        Method::Ppa => Box::new(Ppa {
            max_iterations,
            containers: (scene.body.iter())
                .map(|body| body.role == Role::Container)
                .collect(),
            ..Ppa::default()
        }),
        Method::Clipped => Box::new(Clipped),
        Method::Triangulated => Box::new(Triangulated),
        Method::Relaxation => Box::new(relaxation(packing)),
        Method::Complex => Box::new(Complex {
            relaxation: relaxation(packing),
            levelling: packing.settling_in(D).levelling,
            ..Complex::default()
        }),
    }
}

/// Packs by the scene's method.
pub(crate) fn pack<const D: usize>(
    problem: &Problem<D>,
    scene: &Scene,
    observer: &mut dyn Observer,
) -> Result<Packed<D>, Error>
where
    Space<D>: Dimension<D>,
{
    let packed = Space::<D>::method(scene).pack(problem, &mut RunLog::new(observer));
    packed.map_err(|source| failed(scene, source))
}

/// Whether the scene's method will take the problem, as far as that is known before the work.
pub(crate) fn check<const D: usize>(problem: &Problem<D>, scene: &Scene) -> Result<(), Error>
where
    Space<D>: Dimension<D>,
{
    let checked = Space::<D>::method(scene).check(problem);
    checked.map_err(|source| failed(scene, source))
}

fn failed(scene: &Scene, source: PackingError) -> Error {
    Error::Packing {
        advice: None,
        path: scene.path.clone(),
        error: Box::new(source),
    }
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
