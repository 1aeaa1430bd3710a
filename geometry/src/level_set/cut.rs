//! Cuts on a grid that is as fine as what they leave.

use std::sync::Arc;

use sphpack_neighbors::Bounds;

use super::LevelSet;
use crate::{CutError, GeometryError, Mesh, MeshError, Surface};

/// How often the cells are halved.
const HALVINGS: i32 = 3;

/// What a cut may lose beside what it is told, in parts of the body's volume: cells of ∆s/4 miss a ball of R = 5 ∆s by 0.05 %.
const LOST: f64 = 1e-3;

/// How far beyond the first body the second one is asked, in cells: twice the band in which a grid's values are distances.
const BESIDE_CELLS: f64 = 6.0;

/// What is left of `lower` where `higher` takes its room, as a mesh; `None` where nothing is left. Cells of size `cell`
/// (scene units), halved up to three times while a slice thinner than a cell is lost: what is left and what is taken must
/// have the body's own [volume](Surface::volume) together, but for `lost` (scene units to the power 3) and a thousandth of it.
/// Of bodies that pass the `window` only what is in it is looked at and left ([`LevelSet::within`]); the volume is then
/// that of a mesh of what the window holds of `lower`.
/// Costs two [level sets](LevelSet::of), two Booleans and two meshes for each size of cells.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ball, Cuboid, Surface, cut_on_grid};
/// use sphpack_neighbors::Bounds;
/// let ball = Arc::new(Ball::new([0.0; 3], 1.0)?);
/// // A cap of height 0.04 is above the box.
/// let board = Arc::new(Cuboid::new([-2.0, -2.0, 0.0], [2.0, 2.0, 0.96])?);
/// let window = Bounds::new([-3.0; 3], [3.0; 3]);
/// let left = cut_on_grid(ball, board, 0.1, 1e-3, &window)?;
/// let exact = std::f64::consts::PI * (2.0 / 3.0 + 0.04 * 0.04 * (1.0 - 0.04 / 3.0));
/// assert!(left.is_some_and(|left| (left.volume() - exact).abs() < 5e-3));
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
///
/// # Errors
/// [`CutError::LostOnGrid`] where the finest cells still lose more, and what [`LevelSet::of`] finds wrong with `cell`.
pub fn cut_on_grid(
    lower: Arc<dyn Surface<3>>,
    higher: Arc<dyn Surface<3>>,
    cell: f64,
    lost: f64,
    window: &Bounds<3>,
) -> Result<Option<Mesh>, GeometryError> {
    let is_whole = window.contains_box(&lower.bounds());
    // The other body is asked only where the first one is; cells at the sides of what is asked are not used.
    let beside = (lower.bounds().intersection(*window)).grown(BESIDE_CELLS * cell);
    let mut size = cell;
    let mut missing = 0.0;
    for next in (0..=HALVINGS).map(|n| cell * 0.5_f64.powi(n)) {
        let set =
            |body: &Arc<dyn Surface<3>>, window| LevelSet::within(Arc::clone(body), next, window);
        let (from, by) = match (set(&lower, window), set(&higher, &beside)) {
            (Ok(from), Ok(by)) => (from, by),
            // Finer cells may be too many.
            (Err(e), _) | (_, Err(e)) if next == cell => return Err(e),
            _ => break,
        };
        size = next;
        let (left, taken) = (mesh(&from.minus(&by)?)?, mesh(&from.intersection(&by)?)?);
        let volume = |part: &Option<Mesh>| part.as_ref().map_or(0.0, Mesh::volume);
        let whole = if is_whole {
            lower.volume()
        } else {
            volume(&mesh(&from)?)
        };
        missing = (whole - volume(&left) - volume(&taken)).abs();
        if missing <= lost + LOST * whole {
            return Ok(left);
        }
    }
    Err(CutError::LostOnGrid {
        cell: size,
        volume: missing,
    }
    .into())
}

/// The mesh of a set; `None` where it holds next to nothing.
fn mesh(set: &LevelSet<3>) -> Result<Option<Mesh>, GeometryError> {
    match set.mesh() {
        Err(GeometryError::Mesh(MeshError::NoVolume { .. })) => Ok(None),
        found => found,
    }
}
