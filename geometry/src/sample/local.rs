//! How far apart points shall be where they are.

use sphpack_neighbors::point;

/// What is wanted at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Local {
    /// Distance between points on the same side of the body, scene units.
    pub(crate) spacing: f64,
    /// The same between points on opposite sides; 0 where the body is so thick that these leave each other alone.
    pub(crate) across: f64,
    /// In what a point here measures its moves, scene units: the mean spacing of all, or its own where these differ much.
    pub(crate) unit: f64,
}

impl Local {
    /// The same everywhere, on one side.
    pub(crate) fn even(spacing: f64) -> Self {
        Self {
            spacing,
            across: 0.0,
            unit: spacing,
        }
    }
}

/// A point, the outward normal there, and what is wanted there.
pub(super) type Spot<const D: usize> = ([f64; D], [f64; D], Local);

/// How far apart two points shall be; `None` where they leave each other alone. They are on the same side where the
/// cosine between their normals is at least `same_side`.
#[inline]
pub(super) fn apart<const D: usize>(
    (_, normal, here): &Spot<D>,
    (_, other, there): &Spot<D>,
    same_side: f64,
) -> Option<f64> {
    if point::dot(*normal, *other) >= same_side {
        Some(0.5 * (here.spacing + there.spacing))
    } else if here.across > 0.0 && there.across > 0.0 {
        Some(0.5 * (here.across + there.across))
    } else {
        None
    }
}

/// Whether points measure their moves by units of their own.
pub(super) fn have_units(locals: impl IntoIterator<Item = Local>) -> bool {
    let mut units = locals.into_iter().map(|local| local.unit);
    let first = units.next();
    units.any(|unit| Some(unit) != first)
}

/// The greatest distance that is wanted anywhere.
pub(super) fn greatest(locals: impl IntoIterator<Item = Local>) -> f64 {
    locals
        .into_iter()
        .map(|local| local.spacing.max(local.across))
        .fold(0.0, f64::max)
}
