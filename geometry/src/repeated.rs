//! A surface and its images across the periodic sides of a box.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, Domain, Odometer, point};

use crate::surface::{Closest, Features, Surface};
use crate::{GeometryError, Moments};

/// A surface in a box with periodic axes: whoever asks what is near, or inside, sees the images too.
///
/// Size and points (measure, volume, corners, samples) are those of the surface itself, once, points carried into the
/// box; its own box is, on an axis whose side it passes, the whole period. No two images have room in common, so the surface is
/// shorter than the periods ([`Continued`](crate::Continued) is for what meets its image); a place may lie anywhere.
/// Cost of a query: one of the surface, and one more for every image whose box is nearer than what was found, seldom any.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ball, Repeated, Surface};
/// use sphpack_neighbors::Domain;
/// let channel = Domain::new([0.0, 0.0], [4.0, 2.0]).with_periodic([true, false]);
/// let disc = Repeated::new(Arc::new(Ball::new([0.6, 1.0], 0.5)?), &channel);
/// // Across the seam.
/// assert!((disc.closest([3.9, 1.0]).distance - 0.2).abs() < 1e-15);
/// assert!(disc.inside([4.6, 1.0]) && !disc.inside([0.6, 3.0]));
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Repeated<const D: usize> {
    surface: Arc<dyn Surface<D>>,
    domain: Domain<D>,
    bounds: Bounds<D>,
    /// From the surface to its image in the box, mostly none, and to those around, which may be nearest to places of the box.
    shifts: Vec<[f64; D]>,
}

impl<const D: usize> Repeated<D> {
    /// `surface` and its images across the periodic sides of `domain`.
    #[must_use]
    pub fn new(surface: Arc<dyn Surface<D>>, domain: &Domain<D>) -> Self {
        let size = domain.bounds.size();
        let steps = domain.periodic.map(i64::from);
        let own = domain.whole_periods(surface.bounds().center());
        let mut shifts = vec![own];
        let around = Odometer::new(steps.map(|n| -n), steps.map(|n| n + 1));
        shifts.extend(
            (around.filter(|step| *step != [0; D]))
                .map(|step| std::array::from_fn(|k| own[k] + step[k] as f64 * size[k])),
        );
        let (mut bounds, sides) = (surface.bounds(), domain.bounds);
        for k in (0..D).filter(|&k| domain.periodic[k]) {
            if bounds.min[k] < sides.min[k] || bounds.max[k] > sides.max[k] {
                (bounds.min[k], bounds.max[k]) = (sides.min[k], sides.max[k]);
            }
        }
        Self {
            bounds,
            surface,
            domain: *domain,
            shifts,
        }
    }

    /// Points of the surface, carried into the box.
    fn wrapped(&self, mut hits: Vec<Closest<D>>) -> Vec<Closest<D>> {
        for hit in &mut hits {
            hit.point = self.domain.wrap(hit.point);
        }
        hits
    }

    /// The nearest of the surface and its images within `radius`; the least signed distance, so that who is inside one is inside.
    fn nearest(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        let wrapped = self.domain.wrap(p);
        let back = point::sub(p, wrapped);
        let mut best: Option<Closest<D>> = None;
        for (number, &shift) in self.shifts.iter().enumerate() {
            let seen = point::sub(wrapped, shift);
            let reach = best.map_or(radius, |hit| hit.distance.min(radius));
            let is_far = || self.surface.bounds().distance_squared(seen) > reach * reach;
            if reach < 0.0 || number > 0 && is_far() {
                continue;
            }
            if let Some(hit) = self.surface.closest_within(seen, reach)
                && best.is_none_or(|least| hit.distance < least.distance)
            {
                best = Some(Closest {
                    point: point::add(hit.point, shift),
                    ..hit
                });
            }
        }
        best.map(|hit| Closest {
            point: point::add(hit.point, back),
            ..hit
        })
    }
}

impl<const D: usize> Surface<D> for Repeated<D> {
    fn closest(&self, p: [f64; D]) -> Closest<D> {
        self.nearest(p, f64::INFINITY)
            .unwrap_or_else(|| self.surface.closest(p))
    }

    fn closest_within(&self, p: [f64; D], radius: f64) -> Option<Closest<D>> {
        self.nearest(p, radius)
    }

    fn inside(&self, p: [f64; D]) -> bool {
        let wrapped = self.domain.wrap(p);
        (self.shifts.iter())
            .map(|&shift| point::sub(wrapped, shift))
            .any(|p| self.surface.bounds().contains(p) && self.surface.inside(p))
    }

    fn measure(&self) -> f64 {
        self.surface.measure()
    }

    fn volume(&self) -> f64 {
        self.surface.volume()
    }

    fn moments(&self) -> Option<Moments<D>> {
        self.surface.moments()
    }

    fn bounds(&self) -> Bounds<D> {
        self.bounds
    }

    fn features(&self) -> Features<D> {
        let mut features = self.surface.features();
        for corner in &mut features.corners {
            *corner = self.domain.wrap(*corner);
        }
        features
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<D>>> {
        (self.surface.parts().into_iter())
            .map(|part| Arc::new(Self::new(part, &self.domain)) as Arc<dyn Surface<D>>)
            .collect()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<D>>, GeometryError> {
        Ok(Arc::new(Self::new(
            self.surface.inset(depth)?,
            &self.domain,
        )))
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<D>>, GeometryError> {
        Ok(self.wrapped(self.surface.sample(count)?))
    }

    fn scatter(&self, count: usize) -> Vec<Closest<D>> {
        self.wrapped(self.surface.scatter(count))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{Ball, Cuboid};

    /// Against all images, one by one: of a body that touches its own image too.
    fn check<const D: usize>(
        body: impl Surface<D> + Clone + 'static,
        domain: &Domain<D>,
        p: [f64; D],
    ) {
        let repeated = Repeated::new(Arc::new(body.clone()), domain);
        let hit = repeated.closest(p);
        let size = domain.bounds.size();
        let mut least = f64::INFINITY;
        for number in 0..7_usize.pow(D as u32) {
            let seen: [f64; D] = std::array::from_fn(|k| {
                let step = (number / 7_usize.pow(k as u32) % 7) as f64 - 3.0;
                p[k] - if domain.periodic[k] {
                    step * size[k]
                } else {
                    0.0
                }
            });
            least = least.min(body.closest(seen).distance);
        }
        assert!(
            (hit.distance - least).abs() < 1e-12,
            "{p:?}: {} {least}",
            hit.distance
        );
        assert!((point::distance(hit.point, p) - hit.distance.abs()).abs() < 1e-12);
        if hit.distance.abs() > 1e-9 {
            assert_eq!(repeated.inside(p), hit.distance < 0.0);
            assert_eq!(
                repeated.closest_within(p, hit.distance.abs() * 1.001),
                Some(hit)
            );
            assert_eq!(repeated.closest_within(p, hit.distance.abs() * 0.999), None);
        }
    }

    proptest! {
        #[test]
        fn the_nearest_image_answers(
            x in prop::array::uniform3(-6.0..9.0_f64), c in prop::array::uniform3(0.5..2.5_f64),
            periodic in prop::array::uniform3(any::<bool>()), whole in any::<bool>(),
        ) {
            let domain = Domain::new([0.0; 3], [3.0; 3]).with_periodic(periodic);
            check(Ball::new(c, 0.5).unwrap(), &domain, x);
            let end = if whole { 3.0 } else { 1.7 };
            check(Cuboid::new([0.0, 1.0, 0.5], [end, 2.0, 2.9]).unwrap(), &domain, x);
            let plane = Domain::new([0.0; 2], [3.0; 2]).with_periodic([periodic[0], periodic[1]]);
            check(Ball::new([c[0], c[1]], 0.5).unwrap(), &plane, [x[0], x[1]]);
        }
    }
}
