//! Rings.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use super::perpendicular;
use crate::sample::patches::{Patch, are_needed, over};
use crate::sample::scattered;
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, InsetError, Moments, ParameterError};

/// Pieces around the tube at least where points are scattered: its outer side has more area than its inner one.
const LEAST_AROUND: f64 = 16.0;

/// A torus. Every query is O(1).
///
/// ```
/// use sphpack_geometry::{Surface, Torus};
///
/// let ring = Torus::new([0.0; 3], [0.0, 0.0, 1.0], 1.0, 0.25)?;
/// assert!(ring.inside([1.0, 0.0, 0.2]) && !ring.inside([0.0; 3]));
/// assert!((ring.closest([0.0; 3]).distance - 0.75).abs() < 1e-12);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    center: [f64; 3],
    axis: [f64; 3],
    major: f64,
    minor: f64,
}

impl Torus {
    /// The torus around `axis` through `center`: a tube of radius `minor` whose middle is `major` from the axis,
    /// scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless all is finite, the axis has a direction and 0 < minor < major.
    pub fn new(
        center: [f64; 3],
        axis: [f64; 3],
        major: f64,
        minor: f64,
    ) -> Result<Self, GeometryError> {
        ParameterError::check_finite("torus", "center", center)?;
        ParameterError::check_positive("torus", "length of axis", point::norm(axis))?;
        ParameterError::check_positive("torus", "major", major)?;
        ParameterError::check_positive("torus", "minor", minor)?;
        if minor >= major {
            return Err(ParameterError::OutOfRange {
                of: "torus",
                name: "minor",
                value: minor,
                needs: "smaller than major",
            }
            .into());
        }
        Ok(Self {
            center,
            axis: point::scale(axis, 1.0 / point::norm(axis)),
            major,
            minor,
        })
    }

    /// From the nearest point of the middle circle to `p`, that point, and the direction to it from the centre.
    fn off_ring(&self, p: [f64; 3]) -> ([f64; 3], [f64; 3], [f64; 3]) {
        let away = point::reject(point::sub(p, self.center), self.axis);
        let direction = point::unit(away).unwrap_or_else(|| perpendicular(self.axis));
        let ring = point::add_scaled(self.center, self.major, direction);
        (point::sub(p, ring), ring, direction)
    }
}

impl Surface<3> for Torus {
    fn closest(&self, p: [f64; 3]) -> Closest<3> {
        let (away, ring, direction) = self.off_ring(p);
        let normal = point::unit(away).unwrap_or(direction);
        Closest {
            point: point::add_scaled(ring, self.minor, normal),
            normal,
            distance: point::norm(away) - self.minor,
            feature: Feature::Smooth,
        }
    }

    fn inside(&self, p: [f64; 3]) -> bool {
        point::norm(self.off_ring(p).0) < self.minor
    }

    fn measure(&self) -> f64 {
        4.0 * PI * PI * self.major * self.minor
    }

    fn volume(&self) -> f64 {
        2.0 * PI * PI * self.major * self.minor * self.minor
    }

    fn moments(&self) -> Option<Moments<3>> {
        let volume = self.volume();
        let [major, minor] = [self.major, self.minor].map(|radius| radius * radius);
        let spread = [minor / 4.0, major / 2.0 + 3.0 * minor / 8.0];
        Some(Moments::around_axis(
            volume,
            self.center,
            self.axis,
            spread.map(|mean| volume * mean),
        ))
    }

    fn bounds(&self) -> Bounds<3> {
        let reach = self
            .axis
            .map(|a| self.major * (1.0 - a * a).max(0.0).sqrt() + self.minor);
        Bounds::new(
            point::sub(self.center, reach),
            point::add(self.center, reach),
        )
    }

    fn features(&self) -> Features<3> {
        Features::default()
    }

    fn scatter(&self, count: usize) -> Vec<Closest<3>> {
        if !are_needed::<3>(2.0 * self.minor, self.measure(), count) {
            return scattered(self, count);
        }
        let u = perpendicular(self.axis);
        let v = point::cross(self.axis, u);
        let (around, tube) = (TAU * self.major, TAU * self.minor);
        let patch = Patch {
            sides: [around, tube],
            least: LEAST_AROUND,
            stretch: Box::new(|[_, t]| tube * (around + tube * (TAU * t).cos())),
            at: Box::new(|[s, t]| {
                let (sin, cos) = (TAU * s).sin_cos();
                let out = point::add_scaled(point::scale(u, cos), sin, v);
                let (sin, cos) = (TAU * t).sin_cos();
                let normal = point::add_scaled(point::scale(out, cos), sin, self.axis);
                let middle = point::add_scaled(self.center, self.major, out);
                (point::add_scaled(middle, self.minor, normal), normal)
            }),
        };
        over(&[patch], count)
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        if depth >= self.minor {
            return Err(InsetError::Vanished { depth }.into());
        }
        Ok(Arc::new(Self {
            minor: self.minor - depth,
            ..*self
        }))
    }
}
