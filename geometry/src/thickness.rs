//! How thick a body is where one stands on its surface.

use sphpack_neighbors::point;

use crate::surface::{Closest, Feature, Surface};

/// Sides whose outward normals have a cosine below this face away from each other: a wedge between them is sharper
/// than 60°.
const OPPOSED: f64 = -0.5;

/// A ball fits where its centre is deeper than this part of its radius.
const FITS: f64 = 0.999;

/// A ball smaller than this part of the limit stands on an edge, or as good as.
const NOTHING: f64 = 1e-3;

/// Most times a ball is shrunk; three to five suffice.
const MAX_SHRINKS: usize = 40;

/// How far inside, in parts of the limit, one looks from a corner or an edge.
const BESIDE: f64 = 0.25;

/// The largest ball in a body that touches its surface at one place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touching<const D: usize> {
    pub(crate) radius: f64,
    /// Outward direction at which it touches the surface elsewhere; `None` where its radius is the limit.
    pub(crate) elsewhere: Option<[f64; D]>,
}

impl<const D: usize> Touching<D> {
    /// The ball of radius `limit` at most that touches at `foot`, its centre along `inward`, found by shrinking one
    /// until nothing else is in it (Ma, Bae, Choi: "3D medial axis point approximation using nearest neighbors and
    /// the normal field", The Visual Computer 28, 2012). One query where the limit fits, else some four.
    pub(crate) fn at(
        surface: &dyn Surface<D>,
        foot: [f64; D],
        inward: [f64; D],
        limit: f64,
    ) -> Self {
        let mut ball = Self {
            radius: limit,
            elsewhere: None,
        };
        for _ in 0..MAX_SHRINKS {
            let center = point::add_scaled(foot, ball.radius, inward);
            let hit = surface.closest(center);
            if -hit.distance >= FITS * ball.radius {
                break;
            }
            // The ball through the foot and the point found in it.
            let way = point::sub(hit.point, foot);
            let along = point::dot(way, inward);
            let radius = 0.5 * point::norm_squared(way) / along;
            if !(along > 0.0 && radius < ball.radius) {
                break;
            }
            if radius < NOTHING * limit {
                return Self {
                    radius: 0.0,
                    elsewhere: Some(point::scale(inward, -1.0)),
                };
            }
            let center = point::add_scaled(foot, radius, inward);
            ball = Self {
                radius,
                elsewhere: point::unit(point::sub(hit.point, center)),
            };
        }
        ball
    }

    /// Whether what stops the ball faces away from where it stands.
    pub(crate) fn is_between_sides(&self, inward: [f64; D]) -> bool {
        self.elsewhere
            .is_some_and(|normal| point::dot(normal, inward) > -OPPOSED)
    }
}

/// How thick the body is at the point `at` of its surface, at most `limit` (scene units): the diameter of the largest
/// ball in it that touches there.
///
/// What stops the ball counts only where it faces away from `at`, the two outward normals more than 120° apart: the
/// sides of a plate, of a fin, of a wedge sharper than 60°. Beside a blunter corner or edge, a facet or a bump of a
/// scan the ball is stopped by the neighbouring face, and the body is not thin for that: there the straight way in,
/// up to the opposite side, is its thickness instead. A corner or an edge is as thick as the body beside it, a quarter
/// of the limit inside. A thickness is right within 0.2 %; one query where the limit is reached, else about five.
///
/// ```
/// use sphpack_geometry::{Cuboid, Surface, thickness};
/// let plate = Cuboid::new([0.0; 2], [20.0, 0.5])?;
/// assert!((thickness(&plate, &plate.closest([7.0, 1.0]), 2.0) - 0.5).abs() < 1e-12);
/// assert!((thickness(&plate, &plate.closest([0.1, 1.0]), 2.0) - 0.5).abs() < 1e-12);
/// assert_eq!(thickness(&plate, &plate.closest([-1.0, 0.2]), 2.0), 2.0);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
pub fn thickness<const D: usize>(surface: &dyn Surface<D>, at: &Closest<D>, limit: f64) -> f64 {
    if at.feature == Feature::Smooth {
        return through(surface, at.point, point::scale(at.normal, -1.0), limit);
    }
    let beside = point::add_scaled(at.point, -BESIDE * limit, at.normal);
    let hit = surface.closest(beside);
    match point::unit(point::sub(beside, hit.point)) {
        Some(inward) if hit.distance < 0.0 => through(surface, hit.point, inward, limit),
        // Thinner than one looks: the straight way.
        _ => point::distance(at.point, hit.point).min(limit),
    }
}

/// [`thickness`] at `foot`, where the normal is −`inward`.
pub(crate) fn through<const D: usize>(
    surface: &dyn Surface<D>,
    foot: [f64; D],
    inward: [f64; D],
    limit: f64,
) -> f64 {
    let ball = Touching::at(surface, foot, inward, 0.5 * limit);
    if ball.elsewhere.is_none() {
        return limit;
    }
    if ball.is_between_sides(inward) {
        return 2.0 * ball.radius;
    }
    let beyond = surface.closest(point::add_scaled(foot, limit, inward));
    if beyond.distance > 0.0 && point::dot(beyond.normal, inward) > -OPPOSED {
        (limit - beyond.distance).max(0.0)
    } else {
        limit
    }
}
