//! Which bodies have layers, and whether these can be where the bodies are.

use std::sync::Arc;

use sphpack_geometry::{Surface, WallSide, WallSpec};
use sphpack_neighbors::Domain;

use crate::Error;
use crate::scene::{Role, Scene};

/// A body that is to be a wall.
#[derive(Debug, Clone)]
pub(crate) struct Layered<const D: usize> {
    /// Its index.
    pub(crate) body: usize,
    /// Its true surface, without images across periodic sides.
    pub(crate) surface: Arc<dyn Surface<D>>,
    /// What is asked for.
    pub(crate) spec: WallSpec,
}

/// How far a body may pass a side of the box, in ∆s, and be in it.
const SLACK: f64 = 1e-6;

/// The bodies with layers, of a scene whose bodies have these surfaces.
///
/// # Errors
/// [`Error::Scene`] where a body, or the wall around it, passes a side of the box that it cannot pass.
pub(crate) fn asked<const D: usize>(
    scene: &Scene,
    domain: &Domain<D>,
    surfaces: &[Arc<dyn Surface<D>>],
) -> Result<Vec<Layered<D>>, Error> {
    let mut all = Vec::new();
    for (body, (spec, surface)) in scene.body.iter().zip(surfaces).enumerate() {
        let Some(layers) = spec.layers else {
            continue;
        };
        let spacing = scene.spacing;
        let is_container = spec.role == Role::Container;
        let thickness = spacing * layers as f64;
        for axis in 0..D {
            let is_periodic = domain.periodic[axis];
            let margin = match is_container && is_periodic {
                true => thickness,
                false => -SLACK * spacing,
            };
            let bounds = surface.bounds().grown(margin);
            let passes = bounds.min[axis] < domain.bounds.min[axis]
                || bounds.max[axis] > domain.bounds.max[axis];
            if passes || surface.window().is_some() {
                let name = ["x", "y", "z"][axis.min(2)];
                let what = match is_container && is_periodic {
                    true => "the wall around it reaches",
                    false => "it reaches",
                };
                return Err(Error::Scene {
                    path: scene.path.clone(),
                    at: None,
                    message: format!(
                        "body \"{}\" has layers, and {what} to or beyond a side of the domain along {name}; layers do not go on there yet: enlarge the domain, or leave layers out",
                        spec.name
                    ),
                });
            }
        }
        all.push(Layered {
            body,
            surface: surface.clone(),
            spec: WallSpec {
                side: if is_container {
                    WallSide::Outside
                } else {
                    WallSide::Inside
                },
                spacing,
                layers,
            },
        });
    }
    Ok(all)
}

impl<const D: usize> Layered<D> {
    /// About how many particles it has.
    pub(crate) fn count(&self) -> f64 {
        let area_each = self.spec.spacing.powi(D as i32 - 1);
        self.spec.layers as f64 * self.surface.measure() / area_each
    }
}
