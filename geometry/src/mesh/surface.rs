//! [`Surface`] for meshes.

use std::sync::Arc;

use sphpack_neighbors::{Bounds, point};

use super::triangle::{self, Meeting, Part};
use super::{Mesh, inset};
use crate::surface::{Closest, Feature, Features, Surface};
use crate::{GeometryError, Moments};

/// Directions of the rays of [`Surface::inside`]: +x, then others that no regular mesh is aligned with.
const RAYS: [[f64; 3]; 4] = [
    [1.0, 0.0, 0.0],
    [0.577_215_66, 0.302_775_63, 0.414_213_56],
    [-0.365_123_1, 0.618_033_99, -0.732_050_81],
    [0.141_592_65, -0.718_281_83, -0.236_067_98],
];

impl Mesh {
    /// What triangle `i` answers to `p`, to which it is the nearest.
    fn answer(&self, i: usize, p: [f64; 3]) -> Closest<3> {
        let corners = &self.corners[i];
        let (weights, part) = triangle::nearest(corners, p);
        let q = triangle::place(corners, weights);
        let (pseudonormal, feature) = match part {
            Part::Face => (self.normals.face[i], Feature::Smooth),
            Part::Side(k) => {
                let sharp = self.normals.sharp[i] >> k & 1 == 1;
                let feature = if sharp {
                    Feature::Edge
                } else {
                    Feature::Smooth
                };
                (self.normals.side[i][k], feature)
            }
            Part::Corner(k) => {
                let v = self.triangles[i][k] as usize;
                let feature = if self.normals.is_corner[v] {
                    Feature::Corner
                } else if self.normals.on_edge[v] {
                    Feature::Edge
                } else {
                    Feature::Smooth
                };
                (self.normals.vertex[v], feature)
            }
        };
        let away = point::sub(p, q);
        let distance = point::norm(away);
        let outside = point::dot(away, pseudonormal) >= 0.0;
        let normal = if feature == Feature::Smooth {
            let n = &self.normals.corner[i];
            point::unit(triangle::place(n, weights)).unwrap_or(pseudonormal)
        } else {
            pseudonormal
        };
        Closest {
            point: q,
            normal,
            distance: if outside { distance } else { -distance },
            feature,
        }
    }

    /// Crossings of the ray, or `None` where one is too near an edge to tell.
    fn crossings(&self, p: [f64; 3], direction: [f64; 3]) -> Option<usize> {
        let mut count = Some(0);
        self.bvh.along_ray(p, direction, |i| {
            if let Some(n) = count {
                count = match triangle::meet(&self.corners[i], p, direction) {
                    Meeting::Miss => Some(n),
                    Meeting::Hit => Some(n + 1),
                    Meeting::Unclear => None,
                };
            }
        });
        count
    }
}

impl Surface<3> for Mesh {
    fn closest(&self, p: [f64; 3]) -> Closest<3> {
        self.closest_within(p, f64::INFINITY)
            .unwrap_or_else(|| Closest {
                // Only for a `p` that is not a number.
                point: self.corners[0][0],
                normal: self.normals.face[0],
                distance: f64::NAN,
                feature: Feature::Smooth,
            })
    }

    fn closest_within(&self, p: [f64; 3], radius: f64) -> Option<Closest<3>> {
        if radius < 0.0 {
            return None;
        }
        self.bvh
            .nearest(p, radius * radius, |i| {
                let corners = &self.corners[i];
                let (weights, _) = triangle::nearest(corners, p);
                point::distance_squared(p, triangle::place(corners, weights))
            })
            .map(|found| self.answer(found.index, p))
    }

    /// Ray shooting: inside where a ray crosses the surface an odd number of times. A ray that
    /// passes too near an edge is replaced by one in another direction; after four the closest point decides.
    fn inside(&self, p: [f64; 3]) -> bool {
        if !self.bounds().contains(p) {
            return false;
        }
        RAYS.iter()
            .find_map(|&ray| self.crossings(p, ray))
            .map_or_else(|| self.closest(p).distance < 0.0, |n| n % 2 == 1)
    }

    fn measure(&self) -> f64 {
        self.area
    }

    fn volume(&self) -> f64 {
        self.volume
    }

    fn moments(&self) -> Option<Moments<3>> {
        let triangles = self.triangles.iter();
        let corners = triangles.map(|t| t.map(|v| self.vertices[v as usize]));
        Moments::of_sides(self.bounds().center(), corners, |&[a, b, c]| {
            point::dot(a, point::cross(b, c)) / 6.0
        })
    }

    fn bounds(&self) -> Bounds<3> {
        self.bvh.bounds()
    }

    fn features(&self) -> Features<3> {
        self.features.get_or_init(|| self.find_features()).clone()
    }

    fn parts(&self) -> Vec<Arc<dyn Surface<3>>> {
        let pieces = || self.pieces().into_iter().map(Arc::new).collect();
        (self.parts.get_or_init(pieces).iter())
            .map(|part| Arc::clone(part) as Arc<dyn Surface<3>>)
            .collect()
    }

    fn inset(&self, depth: f64) -> Result<Arc<dyn Surface<3>>, GeometryError> {
        inset::inset(self, depth)
    }

    fn sample(&self, count: usize) -> Result<Vec<Closest<3>>, GeometryError> {
        let scatter = |_, wanted| self.scattered(wanted);
        crate::sample::spread(self, count, &|p| self.closest(p), scatter)
    }

    fn scatter(&self, count: usize) -> Vec<Closest<3>> {
        self.scattered(count).hits()
    }
}
