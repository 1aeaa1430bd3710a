//! Boxes along the axes.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use crate::sample::patches::{Patch, are_needed, over};
use crate::sample::scattered;
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, InsetError, Moments, ParameterError};

/// A rectangle (`D` = 2) or box (`D` = 3) along the axes; [`Placed`](crate::Placed) turns it. Every query is O(1).
///
/// ```
/// use sphpack_geometry::{Cuboid, Feature, Surface};
///
/// let plate = Cuboid::new([0.0, 0.0, 0.0], [2.0, 1.0, 0.1])?;
/// assert_eq!(plate.closest([2.5, 0.5, 0.05]).point, [2.0, 0.5, 0.05]);
/// assert_eq!(plate.closest([2.5, 1.5, 0.05]).feature, Feature::Edge);
/// assert_eq!(plate.features().corners.len(), 8);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cuboid<const D: usize> {
    bounds: Bounds<D>,
}

impl<const D: usize> Cuboid<D> {
    /// The box between the corners `min` and `max`, scene units.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless both are finite and `min` is below `max` along every axis.
    pub fn new(min: [f64; D], max: [f64; D]) -> Result<Self, GeometryError> {
        ParameterError::check_finite("box", "min", min)?;
        ParameterError::check_finite("box", "max", max)?;
        for k in 0..D {
            ParameterError::check_positive("box", "max - min", max[k] - min[k])?;
        }
        Ok(Self {
            bounds: Bounds::new(min, max),
        })
    }

    /// Corner number `bits`: bit `k` says whether it is at the upper end of axis `k`.
    fn corner(&self, bits: usize) -> [f64; D] {
        std::array::from_fn(|k| {
            if bits >> k & 1 == 1 {
                self.bounds.max[k]
            } else {
                self.bounds.min[k]
            }
        })
    }
}

impl<const D: usize> Surface<D> for Cuboid<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        let Bounds { min, max } = self.bounds;
        let mut q: [f64; D] = std::array::from_fn(|k| p[k].max(min[k]).min(max[k]));
        let inside = (0..D).all(|k| min[k] < p[k] && p[k] < max[k]);
        if inside {
            let mut best = (f64::INFINITY, 0, 0.0);
            for k in 0..D {
                for face in [min[k], max[k]] {
                    let gap = (p[k] - face).abs();
                    if gap < best.0 {
                        best = (gap, k, face);
                    }
                }
            }
            q[best.1] = best.2;
        }
        let mut normal = [0.0; D];
        let mut faces = 0;
        for k in 0..D {
            if q[k] == max[k] {
                normal[k] = 1.0;
                faces += 1;
            } else if q[k] == min[k] {
                normal[k] = -1.0;
                faces += 1;
            }
        }
        let distance = point::distance(p, q);
        Closest {
            point: q,
            normal: point::unit(normal).unwrap_or(normal),
            distance: if inside { -distance } else { distance },
            feature: if faces <= 1 {
                Feature::Smooth
            } else if faces == D {
                Feature::Corner
            } else {
                Feature::Edge
            },
        }
    }

    fn inside(&self, p: [f64; D]) -> bool {
        (0..D).all(|k| self.bounds.min[k] < p[k] && p[k] < self.bounds.max[k])
    }

    fn measure(&self) -> f64 {
        let size = self.bounds.size();
        (0..D)
            .map(|k| 2.0 * (0..D).filter(|&j| j != k).map(|j| size[j]).product::<f64>())
            .sum()
    }

    fn volume(&self) -> f64 {
        self.bounds.volume()
    }

    fn moments(&self) -> Option<Moments<D>> {
        let volume = self.volume();
        let along = self.bounds.size().map(|edge| volume * edge * edge / 12.0);
        Some(Moments::along_axes(volume, self.bounds.center(), along))
    }

    fn bounds(&self) -> Bounds<D> {
        self.bounds
    }

    fn features(&self) -> Features<D> {
        let corners = (0..1 << D).map(|bits| self.corner(bits)).collect();
        let mut edges = Vec::new();
        if D == 3 {
            for bits in 0..1 << D {
                for k in (0..D).filter(|k| bits >> k & 1 == 0) {
                    edges.push(vec![self.corner(bits), self.corner(bits | 1 << k)]);
                }
            }
        }
        Features { corners, edges }
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        let size = self.bounds.size();
        let thickness = size.iter().copied().fold(f64::INFINITY, f64::min);
        if !are_needed::<D>(thickness, self.measure(), count) {
            return scattered(self, count);
        }
        let face = |axis: usize, upper: bool| {
            let others: Vec<usize> = (0..D).filter(|&k| k != axis).collect();
            let sides: [f64; 2] = std::array::from_fn(|i| others.get(i).map_or(1.0, |&k| size[k]));
            let area = sides[0] * sides[1];
            let mut normal = [0.0; D];
            normal[axis] = if upper { 1.0 } else { -1.0 };
            let corner = self.corner(usize::from(upper) << axis);
            Patch {
                sides,
                least: 1.0,
                stretch: Box::new(move |_| area),
                at: Box::new(move |at| {
                    let mut p = corner;
                    for (&k, part) in others.iter().zip(at) {
                        p[k] += part * size[k];
                    }
                    (p, normal)
                }),
            }
        };
        let faces: Vec<Patch<'_, D>> = (0..D)
            .flat_map(|axis| [face(axis, false), face(axis, true)])
            .collect();
        over(&faces, count)
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        ParameterError::check_depth(depth)?;
        let bounds = self.bounds.grown(-depth);
        if (0..D).any(|k| bounds.min[k] >= bounds.max[k]) {
            return Err(InsetError::Vanished { depth }.into());
        }
        Ok(Arc::new(Self { bounds }))
    }
}
