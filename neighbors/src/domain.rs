//! The box that holds the particles.

use crate::Bounds;

/// An axis-aligned box, each axis open or periodic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain<const D: usize> {
    /// The box, scene units.
    pub bounds: Bounds<D>,
    /// Which axes wrap around.
    pub periodic: [bool; D],
}

impl<const D: usize> Domain<D> {
    /// A box without periodic axes.
    pub fn new(min: [f64; D], max: [f64; D]) -> Self {
        Self {
            bounds: Bounds::new(min, max),
            periodic: [false; D],
        }
    }

    /// The same box with the given axes periodic.
    pub fn with_periodic(self, periodic: [bool; D]) -> Self {
        Self { periodic, ..self }
    }

    /// Whether any axis is periodic.
    pub fn is_periodic(&self) -> bool {
        self.periodic.contains(&true)
    }

    /// The point of the box that `p` is an image of: periodic coordinates are brought into `[min, max)`.
    #[inline]
    pub fn wrap(&self, p: [f64; D]) -> [f64; D] {
        let size = self.bounds.size();
        std::array::from_fn(|k| {
            if !self.periodic[k] {
                return p[k];
            }
            let x = p[k] - size[k] * ((p[k] - self.bounds.min[k]) / size[k]).floor();
            // Rounding may land on the upper face, which is the lower one.
            if x >= self.bounds.max[k] {
                self.bounds.min[k]
            } else {
                x
            }
        })
    }

    /// `a − b` to the nearest image of `b`.
    #[inline]
    pub fn difference(&self, a: [f64; D], b: [f64; D]) -> [f64; D] {
        let size = self.bounds.size();
        std::array::from_fn(|k| {
            let d = a[k] - b[k];
            if self.periodic[k] {
                d - size[k] * (d / size[k]).round()
            } else {
                d
            }
        })
    }
}
