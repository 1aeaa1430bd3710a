//! How finely space is to be filled.

use std::fmt;
use std::sync::Arc;

use sphpack_geometry::Surface;
use sphpack_neighbors::{Bounds, Domain, Odometer};

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

    /// What the field becomes when a body is put into its problem; `None` where it stays as it is.
    fn beside(&self, surface: &Arc<dyn Surface<D>>) -> Option<Resolution<D>> {
        let _ = surface;
        None
    }

    /// How many particles the inside of a surface asks for: ∫ s^−D dV. Within some thousandths where it is not known better: by
    /// cells of the field's own size, halved at the surface.
    fn count_in(&self, surface: &dyn Surface<D>) -> f64 {
        let of = |cell: Bounds<D>| count_in_cell(self, surface, cell, 0);
        of(surface.bounds())
    }
}

/// Cells are halved until they are as small as the spacing, at the surface until they are so much smaller; and never more often
/// than this.
const AT_SURFACE: f64 = 8.0;
const MOST_HALVINGS: usize = 24;

/// Places along an axis at which the greatest spacing is looked for.
const LOOKED_AT: i64 = 9;

/// Cells that are counted, in spacings: s^−D is right to some thousandths there where spacings grow by less than 10 %.
const COUNTED: f64 = 2.0;

/// Cells that are counted first, to see how many there will be: what they say is a tenth or two too little.
const COARSE: f64 = 16.0;

/// Cells at most: two million take some seconds.
const MOST_CELLS: usize = 1 << 21;

fn count_in_cell<const D: usize, F: SpacingField<D> + ?Sized>(
    field: &F,
    surface: &dyn Surface<D>,
    cell: Bounds<D>,
    halvings: usize,
) -> f64 {
    let (center, radius) = (cell.center(), 0.5 * cell.diagonal());
    let spacing = field.at(center).value;
    let hit = surface.closest_within(center, radius);
    let is_inside = hit.map_or_else(|| surface.inside(center), |hit| hit.distance < 0.0);
    let size = cell.size();
    let edge = size.into_iter().fold(0.0, f64::max);
    let finest = if hit.is_some() {
        spacing / AT_SURFACE
    } else {
        spacing
    };
    if edge > finest && halvings < MOST_HALVINGS && (hit.is_some() || is_inside) {
        let halves = cell.halves(size.iter().position(|&s| s == edge).unwrap_or(0));
        return (halves.into_iter())
            .map(|half| count_in_cell(field, surface, half, halvings + 1))
            .sum();
    }
    let part = match hit {
        Some(hit) => (0.5 - hit.distance / edge).clamp(0.0, 1.0),
        None => f64::from(u8::from(is_inside)),
    };
    part * cell.volume() / spacing.powi(D as i32)
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

    /// The greatest spacing in a box, about: of a grid of places.
    pub fn greatest_in(&self, bounds: &Bounds<D>) -> f64 {
        if let Some(all) = self.uniform() {
            return all;
        }
        let size = bounds.size();
        let places = Odometer::new([0; D], [LOOKED_AT; D]);
        places.fold(0.0, |most: f64, step| {
            let place: [f64; D] = std::array::from_fn(|k| {
                let part = step[k] as f64 / (LOOKED_AT - 1) as f64;
                bounds.min[k] + part * size[k]
            });
            most.max(self.at(place).value)
        })
    }

    /// How many particles a box asks for: ∫ s^−D dV, by cells as small as the spacings in them, or larger ones where these would be too
    /// many. With it how many of those are within so many of their spacings of a side that is not periodic. Infinite where they
    /// cannot be counted.
    pub fn count_in_box(&self, domain: &Domain<D>, spacings: f64) -> [f64; 2] {
        let first = self.count_by(COARSE, domain, spacings);
        let fits = |counted: &f64| {
            // On the way down as many again are looked at, and halving leaves the last a third smaller than allowed.
            let cells = 2.0 * first[0] / (counted / 1.5).powi(D as i32);
            cells < MOST_CELLS as f64
        };
        let counted = [COUNTED, 2.0 * COUNTED, 4.0 * COUNTED];
        let finer = (counted.into_iter().find(fits))
            .map_or(first, |counted| self.count_by(counted, domain, spacings));
        if finer[0].is_finite() { finer } else { first }
    }

    /// [`Resolution::count_in_box`] by cells of so many spacings.
    fn count_by(&self, counted: f64, domain: &Domain<D>, spacings: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        let mut left = vec![(domain.bounds, 0)];
        let mut cells = 0;
        while let Some((cell, halvings)) = left.pop() {
            cells += 1;
            if cells > 2 * MOST_CELLS {
                return [f64::INFINITY; 2];
            }
            let spacing = self.at(cell.center()).value;
            let size = cell.size();
            let axis = (0..D).fold(
                0,
                |longest, k| if size[k] > size[longest] { k } else { longest },
            );
            if size[axis] > spacing * counted && halvings < MOST_HALVINGS * D {
                left.extend(cell.halves(axis).map(|half| (half, halvings + 1)));
                continue;
            }
            let count = cell.volume() / spacing.powi(D as i32);
            let center = cell.center();
            let is_near = (0..D).any(|k| {
                let (low, high) = (domain.bounds.min[k], domain.bounds.max[k]);
                let away = (center[k] - low).min(high - center[k]);
                !domain.periodic[k] && away < spacings * spacing
            });
            sums[0] += count;
            sums[1] += if is_near { count } else { 0.0 };
        }
        sums
    }

    /// How many particles the inside of a surface asks for.
    pub fn count_in(&self, surface: &dyn Surface<D>) -> f64 {
        self.0.count_in(surface)
    }

    /// What the field becomes when a body is put into its problem.
    pub(crate) fn beside(&self, surface: &Arc<dyn Surface<D>>) -> Self {
        (self.0.beside(surface)).unwrap_or_else(|| self.clone())
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
