//! Loops before they are a body in the plane: whatever a file holds, what is wrong with it, and what can be mended.

mod body;
mod repair;
mod report;
mod survey;
#[cfg(test)]
mod tests;
mod trim;

use sphpack_neighbors::point;

use crate::{GeometryError, OutlineError};

pub use body::MendedOutline;
pub use repair::{OutlineRepair, RepairedSketch};
pub use report::{LoopRole, OutlineDefect, OutlineDefectKind, OutlineReport, SketchLoop};

/// Loops of points with any defect a file can have: crossings, loops that overlap or are there twice, spikes.
/// [`Sketch::check`] says what is wrong, [`Sketch::repaired`] mends what can safely be mended, and [`Sketch::body`] makes
/// an [`Outline`](crate::Outline) of it or says why not.
///
/// ```
/// use sphpack_geometry::{OutlineDefectKind, Sketch, Surface};
/// let square = |x: f64| vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
/// let sketch = Sketch::new(vec![square(0.0), square(0.75)])?;
/// assert!(sketch.check().defect(OutlineDefectKind::Overlap).is_some());
/// let mended = sketch.body()?;
/// assert_eq!(mended.done.len(), 1); // two loops were joined
/// assert!((mended.outline.volume() - 1.75).abs() < 1e-12);
/// # Ok::<(), sphpack_geometry::GeometryError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sketch {
    loops: Vec<Vec<[f64; 2]>>,
    /// What was done to make loops of what a file holds.
    done: Vec<OutlineRepair>,
}

impl Sketch {
    /// Loops, each the points on its way round; the last may repeat the first. Scene units.
    ///
    /// # Errors
    /// [`OutlineError::NotFinite`]; [`OutlineError::TooFewPoints`] where there is no loop at all.
    pub fn new(loops: Vec<Vec<[f64; 2]>>) -> Result<Self, GeometryError> {
        if loops.is_empty() {
            return Err(OutlineError::TooFewPoints {
                loop_index: 0,
                count: 0,
            }
            .into());
        }
        // Squares must stay finite too, or every distance is infinite.
        let is_bad = |&p: &[f64; 2]| !point::norm_squared(p).is_finite();
        match loops.iter().flatten().position(is_bad) {
            None => Ok(Self {
                loops,
                done: Vec::new(),
            }),
            Some(index) => Err(OutlineError::NotFinite { index }.into()),
        }
    }

    /// [`Sketch::new`] for loops of which there is something to say: it stands before what else is done to them.
    pub(crate) fn remarked(
        loops: Vec<Vec<[f64; 2]>>,
        done: Vec<OutlineRepair>,
    ) -> Result<Self, GeometryError> {
        Ok(Self {
            done,
            ..Self::new(loops)?
        })
    }

    /// The loops as they were given.
    pub fn loops(&self) -> &[Vec<[f64; 2]>] {
        &self.loops
    }
}
