//! Spacings that grow with the distance from bodies.

use std::sync::Arc;

use sphpack_geometry::Surface;
use sphpack_neighbors::{Bounds, Domain, KdTree, point};

use crate::curvature::{self, Curved};
use crate::resolution::{Resolution, Spacing, SpacingField};

/// A field of spacings: each source has its own, at a body's surface or throughout a region, and the field grows from there with
/// the distance d as s + (growth − 1) d, up to the coarsest; the least of all sources counts. Both ends of that ramp are
/// rounded, so that the field has no kink at a surface nor where it becomes the coarsest; where two sources are equally
/// fine it has one.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::Ball;
/// use sphpack_packing::{Refinement, Resolution};
///
/// let ball = Arc::new(Ball::new([0.0; 2], 1.0)?);
/// let field = Resolution::from(Refinement::new(0.2, 1.08).around(ball, 0.02));
/// assert_eq!(field.at([1.0, 0.0]).value, 0.02);
/// assert_eq!(field.at([9.0, 0.0]).value, 0.2);
/// let middle = field.at([2.0, 0.0]);
/// assert!((middle.value - 0.0954).abs() < 1e-4 && (middle.gradient[0] - 0.0799).abs() < 1e-4);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Refinement<const D: usize> {
    coarsest: f64,
    growth: f64,
    sources: Vec<Source<D>>,
    /// The spacing around every body that is put beside it.
    around_all: Option<f64>,
}

/// Spacings that grow away from all bodies of a problem alike: what [`Problem`](crate::Problem) takes for its resolution where there is
/// no more to say.
///
/// ```
/// use sphpack_geometry::Outline;
/// use sphpack_packing::{Balanced, Graded, Problem};
///
/// let wing = Outline::naca("0015", 1.0)?;
/// let graded = Graded { finest: 0.02, coarsest: 0.1, growth: 1.1 };
/// let packed = Problem::around(&wing, graded).pack(&Balanced::default())?;
/// let quality = packed.quality();
/// assert!(quality.density.linf < 0.002 && quality.closest_pair_over_spacing > 0.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Graded {
    /// At the surfaces of the bodies, scene units.
    pub finest: f64,
    /// Far away, scene units.
    pub coarsest: f64,
    /// The ratio of neighbouring particles' spacings, at most.
    pub growth: f64,
}

impl<const D: usize> From<Graded> for Resolution<D> {
    fn from(graded: Graded) -> Self {
        Refinement {
            around_all: Some(graded.finest),
            ..Refinement::new(graded.coarsest, graded.growth)
        }
        .into()
    }
}

/// Something fine.
#[derive(Debug, Clone)]
struct Source<const D: usize> {
    place: Place<D>,
    ramp: Ramp,
}

/// How spacings grow from a source.
#[derive(Debug, Clone, Copy)]
struct Ramp {
    /// At the source, scene units.
    spacing: f64,
    /// Half axis of the hyperbola, scene units.
    half: f64,
    /// ∣∇s∣ far away.
    slope: f64,
}

impl Ramp {
    /// The value at a distance, and its slope.
    fn at(&self, distance: f64) -> [f64; 2] {
        let along = distance.hypot(self.half);
        [
            self.spacing + self.slope * (along - self.half),
            self.slope * distance / along,
        ]
    }

    /// The distance at which it has come to `value`.
    fn distance_of(&self, value: f64) -> f64 {
        let along = self.half + (value - self.spacing).max(0.0) / self.slope;
        (along * along - self.half * self.half).max(0.0).sqrt()
    }
}

/// Where something is.
#[derive(Debug, Clone)]
enum Place<const D: usize> {
    /// On a surface.
    Around(Arc<dyn Surface<D>>),
    /// Throughout its inside.
    Within(Arc<dyn Surface<D>>),
    /// At points.
    At(Arc<Points<D>>),
}

#[derive(Debug)]
struct Points<const D: usize> {
    places: Vec<[f64; D]>,
    bounds: Bounds<D>,
    tree: KdTree<D>,
}

impl<const D: usize> Place<D> {
    /// The nearest point of it within `reach`, and how far away it is; none where there is none, and zero where the place is
    /// in a region.
    fn nearest(&self, place: [f64; D], reach: f64) -> Option<([f64; D], f64)> {
        match self {
            Self::Around(surface) => {
                let hit = surface.closest_within(place, reach)?;
                Some((hit.point, hit.distance.abs()))
            }
            Self::Within(surface) => match surface.closest_within(place, reach) {
                Some(hit) => Some((hit.point, hit.distance.max(0.0))),
                None => surface.inside(place).then_some((place, 0.0)),
            },
            Self::At(points) => {
                if points.bounds.distance_squared(place) > reach * reach {
                    return None;
                }
                let found = points.tree.nearest(place)?;
                (found.distance <= reach).then(|| (points.places[found.index], found.distance))
            }
        }
    }
}

/// The ramp begins as a hyperbola with this many spacings as its half axis: the growth has come to 71 % of its own after so
/// many spacings.
const ROUNDED: f64 = 3.0;

/// The same around points, from which spacings grow in all directions.
const ROUNDED_AT_POINTS: f64 = 8.0;

/// The ramp ends on a parabola over so much of the coarsest spacing below and above it.
const BLENDED: f64 = 0.3;

impl<const D: usize> Refinement<D> {
    /// The coarsest spacing everywhere (scene units), and by how much neighbouring spacings may differ: 1.08 is 8 %.
    pub fn new(coarsest: f64, growth: f64) -> Self {
        Self {
            coarsest,
            growth,
            sources: Vec::new(),
            around_all: None,
        }
    }

    /// This spacing (scene units; no more than the coarsest) at the surface of a body.
    #[must_use]
    pub fn around(self, surface: Arc<dyn Surface<D>>, spacing: f64) -> Self {
        self.with(Place::Around(surface), spacing)
    }

    /// This spacing (scene units; no more than the coarsest) throughout the inside of a surface.
    #[must_use]
    pub fn within(self, surface: Arc<dyn Surface<D>>, spacing: f64) -> Self {
        self.with(Place::Within(surface), spacing)
    }

    /// So many particles per radius of curvature along the surface of a body in `domain`, where that is finer than the usual
    /// spacing. Corners and sharp edges have no radius, and ask for nothing.
    #[must_use]
    pub fn curved(mut self, surface: &dyn Surface<D>, domain: &Domain<D>, curved: Curved) -> Self {
        for spots in curvature::spots(surface, curved) {
            // Images across periodic sides, as far as they matter.
            let reach = self.ramp(spots.spacing, true).distance_of(self.coarsest);
            let places: Vec<[f64; D]> = (spots.points.iter())
                .flat_map(|&point| domain.images(domain.wrap(point), reach))
                .collect();
            if let Ok(tree) = KdTree::new(&places) {
                let bounds = Bounds::of(&places);
                let points = Arc::new(Points {
                    places,
                    bounds,
                    tree,
                });
                self = self.with(Place::At(points), spots.spacing);
            }
        }
        self
    }

    fn with(mut self, place: Place<D>, spacing: f64) -> Self {
        let ramp = self.ramp(spacing, matches!(place, Place::At(_)));
        self.sources.push(Source { place, ramp });
        // The finest first: others are looked for less far then.
        self.sources
            .sort_by(|a, b| a.ramp.spacing.total_cmp(&b.ramp.spacing));
        self
    }

    fn ramp(&self, spacing: f64, is_at_points: bool) -> Ramp {
        let spacing = spacing.min(self.coarsest);
        let rounded = if is_at_points {
            ROUNDED_AT_POINTS
        } else {
            ROUNDED
        };
        Ramp {
            spacing,
            half: rounded * spacing,
            slope: self.growth - 1.0,
        }
    }

    /// The width of the parabola between a source and the coarsest.
    fn blend(&self, spacing: f64) -> f64 {
        (BLENDED * self.coarsest).min(self.coarsest - spacing)
    }

    /// A ramp's value and slope, ended at the coarsest.
    fn ended(&self, spacing: f64, [value, slope]: [f64; 2]) -> [f64; 2] {
        let blend = self.blend(spacing);
        let below = self.coarsest - value;
        if below >= blend || blend <= 0.0 {
            return [value.min(self.coarsest), slope];
        }
        if below <= -blend {
            return [self.coarsest, 0.0];
        }
        // Halfway between both, less what rounds the corner off.
        let lacking = blend - below.abs();
        let corner = lacking * lacking / (4.0 * blend);
        let least = value.min(self.coarsest);
        let part = if below > 0.0 {
            1.0 - lacking / (2.0 * blend)
        } else {
            lacking / (2.0 * blend)
        };
        [least - corner, part * slope]
    }
}

impl<const D: usize> SpacingField<D> for Refinement<D> {
    fn at(&self, place: [f64; D]) -> Spacing<D> {
        let mut best = Spacing {
            value: self.coarsest,
            gradient: [0.0; D],
        };
        for source in &self.sources {
            let Source { place: of, ramp } = source;
            // Where its ramp, ended, would be no finer than what is known.
            let blend = self.blend(ramp.spacing);
            let matters = if best.value < self.coarsest - blend {
                best.value
            } else {
                self.coarsest + blend
            };
            let Some((nearest, distance)) = of.nearest(place, ramp.distance_of(matters)) else {
                continue;
            };
            let [value, slope] = self.ended(ramp.spacing, ramp.at(distance));
            if value < best.value {
                let away = point::unit(point::sub(place, nearest)).unwrap_or([0.0; D]);
                best = Spacing {
                    value,
                    gradient: point::scale(away, slope),
                };
            }
        }
        best
    }

    fn beside(&self, surface: &Arc<dyn Surface<D>>) -> Option<Resolution<D>> {
        let spacing = self.around_all?;
        Some(self.clone().around(surface.clone(), spacing).into())
    }

    fn range(&self) -> [f64; 2] {
        let finest = (self.sources.iter()).fold(self.coarsest, |least, source| {
            least.min(source.ramp.spacing)
        });
        [finest, self.coarsest]
    }
}
