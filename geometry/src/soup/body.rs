//! From triangles to a body, or the reason why not.

use super::repair::{HoleLimit, Repair};
use super::report::{DefectKind, MeshReport};
use super::{Repaired, Soup};
use crate::{GeometryError, Mesh};

/// A body, and what was done to its triangles to make it one.
#[derive(Debug, Clone)]
pub struct Mended {
    /// The body.
    pub mesh: Mesh,
    /// What was done, in this order; empty where nothing was wrong.
    pub done: Vec<Repair>,
}

impl Soup {
    /// The body that the triangles bound: as they are where nothing is wrong, else after [`Soup::repaired`] (holes
    /// within [`HoleLimit::Small`]). What was done is told.
    ///
    /// # Errors
    /// [`GeometryError::Defective`] with every defect that is left and its cure, or what [`Mesh::new`] finds.
    pub fn body(&self) -> Result<Mended, GeometryError> {
        let report = self.check();
        if report.is_clean() {
            let done = if self.welded > 0 {
                vec![Repair::Welded(self.welded)]
            } else {
                Vec::new()
            };
            let mesh = Mesh::new(self.vertices.clone(), self.triangles.clone())?;
            return Ok(Mended { mesh, done });
        }
        self.repaired(HoleLimit::Small).body()
    }
}

impl Repaired {
    /// The body that the mended triangles bound.
    ///
    /// # Errors
    /// [`GeometryError::Defective`] with every defect that is left and its cure, or what [`Mesh::new`] finds.
    pub fn body(self) -> Result<Mended, GeometryError> {
        let Self { soup, done, report } = self;
        if !report.is_clean() && report.volume != 0.0 {
            return Err(defective(&report));
        }
        let mesh = Mesh::new(soup.vertices, soup.triangles)?;
        Ok(Mended { mesh, done })
    }
}

/// What keeps a mesh from being a body.
fn defective(report: &MeshReport) -> GeometryError {
    let mut words = Vec::new();
    for defect in &report.defects {
        if defect.kind.is_harmless() {
            continue;
        }
        let mut text = match defect.kind {
            DefectKind::OpenEdge | DefectKind::NonManifold => {
                format!("the mesh is not closed: {defect}")
            }
            _ => defect.to_string(),
        };
        if defect.kind == DefectKind::OpenEdge
            && let Some(hole) = report.holes.first()
        {
            text += &format!(
                "; {} of {} edges, the largest {} across, too large to be closed unasked",
                match report.holes.len() {
                    1 => "1 hole".to_owned(),
                    n => format!("{n} holes"),
                },
                defect.count,
                super::report::four_digits(hole.size)
            );
        }
        words.push(format!("{text}; {}", defect.kind.cure()));
    }
    GeometryError::Defective {
        defects: words.join(". "),
    }
}
