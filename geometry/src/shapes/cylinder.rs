//! Round rods.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use super::perpendicular;
use crate::sample::patches::{Patch, are_needed, over};
use crate::sample::scattered;
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, InsetError, Mesh, Moments, ParameterError};

/// Sides of the polyline that stands for each rim in [`Surface::features`].
const RIM_SIDES: usize = 360;

/// A circular cylinder with flat ends. Every query is O(1).
///
/// ```
/// use sphpack_geometry::{Cylinder, Feature, Surface};
///
/// let rod = Cylinder::new([0.0; 3], [0.0, 0.0, 2.0], 0.5)?;
/// assert!((rod.closest([1.0, 0.0, 1.0]).distance - 0.5).abs() < 1e-12);
/// assert_eq!(rod.closest([1.0, 0.0, 2.5]).feature, Feature::Edge);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    start: [f64; 3],
    axis: [f64; 3],
    length: f64,
    radius: f64,
}

impl Cylinder {
    /// The cylinder of `radius` around the axis from `start` to `end` (the middles of its flat ends), scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless all is finite, the ends differ and the radius is positive.
    pub fn new(start: [f64; 3], end: [f64; 3], radius: f64) -> Result<Self, GeometryError> {
        ParameterError::check_finite("cylinder", "start", start)?;
        ParameterError::check_finite("cylinder", "end", end)?;
        ParameterError::check_positive("cylinder", "radius", radius)?;
        let along = point::sub(end, start);
        let length = ParameterError::check_positive(
            "cylinder",
            "distance from start to end",
            point::norm(along),
        )?;
        Ok(Self {
            start,
            axis: point::scale(along, 1.0 / length),
            length,
            radius,
        })
    }

    /// A prism of the same volume whose sides are nowhere farther from the cylinder than about `within` (scene units), of 24 to 720
    /// sides.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `within` is positive, or what [`Mesh::new`] finds where numbers overflow.
    pub fn mesh(&self, within: f64) -> Result<Mesh, GeometryError> {
        ParameterError::check_positive("cylinder", "within", within)?;
        let sides = (PI / (2.0 * within / self.radius).sqrt()).clamp(24.0, 720.0);
        let sides = 4 * (sides / 4.0).ceil() as u32;
        let step = TAU / f64::from(sides);
        let radius = self.radius * (step / step.sin()).sqrt();
        let across = perpendicular(self.axis);
        let other = point::cross(self.axis, across);
        let mut vertices = vec![self.start, self.end()];
        let mut triangles = Vec::new();
        for k in 0..sides {
            let (sin, cos) = (step * f64::from(k)).sin_cos();
            let out = point::add_scaled(point::scale(across, radius * cos), radius * sin, other);
            vertices.extend([self.start, self.end()].map(|middle| point::add(middle, out)));
            let [a, b] = [k, (k + 1) % sides].map(|k| 2 + 2 * k);
            triangles.extend([
                [0, b, a],
                [1, a + 1, b + 1],
                [a, b, b + 1],
                [a, b + 1, a + 1],
            ]);
        }
        Mesh::new(vertices, triangles)
    }

    fn end(&self) -> [f64; 3] {
        point::add_scaled(self.start, self.length, self.axis)
    }

    /// Height along the axis, distance from it, and the direction away from it.
    fn split(&self, p: [f64; 3]) -> (f64, f64, [f64; 3]) {
        let from = point::sub(p, self.start);
        let height = point::dot(from, self.axis);
        let away = point::reject(from, self.axis);
        let direction = point::unit(away).unwrap_or_else(|| perpendicular(self.axis));
        (height, point::norm(away), direction)
    }
}

impl Surface<3> for Cylinder {
    fn closest(&self, p: [f64; 3]) -> Closest<3> {
        let (height, away, direction) = self.split(p);
        let inside = away < self.radius && 0.0 < height && height < self.length;
        let (mut h, mut r) = (height.max(0.0).min(self.length), away.min(self.radius));
        if inside {
            let (to_side, to_start, to_end) = (self.radius - away, height, self.length - height);
            if to_side <= to_start && to_side <= to_end {
                r = self.radius;
            } else if to_start <= to_end {
                h = 0.0;
            } else {
                h = self.length;
            }
        }
        let on_side = r == self.radius;
        let cap = if h == 0.0 {
            -1.0
        } else if h == self.length {
            1.0
        } else {
            0.0
        };
        let mut normal = point::scale(self.axis, cap);
        if on_side {
            normal = point::add(normal, direction);
        }
        let distance = (height - h).hypot(away - r);
        Closest {
            point: point::add_scaled(point::add_scaled(self.start, h, self.axis), r, direction),
            normal: point::unit(normal).unwrap_or(direction),
            distance: if inside { -distance } else { distance },
            feature: if on_side && cap != 0.0 {
                Feature::Edge
            } else {
                Feature::Smooth
            },
        }
    }

    fn inside(&self, p: [f64; 3]) -> bool {
        let (height, away, _) = self.split(p);
        away < self.radius && 0.0 < height && height < self.length
    }

    fn measure(&self) -> f64 {
        TAU * self.radius * (self.radius + self.length)
    }

    fn volume(&self) -> f64 {
        PI * self.radius * self.radius * self.length
    }

    fn moments(&self) -> Option<Moments<3>> {
        let volume = self.volume();
        let center = point::add_scaled(self.start, 0.5 * self.length, self.axis);
        let spread = [
            self.length * self.length / 12.0,
            self.radius * self.radius / 4.0,
        ];
        Some(Moments::around_axis(
            volume,
            center,
            self.axis,
            spread.map(|mean| volume * mean),
        ))
    }

    fn bounds(&self) -> Bounds<3> {
        let reach = self
            .axis
            .map(|a| self.radius * (1.0 - a * a).max(0.0).sqrt());
        let mut bounds = Bounds::EMPTY;
        for end in [self.start, self.end()] {
            bounds.include(point::sub(end, reach));
            bounds.include(point::add(end, reach));
        }
        bounds
    }

    /// Two closed edges, each a polyline of 360 sides with its vertices on the rim.
    fn features(&self) -> Features<3> {
        let u = perpendicular(self.axis);
        let v = point::cross(self.axis, u);
        let rim = |middle: [f64; 3]| -> Vec<[f64; 3]> {
            let mut points: Vec<[f64; 3]> = (0..RIM_SIDES)
                .map(|i| {
                    let (sin, cos) = (TAU * i as f64 / RIM_SIDES as f64).sin_cos();
                    let along_u = point::add_scaled(middle, self.radius * cos, u);
                    point::add_scaled(along_u, self.radius * sin, v)
                })
                .collect();
            points.push(points[0]);
            points
        };
        Features {
            corners: Vec::new(),
            edges: vec![rim(self.start), rim(self.end())],
        }
    }

    fn scatter(&self, count: usize) -> Vec<Closest<3>> {
        if !are_needed::<3>(self.length.min(2.0 * self.radius), self.measure(), count) {
            return scattered(self, count);
        }
        let u = perpendicular(self.axis);
        let v = point::cross(self.axis, u);
        let out = move |t: f64| {
            let (sin, cos) = (TAU * t).sin_cos();
            point::add_scaled(point::scale(u, cos), sin, v)
        };
        let round = TAU * self.radius;
        let side = Patch {
            sides: [self.length, round],
            least: 1.0,
            stretch: Box::new(|_| self.length * round),
            at: Box::new(|[s, t]| {
                let middle = point::add_scaled(self.start, s * self.length, self.axis);
                (point::add_scaled(middle, self.radius, out(t)), out(t))
            }),
        };
        let cap = |middle: [f64; 3], normal: [f64; 3]| Patch {
            sides: [self.radius, 0.5 * round],
            least: 1.0,
            stretch: Box::new(|_| 0.5 * self.radius * round),
            at: Box::new(move |[s, t]| {
                // Rings of equal area.
                let away = self.radius * s.sqrt();
                (point::add_scaled(middle, away, out(t)), normal)
            }),
        };
        let ends = [
            cap(self.start, point::scale(self.axis, -1.0)),
            cap(self.end(), self.axis),
        ];
        let [first, last] = ends;
        over(&[first, side, last], count)
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        if depth >= self.radius || 2.0 * depth >= self.length {
            return Err(InsetError::Vanished { depth }.into());
        }
        Ok(Arc::new(Self {
            start: point::add_scaled(self.start, depth, self.axis),
            axis: self.axis,
            length: self.length - 2.0 * depth,
            radius: self.radius - depth,
        }))
    }
}
