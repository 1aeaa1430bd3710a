//! What a field was found to be, and where.

use sphpack_neighbors::point;

use crate::resolution::Resolution;
use crate::state::values;

/// The field is asked again when a particle has moved by this part of its spacing: most of its cost is the way to the nearest
/// surface. In between a size is off by some 10⁻⁶ of itself, and beside a kink by growth − 1 times this; in the end by
/// nothing.
pub(super) const STRAIGHT: f64 = 0.01;

/// A field as it was found at a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Anchor<const D: usize> {
    place: [f64; D],
    value: f64,
    gradient: [f64; D],
}

values!(Anchor[const D: usize] { place: [f64; D], value: f64, gradient: [f64; D] });

impl<const D: usize> Anchor<D> {
    pub(super) const NONE: Self = Self {
        place: [f64::NAN; D],
        value: 0.0,
        gradient: [0.0; D],
    };

    /// The spacing at a place and its gradient; asks the field where that is too far from where it was asked before.
    pub(super) fn at(
        &mut self,
        field: &Resolution<D>,
        place: [f64; D],
        within: f64,
    ) -> (f64, [f64; D]) {
        let away = point::sub(place, self.place);
        let room = within * self.value;
        // Not a number is nowhere near.
        if point::norm_squared(away) < room * room {
            return (self.value + point::dot(self.gradient, away), self.gradient);
        }
        let spacing = field.at(place);
        *self = Self {
            place,
            value: spacing.value,
            gradient: spacing.gradient,
        };
        (spacing.value, spacing.gradient)
    }
}
