//! Axis-aligned boxes.

use crate::point;

/// An axis-aligned box, `min` and `max` included; empty where some `min > max`.
///
/// ```
/// use sphpack_neighbors::Bounds;
///
/// let bounds = Bounds::of(&[[0.0, 1.0], [2.0, -1.0], [1.0, 0.0]]);
/// assert_eq!((bounds.size(), bounds.center()), ([2.0, 2.0], [1.0, 0.0]));
/// assert!(bounds.grown(0.5).contains([2.25, 0.0]) && !bounds.contains([2.25, 0.0]));
/// assert!(Bounds::<2>::EMPTY.is_empty());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "[f64; D]: serde::Serialize",
        deserialize = "[f64; D]: serde::Deserialize<'de>"
    ))
)]
pub struct Bounds<const D: usize> {
    /// Lower corner, scene units.
    pub min: [f64; D],
    /// Upper corner, scene units.
    pub max: [f64; D],
}

impl<const D: usize> Bounds<D> {
    /// The box that holds nothing and grows by [`Bounds::include`].
    pub const EMPTY: Self = Self {
        min: [f64::INFINITY; D],
        max: [f64::NEG_INFINITY; D],
    };

    /// The box between two corners.
    #[must_use]
    pub fn new(min: [f64; D], max: [f64; D]) -> Self {
        Self { min, max }
    }

    /// The smallest box around the points; [`Bounds::EMPTY`] for none.
    #[must_use]
    pub fn of(points: &[[f64; D]]) -> Self {
        let mut bounds = Self::EMPTY;
        for &p in points {
            bounds.include(p);
        }
        bounds
    }

    /// Grows to hold `p`.
    #[inline(always)]
    pub fn include(&mut self, p: [f64; D]) {
        for k in 0..D {
            self.min[k] = self.min[k].min(p[k]);
            self.max[k] = self.max[k].max(p[k]);
        }
    }

    /// The smallest box around both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let mut both = self;
        for k in 0..D {
            both.min[k] = both.min[k].min(other.min[k]);
            both.max[k] = both.max[k].max(other.max[k]);
        }
        both
    }

    /// The box that both have in common; [empty](Bounds::is_empty) where they are apart.
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        let mut both = self;
        for k in 0..D {
            both.min[k] = both.min[k].max(other.min[k]);
            both.max[k] = both.max[k].min(other.max[k]);
        }
        both
    }

    /// The box grown by `margin` on every side.
    #[must_use]
    pub fn grown(self, margin: f64) -> Self {
        Self {
            min: self.min.map(|x| x - margin),
            max: self.max.map(|x| x + margin),
        }
    }

    /// Edge lengths.
    #[inline(always)]
    pub fn size(&self) -> [f64; D] {
        point::sub(self.max, self.min)
    }

    /// Length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        point::norm(self.size())
    }

    /// Middle of the box.
    #[inline(always)]
    pub fn center(&self) -> [f64; D] {
        point::scale(point::add(self.min, self.max), 0.5)
    }

    /// Area (2-D) or volume (3-D).
    pub fn volume(&self) -> f64 {
        self.size().iter().product()
    }

    /// The lower and the upper half of the box, cut across `axis`.
    #[must_use]
    pub fn halves(self, axis: usize) -> [Self; 2] {
        self.cut(axis, self.center()[axis])
    }

    /// The parts of the box below and above `at` on an axis.
    #[must_use]
    pub fn cut(self, axis: usize, at: f64) -> [Self; 2] {
        let (mut lower, mut upper) = (self, self);
        lower.max[axis] = at;
        upper.min[axis] = at;
        [lower, upper]
    }

    /// Whether no point lies in the box.
    pub fn is_empty(&self) -> bool {
        (0..D).any(|k| self.min[k] > self.max[k])
    }

    /// Whether `p` lies in the box, faces included.
    #[inline(always)]
    pub fn contains(&self, p: [f64; D]) -> bool {
        (0..D).all(|k| self.min[k] <= p[k] && p[k] <= self.max[k])
    }

    /// Whether `other` lies in the box, faces included.
    pub fn contains_box(&self, other: &Self) -> bool {
        self.contains(other.min) && self.contains(other.max)
    }

    /// Squared distance from `p` to the box, 0 inside.
    #[inline(always)]
    pub fn distance_squared(&self, p: [f64; D]) -> f64 {
        let mut sum = 0.0;
        for k in 0..D {
            let gap = (self.min[k] - p[k]).max(p[k] - self.max[k]).max(0.0);
            sum += gap * gap;
        }
        sum
    }
}
