//! Every body's particle surface, and the points that are spread over it.

use std::sync::Arc;

use sphpack_geometry::{
    Closest, Feature, GeometryError, InsetError, Surface, SurfaceSamples, sample_thin,
};

use crate::packed::ParticleSurface;
use crate::problem::{Body, DEFAULT_INSET_OVER_SPACING, PackingError};

/// Whether a body is packed without a particle surface where it is too thin for one. A deeper surface than usual is asked
/// for as it is.
pub(super) fn is_usual<const D: usize>(body: &Body<D>) -> bool {
    body.inset_over_spacing <= DEFAULT_INSET_OVER_SPACING
}

/// A body's particle surface for particles of a spacing, `None` where it is so thin that it has none; the surface itself where that
/// is asked for.
pub(super) fn inset<const D: usize>(
    body: &Body<D>,
    spacing: f64,
) -> Result<Option<Arc<dyn Surface<D>>>, PackingError> {
    let depth = body.inset_over_spacing * spacing;
    if depth == 0.0 {
        return Ok(Some(body.surface.clone()));
    }
    match body.surface.inset(depth) {
        Ok(inset) => Ok(Some(inset)),
        Err(GeometryError::Inset(InsetError::Vanished { .. })) => Ok(None),
        Err(source) => Err(PackingError::Surface {
            body: body.name.clone(),
            error: source,
        }),
    }
}

/// Particle surfaces with their points.
#[derive(Debug)]
pub(super) struct Sampled<const D: usize> {
    /// Every body's particle surface.
    pub(super) surfaces: Vec<ParticleSurface<D>>,
    /// The points on it, and behind them those in the middle of what is too thin to have one.
    pub(super) samples: Vec<Vec<Closest<D>>>,
    /// The volume that these stand for beyond the body's.
    pub(super) excess: Vec<f64>,
}

/// Every particle surface with its points, for particles of a spacing for each, and the volume that these stand for beyond the body's. Points in the middle of parts that are too thin to have a surface count as
/// corners: they stay where they are.
pub(super) fn sample<const D: usize>(
    bodies: &[Body<D>],
    spacings: &[f64],
) -> Result<Sampled<D>, PackingError> {
    let mut surfaces = Vec::new();
    let mut samples = Vec::new();
    let mut excess = Vec::new();
    for (body, &spacing) in bodies.iter().zip(spacings) {
        let fail = |source| PackingError::Surface {
            body: body.name.clone(),
            error: source,
        };
        let depth = body.inset_over_spacing * spacing;
        let is_usual = is_usual(body);
        let inset = inset(body, spacing)?;
        let found = match &inset {
            // A body that fills the box has no surface in it.
            Some(surface) if !is_usual && surface.measure() <= 0.0 => Ok(SurfaceSamples::default()),
            Some(surface) if !is_usual => {
                let count = surface.measure() / spacing.powi(D as i32 - 1);
                surface
                    .sample(count.round().max(1.0) as usize)
                    .map(|on_surface| SurfaceSamples {
                        on_surface,
                        ..SurfaceSamples::default()
                    })
            }
            _ => sample_thin(
                body.surface.as_ref(),
                inset.as_deref(),
                spacing,
                depth,
                body.thin,
            ),
        }
        .map_err(fail)?;
        let mut points = found.on_surface;
        points.extend(found.medial.into_iter().map(|point| Closest {
            feature: Feature::Corner,
            point,
            ..body.surface.closest(point)
        }));
        surfaces.push(ParticleSurface {
            surface: inset.unwrap_or_else(|| body.surface.clone()),
            target_count: points.len(),
        });
        samples.push(points);
        excess.push(found.excess);
    }
    Ok(Sampled {
        surfaces,
        samples,
        excess,
    })
}
