//! Circles and spheres.

use std::f64::consts::TAU;
use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, InsetError, Moments, ParameterError};

/// A circle (`D` = 2) or sphere (`D` = 3). Every query is O(1).
///
/// ```
/// use sphpack_geometry::{Ball, Surface};
/// let cylinder = Ball::new([0.0, 0.0], 1.0)?;
/// assert_eq!(cylinder.closest([0.0, 0.5]).distance, -0.5);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ball<const D: usize> {
    center: [f64; D],
    radius: f64,
}

impl<const D: usize> Ball<D> {
    /// The ball of `radius` around `center`, scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless the centre is finite and the radius positive.
    pub fn new(center: [f64; D], radius: f64) -> Result<Self, GeometryError> {
        ParameterError::check_finite("ball", "center", center)?;
        ParameterError::check_positive("ball", "radius", radius)?;
        Ok(Self { center, radius })
    }

    /// Centre, scene units.
    pub fn center(&self) -> [f64; D] {
        self.center
    }

    /// Radius, scene units.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Content of the unit ball in `D` dimensions: 2, π, 4π/3, …
    fn unit_content() -> f64 {
        let (mut content, mut d) = if D.is_multiple_of(2) {
            (1.0, 0)
        } else {
            (2.0, 1)
        };
        while d < D {
            d += 2;
            content *= TAU / d as f64;
        }
        content
    }
}

impl<const D: usize> Surface<D> for Ball<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        let away = point::sub(p, self.center);
        // At the centre every direction is as good.
        let normal = point::unit(away).unwrap_or_else(|| {
            let mut x = [0.0; D];
            x[0] = 1.0;
            x
        });
        Closest {
            point: point::add_scaled(self.center, self.radius, normal),
            normal,
            distance: point::norm(away) - self.radius,
            feature: Feature::Smooth,
        }
    }

    fn inside(&self, p: [f64; D]) -> bool {
        point::distance_squared(p, self.center) < self.radius * self.radius
    }

    fn measure(&self) -> f64 {
        D as f64 * Self::unit_content() * self.radius.powi(D as i32 - 1)
    }

    fn volume(&self) -> f64 {
        Self::unit_content() * self.radius.powi(D as i32)
    }

    fn moments(&self) -> Option<Moments<D>> {
        let along = Surface::<D>::volume(self) * self.radius * self.radius / (D as f64 + 2.0);
        Some(Moments::along_axes(self.volume(), self.center, [along; D]))
    }

    fn bounds(&self) -> Bounds<D> {
        Bounds::new(self.center, self.center).grown(self.radius)
    }

    fn features(&self) -> Features<D> {
        Features {
            corners: Vec::new(),
            edges: Vec::new(),
        }
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        if depth >= self.radius {
            return Err(InsetError::Vanished { depth }.into());
        }
        Ok(Arc::new(Self {
            center: self.center,
            radius: self.radius - depth,
        }))
    }

    /// Exact on the circle.
    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        if D != 2 {
            return crate::sample::evenly(self, count);
        }
        let at = |i: usize| {
            let (sin, cos) = (TAU * i as f64 / count as f64).sin_cos();
            let normal = point::of_slice(&[cos, sin]);
            Closest {
                point: point::add_scaled(self.center, self.radius, normal),
                normal,
                distance: 0.0,
                feature: Feature::Smooth,
            }
        };
        Ok((0..count).map(at).collect())
    }
}
