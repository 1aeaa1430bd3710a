//! How large particles are: their spacing and their smoothing length.

#[cfg(test)]
mod tests;

/// The sizes of a set of particles: each has a spacing s, the D-th root of its volume where space is evenly filled, and a
/// smoothing length h = η s. Where all have one, nothing is stored for each.
///
/// ```
/// use sphpack_packing::Sizes;
///
/// let all = Sizes::uniform(0.1, 1.2);
/// assert_eq!((all.spacing(7), all.smoothing_length(7)), (0.1, 0.12));
/// let each = Sizes::each(&[0.1, 0.2, 0.4], 1.5);
/// assert_eq!((each.spacing(1), each.smoothing_length(2)), (0.2, 0.6000000000000001));
/// assert_eq!(each.finest(), 0.1);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sizes {
    /// The spacing of all, or the least (scene units).
    finest: f64,
    /// η.
    h_over_spacing: f64,
    /// Every particle's spacing over the finest; empty where all have one.
    relative: Vec<f64>,
}

impl Sizes {
    /// One spacing (scene units) for all, and h over it.
    pub fn uniform(spacing: f64, h_over_spacing: f64) -> Self {
        Self {
            finest: spacing,
            h_over_spacing,
            relative: Vec::new(),
        }
    }

    /// A spacing (scene units; positive and finite) for each particle, and h over it.
    pub fn each(spacings: &[f64], h_over_spacing: f64) -> Self {
        let finest = spacings.iter().copied().fold(f64::INFINITY, f64::min);
        Self {
            finest,
            h_over_spacing,
            relative: spacings.iter().map(|spacing| spacing / finest).collect(),
        }
    }

    /// The same spacings with another h over them.
    #[must_use]
    pub fn with_h_over_spacing(self, h_over_spacing: f64) -> Self {
        Self {
            h_over_spacing,
            ..self
        }
    }

    /// The least spacing, scene units.
    pub fn finest(&self) -> f64 {
        self.finest
    }

    /// η = h/s.
    pub fn h_over_spacing(&self) -> f64 {
        self.h_over_spacing
    }

    /// The smoothing length of the finest, scene units.
    pub fn smallest_smoothing_length(&self) -> f64 {
        self.h_over_spacing * self.finest
    }

    /// The spacing of particle `i`, scene units.
    #[inline]
    pub fn spacing(&self, i: usize) -> f64 {
        self.finest * self.over_finest(i)
    }

    /// The smoothing length of particle `i`, scene units.
    #[inline]
    pub fn smoothing_length(&self, i: usize) -> f64 {
        self.h_over_spacing * self.spacing(i)
    }

    /// The spacing of particle `i` over the finest: 1 where all have one.
    #[inline]
    pub fn over_finest(&self, i: usize) -> f64 {
        self.relative.get(i).copied().unwrap_or(1.0)
    }

    /// Every particle's spacing over the finest; `None` where all have one.
    pub fn relative(&self) -> Option<&[f64]> {
        (!self.relative.is_empty()).then_some(&self.relative)
    }

    /// Those of the particles that `order` names, in its order.
    pub(crate) fn selected(&self, order: &[usize]) -> Self {
        let relative = match self.relative() {
            None => Vec::new(),
            Some(relative) => order.iter().map(|&i| relative[i]).collect(),
        };
        Self { relative, ..*self }
    }
}
