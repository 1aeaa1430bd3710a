//! Cuts on a grid that is as fine as what they leave.

use std::sync::Arc;

use super::LevelSet;
use crate::{CutError, GeometryError, Mesh, MeshError, Surface};

/// How often the cells are halved.
const HALVINGS: i32 = 3;

/// What a cut may lose beside what it is told, in parts of the body's volume: cells of ∆s/4 miss a ball of R = 5 ∆s by 0.05 %.
const LOST: f64 = 1e-3;

/// What is left of `lower` where `higher` takes its room, as a mesh; `None` where nothing is left. Cells of size `cell`
/// (scene units), halved up to three times while a slice thinner than a cell is lost: what is left and what is taken must
/// have the body's own [volume](Surface::volume) together, but for `lost` (scene units to the power 3) and a thousandth of it.
/// Costs two [level sets](LevelSet::of), two Booleans and two meshes for each size of cells.
///
/// ```
/// use std::sync::Arc;
/// use sphpack_geometry::{Ball, Cuboid, Surface, cut_on_grid};
/// let ball = Arc::new(Ball::new([0.0; 3], 1.0)?);
/// // A cap of height 0.04 is above the box.
/// let board = Arc::new(Cuboid::new([-2.0, -2.0, 0.0], [2.0, 2.0, 0.96])?);
/// let left = cut_on_grid(ball, board, 0.1, 1e-3)?;
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
) -> Result<Option<Mesh>, GeometryError> {
    let whole = lower.volume();
    let mut size = cell;
    let mut missing = 0.0;
    for next in (0..=HALVINGS).map(|n| cell * 0.5_f64.powi(n)) {
        let set = |body: &Arc<dyn Surface<3>>| LevelSet::of(Arc::clone(body), next);
        let (from, by) = match (set(&lower), set(&higher)) {
            (Ok(from), Ok(by)) => (from, by),
            // Finer cells may be too many.
            (Err(e), _) | (_, Err(e)) if next == cell => return Err(e),
            _ => break,
        };
        size = next;
        let (left, taken) = (mesh(&from.minus(&by)?)?, mesh(&from.intersection(&by)?)?);
        let volume = |part: &Option<Mesh>| part.as_ref().map_or(0.0, Mesh::volume);
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
