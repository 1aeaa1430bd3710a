//! Spacings that grow with the distance from bodies.

use std::sync::Arc;

use sphpack_geometry::Surface;
use sphpack_neighbors::point;

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
    surface: Arc<dyn Surface<D>>,
    spacing: f64,
    /// Whether the whole inside has the spacing, not only the surface.
    is_region: bool,
}

/// The ramp begins as a hyperbola with this many spacings as its half axis: the growth has come to 71 % of its own after so
/// many spacings.
const ROUNDED: f64 = 3.0;

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
        self.with(surface, spacing, false)
    }

    /// This spacing (scene units; no more than the coarsest) throughout the inside of a surface.
    #[must_use]
    pub fn within(self, surface: Arc<dyn Surface<D>>, spacing: f64) -> Self {
        self.with(surface, spacing, true)
    }

    fn with(mut self, surface: Arc<dyn Surface<D>>, spacing: f64, is_region: bool) -> Self {
        self.sources.push(Source {
            surface,
            spacing: spacing.min(self.coarsest),
            is_region,
        });
        // The finest first: others are looked for less far then.
        self.sources.sort_by(|a, b| a.spacing.total_cmp(&b.spacing));
        self
    }

    /// How fast spacings grow at most: ∣∇s∣.
    fn slope(&self) -> f64 {
        self.growth - 1.0
    }

    /// The width of the parabola between a source and the coarsest.
    fn blend(&self, spacing: f64) -> f64 {
        (BLENDED * self.coarsest).min(self.coarsest - spacing)
    }

    /// The ramp of a source at a distance, and its slope.
    fn ramp(&self, spacing: f64, distance: f64) -> [f64; 2] {
        let half = ROUNDED * spacing;
        let along = distance.hypot(half);
        let slope = self.slope();
        [spacing + slope * (along - half), slope * distance / along]
    }

    /// The distance at which a source's ramp has come to `value`.
    fn distance_of(&self, spacing: f64, value: f64) -> f64 {
        let half = ROUNDED * spacing;
        let along = half + (value - spacing).max(0.0) / self.slope();
        (along * along - half * half).max(0.0).sqrt()
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
            // Where its ramp, ended, would be no finer than what is known.
            let end = self.coarsest + self.blend(source.spacing);
            let matters = if best.value < self.coarsest - self.blend(source.spacing) {
                best.value
            } else {
                end
            };
            let reach = self.distance_of(source.spacing, matters);
            let hit = source.surface.closest_within(place, reach);
            let is_within = source.is_region
                && hit.map_or_else(|| source.surface.inside(place), |hit| hit.distance <= 0.0);
            let (value, gradient) = if is_within {
                (source.spacing, [0.0; D])
            } else if let Some(hit) = hit {
                let ramp = self.ramp(source.spacing, hit.distance.abs());
                let [value, slope] = self.ended(source.spacing, ramp);
                let away = point::unit(point::sub(place, hit.point)).unwrap_or([0.0; D]);
                (value, point::scale(away, slope))
            } else {
                continue;
            };
            if value < best.value {
                best = Spacing { value, gradient };
            }
        }
        best
    }

    fn beside(&self, surface: &Arc<dyn Surface<D>>) -> Option<Resolution<D>> {
        let spacing = self.around_all?;
        Some(self.clone().around(surface.clone(), spacing).into())
    }

    fn range(&self) -> [f64; 2] {
        let finest =
            (self.sources.iter()).fold(self.coarsest, |least, source| least.min(source.spacing));
        [finest, self.coarsest]
    }
}
