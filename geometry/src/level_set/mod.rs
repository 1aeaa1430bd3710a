//! Bodies as signed distances on a grid.

mod blocks;
mod cells;
mod contour;
mod crossings;
mod cut;
mod field;
mod fit;
mod patches;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use sphpack_neighbors::Bounds;

use crate::{Cuboid, GeometryError, ParameterError, Surface};
use blocks::Blocks;
use field::{Boolean, Both, Exact};

pub use cut::cut_on_grid;
pub(crate) use field::Field;

/// Half the width of the band in which distances are stored, in cells.
const BAND_CELLS: f64 = 3.0;

/// A body as the signed distances from its surface at the nodes of a regular grid: negative inside, exact within three
/// cells of the surface, cut off to ± three cells beyond ([`LevelSet::band`]).
///
/// Grids of equal cells are the same grid, whatever the bodies, so that their level sets can be joined, intersected
/// and cut: node by node the lesser or greater distance. The result's values are a lower bound of the distance from
/// its surface: exact but beside the lines where the two surfaces meet, at reentrant edges outside and at convex ones
/// inside.
///
/// Parts and gaps thinner than a cell may be lost. Values are stored in blocks of 8^D nodes along the surface only:
/// in 3-D some 150 bytes per cell² of the surface, in 2-D some 120 per cell of the outline. Making it costs a query
/// of the surface for every node stored, in parallel; a Boolean a few operations for each. The same bits for any
/// number of threads.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ball, LevelSet, Surface};
/// let ball = |x: f64| Ball::new([x, 0.0, 0.0], 1.0).map(|ball| LevelSet::of(Arc::new(ball), 0.05));
/// let (a, b) = (ball(0.0)??, ball(1.0)??);
/// assert!((a.value([0.0, 0.0, 0.9]) + 0.1).abs() < 1e-3);
/// let left = a.minus(&b)?.mesh()?;
/// let exact = std::f64::consts::PI * (4.0 / 3.0 - 5.0 / 12.0); // a lens is missing
/// assert!(left.is_some_and(|left| (left.volume() / exact - 1.0).abs() < 1e-3));
/// assert!(a.minus(&a)?.is_empty());
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone)]
pub struct LevelSet<const D: usize> {
    blocks: Blocks<D>,
    /// What the values are taken from, for places between the nodes.
    field: Arc<dyn Field<D>>,
}

impl<const D: usize> LevelSet<D> {
    /// The level set of `surface` on the grid with cells of size `cell` (scene units).
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] unless `cell` is positive and finite, and where it is so small that the grid
    /// would take more than half a gibibyte.
    pub fn of(surface: Arc<dyn Surface<D>>, cell: f64) -> Result<Self, GeometryError> {
        let bounds = surface.bounds();
        let near = {
            let surface = Arc::clone(&surface);
            move |p| surface.closest(p).distance.abs()
        };
        let field: Arc<dyn Field<D>> = Arc::new(Exact(surface));
        let blocks = Blocks::near(Self::sizes(cell)?, &bounds, near, field.as_ref())?;
        Ok(Self { blocks, field })
    }

    /// The level set of what `window` and the body of `surface` have in common, as large as that: of a body that passes
    /// the window only what is near or in it is asked and stored. Within the window, more than four cells from its
    /// sides, the values are those of [`LevelSet::of`].
    ///
    /// ```
    /// use std::sync::Arc;
    /// use sphpack_geometry::{Ball, LevelSet, Surface};
    /// use sphpack_neighbors::Bounds;
    /// let planet = Arc::new(Ball::new([0.0, 0.0, -6.4e6], 6.4e6)?);
    /// let window = Bounds::new([-2.0, -2.0, -1.0], [2.0, 2.0, 2.0]);
    /// let ground = LevelSet::within(planet, 0.25, &window)?.mesh()?;
    /// assert!(ground.is_some_and(|ground| (ground.volume() - 16.0).abs() < 1e-3));
    /// # Ok::<(), sphpack_geometry::GeometryError>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`LevelSet::of`], for what is within the window, and [`GeometryError::Parameter`] where the window is
    /// flat or endless.
    pub fn within(
        surface: Arc<dyn Surface<D>>,
        cell: f64,
        window: &Bounds<D>,
    ) -> Result<Self, GeometryError> {
        if window.contains_box(&surface.bounds()) {
            return Self::of(surface, cell);
        }
        let bounds = surface.bounds().intersection(*window);
        let window = Cuboid::new(window.min, window.max)?;
        let field: Arc<dyn Field<D>> = Arc::new(Both {
            how: Boolean::Intersection,
            first: Arc::new(Exact(surface)),
            second: Arc::new(Exact(Arc::new(window))),
        });
        let near = |p| field.at(p).0.abs();
        let blocks = Blocks::near(Self::sizes(cell)?, &bounds, near, field.as_ref())?;
        Ok(Self { blocks, field })
    }

    /// The level set of a field whose zero set begins within `bounds` where `near` is small, and may lead on from
    /// there.
    pub(crate) fn of_field(
        field: Arc<dyn Field<D>>,
        cell: f64,
        bounds: &Bounds<D>,
        near: impl Fn([f64; D]) -> f64 + Sync,
    ) -> Result<Self, GeometryError> {
        let blocks = Blocks::near(Self::sizes(cell)?, bounds, near, field.as_ref())?
            .grown(field.as_ref())?;
        Ok(Self { blocks, field })
    }

    fn sizes(cell: f64) -> Result<(f64, f64), GeometryError> {
        let cell = ParameterError::check_positive("level set", "cell", cell)?;
        Ok((cell, BAND_CELLS * cell))
    }

    /// The size of a cell, scene units.
    pub fn cell(&self) -> f64 {
        self.blocks.cell
    }

    /// The largest value there is, three cells: further from the surface only the sign is known.
    pub fn band(&self) -> f64 {
        self.blocks.band
    }

    /// Whether no node is inside.
    pub fn is_empty(&self) -> bool {
        self.blocks.all_values().iter().all(|&v| v >= 0.0)
    }

    /// Memory for the values, bytes.
    pub fn bytes(&self) -> usize {
        self.blocks.count() * (Blocks::<D>::NODES * size_of::<f64>() + size_of::<[i32; D]>())
    }

    /// The signed distance at `p`, interpolated linearly along every axis, at most ± [`LevelSet::band`]. Within a cell
    /// of a surface that bends by radii R₁, R₂ that is within cell²/8 · (1/R₁ + 1/R₂) of the distance: a sphere's is
    /// within cell² / 4R. O(log n) for n blocks.
    pub fn value(&self, p: [f64; D]) -> f64 {
        let (node, part) = self.blocks.below(p);
        let mut sum = 0.0;
        for bits in 0..1_usize << D {
            let upper = |k: usize| bits >> k & 1 == 1;
            let corner = std::array::from_fn(|k| node[k] + i32::from(upper(k)));
            let weight: f64 = (0..D)
                .map(|k| if upper(k) { part[k] } else { 1.0 - part[k] })
                .product();
            sum += weight * self.blocks.at(corner);
        }
        sum
    }

    /// The unit vector along which the distance grows at `p`, from differences of [`LevelSet::value`] over two cells:
    /// within a cell of a surface that bends by radius R it is within some cell² / R² of the normal. `None` where nothing changes, as
    /// beyond the band.
    pub fn normal(&self, p: [f64; D]) -> Option<[f64; D]> {
        let slope = std::array::from_fn(|k| {
            let [mut before, mut after] = [p; 2];
            before[k] -= self.cell();
            after[k] += self.cell();
            self.value(after) - self.value(before)
        });
        sphpack_neighbors::point::unit(slope)
    }

    /// Whether `p` is inside: where [`LevelSet::value`] is negative.
    pub fn inside(&self, p: [f64; D]) -> bool {
        self.value(p) < 0.0
    }

    /// What either body holds: the lesser distance.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] where the cells are not equal.
    pub fn union(&self, other: &Self) -> Result<Self, GeometryError> {
        self.with(other, Boolean::Union)
    }

    /// What both bodies hold: the greater distance.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] where the cells are not equal.
    pub fn intersection(&self, other: &Self) -> Result<Self, GeometryError> {
        self.with(other, Boolean::Intersection)
    }

    /// What is left of the body where `other` has all its room: the greater of the one distance and the negative
    /// other.
    ///
    /// # Errors
    /// [`GeometryError::Parameter`] where the cells are not equal.
    pub fn minus(&self, other: &Self) -> Result<Self, GeometryError> {
        self.with(other, Boolean::Minus)
    }

    fn with(&self, other: &Self, how: Boolean) -> Result<Self, GeometryError> {
        if self.cell() != other.cell() {
            return Err(ParameterError::OutOfRange {
                of: "level set",
                name: "cell",
                value: other.cell(),
                needs: "the same for both bodies",
            }
            .into());
        }
        Ok(Self {
            blocks: self.blocks.with(&other.blocks, how),
            field: Arc::new(Both {
                how,
                first: Arc::clone(&self.field),
                second: Arc::clone(&other.field),
            }),
        })
    }
}
