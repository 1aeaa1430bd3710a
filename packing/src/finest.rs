//! The finest of several fields of spacings.

use std::sync::Arc;

use sphpack_geometry::Surface;

use crate::resolution::{Resolution, Spacing, SpacingField};

/// Everywhere the finest of several fields; where two are equally fine it has a kink.
///
/// ```
/// use sphpack_packing::{Finest, Resolution, SpacingFunction, Spacing};
///
/// let ramp = SpacingFunction::new([0.05, 0.5], |p: [f64; 2]| Spacing {
///     value: 0.05 + 0.08 * p[0],
///     gradient: [0.08, 0.0],
/// });
/// let field = Resolution::from(Finest::of([ramp.into(), 0.2.into()]));
/// assert!((field.at([1.0, 0.0]).value - 0.13).abs() < 1e-15);
/// assert_eq!(field.at([4.0, 0.0]).value, 0.2);
/// assert_eq!(field.range(), [0.05, 0.2]);
/// ```
#[derive(Debug, Clone)]
pub struct Finest<const D: usize>(Vec<Resolution<D>>);

impl<const D: usize> Finest<D> {
    /// The finest of these; no field at all is infinitely coarse.
    pub fn of(fields: impl IntoIterator<Item = Resolution<D>>) -> Self {
        Self(fields.into_iter().collect())
    }
}

impl<const D: usize> SpacingField<D> for Finest<D> {
    fn at(&self, place: [f64; D]) -> Spacing<D> {
        let coarsest = Spacing {
            value: f64::INFINITY,
            gradient: [0.0; D],
        };
        (self.0.iter()).fold(coarsest, |finest, field| {
            let other = field.at(place);
            if other.value < finest.value {
                other
            } else {
                finest
            }
        })
    }

    fn range(&self) -> [f64; 2] {
        let ranges = self.0.iter().map(Resolution::range);
        ranges.fold([f64::INFINITY; 2], |[least, most], [a, b]| {
            [least.min(a), most.min(b)]
        })
    }

    fn beside(&self, surface: &Arc<dyn Surface<D>>) -> Option<Resolution<D>> {
        let beside = self.0.iter().map(|field| field.beside(surface));
        Some(Self::of(beside).into())
    }
}
