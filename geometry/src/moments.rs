//! How a body's volume is spread: its middle, and how it resists being turned.

use sphpack_neighbors::point;

use crate::Similarity;

#[cfg(test)]
mod tests;

/// Volume, centre and second moments of a body of uniform density.
///
/// ```
/// use sphpack_geometry::{Cuboid, Surface};
/// let brick = Cuboid::new([0.0; 3], [2.0, 4.0, 6.0])?;
/// let moments = brick.moments().expect("known of a box");
/// assert_eq!(moments.center, [1.0, 2.0, 3.0]);
/// // m (b² + c²) / 12 about the axis along a.
/// assert!((moments.inertia()[0][0] - 48.0 * (16.0 + 36.0) / 12.0).abs() < 1e-10);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments<const D: usize> {
    /// Volume (area in 2-D), scene units.
    pub volume: f64,
    /// The centre of the volume.
    pub center: [f64; D],
    /// ∫ (x − c) (x − c)ᵀ dV about the centre c.
    pub second: [[f64; D]; D],
}

impl<const D: usize> Moments<D> {
    /// Of a body that is its own image in every axis through the middle: the second moments of its volume along these.
    pub(crate) fn along_axes(volume: f64, center: [f64; D], along: [f64; D]) -> Self {
        Self {
            volume,
            center,
            second: std::array::from_fn(|i| {
                std::array::from_fn(|k| if i == k { along[i] } else { 0.0 })
            }),
        }
    }

    /// Of a body that is round about an axis (a unit vector): the second moments along it and across.
    pub(crate) fn around_axis(
        volume: f64,
        center: [f64; D],
        axis: [f64; D],
        [along, across]: [f64; 2],
    ) -> Self {
        let mut moments = Self::along_axes(volume, center, [across; D]);
        for i in 0..D {
            for k in 0..D {
                moments.second[i][k] += (along - across) * axis[i] * axis[k];
            }
        }
        moments
    }

    /// Of a body bounded by these sides (2-D) or triangles (3-D), outward ones counter-clockwise, about a place near them; `None` where
    /// they enclose nothing. A side and the place span a simplex of volume V: ∫x = V s / (D + 1) and ∫ x xᵀ = V (s sᵀ + Σ v vᵀ) / (D + 1)(D + 2), s = Σ v
    /// its corners' sum.
    pub(crate) fn of_sides(
        near: [f64; D],
        sides: impl Iterator<Item = [[f64; D]; D]>,
        spanned: impl Fn(&[[f64; D]; D]) -> f64,
    ) -> Option<Self> {
        let mut sums = MomentSums::about(near);
        let d = D as f64;
        for side in sides {
            let corners = side.map(|corner| point::sub(corner, near));
            let volume = spanned(&corners);
            let sum = corners.iter().fold([0.0; D], |sum, &v| point::add(sum, v));
            sums.volume += volume;
            sums.first = point::add_scaled(sums.first, volume / (d + 1.0), sum);
            let weight = volume / ((d + 1.0) * (d + 2.0));
            add_outer(&mut sums.second, weight, sum);
            for corner in corners {
                add_outer(&mut sums.second, weight, corner);
            }
        }
        sums.moments()
    }

    /// Of the body carried along.
    pub(crate) fn placed(&self, place: &Similarity<D>) -> Self {
        let grown = place.scale().powi(D as i32);
        // R S Rᵀ: turned row by row, then column by column.
        let rows = self.second.map(|row| place.direction(row));
        let mut second = [[0.0; D]; D];
        for k in 0..D {
            let column = place.direction(std::array::from_fn(|i| rows[i][k]));
            for i in 0..D {
                second[i][k] = grown * place.scale().powi(2) * column[i];
            }
        }
        Self {
            volume: grown * self.volume,
            center: place.point(self.center),
            second,
        }
    }

    /// The tensor of inertia about the centre at density one, ∫ (|r|² I − r rᵀ) dV with r = x − c; in 2-D, where bodies turn about z
    /// alone, its entry for that is `[2][2]` and the others are those of a flat plate.
    pub fn inertia(&self) -> [[f64; 3]; 3] {
        let trace: f64 = (0..D).map(|k| self.second[k][k]).sum();
        std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let own = if i < D && k < D {
                    self.second[i][k]
                } else {
                    0.0
                };
                // From 0, so that none is −0.
                if i == k { trace - own } else { 0.0 - own }
            })
        })
    }
}

/// Moments that are summed up, of points with weights.
///
/// ```
/// use sphpack_geometry::MomentSums;
/// let mut sums = MomentSums::about([0.0, 0.0]);
/// sums.add([1.0, 0.0], 2.0);
/// sums.add([3.0, 0.0], 2.0);
/// let moments = sums.moments().expect("some weight");
/// assert_eq!((moments.center, moments.second[0][0]), ([2.0, 0.0], 4.0));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct MomentSums<const D: usize> {
    origin: [f64; D],
    volume: f64,
    first: [f64; D],
    second: [[f64; D]; D],
}

impl<const D: usize> MomentSums<D> {
    /// None yet. The nearer the place is to the points, the more digits stay.
    pub fn about(place: [f64; D]) -> Self {
        Self {
            origin: place,
            volume: 0.0,
            first: [0.0; D],
            second: [[0.0; D]; D],
        }
    }

    /// One more point.
    pub fn add(&mut self, p: [f64; D], weight: f64) {
        let x = point::sub(p, self.origin);
        self.volume += weight;
        self.first = point::add_scaled(self.first, weight, x);
        add_outer(&mut self.second, weight, x);
    }

    /// The moments of all; `None` where their weights come to nothing.
    pub fn moments(mut self) -> Option<Moments<D>> {
        if self.volume.is_nan() || self.volume <= 0.0 {
            return None;
        }
        let center = point::scale(self.first, 1.0 / self.volume);
        add_outer(&mut self.second, -self.volume, center);
        Some(Moments {
            volume: self.volume,
            center: point::add(self.origin, center),
            second: self.second,
        })
    }
}

/// Adds `weight` v vᵀ.
fn add_outer<const D: usize>(to: &mut [[f64; D]; D], weight: f64, v: [f64; D]) {
    for i in 0..D {
        for k in 0..D {
            to[i][k] += weight * v[i] * v[k];
        }
    }
}
