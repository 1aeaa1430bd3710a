//! How finely space is to be filled.

use std::fmt;
use std::sync::Arc;

use sphpack_geometry::Surface;

/// What a field of spacings says of a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spacing<const D: usize> {
    /// s, scene units.
    pub value: f64,
    /// ∇s.
    pub gradient: [f64; D],
}

/// A field of spacings s(x). A uniform one is [`Uniform`].
pub trait SpacingField<const D: usize>: fmt::Debug + Send + Sync {
    /// The spacing at a place, and its gradient.
    fn at(&self, place: [f64; D]) -> Spacing<D>;

    /// The least and the greatest spacing, scene units.
    fn range(&self) -> [f64; 2];

    /// How many particles the inside of a surface asks for: ∫ s^−D dV.
    fn count_in(&self, surface: &dyn Surface<D>) -> f64;
}

/// The same spacing everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uniform {
    /// ∆s, scene units.
    pub spacing: f64,
}

impl<const D: usize> SpacingField<D> for Uniform {
    fn at(&self, _: [f64; D]) -> Spacing<D> {
        Spacing {
            value: self.spacing,
            gradient: [0.0; D],
        }
    }

    fn range(&self) -> [f64; 2] {
        [self.spacing; 2]
    }

    fn count_in(&self, surface: &dyn Surface<D>) -> f64 {
        surface.volume() / self.spacing.powi(D as i32)
    }
}

/// The field of spacings of a problem. A number is a uniform one.
///
/// ```
/// use sphpack_geometry::Ball;
/// use sphpack_packing::{Resolution, Uniform};
///
/// let fine: Resolution<3> = 0.1.into();
/// assert_eq!(fine.uniform(), Some(0.1));
/// assert_eq!(fine.at([5.0; 3]).gradient, [0.0; 3]);
/// let same = Resolution::<3>::from(Uniform { spacing: 0.1 });
/// let ball = Ball::new([0.0; 3], 1.0)?;
/// assert!((same.count_in(&ball) - 4188.79).abs() < 0.01);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Clone)]
pub struct Resolution<const D: usize>(Arc<dyn SpacingField<D>>);

impl<const D: usize> Resolution<D> {
    /// The spacing at a place, and its gradient.
    pub fn at(&self, place: [f64; D]) -> Spacing<D> {
        self.0.at(place)
    }

    /// The least and the greatest spacing, scene units.
    pub fn range(&self) -> [f64; 2] {
        self.0.range()
    }

    /// How many particles the inside of a surface asks for.
    pub fn count_in(&self, surface: &dyn Surface<D>) -> f64 {
        self.0.count_in(surface)
    }

    /// The least spacing, scene units.
    pub fn finest(&self) -> f64 {
        self.range()[0]
    }

    /// The spacing where it is the same everywhere.
    pub fn uniform(&self) -> Option<f64> {
        let [least, greatest] = self.range();
        // Not a number counts as one spacing: the problem's check refuses it.
        (least == greatest || least.is_nan()).then_some(least)
    }
}

impl<const D: usize> fmt::Debug for Resolution<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<const D: usize> From<f64> for Resolution<D> {
    fn from(spacing: f64) -> Self {
        Self(Arc::new(Uniform { spacing }))
    }
}

impl<const D: usize, F: SpacingField<D> + 'static> From<F> for Resolution<D> {
    fn from(field: F) -> Self {
        Self(Arc::new(field))
    }
}
