//! A surface scaled, turned and moved.

use std::sync::Arc;

use sphpack_neighbors::Bounds;

use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, InsetError, Moments, ParameterError, Similarity};

/// Any surface under a [`Similarity`]: queries are carried back, answers forward. Outlines and meshes need it not:
/// they transform their vertices.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Cuboid, Placed, Similarity, Surface};
/// let square = Arc::new(Cuboid::new([-1.0, -1.0], [1.0, 1.0])?);
/// let tilted = Placed::new(square, Similarity::<2>::new(1.0, 17.0, [0.0, 0.0])?);
/// assert!((tilted.measure() - 8.0).abs() < 1e-12);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Placed<const D: usize> {
    surface: Arc<dyn Surface<D>>,
    place: Similarity<D>,
}

impl<const D: usize> Placed<D> {
    /// `surface` carried along by `place`.
    #[must_use]
    pub fn new(surface: Arc<dyn Surface<D>>, place: Similarity<D>) -> Self {
        Self { surface, place }
    }

    fn forward(&self, hit: Closest<D>) -> Closest<D> {
        Closest {
            point: self.place.point(hit.point),
            normal: self.place.direction(hit.normal),
            distance: hit.distance * self.place.scale(),
            feature: hit.feature,
        }
    }
}

impl<const D: usize> Surface<D> for Placed<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.forward(self.surface.closest(self.place.point_back(p)))
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        self.surface
            .closest_within(self.place.point_back(p), radius / self.place.scale())
            .map(|hit| self.forward(hit))
    }

    fn inside(&self, p: [f64; D]) -> bool {
        self.surface.inside(self.place.point_back(p))
    }

    fn measure(&self) -> f64 {
        self.surface.measure() * self.place.scale().powi(D as i32 - 1)
    }

    fn volume(&self) -> f64 {
        self.surface.volume() * self.place.scale().powi(D as i32)
    }

    fn moments(&self) -> Option<Moments<D>> {
        Some(self.surface.moments()?.placed(&self.place))
    }

    /// The box around the carried box: not always the smallest where it is turned.
    fn bounds(&self) -> Bounds<D> {
        let b = self.surface.bounds();
        let mut around = Bounds::EMPTY;
        for bits in 0..1_usize << D {
            let corner = std::array::from_fn(|k| {
                if bits >> k & 1 == 1 {
                    b.max[k]
                } else {
                    b.min[k]
                }
            });
            around.include(self.place.point(corner));
        }
        around
    }

    fn features(&self) -> Features<D> {
        let there = |points: Vec<[f64; D]>| -> Vec<[f64; D]> {
            points.into_iter().map(|p| self.place.point(p)).collect()
        };
        let features = self.surface.features();
        Features {
            corners: there(features.corners),
            edges: features.edges.into_iter().map(there).collect(),
        }
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<D>>> {
        (self.surface.parts().into_iter())
            .map(|part| Arc::new(Self::new(part, self.place)) as Arc<dyn Surface<D>>)
            .collect()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        let inner = self
            .surface
            .inset(depth / self.place.scale())
            .map_err(|e| match e {
                GeometryError::Inset(InsetError::Vanished { .. }) => {
                    InsetError::Vanished { depth }.into()
                }
                other => other,
            })?;
        Ok(Arc::new(Self::new(inner, self.place)))
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        let hits = self.surface.sample(count)?;
        Ok(hits.into_iter().map(|hit| self.forward(hit)).collect())
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        let hits = self.surface.scatter(count);
        hits.into_iter().map(|hit| self.forward(hit)).collect()
    }
}
