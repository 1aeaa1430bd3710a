//! What a level set is made of: a signed distance at any point, not only at the nodes.

use std::sync::Arc;

use sphpack_neighbors::point;

use crate::Surface;
use crate::level_inset::gradient;

/// A signed distance, or what stands for one: its absolute value is at most the distance to its zero set.
pub(crate) trait Field<const D: usize>: Send + Sync + std::fmt::Debug {
    /// The value at `p`, negative inside, and the unit vector along which it grows.
    fn at(&self, p: [f64; D]) -> (f64, [f64; D]);
}

/// The distance of a surface.
#[derive(Debug)]
pub(super) struct Exact<const D: usize>(pub(super) Arc<dyn Surface<D>>);

impl<const D: usize> Field<D> for Exact<D> {
    fn at(&self, p: [f64; D]) -> (f64, [f64; D]) {
        let hit = self.0.closest(p);
        (hit.distance, gradient(p, &hit))
    }
}

/// What is done with two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Boolean {
    /// What either holds.
    Union,
    /// What both hold.
    Intersection,
    /// What the first holds and the second does not.
    Minus,
}

impl Boolean {
    /// The value of the result where the bodies have `a` and `b`.
    pub(super) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Union => a.min(b),
            Self::Intersection => a.max(b),
            Self::Minus => a.max(-b),
        }
    }
}

/// Two fields made one.
#[derive(Debug)]
pub(super) struct Both<const D: usize> {
    pub(super) how: Boolean,
    pub(super) first: Arc<dyn Field<D>>,
    pub(super) second: Arc<dyn Field<D>>,
}

impl<const D: usize> Field<D> for Both<D> {
    fn at(&self, p: [f64; D]) -> (f64, [f64; D]) {
        let (a, mut b) = (self.first.at(p), self.second.at(p));
        if self.how == Boolean::Minus {
            b = (-b.0, point::scale(b.1, -1.0));
        }
        let takes_first = match self.how {
            Boolean::Union => a.0 <= b.0,
            Boolean::Intersection | Boolean::Minus => a.0 >= b.0,
        };
        if takes_first { a } else { b }
    }
}
