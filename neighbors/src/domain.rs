//! The box that holds the particles.

use std::cmp::Ordering;

use crate::Bounds;

/// An axis-aligned box, each axis open or periodic.
///
/// ```
/// use sphpack_neighbors::Domain;
///
/// let domain = Domain::new([0.0, 0.0], [1.0, 2.0]).with_periodic([true, false]);
/// assert_eq!(domain.wrap([1.25, 5.0]), [0.25, 5.0]); // only periodic axes wrap
/// assert_eq!(domain.difference([0.875, 0.0], [0.125, 0.0]), [-0.25, 0.0]);
/// assert_eq!(domain.clamp([1.25, 5.0]), [1.25, 2.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "[f64; D]: serde::Serialize, [bool; D]: serde::Serialize",
        deserialize = "[f64; D]: serde::Deserialize<'de>, [bool; D]: serde::Deserialize<'de>"
    ))
)]
pub struct Domain<const D: usize> {
    /// The box, scene units.
    pub bounds: Bounds<D>,
    /// Which axes wrap around.
    pub periodic: [bool; D],
}

impl<const D: usize> Domain<D> {
    /// A box without periodic axes.
    #[must_use]
    pub fn new(min: [f64; D], max: [f64; D]) -> Self {
        Self {
            bounds: Bounds::new(min, max),
            periodic: [false; D],
        }
    }

    /// The same box with the given axes periodic.
    #[must_use]
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

    /// The whole periods that carry `p` into the box; 0 along axes that are not periodic.
    pub fn whole_periods(&self, p: [f64; D]) -> [f64; D] {
        let size = self.bounds.size();
        std::array::from_fn(|k| {
            if self.periodic[k] {
                -((p[k] - self.bounds.min[k]) / size[k]).floor() * size[k]
            } else {
                0.0
            }
        })
    }

    /// The place of the box nearest to `p`, periodic axes left as they are.
    #[inline]
    pub fn clamp(&self, p: [f64; D]) -> [f64; D] {
        std::array::from_fn(|k| {
            if self.periodic[k] {
                p[k]
            } else {
                // Not `clamp`, which panics for an empty box.
                p[k].max(self.bounds.min[k]).min(self.bounds.max[k])
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

    /// The images of `p` in the box and within `reach` (scene units) of it across periodic sides; the one in the box first.
    /// `p` alone where no axis is periodic, wherever it is.
    pub fn images(&self, p: [f64; D], reach: f64) -> impl Iterator<Item = [f64; D]> + use<D> {
        let own = self.wrap(p);
        let size = self.bounds.size();
        // How many periods an image may be away: more than one where the box is narrower than the reach.
        let periods: [i32; D] = std::array::from_fn(|k| {
            if self.periodic[k] {
                (reach / size[k]).ceil() as i32
            } else {
                0
            }
        });
        let (near, periodic) = (self.bounds.grown(reach), self.periodic);
        let mut next = Some(periods.map(|n| -n));
        let others = std::iter::from_fn(move || {
            loop {
                let step = next?;
                next = (0..D).rev().find(|&k| step[k] < periods[k]).map(|axis| {
                    std::array::from_fn(|k| match k.cmp(&axis) {
                        Ordering::Less => step[k],
                        Ordering::Equal => step[k] + 1,
                        Ordering::Greater => -periods[k],
                    })
                });
                let image: [f64; D] =
                    std::array::from_fn(|k| own[k] + f64::from(step[k]) * size[k]);
                let is_near = (0..D)
                    .all(|k| !periodic[k] || (near.min[k] <= image[k] && image[k] <= near.max[k]));
                if step != [0; D] && is_near {
                    return Some(image);
                }
            }
        });
        std::iter::once(own).chain(others)
    }
}
